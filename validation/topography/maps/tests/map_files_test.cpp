#include "validation/topography/maps/map_files.hpp"

#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "temporary_folder.hpp"

using namespace hts::validation;

namespace {

constexpr std::size_t columns = 18, rows = 16;

/// Heights [um] of the test's map, with a gap.
double height(std::size_t column, std::size_t row) {
    if (column == 3 && row == 2) return std::nan("");
    return 0.125 * static_cast<double>(column) - 0.5 * static_cast<double>(row);
}

template <class Number>
std::string bytes_of(Number value) {
    std::string text(sizeof(Number), '\0');
    std::memcpy(text.data(), &value, sizeof(Number));
    return text;
}

/// Calls f(height, column, row) by rows.
std::string by_rows(const std::function<std::string(double, std::size_t, std::size_t)>& f) {
    std::string text;
    for (std::size_t j = 0; j < rows; ++j) {
        for (std::size_t i = 0; i < columns; ++i) text += f(height(i, j), i, j);
    }
    return text;
}

std::string gsf(const std::string& head =
                    "XRes = 18\nYRes = 16\nXReal = 9e-6\nYReal = 4e-6\nXYUnits = m\nZUnits = nm\n") {
    std::string text = "Gwyddion Simple Field 1.0\n" + head;
    text.append(4 - text.size() % 4, '\0');
    return text + by_rows([](double z, auto, auto) { return bytes_of(static_cast<float>(1000 * z)); });
}

std::string matrix(char separator, const std::string& head = "") {
    return head + by_rows([separator](double z, std::size_t i, auto) {
               const std::string number = std::isnan(z) ? "nan" : hts::shortest(z);
               return number + (i + 1 == columns ? '\n' : separator);
           });
}

std::string points() {
    return "x,y,z\n" + by_rows([](double z, std::size_t i, std::size_t j) {
               if (std::isnan(z)) return std::string{};
               return hts::shortest(0.5 * static_cast<double>(i)) + "," +
                      hts::shortest(-0.25 * static_cast<double>(j)) + "," + hts::shortest(z) + "\n";
           });
}

std::string esri() {
    return "ncols 18\nnrows 16\nxllcorner 0\nyllcorner 0\ndx 0.5\ndy 0.25\nNODATA_value -9999\n" +
           by_rows([](double z, std::size_t i, auto) {
               return (std::isnan(z) ? std::string{"-9999"} : hts::shortest(z)) +
                      (i + 1 == columns ? "\n" : " ");
           });
}

std::string npy(const std::string& type, bool fortran, const std::string& shape = "(16, 18)") {
    std::string head = "{'descr': '" + type + "', 'fortran_order': " + (fortran ? "True" : "False") +
                       ", 'shape': " + shape + ", }";
    head.append(63 - (head.size() + 10) % 64 + 1, ' ');
    head.back() = '\n';
    std::string text = "\x93NUMPY\x01";
    text.append(1, '\0')
        .append(1, static_cast<char>(head.size() % 256))
        .append(1, static_cast<char>(head.size() / 256));
    text += head;
    const auto number = [&](double z) {
        const std::string bytes = type.substr(1) == "f8" ? bytes_of(z) : bytes_of(static_cast<float>(z));
        return type[0] == '>' ? std::string{bytes.rbegin(), bytes.rend()} : bytes;
    };
    for (std::size_t k = 0; k < columns * rows; ++k) {
        const std::size_t i = fortran ? k / rows : k % columns, j = fortran ? k % rows : k / columns;
        text += number(height(i, j));
    }
    return text;
}

/// Grey levels 1000 + column + 64 row in a PNG file of stored blocks.
std::string png(unsigned bits = 16) {
    const auto big = [](std::uint32_t x) {
        return std::string{static_cast<char>(x >> 24U), static_cast<char>(x >> 16U),
                           static_cast<char>(x >> 8U), static_cast<char>(x)};
    };
    const auto checksum = [](const std::string& text) {
        std::uint32_t c = 0xffffffffU;
        for (const char byte : text) {
            c ^= static_cast<unsigned char>(byte);
            for (int k = 0; k < 8; ++k) c = (c & 1U) != 0 ? 0xedb88320U ^ (c >> 1U) : c >> 1U;
        }
        return ~c;
    };
    const auto chunk = [&](const std::string& body) {
        return big(static_cast<std::uint32_t>(body.size() - 4)) + body + big(checksum(body));
    };
    std::string raw;
    for (std::size_t j = 0; j < rows; ++j) {
        raw += '\0';
        for (std::size_t i = 0; i < columns; ++i) {
            const std::size_t level = 1000 + i + 64 * j;
            if (bits == 16) raw += static_cast<char>(level >> 8U);
            raw += static_cast<char>(level);
        }
    }
    std::uint32_t a = 1, b = 0;
    for (const char byte : raw) {
        a = (a + static_cast<unsigned char>(byte)) % 65521;
        b = (b + a) % 65521;
    }
    const auto size = static_cast<std::uint16_t>(raw.size());
    std::string packed = "\x78\x01\x01";
    packed += bytes_of(size) + bytes_of(static_cast<std::uint16_t>(~size)) + raw + big(b << 16U | a);
    std::string head = "IHDR" + big(columns) + big(rows);
    head += static_cast<char>(bits);
    head.append(4, '\0');
    return "\x89PNG\r\n\x1a\n" + chunk(head) + chunk("IDAT" + packed) + chunk("IEND");
}

class Files {
  public:
    [[nodiscard]] HeightMap read(const std::string& name, const std::string& content,
                                 const MapUnits& units = {}) const {
        const auto path = folder_ / name;
        std::ofstream{path, std::ios::binary} << content;
        return read_height_map(path, units);
    }

  private:
    hts::testing::TemporaryFolder folder_;
};

void check_map(const HeightMap& map) {
    REQUIRE(map.columns() == columns);
    REQUIRE(map.rows() == rows);
    CHECK(map.step_x() == Approx(0.5).epsilon(1e-12));
    CHECK(map.step_y() == Approx(0.25).epsilon(1e-12));
    for (std::size_t j = 0; j < rows; ++j) {
        for (std::size_t i = 0; i < columns; ++i) {
            if (std::isnan(height(i, j)))
                CHECK(std::isnan(map.at(i, j)));
            else
                CHECK(map.at(i, j) == Approx(height(i, j)).margin(1e-6));
        }
    }
}

std::string complaint(const std::function<void()>& action) {
    try {
        action();
    } catch (const hts::Error& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace

TEST_CASE("one height map is read alike from every kind of file") {
    const Files files;
    const MapUnits step{0.5, 0.25, {}, 1}, units{{}, {}, 1, 1};
    check_map(files.read("a.gsf", gsf()));
    check_map(files.read("a.csv", matrix(','), step));
    check_map(files.read("a.txt", matrix(' '), step));
    check_map(files.read(
        "b.txt",
        matrix('\t', "# Channel: Height\n# Width: 9.0 \u00b5m\n# Height: 4000 nm\n# Value units: um\n")));
    check_map(files.read("a.asc", esri(), units));
    check_map(files.read("a.xyz", points(), units));
    for (const char* type : {"<f4", "<f8", ">f4"}) {
        for (const bool fortran : {false, true}) check_map(files.read("a.npy", npy(type, fortran), step));
    }
    const HeightMap picture = files.read("a.png", png(), {0.5, 0.25, {}, 0.001});
    CHECK(picture.at(5, 7) == Approx(1.453).epsilon(1e-12));
}

TEST_CASE("units are those of the file or those given, never both, never none") {
    const Files files;
    const MapUnits step{0.5, 0.25, {}, 1};
    const auto no_units = gsf("XRes = 18\nYRes = 16\n");
    CHECK(complaint([&] { (void)files.read("a.gsf", no_units); }).find("--height-unit") != std::string::npos);
    CHECK(files.read("a.gsf", no_units, {0.5, 0.5, {}, 0.001}).at(1, 0) == Approx(0.125));
    CHECK(complaint([&] { (void)files.read("a.gsf", gsf(), step); }).find("must not be given") !=
          std::string::npos);
    CHECK(complaint([&] {
              (void)files.read("a.csv", matrix(','), {0.5, 0.5, {}, {}});
          }).find("--height-unit") != std::string::npos);
    CHECK(complaint([&] {
              (void)files.read("a.csv", matrix(','), {{}, {}, {}, 1});
          }).find("--step") != std::string::npos);
    CHECK(complaint([&] {
              (void)files.read("a.csv", matrix(','), {0.5, 0.5, 1, 1});
          }).find("--length-unit") != std::string::npos);
    CHECK(complaint([&] { (void)files.read("a.xyz", points(), step); }).find("--step") != std::string::npos);
    for (const auto& [text, um] : {std::pair{"nm", 1e-3}, {"um", 1.0}, {"m", 1e6}, {"0.25", 0.25}})
        CHECK(length_unit(text) == um);
    for (const char* text : {"", "furlong", "-1", "0", "nan", "1e400"})
        CHECK_THROWS_AS(length_unit(text), hts::Error);
}

TEST_CASE("files that lie, lack or break off are refused with the one thing that is wrong") {
    const Files files;
    const MapUnits step{0.5, 0.25, {}, 1}, units{{}, {}, 1, 1};
    struct Bad {
        std::string name, content, part;
        MapUnits units{};
    };
    const std::string head = "XReal = 9e-6\nYReal = 4e-6\nXYUnits = m\nZUnits = m\n";
    std::string cut = gsf();
    cut.resize(cut.size() - 5);
    std::string short_png = png();
    short_png.resize(200);
    const std::vector<Bad> all{
        {"a.gsf", gsf("XRes = 1000000\nYRes = 1000\n" + head), "1e+06 by 1000 points"},
        {"a.gsf", gsf("XRes = 32\nYRes = 16\n" + head), "for 32 by 16 points"},
        {"a.gsf", gsf("XRes = 18.5\nYRes = 16\n" + head), "18.5 by 16 points"},
        {"a.gsf", gsf("XRes = -18\nYRes = 16\n" + head), "-18 by 16 points"},
        {"a.gsf", gsf("YRes = 16\n" + head), "XRes: missing"},
        {"a.gsf", gsf("XRes = 18\nXRes = 18\nYRes = 16\n" + head), "XRes: stands twice"},
        {"a.gsf", gsf("XRes = 18\nYRes = 16\nXReal = 0\nYReal = 1\nXYUnits = m\nZUnits = m\n"),
         "point spacing 0 um"},
        {"a.gsf", gsf("XRes = 18\nYRes = 16\nXReal = 1\nYReal = 1\nXYUnits = px\nZUnits = m\n"),
         "XYUnits: unit \"px\""},
        {"a.gsf", gsf("rubbish\n"), "key = value"},
        {"a.gsf", cut, "bytes of heights"},
        {"a.gsf", "Gwyddion Simple Field 1.0\nXRes = 18\n", "cut off in its head"},
        {"a.npy", npy("<f8", false, "(1000000, 1000)"), "1000 by 1e+06 points", step},
        {"a.npy", npy("<f8", false, "(288,)"), "must be (rows, columns)", step},
        {"a.npy", npy("<c8", false), "must be f4", step},
        {"a.npy", npy("<f8", false).substr(0, 900), "bytes of heights", step},
        {"a.npy", "\x93NUMPY\x01", "cut off", step},
        {"a.png", short_png, "PNG: ", step},
        {"a.png", png(8), "16 bits", step},
        {"a.csv", "1,2,3,4,5\n6,7,8\n", "line 2: 3 numbers: must be 5", step},
        {"a.csv", "1,2,3,4,5\n6,7,8,nine,10\n", "line 2: \"nine\" is not a number", step},
        {"a.csv", "1,2,3,4,5\n6,7,8,9,10\n", "5 by 2 points", step},
        {"a.csv", "1,2,3,4,inf\n", "\"inf\" is not a number", step},
        {"a.csv", "# nothing\n", "no heights", step},
        {"a.csv", "\n\n", "no heights", step},
        {"a.asc", "ncols 40000\nnrows 40000\ncellsize 1\n1 2 3\n", "40000 by 40000 points", units},
        {"a.asc", "ncols 20\nnrows 20\ncellsize 1\n1 2 3\n", "3 heights: must be 20 times 20", units},
        {"a.asc", "ncols 20\nnrows 20\n1 2 3\n", "", units},
        {"a.asc", "ncols 20\nncols 20\n", "line 2: ncols: stands twice", units},
        {"a.xyz", "x y z\n", "no points", units},
        {"a.xyz", "0 0 1\n1 0 1\n0 0 2\n", "all points have one y", units},
        {"a.xyz", points() + "0,0,1\n", "stands twice", units},
        {"a.xyz", points() + "0.13,0,1\n", "must be on a grid", units},
        {"a.bin", std::string("\x01\x00\x02", 3), "must be a .gsf"},
        {"a.txt", "\xff\xfe\xfd", "must be a .gsf"},
    };
    for (const Bad& bad : all) {
        const std::string message = complaint([&] { (void)files.read(bad.name, bad.content, bad.units); });
        INFO(bad.name << ": " << message);
        CHECK(message.find(bad.part) != std::string::npos);
        CHECK(message.find(bad.name + ": ") != std::string::npos);
        CHECK(message.find('\n') == std::string::npos);
    }
    CHECK(complaint([] { (void)read_height_map("/no/such/map.gsf"); }) == "/no/such/map.gsf: no such file");
}

TEST_CASE("maps without heights, or with one height alone, are none") {
    const auto made = [](std::vector<double> heights) {
        return HeightMap{"a", 16, 16, 1, 1, std::move(heights)};
    };
    CHECK(complaint([&] { (void)made(std::vector<double>(256, std::nan(""))); }).find("0 of 256 points") !=
          std::string::npos);
    CHECK(complaint([&] { (void)made(std::vector<double>(256, 2.0)); }) ==
          "all heights are 2 um: must differ");
    CHECK(complaint([&] { (void)made(std::vector<double>(255, 2.0)); }).find("255 heights") !=
          std::string::npos);
    std::vector<double> far(256, 0);
    far[7] = HUGE_VAL;
    CHECK(complaint([&] { (void)made(far); }).find("height inf um") != std::string::npos);
}

TEST_CASE("damaged files end in an error or in a map") {
    const Files files;
    const MapUnits all{0.5, 0.5, {}, 1};
    std::uint32_t state = 1;
    for (const auto& [name, content] : {std::pair{std::string{"a.gsf"}, gsf("XRes = 18\nYRes = 16\n")},
                                        {"a.npy", npy("<f8", false)},
                                        {"a.png", png()},
                                        {"a.csv", matrix(',')}}) {
        int maps = 0;
        for (int k = 0; k < 200; ++k) {
            std::string damaged = content;
            for (int changes = 0; changes < 3; ++changes) {
                state = state * 1664525U + 1013904223U;
                // heads more often than numbers
                const std::size_t place =
                    (state >> 8U) %
                    (k % 2 == 0 ? std::min<std::size_t>(100, damaged.size()) : damaged.size());
                damaged[place] = static_cast<char>(state >> 24U);
            }
            try {
                maps += files.read(name, damaged, all).columns() >= 16 ? 1 : 0;
            } catch (const hts::Error& error) {
                CHECK(std::string{error.what()}.find(name) != std::string::npos);
            }
        }
        INFO(name);
        CHECK(maps < 200);
    }
}

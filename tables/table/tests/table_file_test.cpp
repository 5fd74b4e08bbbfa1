// Files that are no tables, or no longer: a named error each, no crash, no large allocation.

#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include <catch2/catch.hpp>

#include "hts/sampling/random.hpp"
#include "table_fixture.hpp"
#include "tables/formats/little_endian.hpp"
#include "tables/formats/tests/damaged_files.hpp"
#include "tables/table/crc64.hpp"
#include "tables/table/table_contents.hpp"
#include "temporary_folder.hpp"

namespace {

using namespace hts;
using namespace hts::tables;
using namespace hts::tables::testing;

constexpr std::size_t version_at = 8, order_at = 12, header_size_at = 16, numbers_size_at = 24,
                      checksum_at = 32;
constexpr std::size_t prelude_bytes = 64;

template <class Number>
std::string with(std::string bytes, std::size_t at, Number value) {
    std::string little;
    append_little_endian(little, value);
    return bytes.replace(at, little.size(), little);
}

/// As if it had been written so.
std::string signed_again(std::string bytes) {
    const std::string_view all{bytes};
    const std::uint64_t sum = crc64(all.substr(checksum_at + 8), crc64(all.substr(0, checksum_at)));
    return with(std::move(bytes), checksum_at, sum);
}

/// The same table with a piece of its header replaced by one of the same length.
std::string with_header(const std::string& from, std::string to) {
    std::string bytes = small_bytes();
    const auto at = bytes.find(from);
    REQUIRE(at != std::string::npos);
    REQUIRE(to.size() <= from.size());
    to.append(from.size() - to.size(), ' ');
    return signed_again(bytes.replace(at, from.size(), to));
}

std::string refusal(const std::string& bytes) {
    return error_of([&] { return Table::from_bytes(bytes, "m.htst"); });
}

}  // namespace

TEST_CASE("a table is read as it was written, from memory and from a file") {
    const hts::testing::TemporaryFolder folder;
    const auto path = folder.write("m.htst", small_bytes());
    const Table table = Table::open(path);
    std::filesystem::remove(path);
    const auto& info = table.info();
    CHECK(table.bytes() == small_bytes().size());
    CHECK(info.source == small_job().source);
    CHECK(info.tolerance == 3e-2);
    CHECK(info.error.largest <= 3e-2);
    CHECK(info.wavelengths.size() == 3);
    CHECK(header_text(info_from_header(header_text(info), "again")) == header_text(info));
    CHECK_THAT(error_of([&] { return Table::open(path); }), Catch::Contains("cannot be read"));
    CHECK_THAT(error_of([&] { return Table::open(folder.path()); }), Catch::Contains("must be a file"));
}

TEST_CASE("files that are no tables are refused by name") {
    const std::string& good = small_bytes();
    CHECK_THAT(refusal(""), Catch::Contains("m.htst: is no table"));
    CHECK_THAT(refusal(std::string(1000, 'x')), Catch::Contains("is no table"));
    CHECK_THAT(refusal(good.substr(0, 63)), Catch::Contains("is no table"));
    CHECK_THAT(refusal(good.substr(0, 64)), Catch::Contains("cut short"));
    CHECK_THAT(refusal(good.substr(0, good.size() - 1)), Catch::Contains("cut short"));
    CHECK_THAT(refusal(good + "x"), Catch::Contains("must be the"));
    CHECK_THAT(refusal(with(good, version_at, std::uint32_t{2})),
               Catch::Contains("table format 2: must be format 1"));
    CHECK_THAT(refusal(with(good, order_at, other_byte_order)), Catch::Contains("big-endian"));
    std::string changed = good;
    changed[changed.size() / 2] = static_cast<char>(changed[changed.size() / 2] ^ 1);
    CHECK_THAT(refusal(changed), Catch::Contains("checksum"));
}

TEST_CASE("hostile headers are refused by name") {
    const std::string& good = small_bytes();
    const auto& nodes = small_table().info().nodes;
    const std::string ratio = "\"ratio\": " + std::to_string(nodes.ratio);
    constexpr std::uint64_t huge = ~std::uint64_t{0} - 63;
    CHECK_THAT(refusal(signed_again(with(good, header_size_at, huge))), Catch::Contains("at most 4 MiB"));
    CHECK_THAT(refusal(signed_again(with(good, header_size_at, std::uint64_t{0}))),
               Catch::Contains("must be the"));
    CHECK_THAT(refusal(signed_again(with(good, numbers_size_at, huge))), Catch::Contains("must be the"));
    CHECK_THAT(refusal(with_header(ratio, "\"ratio\": 9")), Catch::Contains("for the nodes and wavelengths"));
    CHECK_THAT(refusal(with_header(ratio, "\"ratio\": 0")), Catch::Contains("ratio"));
    CHECK_THAT(refusal(with_header(ratio, "\"ratio\":1e9")), Catch::Contains("must be from 5 to 65536"));
    CHECK_THAT(refusal(with_header(ratio, "\"ratio\":9.5")), Catch::Contains("must be a whole number"));
    CHECK_THAT(refusal(with_header("\"components\": 3", "\"components\": 0")), Catch::Contains("components"));
    CHECK_THAT(refusal(with_header("0.55", "0.45")), Catch::Contains("wavelength"));
    CHECK_THAT(refusal(with_header("\"tolerance\": 0.03", "\"tolerance\": null")),
               Catch::Contains("tolerance"));
    CHECK_THAT(refusal(with_header("\"float\"", "\"flat\"")), Catch::Contains("must be float or double"));
    CHECK_THAT(refusal(with_header("{", "[")), Catch::Contains("JSON"));
    const std::size_t numbers =
        prelude_bytes + from_little_endian<std::uint64_t>(good.substr(header_size_at));
    CHECK_THAT(refusal(signed_again(with(good, numbers, -1.0))),
               Catch::Contains("floor -1 1/sr: must be >= 0"));
    CHECK_THAT(refusal(signed_again(with(good, numbers + 3 * sizeof(double), -0.5))),
               Catch::Contains("uniform diffuse BRDF -0.5 1/sr: must be >= 0"));
    const auto not_a_number = std::bit_cast<std::uint32_t>(std::numeric_limits<float>::quiet_NaN());
    CHECK_THAT(refusal(signed_again(with(good, good.size() - 4, not_a_number))),
               Catch::Contains("not finite"));
}

TEST_CASE("damaged tables are refused or read, and never crash") {
    // A small file, so that most changes meet the header; the numbers follow the same code for any count.
    const auto grid = spectral::WavelengthGrid::from_micrometres({0.5});
    const TableSource source{"s", "{}", "s.json"};  // apart: g++ 12 takes a nested one for uninitialised
    const TableInfo info{source, grid, 0.1, {}, {}, {5, 5, 5, 5, 5, 5}, 1, false, "0"};
    const TableCounts count = counts(info);
    const OwnedNumbers numbers{{1e-9},
                               {0.1},
                               std::vector<double>(count.specular, 0.5),
                               std::vector<double>(count.albedo, 0.5),
                               std::vector<double>(count.polarisation, 0.5),
                               {1.0},
                               std::vector<double>(count.lobe - 1, 0.3)};
    const std::string good = table_bytes(info, numbers);
    const auto header = from_little_endian<std::uint64_t>(good.substr(header_size_at));
    const auto past_checksum = [&](std::string bytes, Random& random) {
        const bool sizes = random.bits() % 2 == 0, sign = random.bits() % 4 != 0;
        if (bytes.size() < prelude_bytes) return bytes;
        const std::size_t behind = bytes.size() - prelude_bytes;
        if (sizes) {
            bytes = with(std::move(bytes), numbers_size_at,
                         std::uint64_t{behind - std::min<std::size_t>(header, behind)});
        }
        return sign ? signed_again(std::move(bytes)) : bytes;
    };
    const auto read = [](const std::string& bytes) {
        const Table table = Table::from_bytes(bytes, "damaged");
        std::vector<double> values(table.wavelengths().size());
        std::vector<Mueller> matrices(values.size());
        table.brdf({Direction::from_degrees(30, 0), Direction::from_degrees(80, 100)}, values);
        for (const double value : values) require_sound(value >= 0);
        table.specular_reflectance(Direction::from_degrees(89, 0), values);
        for (const double value : values) require_sound(value >= 0);
        table.mueller({Direction::from_degrees(0, 0), Direction::from_degrees(0, 0)}, matrices);
    };
    check_damaged({"native table",
                   good,
                   prelude_bytes + header,
                   {"0", "9", "-", "1e9", "1e308", "1e999", ",", ":", "[", "]", "{", "}", "\"", "null",
                    std::string(8, '\0'), std::string(8, '\xff'), std::string("\0\0\xc0\x7f", 4)},
                   read,
                   past_checksum,
                   2000,
                   1'000'000});
}

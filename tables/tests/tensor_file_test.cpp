#include "tables/tensor_file.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "comparison.hpp"
#include "materials.hpp"
#include "tables/little_endian.hpp"
#include "tables/pbsdf.hpp"
#include "tables/rgl.hpp"
#include "tables/whole_file.hpp"

namespace {

using namespace hts;
using namespace hts::tables;
using hts::tables::testing::brdf_of;
using hts::testing::exhaustive;
namespace fs = std::filesystem;

const std::vector<float> six{1, 2, 3, 4, 5, 6.5F};

TensorFileWriter small() {
    TensorFileWriter writer;
    writer.add("description", "text");
    writer.add("a", {2, 3}, six);
    writer.add("words", {1}, std::vector<std::uint16_t>{513});
    return writer;
}

/// Offsets in `small()`: magic 12, version 2, count 4, then the first field.
constexpr std::size_t version = 12, field_count = 14, first_field = 18;
constexpr std::size_t second_field = first_field + 2 + 11 + 2 + 1 + 8 + 8;
constexpr std::size_t second_type = second_field + 2 + 1 + 2, second_offset = second_type + 1;
constexpr std::size_t second_shape = second_offset + 8;

template <class Number>
std::string with(std::size_t at, Number number) {
    std::string bytes = small().bytes(), patch;
    append_little_endian(patch, number);
    std::copy(patch.begin(), patch.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
    return bytes;
}

void refused(std::string bytes, const std::string& message) {
    CHECK_THROWS_WITH(TensorFile::parse(std::move(bytes), "x.bsdf"),
                      Catch::StartsWith("x.bsdf: ") && Catch::Contains(message));
}

/// Reads it as every format does; errors are hts::Error, anything else fails the test.
bool survives(const std::string& bytes) {
    bool read = false;
    const auto attempt = [&](const auto& action) {
        try {
            action();
            read = true;
        } catch (const Error&) {
        }
    };
    const DirectionPair pair{Direction::from_degrees(40, 30), Direction::from_degrees(50, 200)};
    const DirectionPair vertical{Direction::from_degrees(0, 0), Direction::from_degrees(0, 0)};
    std::vector<double> values(16);
    attempt([&] {
        const auto brdf = parse_rgl(bytes, "x.bsdf");
        values.resize(brdf->wavelengths().size());
        for (const DirectionPair& each : {pair, vertical}) {
            brdf->brdf(each, values);
            for (const double value : values) REQUIRE((std::isfinite(value) && value >= 0));
            REQUIRE(std::isfinite(brdf->density(each)));
            static_cast<void>(brdf->sample(each.in, 0.3, 0.999));
        }
    });
    attempt([&] {
        const auto brdf = parse_pbsdf(bytes, "x.pbsdf");
        values.resize(5);
        std::vector<Mueller> matrices(5);
        for (const DirectionPair& each : {pair, vertical}) {
            brdf->brdf(each, values);
            brdf->mueller(each, matrices);
            for (const double value : values) REQUIRE((!std::isnan(value) && value >= 0));
        }
    });
    return read;
}

std::string mutated(std::string bytes, std::mt19937_64& random) {
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    static const std::vector<std::string> evil{std::string(4, '\0'),
                                               std::string(8, '\0'),
                                               std::string(4, '\xff'),
                                               std::string(8, '\xff'),
                                               std::string("\0\0\xc0\x7f", 4),
                                               std::string("\0\0\x80\xff", 4),
                                               std::string("\0\0\0\0\0\0\0\x80", 8)};
    for (std::size_t i = 0, changes = 1 + below(3); i < changes && bytes.size() > 16; ++i) {
        const std::size_t header =
            std::min<std::size_t>(bytes.size(), 420);  // most changes where they matter
        const std::size_t at = below(below(4) != 0 ? header : bytes.size());
        switch (below(5)) {
            case 0:
                bytes[at] = static_cast<char>(random());
                break;
            case 1:
                bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
                break;
            case 2:
                bytes.resize(at);
                break;
            case 3:
                bytes = bytes.substr(0, at).append(bytes, below(bytes.size()), 16).append(bytes, at);
                break;
            default: {
                const std::string& patch = evil[below(evil.size())];
                std::copy(
                    patch.begin(), patch.end(),
                    bytes.begin() + static_cast<std::ptrdiff_t>(std::min(at, bytes.size() - patch.size())));
            }
        }
    }
    return bytes;
}

}  // namespace

TEST_CASE("a tensor file holds what was put in, at multiples of 8 bytes") {
    const std::string bytes = small().bytes();
    const TensorFile file = TensorFile::parse(bytes, "x.bsdf");
    CHECK(file.floats("a", 2).numbers == six);
    CHECK(file.shape("a") == TensorShape{2, 3});
    CHECK(file.words("words") == std::vector<std::uint16_t>{513});
    CHECK(file.octets("description") == std::vector<std::uint8_t>{'t', 'e', 'x', 't'});
    CHECK(file.contains("a"));
    CHECK_FALSE(file.contains("b"));
    // the bytes themselves, as the format's description has them
    CHECK(bytes.substr(0, 18) == std::string("tensor_file\0\1\0\3\0\0\0", 18));
    CHECK(bytes.substr(second_field, 6) == std::string("\1\0a\2\0\x0a", 6));
    const auto offset = from_little_endian<std::uint64_t>(bytes.substr(second_offset));
    CHECK(offset % 8 == 0);
    CHECK(bytes.substr(offset + 20, 4) == std::string("\0\0\xd0\x40", 4));  // 6.5
}

TEST_CASE("what is no tensor file is refused by name") {
    refused("", "is no tensor file");
    refused(std::string(100, 'x'), "is no tensor file");
    refused(with(version, std::uint8_t{2}), "version 2.0");
    refused(with(version + 1, std::uint8_t{1}), "version 1.1");
    refused(with(field_count, std::uint32_t{0x03000000}),
            "number of fields 50331648: must be at most");  // big-endian 3
    refused(with(field_count, std::uint32_t{4}), "x.bsdf");
    refused(with(first_field, std::uint16_t{0}), "name is empty");
    refused(with(first_field, std::uint16_t{65535}), "truncated");
    refused(with(second_type, std::uint8_t{0}), "field \"a\": type 0");
    refused(with(second_type, std::uint8_t{12}), "field \"a\": type 12");
    refused(with(second_type - 2, std::uint16_t{17}), "17 dimensions");
    refused(with(second_shape, std::uint64_t{0}), "a size of 0");
    refused(with(second_shape, std::uint64_t{1} << 63), "more numbers than the file has room for");
    refused(with(second_shape, std::uint64_t{7}), "field \"a\":");
    refused(with(second_offset, ~std::uint64_t{0}), "reaches beyond the end");
    refused(with(second_offset, std::uint64_t{8}), "starts inside the header");
    TensorFileWriter twins;
    twins.add("a", {6}, six);
    twins.add("a", {6}, six);
    refused(twins.bytes(), "field \"a\": is there twice");
    const std::string whole = small().bytes();
    for (std::size_t length = 0; length < whole.size(); ++length)
        CHECK_THROWS_AS(TensorFile::parse(whole.substr(0, length), "x"), Error);
}

TEST_CASE("fields that are not as asked for are refused by name") {
    const TensorFile file = TensorFile::parse(small().bytes(), "x.bsdf");
    CHECK_THROWS_WITH(file.floats("b", 1), "x.bsdf: field \"b\": is missing");
    CHECK_THROWS_WITH(file.floats("a", 3), "x.bsdf: field \"a\": 2 dimensions: must be 3");
    CHECK_THROWS_WITH(file.floats("words", 1), "x.bsdf: field \"words\": type u16: must be f32");
    TensorFileWriter writer;
    writer.add("a", {2}, std::vector<float>{1, std::numeric_limits<float>::quiet_NaN()});
    const TensorFile nan = TensorFile::parse(writer.bytes(), "x.bsdf");
    CHECK_THROWS_WITH(nan.floats("a", 1), "x.bsdf: field \"a\": number 1 is not finite");
    CHECK(nan.floats("a", 1, NotFinite::kept).numbers.size() == 2);
}

TEST_CASE("mutated files give an error or a reflectance, never anything else") {
    const auto grid = spectral::WavelengthGrid::linear(0.45, 0.65, 5);
    const auto brdf = brdf_of("rough-aluminium.json", grid);
    const fs::path path = fs::temp_directory_path() / "hts-mutated.bsdf";
    write_rgl(*brdf, path, {2, 2, 3, 8});
    const std::string rgl = read_whole_file(path);
    write_pbsdf(*brdf, path, {2, 2, 2});
    const std::string pbsdf = read_whole_file(path);
    REQUIRE(survives(rgl));
    REQUIRE(survives(pbsdf));
    std::mt19937_64 random{11};
    const std::size_t files = exhaustive() ? 500'000 : 1500;
    std::size_t read = 0;
    for (std::size_t i = 0; i < files; ++i) {
        if (survives(mutated(rgl, random))) ++read;
        if (survives(mutated(pbsdf, random))) ++read;
    }
    fs::remove(path);
    WARN(2 * files << " mutated files, " << read << " still readable");
    CHECK(read > 0);
    CHECK(read < 2 * files);
}

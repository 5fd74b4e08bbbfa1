#include "tables/formats/mitsuba/tensor_file.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "damaged_files.hpp"
#include "materials.hpp"
#include "tables/formats/little_endian.hpp"
#include "tables/formats/mitsuba/pbsdf.hpp"
#include "tables/formats/mitsuba/rgl.hpp"
#include "tables/formats/whole_file.hpp"
#include "temporary_folder.hpp"

namespace {

using namespace hts;
using namespace hts::tables;
using hts::tables::testing::brdf_of;
using hts::tables::testing::check_damaged;
using hts::tables::testing::require_sound;
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

const DirectionPair aslant{Direction::from_degrees(40, 30), Direction::from_degrees(50, 200)};
const DirectionPair upright{Direction::from_degrees(0, 0), Direction::from_degrees(0, 0)};

void read_as_rgl(const std::string& bytes) {
    const auto brdf = parse_rgl(bytes, "x.bsdf");
    std::vector<double> values(brdf->wavelengths().size());
    for (const DirectionPair& each : {aslant, upright}) {
        brdf->brdf(each, values);
        for (const double value : values) require_sound(std::isfinite(value) && value >= 0);
        require_sound(std::isfinite(brdf->density(each)));
        static_cast<void>(brdf->sample(each.in, 0.3, 0.999));
    }
}

void read_as_pbsdf(const std::string& bytes) {
    const auto brdf = parse_pbsdf(bytes, "x.pbsdf");
    std::vector<double> values(brdf.wavelengths().size());
    std::vector<Mueller> matrices(values.size());
    for (const DirectionPair& each : {aslant, upright}) {
        brdf.brdf(each, values);
        brdf.mueller(each, matrices);
        for (const double value : values) require_sound(!std::isnan(value) && value >= 0);
    }
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

TEST_CASE("damaged tensor files give an error or a reflectance, never anything else") {
    const auto grid = spectral::WavelengthGrid::linear(0.45, 0.65, 5);
    const auto brdf = brdf_of("rough-aluminium.json", grid);
    const hts::testing::TemporaryFolder folder;
    const fs::path path = folder.path() / "small.bsdf";
    const std::vector<std::string> nasty{std::string(4, '\0'),
                                         std::string(8, '\0'),
                                         std::string(4, '\xff'),
                                         std::string(8, '\xff'),
                                         std::string("\0\0\xc0\x7f", 4),
                                         std::string("\0\0\x80\xff", 4),
                                         std::string("\0\0\0\0\0\0\0\x80", 8)};
    write_rgl(brdf, path, {2, 2, 3, 8});
    check_damaged({"RGL", read_whole_file(path), 420, nasty, read_as_rgl, {}, 1500, 500'000});
    write_pbsdf(brdf, path, {2, 2, 2});
    check_damaged({"pbsdf", read_whole_file(path), 420, nasty, read_as_pbsdf, {}, 1500, 500'000});
}

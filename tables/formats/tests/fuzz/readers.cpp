// Every reader of bytes, for libFuzzer: the first byte of an input says which reader takes the rest. What a
// reader refuses it must refuse with hts::Error; anything else that is thrown ends the
// program, as do the sanitizers.
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "hts/error.hpp"
#include "spectral/materials/optical_constants_yaml.hpp"
#include "spectral/models/material.hpp"
#include "spectral/text/csv.hpp"
#include "spectral/text/png.hpp"
#include "tables/formats/mitsuba/pbsdf.hpp"
#include "tables/formats/mitsuba/rgl.hpp"
#include "tables/formats/points/scatter_points.hpp"
#include "tables/formats/radiance/radiance_xml.hpp"
#include "tables/formats/zemax.hpp"
#include "tables/table/table.hpp"

namespace {

using namespace hts;

using Reader = void (*)(const std::string& bytes);

/// In the order that run counts in.
constexpr std::array<Reader, 11> readers{
    [](const std::string& bytes) { static_cast<void>(spectral::material_from_text(bytes, "m.json")); },
    [](const std::string& bytes) { static_cast<void>(spectral::material_from_yaml(bytes, "m", "m.yml")); },
    [](const std::string& bytes) { static_cast<void>(spectral::CsvTable::parse(bytes, "t.csv")); },
    [](const std::string& bytes) { static_cast<void>(spectral::png_pixels(bytes)); },
    [](const std::string& bytes) { static_cast<void>(tables::Table::from_bytes(bytes, "t.htst")); },
    [](const std::string& bytes) { static_cast<void>(tables::points_of_csv(bytes, "p.csv")); },
    [](const std::string& bytes) { static_cast<void>(tables::points_of_astm(bytes, "p.astm")); },
    [](const std::string& bytes) { static_cast<void>(tables::zemax_brdf(bytes, "z.bsdf")); },
    [](const std::string& bytes) { static_cast<void>(tables::radiance_brdf(bytes, "r.xml")); },
    [](const std::string& bytes) { static_cast<void>(tables::parse_rgl(bytes, "r.bsdf")); },
    [](const std::string& bytes) { static_cast<void>(tables::parse_pbsdf(bytes, "p.pbsdf")); },
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::string bytes{data + 1, data + size};
    try {
        readers[data[0] % readers.size()](bytes);
    } catch (const Error&) {
    }
    return 0;
}

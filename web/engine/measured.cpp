// Measured points of the text files that need no library to be read.

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "engine.hpp"
#include "hts/error.hpp"
#include "spectral/text/csv.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/points/astm.hpp"
#include "tables/formats/points/bird.hpp"
#include "tables/formats/points/fred.hpp"
#include "tables/formats/points/lighttools.hpp"

namespace hts::page {
namespace {

using spectral::WavelengthGrid;

double value_at(const spectral::CsvTable& table, std::size_t row, std::optional<std::size_t> column,
                double otherwise) {
    return column ? table.number(row, *column) : otherwise;
}

// A table with a row per point, whose azimuths and wavelengths may be left out.
json points_of_table(const json& request, const std::string& file, const std::string& text) {
    const auto table = spectral::CsvTable::parse(text, file);
    const auto brdf = table.find_column("brdf") ? table.find_column("brdf") : table.find_column("value");
    if (!brdf)
        throw Error{table.where_header() + "column \"brdf\" or \"value\": missing; must be the BRDF in 1/sr"};
    const auto theta_i = table.column("theta_i_deg"), theta_r = table.column("theta_r_deg");
    const auto phi_i = table.find_column("phi_i_deg");
    const auto phi_r =
        table.find_column("phi_r_deg") ? table.find_column("phi_r_deg") : table.find_column("phi_deg");
    const auto named = table.find_wavelength();
    const auto first = table.find_column("first_um"), last = table.find_column("last_um");
    json points = json::array();
    for (std::size_t row = 0; row < table.row_count(); ++row) {
        double wavelength = named ? named->micrometres(table.number(row, named->place))
                                  : request.at("wavelength_um").get<double>();
        if (first && last) wavelength = (table.number(row, *first) + table.number(row, *last)) / 2;
        const double i = table.number(row, theta_i), r = table.number(row, theta_r);
        if (!(i >= 0 && i <= 90))
            throw table.error(row, out_of_range("theta_i_deg", i, "deg", "0 ... 90").what());
        if (!(std::abs(r) <= 90))
            throw table.error(row, out_of_range("theta_r_deg", r, "deg", "-90 ... 90").what());
        if (!(wavelength > 0))
            throw table.error(row, out_of_range("wavelength", wavelength, "um", "> 0").what());
        double phi = value_at(table, row, phi_r, 180) - value_at(table, row, phi_i, 0);
        if (r < 0) phi += 180;
        points.push_back({i, std::abs(r), std::remainder(phi, 360), wavelength, table.number(row, *brdf)});
    }
    if (points.empty()) throw Error{file + ": table without a row: must have at least one"};
    return {
        {"points", points}, {"wavelength_from_page", !named && !(first && last)}, {"notes", json::array()}};
}

// A scatter file of another program.
struct Format {
    bool (*is)(std::string_view text);
    bool (*names_wavelengths)(const std::string& text, const std::string& file);
    /// `wavelengths` of a file that names none; azimuths count as the page says, where files differ.
    tables::ScatterPoints (*points)(const std::string& text, const std::string& file,
                                    const std::optional<WavelengthGrid>& wavelengths, double mirror_azimuth);
};

const std::array formats{Format{tables::is_fred_file, [](const auto&, const auto&) { return false; },
                                [](const auto& text, const auto& file, const auto& at, double mirror) {
                                    return tables::points_of_fred(text, file, at, mirror);
                                }},
                         Format{tables::is_lighttools_file, [](const auto&, const auto&) { return true; },
                                [](const auto& text, const auto& file, const auto& at, double) {
                                    return tables::points_of_lighttools(text, file, at);
                                }},
                         Format{tables::is_bird_file, tables::bird_names_wavelengths,
                                [](const auto& text, const auto& file, const auto& at, double) {
                                    return tables::points_of_bird(text, file, at);
                                }},
                         Format{tables::is_astm_file,
                                [](const auto& text, const auto& file) {
                                    const auto names = tables::astm_file(text, file).channel_names;
                                    return names.size() != 1 || names[0].ends_with("nm");
                                },
                                [](const auto& text, const auto& file, const auto& at, double) {
                                    return tables::points_of_astm(text, file, at);
                                }}};

// None where a text is in none of these formats.
const Format* format_of(const std::string& text) {
    for (const Format& format : formats)
        if (format.is(text)) return &format;
    return nullptr;
}

// What names no wavelength is taken to be at the page's.
json points_of_format(const Format& format, const json& request, const std::string& file,
                      const std::string& text) {
    std::optional<WavelengthGrid> here;
    if (!format.names_wavelengths(text, file))
        here = WavelengthGrid::from_micrometres({request.at("wavelength_um").get<double>()});
    const auto [wavelengths, angles, values, lines, notes, channels] =
        format.points(text, file, here, request.at("mirror_azimuth_deg"));
    if (!channels.empty())
        throw Error{file + ": channels " + spectral::joined(channels) +
                    ": must be wavelengths, which colours are not"};
    json points = json::array();
    for (std::size_t i = 0; i < angles.size(); ++i)
        for (std::size_t w = 0; w < wavelengths.size(); ++w)
            points.push_back({angles[i].theta_i, angles[i].theta_r,
                              std::remainder(angles[i].phi_r - angles[i].phi_i, 360),
                              wavelengths[w].micrometres(), values[i * wavelengths.size() + w]});
    return {{"points", points}, {"wavelength_from_page", here.has_value()}, {"notes", notes}};
}

}  // namespace

bool is_scatter_file(const std::string& text) {
    return format_of(text) != nullptr;
}

json curve(const json& request) {
    const std::string file = request.at("file");
    const std::string text = spectral::checked_text(request.at("text"), file);
    const Format* const format = format_of(text);
    return format == nullptr ? points_of_table(request, file, text)
                             : points_of_format(*format, request, file, text);
}

}  // namespace hts::page

// Measured points of the text files that need no library to be read.

#include <cmath>
#include <optional>

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
    const auto um = table.find_column("wavelength_um"), nm = table.find_column("wavelength_nm");
    const auto first = table.find_column("first_um"), last = table.find_column("last_um");
    json points = json::array();
    for (std::size_t row = 0; row < table.row_count(); ++row) {
        double wavelength = value_at(table, row, um, request.at("wavelength_um"));
        if (nm) wavelength = table.number(row, *nm) / 1000;
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
    return {{"points", points},
            {"wavelength_from_page", !um && !nm && !(first && last)},
            {"notes", json::array()}};
}

// A file of one channel that names no wavelength is taken to be at the page's.
struct Read {
    tables::ScatterPoints points;
    bool wavelength_from_page = false;
};

// None of a text that is in none of these formats.
std::optional<Read> scatter_points(const json& request, const std::string& file, const std::string& text) {
    const auto here = WavelengthGrid::from_micrometres({request.at("wavelength_um").get<double>()});
    const double mirror = request.at("mirror_azimuth_deg");
    if (tables::is_fred_file(text)) return Read{tables::points_of_fred(text, file, here, mirror), true};
    if (tables::is_lighttools_file(text)) return Read{tables::points_of_lighttools(text, file, std::nullopt)};
    if (tables::is_bird_file(text)) {
        const bool says = text.find("\"wavelength\"") != std::string::npos;
        return Read{tables::points_of_bird(text, file, says ? std::nullopt : std::optional{here}, 180),
                    !says};
    }
    if (!tables::is_astm_file(text)) return std::nullopt;
    const auto names = tables::astm_file(text, file).channel_names;
    const bool says = names.size() != 1 || names[0].ends_with("nm");
    return Read{tables::points_of_astm(text, file, says ? std::nullopt : std::optional{here}), !says};
}

json listed(const Read& read, const std::string& file) {
    const auto& [wavelengths, angles, values, lines, notes, channels] = read.points;
    if (!channels.empty())
        throw Error{file + ": channels " + spectral::joined(channels) +
                    ": must be wavelengths, which colours are not"};
    json points = json::array();
    for (std::size_t i = 0; i < angles.size(); ++i)
        for (std::size_t w = 0; w < wavelengths.size(); ++w)
            points.push_back({angles[i].theta_i, angles[i].theta_r,
                              std::remainder(angles[i].phi_r - angles[i].phi_i, 360),
                              wavelengths[w].micrometres(), values[i * wavelengths.size() + w]});
    return {{"points", points}, {"wavelength_from_page", read.wavelength_from_page}, {"notes", notes}};
}

}  // namespace

bool is_scatter_file(const std::string& text) {
    return tables::is_fred_file(text) || tables::is_lighttools_file(text) || tables::is_bird_file(text) ||
           tables::is_astm_file(text);
}

json curve(const json& request) {
    const std::string file = request.at("file");
    const std::string text = spectral::checked_text(request.at("text"), file);
    const auto read = scatter_points(request, file, text);
    return read ? listed(*read, file) : points_of_table(request, file, text);
}

}  // namespace hts::page

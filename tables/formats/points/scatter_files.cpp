#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "hts/error.hpp"
#include "spectral/colour/display_colour.hpp"
#include "spectral/text/csv.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/channels.hpp"
#include "tables/formats/points/astm.hpp"
#include "tables/formats/points/scatter_points.hpp"

namespace hts::tables {
namespace {

using spectral::WavelengthGrid;

// What the columns of values are: wavelengths, and which column is the first of them, the second …
struct ChannelColumns {
    WavelengthGrid wavelengths;
    std::vector<std::size_t> order;
    bool tristimulus = false;  // columns X, Y, Z
};

// 0.55 of "550nm", none of other names.
std::optional<double> wavelength_named(std::string_view name) {
    if (!name.ends_with("nm")) return std::nullopt;
    name.remove_suffix(2);
    try {
        return spectral::number_in(name) / 1000;
    } catch (const Error&) {
        return std::nullopt;
    }
}

std::vector<std::size_t> in_order(const std::vector<double>& wavelengths) {
    std::vector<std::size_t> order(wavelengths.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return wavelengths[a] < wavelengths[b]; });
    return order;
}

ChannelColumns channels_named(const std::string& file, const std::vector<std::string>& names,
                              const std::optional<WavelengthGrid>& given) {
    std::vector<double> wavelengths;
    for (const std::string& name : names)
        if (const auto wavelength = wavelength_named(name)) wavelengths.push_back(*wavelength);
    ChannelColumns result{given ? *given : rgb_wavelengths(), {}};
    if (names == std::vector<std::string>{"R", "G", "B"}) {
        result.order = {2, 1, 0};
    } else if (names == std::vector<std::string>{"X", "Y", "Z"}) {
        result.order = {0, 1, 2};
        result.tristimulus = true;
    } else if (!names.empty() && wavelengths.size() == names.size()) {
        result.order = in_order(wavelengths);
        std::sort(wavelengths.begin(), wavelengths.end());
        result.wavelengths =
            spectral::located(file, [&] { return WavelengthGrid::from_micrometres(wavelengths); });
    } else if (names.size() != 1) {
        throw Error{file + ": channels " + spectral::in_quotes(spectral::joined(names)).substr(0, 80) +
                    ": must be wavelengths such as 550nm, or R, G, B, or X, Y, Z, or one"};
    } else if (given) {
        result.order = {0};
    } else {
        throw Error{file + ": does not say its wavelength, which must be given"};
    }
    if (result.wavelengths.size() != names.size()) {
        throw Error{file + ": holds " + std::to_string(names.size()) + " channels, not " +
                    std::to_string(result.wavelengths.size())};
    }
    return result;
}

// Values of a point in the order of wavelengths; negative ones, which measurements have, become 0.
void append_values(std::vector<double>& values, const std::vector<double>& columns,
                   const ChannelColumns& channels) {
    if (channels.tristimulus) {
        const auto rgb =
            spectral::linear_srgb({columns[0], columns[1], columns[2]}, spectral::Illuminant::D65);
        for (const double value : {rgb.blue, rgb.green, rgb.red}) values.push_back(std::max(0.0, value));
        return;
    }
    for (const std::size_t column : channels.order) values.push_back(std::max(0.0, columns[column]));
}

class CsvPoints {
  public:
    CsvPoints(std::string_view text, const std::string& name)
        : table_{spectral::CsvTable::parse(text, name)} {
        theta_i_ = table_.column("theta_i_deg");
        theta_r_ = table_.column("theta_r_deg");
        phi_r_ = table_.column("phi_r_deg");
        phi_i_ = table_.find_column("phi_i_deg");
        if (table_.row_count() == 0) throw Error{name + ": no points"};
    }

    [[nodiscard]] ScatterPoints read(const std::optional<WavelengthGrid>& given) const {
        if (const auto value = table_.find_column("brdf")) {
            if (const auto wavelength = table_.find_column("wavelength_um"))
                return by_rows(*value, *wavelength);
        }
        return by_columns(given);
    }

  private:
    [[nodiscard]] double angle(std::size_t row, std::size_t column, double least, double most) const {
        const double degrees = table_.number(row, column);
        if (degrees >= least && degrees <= most) return degrees;
        throw table_.error(
            row, column,
            out_of_range("angle", degrees, "deg", "from " + shortest(least) + " to " + shortest(most))
                .what());
    }
    [[nodiscard]] ScatterAngles angles(std::size_t row) const {
        return {angle(row, theta_i_, 0, 90), phi_i_ ? angle(row, *phi_i_, -1e6, 1e6) : 0,
                angle(row, theta_r_, 0, 90), angle(row, phi_r_, -1e6, 1e6)};
    }
    [[nodiscard]] ScatterPoints by_columns(const std::optional<WavelengthGrid>& given) const {
        std::vector<std::string> names;
        std::vector<std::size_t> columns;
        for (std::size_t i = 0; i < table_.columns().size(); ++i) {
            const std::string& column = table_.columns()[i];
            if (column != "brdf" && !(column.starts_with("brdf_") && wavelength_named(column.substr(5))))
                continue;
            names.push_back(column == "brdf" ? column : column.substr(5));
            columns.push_back(i);
        }
        if (columns.empty())
            throw Error{table_.name() + R"(: column "brdf" or "brdf_550nm" or the like: missing)"};
        const ChannelColumns channels = channels_named(table_.name(), names, given);
        ScatterPoints points{channels.wavelengths, {}, {}};
        std::vector<double> row_values(columns.size());
        for (std::size_t row = 0; row < table_.row_count(); ++row) {
            for (std::size_t k = 0; k < columns.size(); ++k) row_values[k] = table_.number(row, columns[k]);
            points.angles.push_back(angles(row));
            append_values(points.values, row_values, channels);
        }
        return points;
    }
    // A row per point and wavelength, in any order.
    [[nodiscard]] ScatterPoints by_rows(std::size_t value, std::size_t wavelength) const {
        std::vector<double> wavelengths;
        for (std::size_t row = 0; row < table_.row_count(); ++row)
            wavelengths.push_back(table_.number(row, wavelength));
        std::sort(wavelengths.begin(), wavelengths.end());
        wavelengths.erase(std::unique(wavelengths.begin(), wavelengths.end()), wavelengths.end());
        ScatterPoints points{
            spectral::located(table_.name(), [&] { return WavelengthGrid::from_micrometres(wavelengths); }),
            {},
            {}};
        // values at the wavelengths seen of each point; a point lacks some until its last row
        std::map<std::array<double, 4>, std::map<double, double>> found;
        for (std::size_t row = 0; row < table_.row_count(); ++row) {
            const ScatterAngles at = angles(row);
            found[{at.phi_i, at.theta_i, at.phi_r, at.theta_r}][table_.number(row, wavelength)] =
                std::max(0.0, table_.number(row, value));
        }
        for (const auto& [at, spectrum] : found) {
            if (spectrum.size() != wavelengths.size()) {
                throw Error{table_.name() + ": " + std::to_string(spectrum.size()) + " of " +
                            std::to_string(wavelengths.size()) + " wavelengths at theta_i_deg " +
                            shortest(at[1]) + ", theta_r_deg " + shortest(at[3]) + ", phi_r_deg " +
                            shortest(at[2])};
            }
            points.angles.push_back({at[1], at[0], at[3], at[2]});
            for (const auto& [one, brdf] : spectrum) points.values.push_back(brdf);
        }
        return points;
    }

    spectral::CsvTable table_;
    std::size_t theta_i_, theta_r_, phi_r_;
    std::optional<std::size_t> phi_i_;
};

double checked_degrees(double radians, double most, const std::string& place) {
    const double degrees = radians * 180 / std::numbers::pi;
    if (std::abs(degrees - 90) < 1e-4) return std::min(degrees, most);  // pi/2 in few digits
    if (degrees >= (most > 90 ? -most : 0) && degrees <= most) return degrees;
    throw Error{place + ": " + out_of_range("angle", radians, "rad", "a direction above the horizon").what()};
}

}  // namespace

ScatterPoints points_of_csv(std::string_view text, const std::string& name,
                            const std::optional<WavelengthGrid>& wavelengths) {
    return CsvPoints{text, name}.read(wavelengths);
}

ScatterPoints points_of_astm(std::string_view text, const std::string& name,
                             const std::optional<WavelengthGrid>& wavelengths) {
    const AstmFile file = astm_file(text, name);
    const ChannelColumns channels = channels_named(name, file.channel_names, wavelengths);
    ScatterPoints points{channels.wavelengths, {}, {}};
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
        const auto row = file.row(i);
        const std::string place = name + ":" + std::to_string(file.lines[i]);
        points.angles.push_back({checked_degrees(row[file.theta_i], 90, place),
                                 file.phi_i ? checked_degrees(row[*file.phi_i], 1e6, place) : 0,
                                 checked_degrees(row[file.theta_s], 90, place),
                                 checked_degrees(row[file.phi_s], 1e6, place)});
        std::vector<double> values;
        for (const std::size_t channel : file.channels) values.push_back(row[channel]);
        append_values(points.values, values, channels);
    }
    return points;
}

}  // namespace hts::tables

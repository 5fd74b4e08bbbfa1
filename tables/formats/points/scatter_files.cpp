#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "hts/error.hpp"
#include "spectral/text/csv.hpp"
#include "spectral/text/suggestion.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/channels.hpp"
#include "tables/formats/points/astm.hpp"
#include "tables/formats/points/fred.hpp"
#include "tables/formats/points/scatter_points.hpp"
#include "tables/formats/points/tokens.hpp"

namespace hts::tables {
namespace {

using spectral::WavelengthGrid;

// What the columns of values are: wavelengths, and which column is the first of them, the second …
struct ChannelColumns {
    WavelengthGrid wavelengths;
    std::vector<std::size_t> order;
    std::vector<std::string> channels{};  // what they stand for if not for wavelengths
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
        if (!given) result.channels = rgb_channels();
    } else if (names == std::vector<std::string>{"X", "Y", "Z"}) {
        result.order = {2, 1, 0};
        if (!given) result.channels = xyz_channels();
    } else if (!names.empty() && wavelengths.size() == names.size()) {
        if (given) throw Error{file + ": says its wavelengths, which must not be given"};
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

// Values of points, of which negative ones become 0 and are counted.
class Values {
  public:
    explicit Values(ScatterPoints& points) : points_{points} {}

    // Those of a point in the order of wavelengths.
    void append(const std::vector<double>& columns, const ChannelColumns& channels, std::size_t line) {
        for (const std::size_t column : channels.order) append(columns[column], line);
    }
    void append(double value, std::size_t line) {
        if (value < 0) negative_.note(value, line);
        points_.values.push_back(std::max(0.0, value));
    }
    void write_note() {
        if (negative_.count > 0) points_.notes.push_back(negative_.text());
    }

  private:
    ScatterPoints& points_;
    NegativeValues negative_;
};

// What `hts eval` writes besides directions and BRDF.
bool is_of_eval(std::string_view column) {
    static const std::vector<std::string_view> names{"directional_diffuse",
                                                     "uniform_diffuse",
                                                     "specular_reflectance",
                                                     "n",
                                                     "k",
                                                     "rms_roughness_um",
                                                     "correlation_length_um",
                                                     "albedo",
                                                     "g",
                                                     "t",
                                                     "effective_roughness_um",
                                                     "shadowing",
                                                     "fresnel",
                                                     "method",
                                                     "btdf",
                                                     "s0",
                                                     "s1",
                                                     "s2",
                                                     "s3",
                                                     "degree_of_polarisation",
                                                     "angle_of_polarisation_deg"};
    const bool mueller = column.size() == 3 && column[0] == 'm' && column[1] >= '0' && column[1] <= '3' &&
                         column[2] >= '0' && column[2] <= '3';
    return mueller || std::ranges::find(names, column) != names.end();
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
        const std::vector<std::string> unused = unused_columns();
        const auto wavelength = table_.find_wavelength();
        const auto value = table_.find_column("brdf");
        if (wavelength && given)
            throw Error{table_.name() + ": says its wavelengths, which must not be given"};
        if (wavelength && !value) {
            throw Error{table_.where_header() + "column " + spectral::in_quotes(wavelength->name()) +
                        ": must come with one column \"brdf\""};
        }
        ScatterPoints points = wavelength ? by_rows(*value, *wavelength) : by_columns(given);
        if (!unused.empty()) points.notes.push_back("columns not used: " + spectral::joined(unused));
        const std::string dialect = table_.dialect_in_words();
        if (!dialect.empty()) points.notes.push_back(dialect);
        return points;
    }

  private:
    // hts::Error for a column that may be meant for a known one.
    [[nodiscard]] std::vector<std::string> unused_columns() const {
        const std::vector<std::string> known{"theta_i_deg", "phi_i_deg",     "theta_r_deg",  "phi_r_deg",
                                             "brdf",        "wavelength_um", "wavelength_nm"};
        std::vector<std::string> unused;
        for (const std::string& column : table_.columns()) {
            if (std::ranges::find(known, column) != known.end() || is_of_eval(column)) continue;
            if (column.starts_with("brdf_") && wavelength_named(column.substr(5))) continue;
            std::string similar = spectral::similar_name(column, known);
            if (column.starts_with("brdf_") && wavelength_named(column.substr(5) + "nm"))
                similar = column + "nm";
            const bool of_points =
                std::ranges::any_of(std::array{"theta", "phi", "wave", "lambda", "azimuth", "polar", "wl"},
                                    [&](std::string_view word) {
                                        return column.size() >= word.size() &&
                                               spectral::same_letters(column.substr(0, word.size()), word);
                                    });
            if (similar.empty() && !of_points) {
                unused.push_back(column);
                continue;
            }
            throw Error{table_.where_header() + "column " + spectral::in_quotes(column) +
                        ": not known; must be " +
                        (similar.empty() ? "one of " + spectral::joined(known) + ", brdf_550nm"
                                         : spectral::in_quotes(similar))};
        }
        return unused;
    }
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
        ScatterPoints points{channels.wavelengths, {}, {}, {}, {}, channels.channels};
        Values values{points};
        std::vector<double> row_values(columns.size());
        for (std::size_t row = 0; row < table_.row_count(); ++row) {
            for (std::size_t k = 0; k < columns.size(); ++k) row_values[k] = table_.number(row, columns[k]);
            points.angles.push_back(angles(row));
            points.lines.push_back(table_.line(row));
            values.append(row_values, channels, table_.line(row));
        }
        values.write_note();
        return points;
    }
    // A row per point and wavelength, in any order.
    //   unit   of the wavelengths [um]
    [[nodiscard]] ScatterPoints by_rows(std::size_t value, const spectral::WavelengthColumn& column) const {
        const auto um = [&](std::size_t row) { return column.micrometres(table_.number(row, column.place)); };
        std::vector<double> wavelengths;
        for (std::size_t row = 0; row < table_.row_count(); ++row) wavelengths.push_back(um(row));
        std::sort(wavelengths.begin(), wavelengths.end());
        wavelengths.erase(std::unique(wavelengths.begin(), wavelengths.end()), wavelengths.end());
        ScatterPoints points{
            spectral::located(table_.name(), [&] { return WavelengthGrid::from_micrometres(wavelengths); }),
            {},
            {}};
        // rows at the wavelengths seen of each point; a point lacks some until its last row
        std::map<std::array<double, 4>, std::map<double, std::size_t>> found;
        for (std::size_t row = 0; row < table_.row_count(); ++row) {
            const ScatterAngles at = angles(row);
            const auto [first, fresh] =
                found[{at.phi_i, at.theta_i, at.phi_r, at.theta_r}].emplace(um(row), row);
            if (fresh || table_.number(row, value) == table_.number(first->second, value)) continue;
            throw table_.error(row, "the directions and wavelength of line " +
                                        std::to_string(table_.line(first->second)) + " again, BRDF " +
                                        table_.text(row, value) + " and " +
                                        table_.text(first->second, value) + " 1/sr: must have one value");
        }
        Values values{points};
        for (const auto& [at, rows] : found) {
            const std::size_t first_row = rows.begin()->second;
            if (rows.size() != wavelengths.size()) {
                throw table_.error(first_row,
                                   std::to_string(rows.size()) + " of " + std::to_string(wavelengths.size()) +
                                       " wavelengths at theta_i_deg " + shortest(at[1]) + ", theta_r_deg " +
                                       shortest(at[3]) + ", phi_r_deg " + shortest(at[2]) + ": must be all");
            }
            points.angles.push_back({at[1], at[0], at[3], at[2]});
            points.lines.push_back(table_.line(first_row));
            for (const auto& [one, row] : rows) values.append(table_.number(row, value), table_.line(row));
        }
        values.write_note();
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
    ScatterPoints points{channels.wavelengths, {}, {}, {}, {}, channels.channels};
    Values negatives{points};
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
        const auto row = file.row(i);
        points.lines.push_back(file.lines[i]);
        const std::string place = name + ":" + std::to_string(file.lines[i]);
        points.angles.push_back({checked_degrees(row[file.theta_i], 90, place),
                                 file.phi_i ? checked_degrees(row[*file.phi_i], 1e6, place) : 0,
                                 checked_degrees(row[file.theta_s], 90, place),
                                 checked_degrees(row[file.phi_s], 1e6, place)});
        std::vector<double> values;
        for (const std::size_t channel : file.channels) values.push_back(row[channel]);
        negatives.append(values, channels, file.lines[i]);
    }
    negatives.write_note();
    return points;
}

ScatterPoints points_of_fred(std::string_view text, const std::string& name,
                             const std::optional<WavelengthGrid>& wavelengths, double mirror_azimuth) {
    const FredFile file = fred_file(text, name);
    if (!wavelengths) throw Error{name + ": does not say its wavelength, which must be given"};
    if (wavelengths->size() != 1)
        throw Error{name + ": holds 1 channel, not " + std::to_string(wavelengths->size())};
    ScatterPoints points{*wavelengths, {}, {}};
    points.notes = file.remarks;
    Values values{points};
    std::array<double, 2> sums{};  // on the mirror's side and on the light's
    for (const FredPoint& p : file.points) {
        for (const double theta : {p.theta_i, p.theta_s}) {
            if (theta >= 0 && theta <= 90) continue;
            throw Error{name + ":" + std::to_string(p.line) + ": " +
                        out_of_range("polar angle", theta, "deg", "from 0 to 90").what()};
        }
        points.angles.push_back({p.theta_i, p.phi_i, p.theta_s, p.phi_s + 180 - mirror_azimuth});
        points.lines.push_back(p.line);
        values.append(p.value, p.line);
        const double turn = std::abs(std::remainder(p.phi_s - p.phi_i - mirror_azimuth, 360));
        if (p.theta_i >= 5 && p.theta_s >= 5 && (turn < 1 || turn > 179)) sums[turn < 1 ? 0 : 1] += p.value;
    }
    if (sums[1] > 2 * sums[0]) {
        throw Error{
            name + ": more light at azimuth " + shortest(180 - mirror_azimuth) + " deg than at " +
            shortest(mirror_azimuth) +
            ", where the mirror direction is taken to be: mirror_azimuth_deg (--mirror-azimuth) must be " +
            shortest(180 - mirror_azimuth)};
    }
    points.notes.push_back("azimuths counted with the mirror direction at " + shortest(mirror_azimuth) +
                           " deg");
    values.write_note();
    return points;
}

}  // namespace hts::tables

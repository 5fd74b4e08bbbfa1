#include "validation/curves/import_formats.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hts/error.hpp"
#include "spectral/text/csv.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/points/astm.hpp"
#include "tables/formats/points/fred.hpp"

namespace hts::validation {
namespace {

namespace fs = std::filesystem;
using spectral::CsvTable;

/// The only wavelength that the recipe gives a file without any.
Band only_band(const ImportRecipe& recipe, const fs::path& path) {
    if (recipe.values.size() == 1 && recipe.values[0].band) return *recipe.values[0].band;
    throw Error{path.string() + ": no wavelength in the file: the recipe must give one"};
}

/// Full directions as a file counts azimuths, turned so that the mirror direction lies at 180 deg.
CurvePoint full_point(const ImportRecipe& recipe, const std::array<double, 4>& angles, double value) {
    return {angles[0], angles[1], angles[2], angles[3] + 180 - recipe.mirror_azimuth, value, 0};
}

/// A point in the plane of incidence, to a thousandth of a degree, gets the azimuths of in_plane_point.
CurvePoint flattened(const CurvePoint& p, Sweep sweep) {
    const double apart = std::abs(std::remainder(p.phi_r - p.phi_i, 360));
    const bool in_plane = std::min(apart, 180 - apart) < 1e-3;
    if (sweep == Sweep::scattered || !in_plane) return p;
    const double side = apart < 90 ? -1 : 1;
    return sweep == Sweep::incident
               ? in_plane_point(sweep, p.theta_r, side * p.theta_i, p.value, p.uncertainty)
               : in_plane_point(sweep, p.theta_i, side * p.theta_r, p.value, p.uncertainty);
}

// ---- CSV

/// An angle column whose name says its unit.
class AngleColumn {
  public:
    AngleColumn(const CsvTable& table, const std::string& name) : table_{table}, column_{table.column(name)} {
        if (name.ends_with("_rad")) {
            degrees_ = 180 / std::numbers::pi;
        } else if (!name.ends_with("_deg")) {
            throw Error{table.name() + ": column " + spectral::in_quotes(name) +
                        ": no unit: must end in _deg or _rad"};
        }
    }
    [[nodiscard]] double operator()(std::size_t row) const { return degrees_ * table_.number(row, column_); }

  private:
    const CsvTable& table_;
    std::size_t column_;
    double degrees_ = 1;
};

const std::string& column_of(const ImportRecipe& recipe, const char* angle) {
    const auto found = recipe.angle_columns.find(angle);
    if (found != recipe.angle_columns.end()) return found->second;
    throw Error{std::string{"recipe: key \"columns."}.append(angle).append("\": missing")};
}

/// What turns a row into directions.
class CsvDirections {
  public:
    CsvDirections(const CsvTable& table, const ImportRecipe& recipe) : recipe_{recipe} {
        const bool full = recipe.angle_columns.contains("phi_r");
        columns_.emplace_back(table, column_of(recipe, "theta_i"));
        if (recipe.head.quantity == Quantity::hemispherical_reflectance) return;
        columns_.emplace_back(table, column_of(recipe, "theta_r"));
        if (full)
            for (const char* angle : {"phi_i", "phi_r"})
                columns_.emplace_back(table, column_of(recipe, angle));
    }
    [[nodiscard]] CurvePoint operator()(std::size_t row, double value) const {
        const double theta_i = columns_[0](row), theta_r = columns_.size() > 1 ? columns_[1](row) : 0;
        if (columns_.size() == 4)
            return flattened(
                full_point(recipe_, {theta_i, columns_[2](row), theta_r, columns_[3](row)}, value),
                recipe_.sweep);
        const bool incident = recipe_.sweep == Sweep::incident;
        if (columns_.size() == 1) return in_plane_point(Sweep::incident, 0, theta_i, value, 0);
        const double swept = recipe_.mirror_sign * (incident ? theta_i : theta_r);
        return in_plane_point(recipe_.sweep, incident ? theta_r : theta_i, swept, value, 0);
    }

  private:
    const ImportRecipe& recipe_;
    std::vector<AngleColumn> columns_;
};

// ---- ASTM

/// Wavelength of a channel: that of the recipe, or in the name, "450nm".
Band channel_band(const std::string& channel, const std::optional<Band>& of_recipe, const fs::path& path) {
    if (of_recipe) return *of_recipe;
    const auto nanometres = channel.find("nm");
    if (nanometres == std::string::npos || nanometres == 0)
        throw Error{path.string() + ": channel " + spectral::in_quotes(channel) +
                    " names no wavelength: the recipe must"};
    const double um = spectral::located(path.string() + ": channel " + spectral::in_quotes(channel), [&] {
        return spectral::number_in(std::string_view{channel}.substr(0, nanometres)) / 1000;
    });
    return {um, um};
}

/// A channel that the recipe asks for; all of them where it names none.
struct AstmChannel {
    std::size_t column;
    Band band;
};

std::vector<AstmChannel> astm_channels(const tables::AstmFile& file, const ImportRecipe& recipe,
                                       const fs::path& path) {
    std::vector<AstmChannel> result;
    std::vector<ValueColumn> wanted = recipe.values;
    const auto& names = file.channel_names;
    if (wanted.empty())
        for (const std::string& channel : names) wanted.push_back({channel});
    for (const ValueColumn& value : wanted) {
        const auto found = std::find(names.begin(), names.end(), value.column);
        if (found == names.end())
            throw Error{path.string() + ": no channel " + spectral::in_quotes(value.column) +
                        ": must be one of " + spectral::joined(names)};
        result.push_back({file.channels[static_cast<std::size_t>(found - names.begin())],
                          channel_band(*found, value.band, path)});
    }
    return result;
}

}  // namespace

std::vector<ImportedPoint> read_csv_points(const fs::path& path, const ImportRecipe& recipe) {
    const CsvTable table = CsvTable::read(path);
    const CsvDirections directions{table, recipe};
    std::optional<std::size_t> chosen;
    if (!recipe.row_column.empty()) chosen = table.column(recipe.row_column);
    std::vector<ImportedPoint> points;
    for (const ValueColumn& value : recipe.values) {
        const std::size_t column = table.column(value.column);
        std::optional<std::size_t> own;
        if (!value.uncertainty.empty()) own = table.column(value.uncertainty);
        for (std::size_t row = 0; row < table.row_count(); ++row) {
            if (chosen && table.text(row, *chosen) != recipe.row_text) continue;
            const double number = table.number(row, column);
            points.push_back({value.band.value(), directions(row, recipe.emissivity ? 1 - number : number),
                              table.line(row)});
            if (own) points.back().point.uncertainty = table.number(row, *own);
        }
    }
    return points;
}

std::vector<ImportedPoint> read_fred_points(const fs::path& path, const ImportRecipe& recipe) {
    const Band band = only_band(recipe, path);
    const auto file = tables::fred_file(spectral::read_text_file(path), path.string());
    std::vector<ImportedPoint> points;
    for (const tables::FredPoint& p : file.points) {
        const CurvePoint point = full_point(recipe, {p.theta_i, p.phi_i, p.theta_s, p.phi_s}, p.value);
        points.push_back({band, flattened(point, recipe.sweep), p.line});
    }
    return points;
}

std::vector<ImportedPoint> read_astm_points(const fs::path& path, const ImportRecipe& recipe) {
    const tables::AstmFile file = tables::astm_file(spectral::read_text_file(path), path.string());
    constexpr double degrees = 180 / std::numbers::pi;
    std::vector<ImportedPoint> points;
    for (const AstmChannel& channel : astm_channels(file, recipe, path)) {
        for (std::size_t i = 0; i < file.lines.size(); ++i) {
            const auto n = file.row(i);
            const std::array angles{degrees * n[file.theta_i], file.phi_i ? degrees * n[*file.phi_i] : 0,
                                    degrees * n[file.theta_s], degrees * n[file.phi_s]};
            const CurvePoint point = full_point(recipe, angles, n[channel.column]);
            points.push_back({channel.band, flattened(point, recipe.sweep), file.lines[i]});
        }
    }
    return points;
}

}  // namespace hts::validation

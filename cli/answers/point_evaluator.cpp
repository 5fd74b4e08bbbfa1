#include "cli/answers/point_evaluator.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "cli/io/usage.hpp"
#include "hts/error.hpp"
#include "spectral/models/compensated.hpp"
#include "spectral/models/he_torrance_material.hpp"
#include "spectral/models/reflected_terms.hpp"
#include "spectral/text/suggestion.hpp"
#include "spectral/text/text.hpp"

namespace hts::cli {
namespace {

const std::vector<std::string> known_columns{"wavelength_um",
                                             "wavelength_nm",
                                             "theta_i_deg",
                                             "phi_i_deg",
                                             "theta_r_deg",
                                             "phi_r_deg",
                                             "n",
                                             "k",
                                             "rms_roughness_um",
                                             "correlation_length_um",
                                             "correlation_length_x_um",
                                             "correlation_length_y_um",
                                             "azimuth_deg",
                                             "albedo"};

double cell(const CsvRow& row, std::size_t column, const char* name) {
    return row.number(column, name);
}

Direction direction(double theta, double phi, const char* whose) {
    try {
        return Direction::from_degrees(theta, phi);
    } catch (const Error& error) {
        throw Error{whose + std::string{error.what()}};
    }
}

/// A material of which each row says all but the albedo.
spectral::Material told_by_rows() {
    return spectral::he_torrance_material("", Surface{0, 1}, spectral::OpticalConstants::constant({1, 0}));
}

void add_detail(const spectral::Reflectance& of, const DirectionPair& pair, std::span<Evaluation> result) {
    std::vector<spectral::LobeDetail> details(result.size());
    of.evaluator().detail(pair, details);
    for (std::size_t i = 0; i < result.size(); ++i) result[i].detail = details[i];
}

}  // namespace

PairColumns::PairColumns(const CsvReader& points)
    : theta_i_{points.column("theta_i_deg")},
      phi_i_{points.column("phi_i_deg")},
      theta_r_{points.column("theta_r_deg")},
      phi_r_{points.column("phi_r_deg")} {}

DirectionPair PairColumns::pair(const CsvRow& row) const {
    const Direction in =
        direction(cell(row, theta_i_, "theta_i_deg"), cell(row, phi_i_, "phi_i_deg"), "light: ");
    return {in, direction(cell(row, theta_r_, "theta_r_deg"), cell(row, phi_r_, "phi_r_deg"), "view: ")};
}

PointEvaluator::Columns::Columns(const CsvReader& points, bool needs_wavelength)
    : directions{points},
      wavelength{needs_wavelength ? points.wavelength() : points.find_wavelength()},
      n{points.find_column("n")},
      k{points.find_column("k")},
      rms_roughness{points.find_column("rms_roughness_um")},
      correlation_length{points.find_column("correlation_length_um")},
      correlation_length_x{points.find_column("correlation_length_x_um")},
      correlation_length_y{points.find_column("correlation_length_y_um")},
      azimuth{points.find_column("azimuth_deg")},
      albedo{points.find_column("albedo")} {}

bool PointEvaluator::Columns::any_of_material() const noexcept {
    return n || k || rms_roughness || correlation_length || correlation_length_x || correlation_length_y ||
           azimuth || albedo;
}

PointEvaluator::PointEvaluator(const CsvReader& points, const std::optional<spectral::Material>& material,
                               std::optional<spectral::WavelengthGrid> wavelengths,
                               const spectral::EvaluationOptions& how)
    : columns_{points, !wavelengths},
      material_{material.value_or(told_by_rows())},
      wavelengths_{std::move(wavelengths)},
      how_{how},
      by_wavelength_{std::make_shared<WavelengthCache<spectral::Reflectance>>()} {
    if (wavelengths_ && columns_.wavelength) {
        throw UsageError{"wavelength given twice: must be either the column " +
                         points.columns()[columns_.wavelength->place] + " or an option"};
    }
    require_whole_surfaces(points);
    if (!material) require_material(points);
    if (!of_rough_surfaces()) require_no_material_columns(points);
    if (wavelengths_ && !columns_.any_of_material()) same_for_all_ = material_.at(*wavelengths_, how_);
    if (how_.compensate_energy) compensation_ = std::make_shared<CompensationCache>();
    how_.compensate_energy = false;  // that of rows comes from the cache
}

void PointEvaluator::with(const spectral::UncertainMaterial& uncertain) {
    if (columns_.any_of_material())
        throw UsageError{"--uncertainty: must not come with points that have columns of the material"};
    uncertain_ = uncertain;
    uncertainty_ = std::make_shared<WavelengthCache<spectral::UncertainReflectance>>();
}

void PointEvaluator::require_material(const CsvReader& points) const {
    const std::array<std::pair<const char*, Column>, 4> needed{
        {{"n", columns_.n},
         {"k", columns_.k},
         {"rms_roughness_um", columns_.rms_roughness},
         {"correlation_length_um",
          columns_.correlation_length ? columns_.correlation_length : columns_.correlation_length_x}}};
    const auto absent = [](const auto& column) { return !column.second; };
    if (std::all_of(needed.begin(), needed.end(), absent)) {
        throw UsageError{
            "--material missing: must be given, or columns n, k, rms_roughness_um, correlation_length_um"};
    }
    const auto gap = std::find_if(needed.begin(), needed.end(), absent);
    if (gap == needed.end()) return;
    throw Error{points.where_header() + "column " + gap->first +
                " missing: must be in the header where no --material is given"};
}

// Both lengths together, or one; an azimuth where there are axes.
void PointEvaluator::require_whole_surfaces(const CsvReader& points) const {
    const Columns& c = columns_;
    const auto wrong = [&](const char* column, const char* why) {
        return Error{points.where_header() + "column " + column + why};
    };
    if (c.correlation_length_x && !c.correlation_length_y)
        throw wrong("correlation_length_y_um",
                    " missing: must be in the header beside correlation_length_x_um");
    if (c.correlation_length_y && !c.correlation_length_x)
        throw wrong("correlation_length_x_um",
                    " missing: must be in the header beside correlation_length_y_um");
    if (!c.correlation_length) return;
    if (c.correlation_length_x)
        throw wrong("correlation_length_um", ": must not be in the header beside correlation_length_x_um");
    if (c.azimuth) throw wrong("azimuth_deg", ": must not be in the header beside correlation_length_um");
}

void PointEvaluator::require_no_material_columns(const CsvReader& points) const {
    for (const char* name : {"n", "k", "rms_roughness_um", "correlation_length_um", "correlation_length_x_um",
                             "azimuth_deg", "albedo"}) {
        if (!points.find_column(name)) continue;
        throw Error{points.where_header() + "column " + name +
                    ": must not be in the header where the material's model is not he"};
    }
}

std::vector<std::string> PointEvaluator::unused_columns(const CsvReader& points) {
    std::vector<std::string> unused;
    for (const std::string& name : points.columns()) {
        if (std::ranges::find(known_columns, name) != known_columns.end()) continue;
        const std::string similar = spectral::similar_name(name, known_columns);
        if (!similar.empty()) {
            throw Error{points.where_header() + "column " + spectral::in_quotes(name) +
                        ": not known; must be " + spectral::in_quotes(similar)};
        }
        unused.push_back(name);
    }
    return unused;
}

void PointEvaluator::evaluate(const CsvRow& row, const Wish& wish, std::span<Evaluation> result,
                              ValidityWarning& warning) const {
    const DirectionPair pair = columns_.directions.pair(row);
    std::optional<spectral::Reflectance> own;
    const spectral::Reflectance& of = reflectance(row, own);
    thread_local spectral::ReflectedTerms terms;
    spectral::reflected_terms(of, pair, terms);
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i] = {.wavelength = of.wavelengths().micrometres()[i],
                     .cos_theta_i = pair.in.cos_theta(),
                     .cos_theta_r = pair.out.cos_theta(),
                     .directional_diffuse = terms.directional_diffuse[i],
                     .uniform_diffuse = terms.uniform_diffuse[i],
                     .specular_reflectance = terms.specular_reflectance[i]};
    }
    if (wish.mueller) {
        const auto matrices = of.directional_diffuse_mueller(pair);
        const auto mirror = of.specular_mueller(pair.in);
        for (std::size_t i = 0; i < result.size(); ++i) {
            result[i].mueller = matrices[i];
            result[i].specular_mueller = mirror[i];
        }
    }
    if (wish.detail) add_detail(of, pair, result);
    if (uncertain_) add_uncertainty(pair, of.wavelengths(), result);
    warning.note(of, pair);
}

void PointEvaluator::add_uncertainty(const DirectionPair& pair, const spectral::WavelengthGrid& grid,
                                     std::span<Evaluation> result) const {
    const auto& of =
        uncertainty_->at(grid.micrometres()[0], [&](double) { return uncertain_->at(grid, how_); });
    std::vector<double> brdf(result.size()), specular(result.size());
    of.brdf(pair, brdf);
    of.specular_reflectance(pair.in, specular);
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i].brdf_uncertainty = brdf[i];
        result[i].specular_uncertainty = specular[i];
    }
}

void PointEvaluator::evaluate_transmission(const CsvRow& row, std::span<Evaluation> result) const {
    const DirectionPair pair = columns_.directions.pair(row);
    std::optional<spectral::Reflectance> own;
    const spectral::Reflectance& of = reflectance(row, own);
    const auto micrometres = of.wavelengths().micrometres();
    for (std::size_t i = 0; i < result.size(); ++i) {
        if (of.transmits(i)) continue;
        throw Error{"transmission at " + shortest(micrometres[i]) +
                    " um: the surface is opaque: must be of model walter and transparent (k = 0)"};
    }
    const auto btdf = of.btdf(pair);
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = {.wavelength = micrometres[i], .btdf = btdf[i]};
}

const spectral::Reflectance& PointEvaluator::reflectance(const CsvRow& row,
                                                         std::optional<spectral::Reflectance>& own) const {
    if (same_for_all_) return *same_for_all_;
    const auto compensated = [&](const spectral::Reflectance& of, const spectral::WavelengthGrid& grid) {
        if (!compensation_) return of;
        return spectral::compensated(of, compensation_->at(*of.properties().surface, grid));
    };
    if (!columns_.any_of_material()) {
        return by_wavelength_->at(wavelength(row), [&](double micrometres) {
            const auto grid = spectral::WavelengthGrid::from_micrometres({micrometres});
            return compensated(material_.at(grid, how_), grid);
        });
    }
    const auto grid =
        wavelengths_ ? *wavelengths_ : spectral::WavelengthGrid::from_micrometres({wavelength(row)});
    spectral::EvaluationOptions how = how_;
    how.instead = own_values(row);
    return own.emplace(compensated(material_.at(grid, how), grid));
}

spectral::RoughSurfaceValues PointEvaluator::own_values(const CsvRow& row) const {
    const auto value = [&](const Column& column, const char* name) {
        return column ? std::optional{cell(row, *column, name)} : std::nullopt;
    };
    const auto degrees = value(columns_.azimuth, "azimuth_deg");
    const auto axis = degrees ? std::optional{Direction::from_degrees(90, *degrees)} : std::nullopt;
    return {.n = value(columns_.n, "n"),
            .k = value(columns_.k, "k"),
            .rms_roughness = value(columns_.rms_roughness, "rms_roughness_um"),
            .correlation_length = value(columns_.correlation_length, "correlation_length_um"),
            .correlation_length_x = value(columns_.correlation_length_x, "correlation_length_x_um"),
            .correlation_length_y = value(columns_.correlation_length_y, "correlation_length_y_um"),
            .axis = axis,
            .diffuse_albedo = value(columns_.albedo, "albedo")};
}

double PointEvaluator::wavelength(const CsvRow& row) const {
    const auto& column = *columns_.wavelength;
    const double number = cell(row, column.place, column.name());
    return Wavelength::from_micrometres(column.micrometres(number)).micrometres();
}

}  // namespace hts::cli

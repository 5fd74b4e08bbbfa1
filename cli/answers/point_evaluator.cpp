#include "cli/answers/point_evaluator.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "cli/io/usage.hpp"
#include "hts/error.hpp"
#include "spectral/text/text.hpp"

namespace hts::cli {
namespace {

constexpr std::array known_columns{
    "wavelength_um",    "theta_i_deg",           "phi_i_deg", "theta_r_deg", "phi_r_deg", "n", "k",
    "rms_roughness_um", "correlation_length_um", "albedo"};

double cell(const CsvRow& row, std::size_t column, const char* name) {
    return spectral::number_in(row.fields[column], name);
}

Direction direction(const CsvRow& row, std::size_t theta, std::size_t phi, const std::string& name) {
    const double polar = cell(row, theta, ("theta_" + name + "_deg").c_str());
    const double azimuth = cell(row, phi, ("phi_" + name + "_deg").c_str());
    try {
        return Direction::from_degrees(polar, azimuth);
    } catch (const Error& error) {
        throw Error{(name == "i" ? "light: " : "view: ") + std::string{error.what()}};
    }
}

}  // namespace

const spectral::EnergyCompensation& CompensationCache::at(const Surface& surface,
                                                          const Wavelength& wavelength) {
    std::unique_lock lock{mutex_};
    Entry& entry =
        entries_[{surface.rms_roughness(), surface.correlation_length(), wavelength.micrometres()}];
    lock.unlock();
    std::call_once(entry.once, [&] { entry.solved.emplace(surface, wavelength); });
    return *entry.solved;
}

PairColumns::PairColumns(const CsvReader& points)
    : theta_i_{points.column("theta_i_deg")},
      phi_i_{points.column("phi_i_deg")},
      theta_r_{points.column("theta_r_deg")},
      phi_r_{points.column("phi_r_deg")} {}

DirectionPair PairColumns::pair(const CsvRow& row) const {
    const Direction in = direction(row, theta_i_, phi_i_, "i");
    return {in, direction(row, theta_r_, phi_r_, "r")};
}

PointEvaluator::Columns::Columns(const CsvReader& points, bool needs_wavelength)
    : directions{points},
      wavelength{needs_wavelength ? points.column("wavelength_um") : points.find_column("wavelength_um")},
      n{points.find_column("n")},
      k{points.find_column("k")},
      rms_roughness{points.find_column("rms_roughness_um")},
      correlation_length{points.find_column("correlation_length_um")},
      albedo{points.find_column("albedo")} {}

PointEvaluator::PointEvaluator(const CsvReader& points,
                               const std::optional<spectral::AnyReflector>& reflector,
                               std::optional<spectral::WavelengthGrid> wavelengths,
                               spectral::OutsideRange policy, bool compensate_energy)
    : columns_{points, !wavelengths}, wavelengths_{std::move(wavelengths)}, policy_{policy} {
    if (compensate_energy) compensation_ = std::make_shared<CompensationCache>();
    if (wavelengths_ && columns_.wavelength) {
        throw UsageError{"wavelength given twice: must be either the column wavelength_um or an option"};
    }
    if (reflector && !reflector->he_torrance()) {
        require_no_material_columns(points);
        other_ = reflector;
        if (wavelengths_) spectrum_ = other_->spectrum(*wavelengths_, policy_);
        return;
    }
    if (reflector) reflector_ = *reflector->he_torrance();
    if (!reflector_) require_material(points);
    if (compensation_ && wavelengths_ && !columns_.rms_roughness && !columns_.correlation_length)
        compensations_ = spectral::EnergyCompensation::of(reflector_->surface, *wavelengths_);
    if (!same_for_all_rows()) return;
    for (std::size_t i = 0; i < wavelengths_->size(); ++i)
        samples_.push_back(sample(nullptr, (*wavelengths_)[i]));
}

void PointEvaluator::require_material(const CsvReader& points) const {
    const std::array<std::pair<const char*, Column>, 4> needed{
        {{"n", columns_.n},
         {"k", columns_.k},
         {"rms_roughness_um", columns_.rms_roughness},
         {"correlation_length_um", columns_.correlation_length}}};
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

void PointEvaluator::require_no_material_columns(const CsvReader& points) const {
    for (const char* name : {"n", "k", "rms_roughness_um", "correlation_length_um", "albedo"}) {
        if (!points.find_column(name)) continue;
        throw Error{points.where_header() + "column " + name +
                    ": must not be in the header where the material's model is not he"};
    }
}

bool PointEvaluator::same_for_all_rows() const noexcept {
    return wavelengths_ && !columns_.n && !columns_.k && !columns_.albedo;
}

std::vector<std::string> PointEvaluator::unused_columns(const CsvReader& points) {
    std::vector<std::string> unused;
    for (const std::string& name : points.columns()) {
        if (std::find(known_columns.begin(), known_columns.end(), name) == known_columns.end()) {
            unused.push_back(name);
        }
    }
    return unused;
}

void PointEvaluator::evaluate(const CsvRow& row, bool with_mueller, std::span<Evaluation> result,
                              ValidityWarning& warning) const {
    const auto [in, out] = columns_.directions.pair(row);
    if (other_) return evaluate_other(row, {in, out}, result);
    const Surface rough = surface(row);
    const View light = view(rough, in);
    const View seen = view(rough, out);
    const PairFactors pair{rough, light, seen};
    const spectral::CompensationPair lobe{{in, out}}, mirror{{in, in.mirror()}};
    for (std::size_t i = 0; i < result.size(); ++i) {
        const Sample at = samples_.empty() ? sample(&row, wavelength(row, i)) : samples_[i];
        DirectionalDiffuse directional = directional_diffuse(pair, at.wavelength, at.index);
        double specular = specular_reflectance(rough, light, at.wavelength, at.index).value();
        if (compensation_) {
            const auto& s =
                compensations_.empty() ? compensation_->at(rough, at.wavelength) : compensations_[i];
            const double factor = s.factor(lobe);
            directional.lobe *= factor;
            directional.brdf *= factor;
            specular *= s.factor(mirror);
        }
        result[i] = {at.wavelength.micrometres(), directional,      at.uniform_diffuse, specular,
                     pair.effective_roughness(),  pair.shadowing(), Mueller{},          0};
        warning.note(spectral::validity(rough, light, seen, at));
        if (with_mueller) result[i].mueller = directional_diffuse_mueller(in, out, directional);
    }
}

void PointEvaluator::evaluate_other(const CsvRow& row, const spectral::DirectionPair& pair,
                                    std::span<Evaluation> result) const {
    const auto own = spectrum_
                         ? std::nullopt
                         : std::optional{spectral::AnySpectrum{{other_->at(wavelength(row, 0), policy_)}}};
    const spectral::AnySpectrum& model = spectrum_ ? *spectrum_ : *own;
    std::vector<double> brdf(result.size()), specular(result.size());
    model.brdf(pair, brdf);
    model.specular_reflectance(pair.in, specular);
    for (std::size_t i = 0; i < result.size(); ++i) {
        const double uniform = std::min(brdf[i], model.uniform_diffuse()[i]);
        result[i] = {};
        result[i].wavelength = wavelength(row, i).micrometres();
        result[i].directional.brdf = brdf[i] - uniform;
        result[i].uniform_diffuse = uniform;
        result[i].specular_reflectance = specular[i];
    }
}

void PointEvaluator::evaluate_transmission(const CsvRow& row, std::span<Evaluation> result) const {
    const auto [in, behind] = columns_.directions.pair(row);
    for (std::size_t i = 0; i < result.size(); ++i) {
        const Wavelength at = wavelength(row, i);
        if (const auto through = other_ ? std::optional{model(at, i)} : std::nullopt;
            through && through->transmits()) {
            result[i] = {};
            result[i].wavelength = at.micrometres();
            result[i].btdf = through->btdf(in, behind);
            continue;
        }
        throw Error{"transmission at " + shortest(at.micrometres()) +
                    " um: the surface is opaque: must be of model walter and transparent (k = 0)"};
    }
}

spectral::AnyModel PointEvaluator::model(const Wavelength& wavelength, std::size_t i) const {
    return spectrum_ ? spectrum_->models()[i] : other_->at(wavelength, policy_);
}

Surface PointEvaluator::surface(const CsvRow& row) const {
    if (!columns_.rms_roughness && !columns_.correlation_length) return reflector_->surface;
    const double rms_roughness = columns_.rms_roughness
                                     ? cell(row, *columns_.rms_roughness, "rms_roughness_um")
                                     : reflector_->surface.rms_roughness();
    const double correlation_length = columns_.correlation_length
                                          ? cell(row, *columns_.correlation_length, "correlation_length_um")
                                          : reflector_->surface.correlation_length();
    return {rms_roughness, correlation_length};
}

PointEvaluator::Sample PointEvaluator::sample(const CsvRow* row, const Wavelength& wavelength) const {
    return {wavelength, index(row, wavelength), hts::uniform_diffuse(albedo(row, wavelength))};
}

RefractiveIndex PointEvaluator::index(const CsvRow* row, const Wavelength& wavelength) const {
    if (columns_.n && columns_.k) return {cell(*row, *columns_.n, "n"), cell(*row, *columns_.k, "k")};
    const RefractiveIndex own = reflector_->material.index(wavelength, policy_);
    return {columns_.n ? cell(*row, *columns_.n, "n") : own.n(),
            columns_.k ? cell(*row, *columns_.k, "k") : own.k()};
}

double PointEvaluator::albedo(const CsvRow* row, const Wavelength& wavelength) const {
    if (columns_.albedo) return cell(*row, *columns_.albedo, "albedo");
    return reflector_ ? reflector_->albedo(wavelength, policy_) : 0;
}

Wavelength PointEvaluator::wavelength(const CsvRow& row, std::size_t i) const {
    if (wavelengths_) return (*wavelengths_)[i];
    return Wavelength::from_micrometres(cell(row, *columns_.wavelength, "wavelength_um"));
}

}  // namespace hts::cli

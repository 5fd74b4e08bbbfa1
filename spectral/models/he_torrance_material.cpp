#include "spectral/models/he_torrance_material.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include "hts/error.hpp"
#include "hts/he_torrance.hpp"
#include "hts/unified/he_unified.hpp"
#include "spectral/energy/compensation.hpp"
#include "spectral/materials/coated_constants.hpp"
#include "spectral/models/compensated.hpp"
#include "spectral/models/spectral_number.hpp"
#include "spectral/models/surface_reader.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {
namespace {

constexpr auto published_source = "He, Torrance, Sillion, Greenberg 1991";
constexpr auto unified_source = "hts, successor of He, Torrance, Sillion, Greenberg 1991";

Properties properties_of(const RoughSurface& surface) {
    return {.polarised = true, .specular_term = true, .isotropic = surface.isotropic(), .surface = surface};
}

WavelengthGrid grid_of(const std::vector<SpectralSample>& samples) {
    std::vector<double> micrometres;
    micrometres.reserve(samples.size());
    for (const SpectralSample& sample : samples) micrometres.push_back(sample.wavelength.micrometres());
    return WavelengthGrid::from_micrometres(std::move(micrometres));
}

template <class Spectrum>
class RoughSurfaceSampler final : public DirectionSampler {
  public:
    explicit RoughSurfaceSampler(Spectrum spectrum) : model_{std::move(spectrum)} {}

    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept override {
        return model_.pdf(in, out);
    }
    [[nodiscard]] Draw sample(const Direction& in, const Uniforms& uniforms) const noexcept override {
        return model_.sample(in, uniforms);
    }
    [[nodiscard]] Draw draw(const Direction& in, const Uniforms& uniforms) const noexcept override {
        return model_.draw(in, uniforms);
    }
    [[nodiscard]] double specular_probability(const Direction& in) const noexcept override {
        return model_.specular_probability(in);
    }

  private:
    RoughSurfaceModel<Spectrum> model_;
};

void add_detail(const HeTorranceSpectrum& of, const DirectionPair& pair, std::span<LobeDetail> values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        const SpectralSample& sample = of.samples()[i];
        const PairFactors factors = of.factors(pair, i);
        const DirectionalDiffuse term = directional_diffuse(factors, sample.wavelength, sample.index);
        values[i] = {term.phase_variance,
                     term.lobe_argument,
                     factors.effective_roughness(),
                     factors.shadowing(),
                     term.amplitudes.unpolarised_reflectance(),
                     term.method};
    }
}

void add_detail(const HeUnifiedSpectrum& of, const DirectionPair& pair, std::span<LobeDetail> values) {
    const double cos_theta_d = wave_vector_change(pair.in, pair.out).cos_theta_d();
    for (std::size_t i = 0; i < values.size(); ++i) {
        const UnifiedLobe lobe = unified_lobe(of.view(pair.in, i), of.view(pair.out, i), of.waves()[i]);
        values[i] = {lobe.phase_variance,
                     lobe.lobe_argument,
                     of.surface().rms_roughness(),
                     lobe.shadowing,
                     of.samples()[i].index.amplitudes(cos_theta_d).unpolarised_reflectance(),
                     lobe.kicks.method};
    }
}

/// Makes the spectrum of samples.
template <class Spectrum>
using Spectra = std::function<Spectrum(std::vector<SpectralSample> samples)>;

template <class Spectrum>
class RoughSurfaceEvaluator final : public Evaluator {
  public:
    RoughSurfaceEvaluator(const std::string& name, RoughSurface surface, std::vector<SpectralSample> samples,
                          Spectra<Spectrum> spectrum_of)
        : Evaluator{name, grid_of(samples)},
          surface_{std::move(surface)},
          samples_{samples},
          uniform_diffuse_{taken_from(samples)},
          has_uniform_{std::ranges::any_of(uniform_diffuse_, [](double value) { return value != 0; })},
          spectrum_of_{std::move(spectrum_of)},
          lobe_{spectrum_of_(std::move(samples))} {}

    [[nodiscard]] Properties properties() const override { return properties_of(surface_); }
    [[nodiscard]] std::size_t bytes() const noexcept override {
        return sizeof *this - sizeof lobe_ + lobe_.bytes() +
               samples_.size() * (sizeof(SpectralSample) + 2 * sizeof(double));
    }
    [[nodiscard]] std::span<const SpectralSample> samples() const noexcept override { return samples_; }
    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        lobe_.brdf(pair, values);
        if (has_uniform_) add_uniform(values);
    }
    void brdf_batch(std::span<const DirectionPair> pairs, std::span<double> values) const noexcept override {
        lobe_.brdf(pairs, values);
        if (!has_uniform_) return;
        const std::size_t width = uniform_diffuse_.size();
        for (std::size_t i = 0; i < pairs.size(); ++i) add_uniform(values.subspan(i * width, width));
    }
    void uniform_diffuse(std::span<double> values) const noexcept override {
        std::ranges::copy(uniform_diffuse_, values.begin());
    }
    void directional_diffuse(const DirectionPair& pair, std::span<double> values) const noexcept override {
        lobe_.brdf(pair, values);
    }
    void specular_reflectance(const Direction& in, std::span<double> values) const noexcept override {
        lobe_.specular_reflectance(in, values);
    }
    void mueller(const DirectionPair& pair, std::span<Mueller> values) const noexcept override {
        lobe_.mueller(pair, values);
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = values[i] + Mueller::depolariser(uniform_diffuse_[i]);
    }
    void directional_diffuse_mueller(const DirectionPair& pair,
                                     std::span<Mueller> values) const noexcept override {
        lobe_.mueller(pair, values);
    }
    void specular_mueller(const Direction& in, std::span<Mueller> values) const noexcept override {
        lobe_.specular_mueller(in, values);
    }
    void detail(const DirectionPair& pair, std::span<LobeDetail> values) const noexcept override {
        add_detail(lobe_, pair, values);
    }
    [[nodiscard]] HemisphericalReflectance albedo(const Direction& in,
                                                  std::size_t wavelength) const override {
        const SpectralSample& sample = samples_[wavelength];
        auto result = directional_hemispherical_reflectance(surface_, sample.index, sample.wavelength, in);
        result.uniform_diffuse = sample.uniform_diffuse * std::numbers::pi;
        return result;
    }
    [[nodiscard]] HemisphericalReflectance albedo(const Direction& in, std::size_t wavelength,
                                                  const Stokes& light) const override {
        if (!surface_.isotropic() && (light[2] != 0 || light[3] != 0)) {
            throw Error{
                "albedo of a surface of two correlation lengths: the light must be polarised along s or p, "
                "or not at all"};
        }
        const SpectralSample& sample = samples_[wavelength];
        auto result =
            directional_hemispherical_reflectance(surface_, sample.index, sample.wavelength, in, light);
        result.uniform_diffuse = sample.uniform_diffuse * std::numbers::pi;
        return result;
    }
    [[nodiscard]] std::shared_ptr<const DirectionSampler> sampler(std::size_t wavelength) const override {
        return std::make_shared<const RoughSurfaceSampler<Spectrum>>(spectrum_of_({samples_[wavelength]}));
    }

  private:
    /// The uniform terms, which the samples then lack: so the lobe by itself is there without cancellation.
    [[nodiscard]] static std::vector<double> taken_from(std::vector<SpectralSample>& samples) {
        std::vector<double> taken;
        taken.reserve(samples.size());
        for (SpectralSample& sample : samples) taken.push_back(std::exchange(sample.uniform_diffuse, 0));
        return taken;
    }
    void add_uniform(std::span<double> values) const noexcept {
        for (std::size_t i = 0; i < values.size(); ++i) values[i] += uniform_diffuse_[i];
    }

    RoughSurface surface_;
    std::vector<SpectralSample> samples_;
    std::vector<double> uniform_diffuse_;
    bool has_uniform_;
    Spectra<Spectrum> spectrum_of_;
    Spectrum lobe_;
};

/// What a caller knows better goes before the constants, which then need not be known there.
RefractiveIndex substrate_of(const OpticalConstants& constants, const Wavelength& wavelength,
                             const EvaluationOptions& options) {
    const auto &n = options.instead.n, &k = options.instead.k;
    if (n && k) return {*n, *k};
    const RefractiveIndex own = constants.index(wavelength, options.outside);
    return {n.value_or(own.n()), k.value_or(own.k())};
}

double checked_albedo(double albedo) {
    if (!(albedo >= 0 && albedo <= 1)) throw out_of_range("diffuse albedo", albedo, "", "from 0 to 1");
    return albedo;
}

DiffuseAlbedo albedo_from(const std::optional<JsonValue>& albedo) {
    if (!albedo) return DiffuseAlbedo{0};
    if (albedo->is_object()) {
        albedo->require_keys_among({"table"});
        return DiffuseAlbedo{number_table((*albedo)["table"], "a", checked_albedo)};
    }
    const double value = albedo->number();
    return located(albedo->place(), [&] { return DiffuseAlbedo{value}; });
}

UnifiedChoices::Mirror mirror_from(const std::optional<JsonValue>& mirror) {
    if (!mirror || mirror->text() == "closed") return UnifiedChoices::Mirror::closed;
    if (mirror->text() == "second_order") return UnifiedChoices::Mirror::second_order;
    throw mirror->error(in_quotes(mirror->text()) + " is not known; must be closed or second_order");
}

/// Lengths so different that the longer one all but leaves the lobe a line.
bool is_grooved(const Surface& surface) {
    constexpr double most_ratio = 100;
    const auto& [along, across] = surface.correlation_lengths();
    return std::max(along, across) >= most_ratio * std::min(along, across);
}

std::string groove_warning(const Surface& surface) {
    const auto& [along, across] = surface.correlation_lengths();
    return "correlation lengths " + shortest(along) + " and " + shortest(across) +
           " um: grooves: nearly all light goes into the cone about them, where the BRDF grows as the longer "
           "length";
}

std::vector<std::string> known_keys(const std::vector<std::string>& own = {}) {
    std::vector<std::string> keys{"name", "model"};
    keys.insert(keys.end(), surface_keys().begin(), surface_keys().end());
    keys.insert(keys.end(), {"index", "films", "diffuse_albedo"});
    keys.insert(keys.end(), own.begin(), own.end());
    return keys;
}

Material material_from(const MaterialFile& file, const RoughSurface& surface) {
    return he_torrance_material(file.default_name, surface, coated_constants_from(file.json, file.folder),
                                albedo_from(file.json.find("diffuse_albedo")));
}

}  // namespace

Surface RoughSurfaceValues::of(const Surface& own) const {
    const double roughness = rms_roughness.value_or(own.rms_roughness());
    const auto correlated = [&](const Surface& of) {
        return own.correlation() ? of.correlated(*own.correlation()) : of;
    };
    if (correlation_length) return correlated({roughness, *correlation_length});
    const CorrelationLengths lengths = own.correlation_lengths();
    return correlated(Surface::anisotropic(
        roughness,
        {correlation_length_x.value_or(lengths.along), correlation_length_y.value_or(lengths.across)},
        axis.value_or(own.axis())));
}

DiffuseAlbedo::DiffuseAlbedo(double albedo) : value_{ConstantValue{checked_albedo(albedo)}} {}

DiffuseAlbedo::DiffuseAlbedo(PiecewiseLinear table) : value_{ConstantValue{0}} {
    for (const auto& point : table.points()) static_cast<void>(checked_albedo(point.value));
    value_ = std::move(table);
}

double DiffuseAlbedo::operator()(const Wavelength& wavelength, OutsideRange policy) const {
    return value_at(value_, range_of(value_).admit(wavelength, policy, "diffuse albedo"));
}

Material he_torrance_material(const std::string& name, const RoughSurface& surface,
                              const CoatedConstants& constants, const DiffuseAlbedo& albedo) {
    const auto prepare = [surface, constants, albedo](const std::string& of,
                                                      const WavelengthGrid& wavelengths,
                                                      const EvaluationOptions& options) {
        const RoughSurfaceValues& given = options.instead;
        RoughSurface rough = surface.with(given.of(surface));
        if (surface.band() && !given.rms_roughness) rough = rough.stated_for(*surface.band());
        std::vector<SpectralSample> samples;
        samples.reserve(wavelengths.size());
        for (std::size_t i = 0; i < wavelengths.size(); ++i) {
            const CoatedIndex index =
                constants.on(substrate_of(constants.substrate(), wavelengths[i], options), wavelengths[i],
                             options.outside);
            const double own =
                given.diffuse_albedo ? *given.diffuse_albedo : albedo(wavelengths[i], options.outside);
            samples.push_back({wavelengths[i], index, hts::uniform_diffuse(own)});
        }
        const Reflectance model =
            he_torrance_reflectance(of, rough, std::move(samples), options.tolerance, options.lobe);
        return options.compensate_energy ? compensated(model, EnergyCompensation::of(rough, wavelengths))
                                         : model;
    };
    std::vector<std::string> warnings = constants.warnings();
    if (is_grooved(surface)) warnings.push_back(groove_warning(surface));
    const Material material{prepare, properties_of(surface), std::move(warnings), constants.name()};
    return surface.unified() ? material.named(name, "he_unified", unified_source)
                             : material.named(name, "he", published_source);
}

Reflectance he_torrance_reflectance(const std::string& name, const RoughSurface& surface,
                                    std::vector<SpectralSample> samples, Tolerance tolerance,
                                    DiffuseLobe lobe) {
    if (surface.unified()) {
        return Reflectance{std::make_shared<const RoughSurfaceEvaluator<HeUnifiedSpectrum>>(
            name, surface, std::move(samples), [=](std::vector<SpectralSample> of) {
                return HeUnifiedSpectrum{surface, std::move(of), tolerance, lobe, *surface.unified()};
            })};
    }
    return Reflectance{std::make_shared<const RoughSurfaceEvaluator<HeTorranceSpectrum>>(
        name, surface, std::move(samples), [=](std::vector<SpectralSample> of) {
            return HeTorranceSpectrum{surface, std::move(of), tolerance, lobe};
        })};
}

Material read_he_torrance(const MaterialFile& file) {
    file.json.require_keys_among(known_keys());
    return material_from(file, surface_from(file.json, file.folder));
}

Material read_he_unified(const MaterialFile& file) {
    file.json.require_keys_among(known_keys({"mirror", "polarisation_mixing", "conductor_shortcut"}));
    const UnifiedChoices choices{.mirror = mirror_from(file.json.find("mirror")),
                                 .polarisation_mixing = truth_or(file.json, "polarisation_mixing", false),
                                 .conductor_shortcut = truth_or(file.json, "conductor_shortcut", false)};
    if (const auto films = file.json.find("films"); films && !films->items().empty())
        located(file.json.place(), [&] { require_theory_of_films(choices); });
    const RoughSurface rough = surface_from(file.json, file.folder), unified{rough, choices};
    return material_from(file, rough.band() ? unified.stated_for(*rough.band()) : unified);
}

}  // namespace hts::spectral

#include "spectral/plans/planning_error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "hts/error.hpp"
#include "hts/sampling/random.hpp"
#include "spectral/colour/colour_difference.hpp"
#include "spectral/parallel.hpp"
#include "spectral/statistics.hpp"

namespace hts::spectral {
namespace {

constexpr std::size_t most_pairs = 10'000'000;
constexpr std::size_t early_pairs = 128;
constexpr std::uint64_t largest_seed = std::uint64_t{1} << 53;  // exact in JSON

double square(double x) {
    return x * x;
}

// ---- directions

/// Draws pairs in a scene's domain.
class PairSource {
  public:
    PairSource(const Scene& scene, const Material& material, std::uint64_t seed)
        : scene_{scene},
          surface_{material.properties().surface},
          lowest_cosine_i_{std::max(0., std::cos(scene.largest_theta_i))},
          lowest_cosine_r_{std::max(0., std::cos(scene.largest_theta_r))},
          random_{seed} {
        if (surface_) return;
        const Reflectance model = material.at(scene.wavelengths, {.outside = scene.outside_range});
        for (std::size_t i = 0; i < model.size(); ++i) samplers_.push_back(model.sampler(i));
    }

    DirectionPair anywhere() {
        const Direction in = random_.direction(lowest_cosine_i_);
        return {in, random_.direction(lowest_cosine_r_)};
    }

    /// The view in the lobe of a random wavelength, where that is in the domain.
    DirectionPair in_lobe() {
        constexpr int most_tries = 32;
        const DirectionPair pair = anywhere();
        const auto count = static_cast<double>(scene_.wavelengths.size());
        const auto wavelength = static_cast<std::size_t>(count * random_.uniform());
        const double width = surface_ ? lobe_width(pair.in, scene_.wavelengths[wavelength]) : 0;
        for (int i = 0; i < most_tries; ++i) {
            const auto out = surface_ ? about_mirror(pair.in, width) : drawn(pair.in, wavelength);
            if (out) return {pair.in, *out};
        }
        return pair;
    }

  private:
    /// |v_xy| in units of 2 pi / wavelength at which t is 1, or g where that is more; of an
    /// anisotropic surface `stretched`.
    [[nodiscard]] double lobe_width(const Direction& in, const Wavelength& wavelength) const {
        const Surface& surface = *surface_;
        const Surface seen = surface.seen_by(wavelength);
        const PairFactors mirrored{surface, view(seen, in), view(seen, in.mirror())};
        return 2 / surface.correlation_length() / wavelength.wave_number() *
               std::sqrt(std::max(1., mirrored.phase_variance(wavelength)));
    }

    /// About as far from the mirror direction as the lobe of a rough surface is wide.
    std::optional<Direction> about_mirror(const Direction& in, double width) {
        double away = width * std::sqrt(-2 * std::log1p(-random_.uniform()));
        const double azimuth = 2 * std::numbers::pi * random_.uniform();
        if (surface_ && !surface_->isotropic())
            away /= surface_->stretched({std::cos(azimuth), std::sin(azimuth)});
        const Vector3 mirror = in.mirror().vector();
        const double x = mirror.x + away * std::cos(azimuth), y = mirror.y + away * std::sin(azimuth);
        const double sine_squared = square(x) + square(y);
        if (sine_squared > 1 - square(lowest_cosine_r_)) return std::nullopt;
        return Direction::from_vector({x, y, std::sqrt(std::max(0., 1 - sine_squared))});
    }

    /// As the model draws.
    std::optional<Direction> drawn(const Direction& in, std::size_t wavelength) {
        const Uniforms uniforms = random_.uniforms();
        const Draw draw = samplers_[wavelength].draw(in, uniforms);
        if (draw.lobe == Lobe::none || draw.out.cos_theta() < lowest_cosine_r_) return std::nullopt;
        return draw.out;
    }

    const Scene& scene_;
    std::optional<Surface> surface_;
    std::vector<Sampler> samplers_;  // of what is no rough surface, at the scene's wavelengths
    double lowest_cosine_i_, lowest_cosine_r_;
    Random random_;
};

/// Lights along the normal and at the rim; views in the mirror direction, along the normal and at the rim.
std::vector<DirectionPair> pairs_at_edges(const Scene& scene) {
    std::vector<DirectionPair> pairs;
    for (const double theta_i : {0., scene.largest_theta_i}) {
        const Direction in = Direction::from_angles(theta_i, 0);
        if (theta_i <= scene.largest_theta_r) pairs.push_back({in, in.mirror()});
        pairs.push_back({in, Direction::from_angles(0, 0)});
        for (const double degrees : {0., 90., 180.}) {
            pairs.push_back(
                {in, Direction::from_angles(scene.largest_theta_r, degrees * std::numbers::pi / 180)});
        }
    }
    return pairs;
}

// ---- errors

/// The lobe's largest values in the plane of incidence, one per wavelength, from coarse values.
class Peaks {
  public:
    Peaks(const Scene& scene, const Reflectance& coarse)
        : scene_{scene}, coarse_{coarse}, uniform_(scene.wavelengths.size()) {
        coarse_.uniform_diffuse(uniform_);
    }

    void find(const DirectionPair& pair, std::span<double> peaks) const {
        constexpr int fan = 45;  // views on either side of the normal
        std::vector<double> brdf(peaks.size());
        const auto look = [&](const Direction& out) {
            coarse_.brdf({pair.in, out}, brdf);
            for (std::size_t i = 0; i < peaks.size(); ++i)
                peaks[i] = std::max(peaks[i], brdf[i] - uniform_[i]);
        };
        std::fill(peaks.begin(), peaks.end(), 0.);
        look(pair.out);
        const Direction mirror = pair.in.mirror();
        if (mirror.cos_theta() >= std::cos(scene_.largest_theta_r)) look(mirror);
        const double azimuth = std::atan2(mirror.sin_phi(), mirror.cos_phi());
        for (int i = 0; i <= fan; ++i) {
            const double theta = scene_.largest_theta_r * i / fan;
            look(Direction::from_angles(theta, azimuth));
            look(Direction::from_angles(theta, azimuth + std::numbers::pi));
        }
    }

  private:
    const Scene& scene_;
    const Reflectance& coarse_;
    std::vector<double> uniform_;
};

/// CIEDE2000 of two colours, exposed so that neither is brighter than the white.
double exposed_difference(const Xyz& a, const Xyz& b, const Xyz& white) {
    const double exposure = white.Y / std::max({white.Y, a.Y, b.Y});
    return colour_difference(cielab(exposure * a, white), cielab(exposure * b, white));
}

double largest_difference(const Mueller& a, const Mueller& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.elements().size(); ++i) {
        largest = std::max(largest, std::abs(a.elements()[i] - b.elements()[i]));
    }
    return largest;
}

double ratio(double difference, double scale) {
    return difference == 0 ? 0 : difference / scale;
}

MeasuredError summary(std::vector<double> errors) {
    const double at_99 = in_order(errors, (errors.size() - 1) * 99 / 100);
    return {*std::ranges::max_element(errors), at_99};
}

}  // namespace

std::vector<DirectionPair> planning_pairs(const Scene& scene, const Material& material,
                                          const PlanSampling& sampling) {
    if (sampling.pairs < 1 || sampling.pairs > most_pairs) {
        throw out_of_range("number of pairs", static_cast<double>(sampling.pairs), "",
                           "from 1 to " + std::to_string(most_pairs));
    }
    if (sampling.seed > largest_seed) {
        throw Error{"seed " + std::to_string(sampling.seed) + ": must be from 0 to 2^53"};
    }
    PairSource source{scene, material, sampling.seed};
    const auto& surface = material.properties().surface;
    const bool has_lobe = !surface || surface->rms_roughness() > 0;
    std::vector<DirectionPair> pairs = pairs_at_edges(scene);
    for (std::size_t i = 0; i < sampling.pairs; ++i) {
        pairs.push_back(i % 2 == 1 && has_lobe ? source.in_lobe() : source.anywhere());
    }
    return pairs;
}

ErrorMeter::ErrorMeter(const Scene& scene, const Material& material, const MaterialForms& forms,
                       const PlanSampling& sampling)
    : scene_{scene}, full_{forms.full_model()}, pairs_{planning_pairs(scene, material, sampling)} {
    scene.measure == ErrorMeasure::delta_e_2000 ? remember_colours()
                                                : remember_spectra(forms.full_model(Tolerance{1e-3}));
}

void ErrorMeter::remember_spectra(const PlannedForm& coarse) {
    const Peaks peaks{scene_, coarse.at_nodes()};
    const std::size_t count = full_.reflectance().size();
    spectra_.resize(pairs_.size() * count);
    scales_.resize(pairs_.size() * count);
    full_.reflectance().brdf(pairs_, spectra_);
    parallel_for(pairs_.size(), [&](std::size_t i) {
        const auto scales = std::span{scales_}.subspan(i * count, count);
        peaks.find(pairs_[i], scales);
        for (std::size_t j = 0; j < count; ++j)
            scales[j] = spectra_[i * count + j] + floor_of_peak * scales[j];
    });
}

void ErrorMeter::remember_colours() {
    white_ = white_point(*scene_.illuminant);
    colours_.resize(pairs_.size());
    specular_colours_.resize(pairs_.size());
    parallel_for(pairs_.size(), [&](std::size_t i) {
        std::vector<double> scratch(full_.at_nodes().size());
        colours_[i] = full_.colour(pairs_[i], scratch);
        specular_colours_[i] = full_.specular_colour(pairs_[i].in);
    });
}

bool ErrorMeter::fails_early(const PlannedForm& candidate, double enough) const {
    for (std::size_t i = 0; i < std::min(early_pairs, pairs_.size()); ++i) {
        if (diffuse_error(candidate, i) > enough || specular_error(candidate, i) > enough) return true;
    }
    return false;
}

MeasuredError ErrorMeter::error(const PlannedForm& candidate) const {
    std::vector<double> errors(pairs_.size());
    parallel_for(pairs_.size(), [&](std::size_t i) {
        errors[i] = std::max(diffuse_error(candidate, i), specular_error(candidate, i));
    });
    return summary(std::move(errors));
}

double ErrorMeter::diffuse_error(const PlannedForm& candidate, std::size_t pair) const {
    if (scene_.measure == ErrorMeasure::delta_e_2000) {
        std::vector<double> scratch(candidate.at_nodes().size());
        return exposed_difference(colours_[pair], candidate.colour(pairs_[pair], scratch), white_);
    }
    const std::size_t first = pair * full_.reflectance().size();
    double worst = 0;
    if (scene_.polarised) {
        const auto full = full_.reflectance().mueller(pairs_[pair]);
        const auto value = candidate.reflectance().mueller(pairs_[pair]);
        for (std::size_t i = 0; i < full.size(); ++i) {
            worst = std::max(worst, ratio(largest_difference(value[i], full[i]), scales_[first + i]));
        }
    } else {
        const auto value = candidate.reflectance().brdf(pairs_[pair]);
        for (std::size_t i = 0; i < value.size(); ++i) {
            worst = std::max(worst, ratio(std::abs(value[i] - spectra_[first + i]), scales_[first + i]));
        }
    }
    return worst;
}

double ErrorMeter::specular_error(const PlannedForm& candidate, std::size_t pair) const {
    const Direction& in = pairs_[pair].in;
    if (scene_.measure == ErrorMeasure::delta_e_2000) {
        return exposed_difference(specular_colours_[pair], candidate.specular_colour(in), white_);
    }
    const auto samples = full_.at_nodes().samples();
    if (samples.empty()) return 0;  // nor has it a specular term
    const auto full = full_.reflectance().specular_reflectance(in);
    const auto value = candidate.reflectance().specular_reflectance(in);
    double worst = 0;
    for (std::size_t i = 0; i < full.size(); ++i) {
        const double shadowing =
            mirror_shadowing(*full_.at_nodes().properties().surface, in, samples[i].wavelength);
        const double reflected =
            samples[i].index.amplitudes(in.cos_theta()).unpolarised_reflectance() * shadowing +
            samples[i].uniform_diffuse * std::numbers::pi;
        worst = std::max(worst, ratio(std::abs(value[i].value() - full[i].value()), reflected));
    }
    return worst;
}

}  // namespace hts::spectral

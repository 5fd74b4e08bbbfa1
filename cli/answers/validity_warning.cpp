#include "cli/answers/validity_warning.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <tuple>
#include <vector>

#include "cli/io/options.hpp"
#include "hts/error.hpp"
#include "hts/sampling/random.hpp"
#include "spectral/energy/surely_valid.hpp"
#include "spectral/parallel.hpp"

namespace hts::cli {

using spectral::Severity;

namespace {

/// Nearer to the horizon draws scatter too much to tell.
constexpr double least_cosine = 0.05;

std::optional<spectral::Sampler> sampler(const spectral::Reflectance& reflectance, std::size_t wavelength) {
    try {
        return reflectance.sampler(wavelength);
    } catch (const Error&) {
        return std::nullopt;
    }
}

/// A lower bound of the directional-hemispherical reflectance: of rough surfaces the integral, of others the
/// mean weight of draws less three standard errors; none where nobody knows how to draw.
std::optional<double> least_reflectance(const spectral::Reflectance& reflectance, const Direction& in,
                                        std::size_t wavelength) {
    if (reflectance.properties().surface) return reflectance.albedo(in, wavelength).total();
    const auto drawn_by = sampler(reflectance, wavelength);
    if (!drawn_by) return std::nullopt;
    constexpr int draws = 4096;
    Random random{1};
    double sum = 0, squares = 0;
    for (int i = 0; i < draws; ++i) {
        const double weight = drawn_by->sample(in, random.uniforms()).weight;
        sum += weight / draws;
        squares += weight * weight / draws;
    }
    return sum - 3 * std::sqrt(std::max(0.0, squares - sum * sum) / draws);
}

}  // namespace

void GainWarning::Places::note(const spectral::Reflectance& reflectance, const Direction& in) {
    const auto order = [](const spectral::Reflectance& of, const Direction& from, double sign) {
        return std::tuple{sign * from.cos_theta(), of.wavelengths().micrometres()[0], from.cos_phi(),
                          from.sin_phi()};
    };
    const auto keep = [&](std::optional<Place>& place, double sign) {
        if (place && sign * in.cos_theta() > sign * place->in.cos_theta()) return;
        if (!place || order(reflectance, in, sign) < order(place->reflectance, place->in, sign))
            place.emplace(Place{reflectance, in});
    };
    keep(oblique, 1);
    keep(upright, -1);
}

void GainWarning::note(const spectral::Reflectance& reflectance, const Direction& in) {
    if (in.cos_theta() >= least_cosine) places_.mine().note(reflectance, in);
}

void GainWarning::print(const std::string& source) const {
    Places all;
    places_.for_each([&all](const Places& places) {
        for (const std::optional<Place>& place : {places.oblique, places.upright})
            if (place) all.note(place->reflectance, place->in);
    });
    const std::array places{&all.oblique, &all.upright};
    std::array<double, places.size()> least{};
    spectral::parallel_for(places.size(), [&](std::size_t i) {
        const std::optional<Place>& place = *places[i];
        if (place) least[i] = least_reflectance(place->reflectance, place->in, 0).value_or(0);
    });
    warn_of_gain(source, std::max(least[0], least[1]));
}

void warn_of_gain_of(const spectral::Reflectance& reflectance, const std::string& source) {
    constexpr std::array polar_angles{0.0, 60.0};
    std::vector<double> least(reflectance.size() * polar_angles.size());
    spectral::parallel_for(least.size(), [&](std::size_t i) {
        const Direction in = Direction::from_degrees(polar_angles[i % polar_angles.size()], 0);
        least[i] = least_reflectance(reflectance, in, i / polar_angles.size()).value_or(0);
    });
    if (!least.empty()) warn_of_gain(source, std::ranges::max(least));
}

void ValidityWarning::note(const spectral::Validity& verdict) noexcept {
    Verdicts& mine = verdicts_.mine();
    ++mine.count;
    if (verdict.severity() != Severity::outside) return;
    ++mine.outside;
    for (const spectral::Finding& finding : verdict.findings) {
        if (finding.severity() == Severity::outside)
            mine.broken[static_cast<std::size_t>(finding.criterion)] = true;
    }
}

void ValidityWarning::note(const spectral::RoughSurface& surface, const SpectralSample& sample,
                           const Direction& in, Judged& last) {
    const std::array of{surface.rms_roughness(),         surface.shortest_correlation_length(),
                        sample.wavelength.micrometres(), sample.index.substrate().n(),
                        sample.index.substrate().k(),    in.cos_theta()};
    if (of != last.of) last = {of, spectral::judgement(spectral::expected_distance(surface, sample, in))};
    Verdicts& mine = verdicts_.mine();
    ++mine.count;
    if (last.judgement.severity != Severity::outside) return;
    ++mine.outside;
    (last.judgement.error ? mine.far : mine.not_studied) = true;
}

void ValidityWarning::note(const spectral::Reflectance& reflectance, const DirectionPair& pair) {
    gain_.note(reflectance, pair.in);
    const auto& surface = reflectance.properties().surface;
    if (!surface) return;
    const auto samples = reflectance.samples();
    if (spectral::judged_by_distance(*surface)) {
        auto& last = verdicts_.mine().last;
        if (last.size() < samples.size()) last.resize(samples.size());
        for (std::size_t i = 0; i < samples.size(); ++i) note(*surface, samples[i], pair.in, last[i]);
        return;
    }
    for (const SpectralSample& sample : samples) {
        if (spectral::surely_valid(*surface, pair, sample.wavelength)) {
            ++verdicts_.mine().count;
        } else {
            note(spectral::validity(*surface, pair, sample));
        }
    }
}

ValidityWarning::Verdicts ValidityWarning::all() const {
    Verdicts sum;
    verdicts_.for_each([&sum](const Verdicts& each) {
        sum.count += each.count;
        sum.outside += each.outside;
        sum.far = sum.far || each.far;
        sum.not_studied = sum.not_studied || each.not_studied;
        for (std::size_t i = 0; i < sum.broken.size(); ++i) sum.broken[i] = sum.broken[i] || each.broken[i];
    });
    return sum;
}

void ValidityWarning::print(const std::string& source) const {
    gain_.print(source);
    const Verdicts sum = all();
    if (sum.outside == 0) return;
    std::string reasons;
    const auto add = [&reasons](bool broken, const std::string& reason) {
        if (broken) reasons.append(reasons.empty() ? "" : ", ").append(reason);
    };
    for (std::size_t i = 0; i < sum.broken.size(); ++i)
        add(sum.broken[i], std::string{name(static_cast<spectral::Criterion>(i))});
    add(sum.far, "more than " + shortest(spectral::greatest_distance) + " dB from exact scattering expected");
    add(sum.not_studied, "nothing like it was solved exactly");
    std::cerr << "hts: " << sum.outside << " of " << sum.count << " values "
              << (sum.count == 1 ? "is" : "are") << " outside the model's validity (" << reasons
              << "): see hts info\n";
}

}  // namespace hts::cli

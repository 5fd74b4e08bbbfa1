/// What every model of hts/microfacet/ must pass.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <catch2/catch.hpp>

#include "chi_squared.hpp"
#include "comparison.hpp"
#include "hts/error.hpp"
#include "hts/microfacet/albedo.hpp"
#include "hts/microfacet/model.hpp"

namespace hts::testing {

inline Direction random_direction(Random& random) {
    const double theta =
        random.uniform(0, 1) < 0.3 ? 90 - random.logarithmic(1e-3, 45) : random.uniform(0, 90);
    return Direction::from_degrees(theta, random.uniform(0, 360));
}

inline std::string text(const Direction& d) {
    const double degree = 180 / std::numbers::pi;
    return "theta " + shortest(std::atan2(d.sin_theta(), d.cos_theta()) * degree) + ", phi " +
           shortest(std::atan2(d.sin_phi(), d.cos_phi()) * degree);
}

/// f(in, out) = f(out, in) to rounding, and nothing that is not a number, negative or below the horizon.
template <ReflectanceModel Model>
void check_values(const std::string& name, const Model& model, double reciprocity_bound) {
    Random random{7};
    WorstCase reciprocity{name + ", reciprocity", reciprocity_bound};
    std::size_t bad = 0;
    for (int i = 0; i < 2000; ++i) {
        const Direction in = random_direction(random);
        const Direction out = i % 4 == 0 ? in.mirror() : i % 4 == 1 ? in : random_direction(random);
        const double there = model.brdf(in, out);
        reciprocity.note(relative_error(there, model.brdf(out, in)),
                         [&] { return text(in) + "; " + text(out); });
        const double pdf = model.pdf(in, out);
        const hts::Draw drawn = model.sample(in, random.uniforms());
        const bool good = there >= 0 && std::isfinite(there) && pdf >= 0 && std::isfinite(pdf) &&
                          drawn.weight >= 0 && std::isfinite(drawn.weight) &&
                          (drawn.pdf == 0 || drawn.pdf == model.pdf(in, drawn.out));
        bad += good ? 0 : 1;
    }
    reciprocity.check();
    CHECK(bad == 0);
    const Direction horizon = Direction::from_degrees(90, 30);
    const Direction up = Direction::from_degrees(40, 210);
    for (const auto& [in, out] : {std::pair{horizon, up}, {up, horizon}, {horizon, horizon.mirror()}}) {
        CHECK(model.brdf(in, out) == 0);
        CHECK(model.pdf(in, out) == 0);
    }
    CHECK(model.sample(horizon, {0.3, 0.4, 0.6}).weight == 0);
    for (const double low : {1e-29, 1e-200, 5e-324}) {
        const auto grazing = Direction::from_vector({1, 0, low});
        CHECK(std::isfinite(model.brdf(grazing, grazing.mirror())));
        CHECK(std::isfinite(model.brdf(grazing, grazing)));
    }
}

/// Draws fall as the density says, and their mean weight is the albedo by quadrature.
template <ReflectanceModel Model>
void check_sampling(const std::string& name, const Model& model) {
    const std::size_t count = exhaustive() ? 1'000'000 : 20'000;
    for (const double theta : {5.0, 50.0, 80.0}) {
        const Direction in = Direction::from_degrees(theta, 25);
        const Direction mirror = in.mirror();
        const double mirror_phi = std::atan2(mirror.sin_phi(), mirror.cos_phi());
        Random random{11};
        double sum = 0, squares = 0, weights = 0;
        const auto draw = [&]() -> std::optional<Angles> {
            const hts::Draw drawn = model.sample(in, random.uniforms());
            sum += drawn.weight;
            squares += drawn.weight * drawn.weight;
            ++weights;
            if (drawn.pdf == 0) return std::nullopt;
            const Direction& o = drawn.out;
            return Angles{std::atan2(o.sin_theta(), o.cos_theta()),
                          std::atan2(o.sin_phi() * mirror.cos_phi() - o.cos_phi() * mirror.sin_phi(),
                                     o.cos_phi() * mirror.cos_phi() + o.sin_phi() * mirror.sin_phi())};
        };
        const auto density = [&](double polar, double phi) {
            if (polar >= std::numbers::pi / 2) return 0.0;
            return model.pdf(in, Direction::from_angles(polar, mirror_phi + phi));
        };
        const Fit fit = fit_of(draw, density, count);
        const double mean = sum / weights;
        const double error = std::sqrt(std::max(0.0, squares / weights - mean * mean) / weights);
        const double albedo = directional_albedo(model, in);
        const double deviation = std::abs(mean - albedo) / (error + 2e-6 * albedo);
        INFO(name << ", " << text(in) << ": mean weight " << mean << ", albedo " << albedo);
        CHECK(fit.p_value > 1e-4);
        CHECK(fit.deviation_of_sum(count) < 5);
        CHECK(deviation < 5);
    }
}

}  // namespace hts::testing

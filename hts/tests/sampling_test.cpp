// The sampler against its density and against the model, by quadrature of both. HTS_EXHAUSTIVE=1 takes every case with
// 10^6 draws, a few minutes; otherwise every seventh with 4 10^4.
#include "hts/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <numbers>
#include <sstream>
#include <vector>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <catch2/catch.hpp>

#include "comparison.hpp"

using hts::Direction;
using hts::DirectionSampler;
using hts::Lobe;
using hts::SpectralSample;
using hts::Surface;
using hts::Tolerance;
using hts::Wavelength;
using hts::testing::Random;
using hts::testing::WorstCase;

namespace {

constexpr double pi = std::numbers::pi;

/// A surface at 0.5 um, lit from an angle.
struct Case {
    double roughness_over_wavelength, slope, theta;
    hts::RefractiveIndex index;
    double albedo;

    [[nodiscard]] Surface surface() const {
        const double sigma = 0.5 * roughness_over_wavelength;
        return {sigma, sigma / slope};
    }
    [[nodiscard]] SpectralSample sample() const {
        return {Wavelength::from_micrometres(0.5), index, hts::uniform_diffuse(albedo)};
    }
    [[nodiscard]] DirectionSampler sampler() const { return {surface(), sample(), Tolerance{1e-6}}; }
    [[nodiscard]] Direction in() const { return Direction::from_degrees(theta, 20); }
    [[nodiscard]] std::string text() const {
        std::ostringstream text;
        text << "sigma0/lambda " << roughness_over_wavelength << ", sigma0/tau " << slope << ", theta_i "
             << theta << ", N " << index.n() << " + " << index.k() << "i, albedo " << albedo;
        return text.str();
    }
};

/// 210 cases, sigma0/lambda 0.02 ... 5, sigma0/tau 0.005 ... 1, 0 ... 89 deg, a metal, a glass and a glass over white.
const std::vector<Case>& cases() {
    static const std::vector<Case> all = [] {
        const std::array<hts::RefractiveIndex, 3> index{{{0.77, 6.08}, {1.5, 0}, {1.5, 0}}};
        std::vector<Case> result;
        for (const double slope : {0.005, 0.02, 0.1, 0.25, 1.0}) {
            for (const double roughness : {0.02, 0.05, 0.1, 0.3, 1.0, 5.0}) {
                for (const double theta : {0.0, 30.0, 45.0, 60.0, 75.0, 80.0, 89.0}) {
                    const std::size_t material = result.size() % index.size();
                    result.push_back({roughness, slope, theta, index[material], material == 2 ? 0.3 : 0.0});
                }
            }
        }
        return result;
    }();
    return all;
}

std::size_t stride() {
    return hts::testing::exhaustive() ? 1 : 11;
}

std::size_t draws() {
    return hts::testing::exhaustive() ? 1'000'000 : 40'000;
}

DirectionSampler::Uniforms uniforms(Random& random) {
    const double u0 = random.uniform(0, 1);
    const double u1 = random.uniform(0, 1);
    return {u0, u1, random.uniform(0, 1)};
}

/// Integral over theta0 ... theta1 and phi0 ... phi1 of f(theta, phi) sin(theta), cut at the breakpoints.
template <class Function>
double patch(const Function& f, double theta0, double theta1, double phi0, double phi1, double tolerance) {
    using Quadrature = boost::math::quadrature::gauss_kronrod<double, 15>;
    const auto ring = [&](double theta) {
        const auto along = [&](double phi) { return f(theta, phi); };
        return std::sin(theta) * Quadrature::integrate(along, phi0, phi1, 8, tolerance / 10);
    };
    return Quadrature::integrate(ring, theta0, theta1, 8, tolerance);
}

/// Edges that grow away from a centre by factors of 2.5, between two ends.
std::vector<double> edges(double low, double high, double centre, double width) {
    std::vector<double> result{low, high};
    if (centre > low && centre < high) result.push_back(centre);
    for (double step = width; step < 4; step *= 2.5) {
        for (const double edge : {centre - step, centre + step}) {
            if (edge > low && edge < high) result.push_back(edge);
        }
    }
    std::sort(result.begin(), result.end());
    return result;
}

/// Reflectance of the directional-diffuse term by adaptive quadrature of the exact BRDF, finer about the mirror
/// direction.
double reflectance_by_quadrature(const Case& c) {
    const Surface surface = c.surface();
    const Direction in = Direction::from_degrees(c.theta, 0);
    const hts::View seen = view(surface, in);
    const SpectralSample sample = c.sample();
    const auto reflected = [&](double theta, double from_mirror) {
        const Direction out = Direction::from_angles(theta, pi + from_mirror);
        return directional_diffuse({surface, seen, view(surface, out)}, sample.wavelength, sample.index)
                   .brdf *
               std::cos(theta);
    };
    const double width = std::min(0.5, surface.slope_width() + 0.2 * c.slope / c.roughness_over_wavelength);
    const double mirror = std::acos(in.cos_theta());
    const auto thetas = edges(0, pi / 2, mirror, width);
    const auto azimuths = edges(0, pi, 0, width / std::max(0.1, in.sin_theta()));
    double sum = 0;
    for (std::size_t i = 1; i < thetas.size(); ++i) {
        for (std::size_t j = 1; j < azimuths.size(); ++j)
            sum += 2 * patch(reflected, thetas[i - 1], thetas[i], azimuths[j - 1], azimuths[j], 1e-6);
    }
    return sum;
}

/// Sums over draws from a sampler.
struct Tally {
    double sum = 0, squares = 0, most = 0;
    std::size_t none = 0, diffuse = 0, count = 0;

    void add(double weight) {
        sum += weight;
        squares += weight * weight;
        most = std::max(most, weight);
        ++count;
    }
    [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
    [[nodiscard]] double deviation() const {
        return std::sqrt(std::max(0.0, squares / static_cast<double>(count) - mean() * mean()));
    }
};

/// Polar angle and azimuth of a draw, from -pi to pi about the mirror's.
struct Angles {
    double theta, phi;
};

Angles angles(const Direction& in, const Direction& out) {
    const Direction mirror = in.mirror();
    const double x = out.cos_phi() * mirror.cos_phi() + out.sin_phi() * mirror.sin_phi();
    const double y = out.sin_phi() * mirror.cos_phi() - out.cos_phi() * mirror.sin_phi();
    return {std::atan2(out.sin_theta(), out.cos_theta()), std::atan2(y, x)};
}

/// Boundaries that hold an equal number of values each, the ends given.
std::vector<double> quantiles(std::vector<double> values, std::size_t parts, double low, double high) {
    std::sort(values.begin(), values.end());
    std::vector<double> result{low};
    for (std::size_t i = 1; i < parts && !values.empty(); ++i) {
        const double edge = values[i * values.size() / parts];
        if (edge > result.back() && edge < high) result.push_back(edge);
    }
    result.push_back(high);
    return result;
}

std::size_t cell_of(const std::vector<double>& bounds, double value) {
    const auto above = std::upper_bound(bounds.begin() + 1, bounds.end() - 1, value);
    return static_cast<std::size_t>(above - bounds.begin()) - 1;
}

/// Cells of the hemisphere with about as many draws in each.
class Cells {
  public:
    Cells(const DirectionSampler& sampler, const Direction& in, Random& random) : sampler_{sampler}, in_{in} {
        std::vector<Angles> pilot;
        for (int i = 0; i < 12000; ++i) {
            const auto drawn = sampler.draw(in, uniforms(random));
            if (drawn.lobe != Lobe::none && drawn.lobe != Lobe::specular)
                pilot.push_back(angles(in, drawn.out));
        }
        std::vector<double> thetas;
        for (const Angles& a : pilot) thetas.push_back(a.theta);
        thetas_ = quantiles(thetas, 12, 0, pi / 2);
        std::vector<std::vector<double>> rows(thetas_.size() - 1);
        for (const Angles& a : pilot) rows[cell_of(thetas_, a.theta)].push_back(a.phi);
        for (auto& row : rows) azimuths_.push_back(quantiles(std::move(row), 8, -pi, pi));
    }

    [[nodiscard]] std::pair<std::size_t, std::size_t> of(const Direction& out) const {
        const Angles a = angles(in_, out);
        const std::size_t row = cell_of(thetas_, a.theta);
        return {row, cell_of(azimuths_[row], a.phi)};
    }
    /// Probability of each cell by quadrature of the density.
    [[nodiscard]] std::map<std::pair<std::size_t, std::size_t>, double> probabilities() const {
        const double mirror = std::atan2(in_.mirror().sin_phi(), in_.mirror().cos_phi());
        const auto density = [&](double theta, double phi) {
            return sampler_.pdf(in_, Direction::from_angles(theta, mirror + phi));
        };
        std::map<std::pair<std::size_t, std::size_t>, double> result;
        for (std::size_t i = 0; i + 1 < thetas_.size(); ++i) {
            for (std::size_t j = 0; j + 1 < azimuths_[i].size(); ++j) {
                result[{i, j}] =
                    cell(density, {thetas_[i], thetas_[i + 1]}, {azimuths_[i][j], azimuths_[i][j + 1]},
                         azimuths_[i][azimuths_[i].size() / 2] - azimuths_[i][azimuths_[i].size() / 2 - 1]);
            }
        }
        return result;
    }

  private:
    /// Integral over a cell, in pieces that grow away from the lobe, which outer cells contain the flank of.
    template <class Function>
    [[nodiscard]] double cell(const Function& f, std::pair<double, double> theta,
                              std::pair<double, double> phi, double width) const {
        const std::size_t middle = thetas_.size() / 2;
        const auto rows =
            edges(theta.first, theta.second, thetas_[middle], thetas_[middle] - thetas_[middle - 1]);
        const auto columns = edges(phi.first, phi.second, 0, width);
        double sum = 0;
        for (std::size_t i = 1; i < rows.size(); ++i) {
            for (std::size_t j = 1; j < columns.size(); ++j)
                sum += patch(f, rows[i - 1], rows[i], columns[j - 1], columns[j], 1e-5);
        }
        return sum;
    }

    const DirectionSampler& sampler_;
    Direction in_;
    std::vector<double> thetas_;
    std::vector<std::vector<double>> azimuths_;
};

/// Pearson's statistic with cells pooled up to 10 expected draws.
class ChiSquared {
  public:
    void add(double expected, double found) {
        expected_ += expected;
        found_ += found;
        if (expected_ >= 10) close();
    }
    /// The probability of a worse fit by chance.
    [[nodiscard]] double p_value() {
        if (expected_ > 0) sum_ += (found_ - expected_) * (found_ - expected_) / std::max(expected_, 1.0);
        if (cells_ < 2) return 1;
        return cdf(complement(boost::math::chi_squared{static_cast<double>(cells_ - 1)}, sum_));
    }

  private:
    void close() {
        sum_ += (found_ - expected_) * (found_ - expected_) / expected_;
        expected_ = found_ = 0;
        ++cells_;
    }
    double expected_ = 0, found_ = 0, sum_ = 0;
    std::size_t cells_ = 0;
};

}  // namespace

TEST_CASE("draws fall as their density says, and density, specular and none make 1") {
    const double significance = 0.01;
    std::size_t tests = 0;
    double least = 1;
    WorstCase sums{"density, specular and none, from 1, in standard errors", 4.5};
    for (std::size_t k = 0; k < cases().size(); k += stride()) {
        const Case& c = cases()[k];
        const DirectionSampler sampler = c.sampler();
        const Direction in = c.in();
        Random random{1000 + k};
        const Cells cells{sampler, in, random};
        std::map<std::pair<std::size_t, std::size_t>, double> found;
        const auto n = static_cast<double>(draws());
        double none = 0;
        double specular = 0;
        for (std::size_t i = 0; i < draws(); ++i) {
            const auto drawn = sampler.draw(in, uniforms(random));
            if (drawn.lobe == Lobe::none)
                ++none;
            else if (drawn.lobe == Lobe::specular)
                ++specular;
            else
                ++found[cells.of(drawn.out)];
        }
        ChiSquared fit;
        const double mirror = sampler.specular_probability(in);
        fit.add(n * mirror, specular);
        double total = mirror;
        for (const auto& [cell, probability] : cells.probabilities()) {
            fit.add(n * probability, found[cell]);
            total += probability;
        }
        fit.add(n * std::max(0.0, 1 - total), none);
        const double p = fit.p_value();
        if (p < least) least = p;
        ++tests;
        INFO(c.text() << ", total " << total << ", none " << none / n);
        CHECK(p > 1 - std::pow(1 - significance,
                               static_cast<double>(stride()) / static_cast<double>(cases().size())));
        const double error = std::sqrt(std::max(none, 1.0)) / n + 2e-6;
        sums.note(std::abs(total + none / n - 1) / error, [&] { return c.text(); });
    }
    std::cout << "sampler: least p " << least << " of " << tests << " chi-squared tests\n";
    sums.check();
}

TEST_CASE("the mean weight is the reflectance, and weights stay near it") {
    WorstCase means{"mean weight from the reflectance, in standard errors", 4};
    WorstCase to_45{"relative deviation of weights to 45 deg, sigma0/tau <= 0.25", 0.33};
    WorstCase at_60{"the same at 60 deg", 1};
    WorstCase to_80{"the same at 75 and 80 deg", 1.5};
    WorstCase beyond{"the same at 89 deg", 2.5};
    WorstCase steep{"the same for sigma0/tau = 1", 2.5};
    WorstCase most{"greatest weight over the mean", 20};
    WorstCase none{"share of draws that are none", 0.1};
    for (std::size_t k = 0; k < cases().size(); k += stride()) {
        const Case& c = cases()[k];
        const auto where = [&] { return c.text(); };
        const DirectionSampler sampler = c.sampler();
        const Direction in = c.in();
        Random random{5000 + k};
        Tally all;
        Tally lobe;  // all but the specular draws
        for (std::size_t i = 0; i < draws(); ++i) {
            const auto drawn = sampler.sample(in, uniforms(random));
            all.add(drawn.weight);
            if (drawn.lobe != Lobe::specular) lobe.add(drawn.weight);
            if (drawn.lobe == Lobe::none) ++lobe.none;
        }
        const double specular =
            specular_reflectance(c.surface(), view(c.surface(), in), c.sample().wavelength, c.index).value();
        const double reflectance = specular + reflectance_by_quadrature(c) + c.albedo;
        const double error = all.deviation() / std::sqrt(static_cast<double>(draws())) + 1e-5 * reflectance;
        means.note(std::abs(all.mean() - reflectance) / error, where);
        if (lobe.count < draws() / 100) continue;
        const double relative = lobe.deviation() / lobe.mean();
        WorstCase& bound = c.slope > 0.25  ? steep
                           : c.theta <= 45 ? to_45
                           : c.theta <= 60 ? at_60
                           : c.theta <= 80 ? to_80
                                           : beyond;
        if (c.albedo == 0) bound.note(relative, where);
        most.note(lobe.most / lobe.mean(), where);
        none.note(static_cast<double>(lobe.none) / static_cast<double>(lobe.count), where);
    }
    means.check();
    to_45.check();
    at_60.check();
    to_80.check();
    beyond.check();
    steep.check();
    most.check();
    none.check();
}

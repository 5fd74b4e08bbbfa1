#include "validation/fit/fit_uncertainty.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "fit_samples.hpp"

using namespace hts;
using namespace hts::validation;
using namespace hts::validation::testing;

namespace {

/// A straight line over 8 curves of 12 data each: a common height, and a slope within each curve.
struct Lines {
    static constexpr std::size_t curves = 8, each = 12;
    Columns jacobian{std::vector<double>(curves * each, 1.0), std::vector<double>(curves* each)};
    Scatter scatter{std::vector<double>(curves * each), std::vector<double>(curves* each, 1.0),
                    std::vector<std::size_t>(curves* each)};

    Lines() {
        for (std::size_t i = 0; i < curves * each; ++i) {
            jacobian[1][i] = static_cast<double>(i % each) / each - 0.5;
            scatter.curves[i] = i / each;
        }
    }
    /// Draws residuals, fits both parameters and leaves what is left; returns the parameters.
    std::vector<double> fit(hts::testing::Random& random, double noise, double gain) {
        std::vector<double> gains;
        for (std::size_t c = 0; c < curves; ++c) gains.push_back(gain * gaussian(random));
        auto& residuals = scatter.residuals;
        for (std::size_t i = 0; i < residuals.size(); ++i)
            residuals[i] = gains[scatter.curves[i]] + noise * gaussian(random);
        auto found = bounded_linear_solution(jacobian, residuals, {{-100, 100}, {-100, 100}});
        for (std::size_t i = 0; i < residuals.size(); ++i)
            residuals[i] -= found[0] * jacobian[0][i] + found[1] * jacobian[1][i];
        return found;
    }
};

const ParameterRange plain{"x", "x", "1", Motion::steps, 0, 1, {0}};

}  // namespace

TEST_CASE("noise and gains come back from residuals, in the mean") {
    Lines lines;
    hts::testing::Random random{3};
    const double noise_in = 0.02, gain_in = 0.05;
    double variance = 0, gain = 0;
    constexpr int times = 400;
    for (int i = 0; i < times; ++i) {
        lines.fit(random, noise_in, gain_in);
        const Noise found = noise(lines.jacobian, lines.scatter);
        variance += found.variance / times;
        gain += found.gain_variance / times;
    }
    CHECK(variance == Approx(noise_in * noise_in).epsilon(0.03));
    CHECK(gain == Approx(gain_in * gain_in).epsilon(0.08));
}

TEST_CASE("standard errors are those of repeated measurements") {
    Lines lines;
    hts::testing::Random random{4};
    const double gain = GENERATE(0.0, 0.05);
    double height = 0, slope = 0, of_height = 0, of_slope = 0;
    constexpr int times = 400;
    for (int i = 0; i < times; ++i) {
        const auto found = lines.fit(random, 0.02, gain);
        const auto errors = uncertainty({{"height", plain, 1}, {"slope", plain, 1}}, lines.jacobian,
                                        lines.scatter, noise(lines.jacobian, lines.scatter))
                                .standard_errors;
        height += found[0] * found[0] / times;
        slope += found[1] * found[1] / times;
        of_height += errors[0] * errors[0] / times;
        of_slope += errors[1] * errors[1] / times;
    }
    INFO("gain " << gain << ": height " << std::sqrt(height) << " for " << std::sqrt(of_height) << ", slope "
                 << std::sqrt(slope) << " for " << std::sqrt(of_slope));
    // of few curves Student's t is wider: 7/5 for 7 degrees of freedom
    CHECK(of_height / height > 0.85);
    CHECK(of_height / height < 1.7);
    CHECK(of_slope / slope == Approx(1).epsilon(0.2));
}

TEST_CASE("one curve, or data of which each is a curve, tell no gain") {
    Lines lines;
    hts::testing::Random random{5};
    lines.fit(random, 0.02, 0.05);
    std::ranges::fill(lines.scatter.curves, std::size_t{0});
    CHECK(noise(lines.jacobian, lines.scatter).gain_variance == 0);
    for (std::size_t i = 0; i < lines.scatter.curves.size(); ++i) lines.scatter.curves[i] = i;
    CHECK(noise(lines.jacobian, lines.scatter).gain_variance == 0);
    CHECK(student_variance(1e9) == Approx(1));
    CHECK(student_variance(4) == Approx(2));
    CHECK(student_variance(0.1) == Approx(5));
}

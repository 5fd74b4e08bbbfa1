// The self-affine spectrum between two cut-offs, by quadrature of its formula.

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/bessel.hpp>
#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/correlation/correlation.hpp"
#include "hts/error.hpp"

namespace hts {
namespace {

using testing::relative_error;
using testing::WorstCase;

double square(double x) {
    return x * x;
}

struct Nodes {
    std::vector<double> x, weight;
};

/// Gauss's rule of 15 points in each of equal panels.
Nodes nodes(double to, double panel) {
    using Rule = boost::math::quadrature::gauss<double, 15>;
    Nodes result;
    const int panels = static_cast<int>(std::ceil(to / panel));
    const double half = to / panels / 2;
    for (int i = 0; i < panels; ++i) {
        for (std::size_t j = 0; j < Rule::abscissa().size(); ++j) {
            for (const double sign : {-1.0, 1.0}) {
                if (j == 0 && sign > 0) continue;  // the middle
                result.x.push_back(half * (2 * i + 1 + sign * Rule::abscissa()[j]));
                result.weight.push_back(half * Rule::weights()[j]);
            }
        }
    }
    return result;
}

/// Of the formula, in units of the longest period over 2 pi.
class Fractal {
  public:
    Fractal(double slope, double periods) : slope_{slope}, periods_{periods} {
        const Nodes q = nodes(1.5 * periods, 0.3);
        for (std::size_t i = 0; i < q.x.size(); ++i) whole_ += q.weight[i] * q.x[i] * density(q.x[i]);
        x_ = nodes(40, 0.2);
        for (const double x : x_.x) {
            double sum = 0;
            for (std::size_t i = 0; i < q.x.size(); ++i)
                sum += q.weight[i] * q.x[i] * density(q.x[i]) * boost::math::cyl_bessel_j(0, q.x[i] * x);
            correlation_.push_back(sum / whole_);
        }
    }
    [[nodiscard]] double spectrum(double q) const { return density(q) / whole_; }
    /// 2 D: the first order by the formula, since it falls slowly; the others by quadrature.
    [[nodiscard]] double twice_lobe(double g, double q) const {
        double rest = 0;
        for (std::size_t i = 0; i < x_.x.size(); ++i) {
            const double y = g * correlation_[i];
            rest += x_.weight[i] * x_.x[i] * (std::expm1(y) - y) * boost::math::cyl_bessel_j(0, q * x_.x[i]);
        }
        return 2 * std::exp(-g) * (g * spectrum(q) + rest);
    }

  private:
    [[nodiscard]] double density(double q) const {
        return std::pow(1 + q * q, -slope_ / 2) *
               std::erfc(std::log(q / periods_) / (0.05 * std::sqrt(2.0))) / 2;
    }

    double slope_, periods_, whole_ = 0;
    Nodes x_;
    std::vector<double> correlation_;
};

}  // namespace

TEST_CASE("Fractal: spectrum and lobe are those of the formula") {
    for (const double slope : {1.3, 2.4}) {  // of the first no variance would be finite without an end
        constexpr double periods = 10;
        const auto [shape, length, rms] = Correlation::fractal(slope, periods);
        const double scale = 2 * std::numbers::pi * length;  // q of ours over that of the formula
        const Fractal exact{slope, periods};
        WorstCase spectrum{"spectrum, C " + shortest(slope), 4e-6};
        for (const double q : {1e-5, 0.1, 0.5, 1.0, 3.0, 8.0, 9.5, 10.0})
            spectrum.note(
                relative_error(std::exp(shape.log_spectrum(q * scale)) * square(scale), exact.spectrum(q)),
                [&] { return "q = " + shortest(q); });
        spectrum.check();
        WorstCase lobe{"lobe, C " + shortest(slope), accuracy::correlation_two_scales};
        WorstCase tail{"lobe about the end of the spectrum, C " + shortest(slope), 3e-4};
        for (const double g : {0.01, 0.3, 2.0, 10.0}) {
            for (const double q : {0.0, 0.3, 1.0, 2.0, 4.0, 7.0, 10.0}) {
                const double expected = exact.twice_lobe(g, q);
                const double error = relative_error(shape.lobe(g, q * scale).value * square(scale), expected);
                (q < 7 ? lobe : tail).note(error, [&] {
                    return "g = " + shortest(g) + ", q = " + shortest(q);
                });
            }
        }
        lobe.check();
        tail.check();
        CHECK(rms == 1);
    }
}

TEST_CASE("Fractal: over many decades it is the K-correlation of its slope, which goes on") {
    const double nu = 0.75;
    const auto [shape, length, rms] = Correlation::fractal(2 * nu + 2, 1e5);
    const double scale = 2 * std::numbers::pi * length;
    const Correlation endless = Correlation::matern(nu);
    WorstCase worst{"fractal against K-correlation", accuracy::correlation_tail};
    for (const double g : {0.01, 1.0, 30.0})
        for (const double q : {0.01, 0.5, 2.0, 20.0})
            worst.note(
                relative_error(shape.lobe(g, q * scale).value * square(scale), endless.lobe(g, q).value),
                [&] { return "g = " + shortest(g) + ", q = " + shortest(q); });
    worst.check();
    CHECK(relative_error(shape.slope_variance_below(1e3 * scale) / square(scale),
                         endless.slope_variance_below(1e3)) < 1e-5);
}

TEST_CASE("Fractal: two halves are the whole") {
    const Correlation shape = Correlation::fractal(2.4, 10).shape;
    const Correlation::Part half{0.5, shape, 1};
    const Correlation sum = Correlation::sum(std::vector{half, half});
    WorstCase worst{"sum of two equal fractals", 1e-12};
    for (const double g : {0.01, 0.3, 10.0})
        for (const double q : {0.0, 1.0, 30.0, 100.0, 1000.0})
            worst.note(relative_error(sum.lobe(g, q).value, shape.lobe(g, q).value),
                       [&] { return "g = " + shortest(g) + ", q = " + shortest(q); });
    worst.check();
}

TEST_CASE("Fractal: what is no such spectrum is refused") {
    using Catch::Matchers::Contains;
    CHECK_THROWS_WITH(Correlation::fractal(11, 10),
                      Contains("slope of a fractal spectrum 11: must be from 0.1 to 10"));
    CHECK_THROWS_WITH(Correlation::fractal(2, 1), Contains("must be from 2 to 1e+07"));
    CHECK_THAT(Correlation::fractal(2.4, 100).shape.name(),
               Contains("fractal, C 2.4 over periods of 1 : 100"));
}

}  // namespace hts

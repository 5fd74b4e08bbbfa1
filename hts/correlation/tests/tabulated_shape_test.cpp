#include "hts/correlation/tabulated_shape.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/correlation/correlation.hpp"
#include "hts/error.hpp"

namespace hts {
namespace {

using testing::relative_error;
using testing::WorstCase;

double density_at(double f) {
    return std::pow(1 + 25 * f * f, -1.5);
}

}  // namespace

TEST_CASE("Tabulated shape: spectra that end scatter all the light, wherever they end") {
    struct Reach {
        double first, last;
        int count;
    };
    for (const Reach& reach : {Reach{0.002, 2.8, 77},
                               {0.02, 2.4, 20},
                               {0.002, 2.96, 370},
                               {0.01, 1, 26},
                               {0.1, 20, 110},
                               {1e-5, 0.01, 73},
                               {0.5, 0.9, 30}}) {
        std::vector<double> frequency, density;
        for (int i = 0; i < reach.count; ++i) {
            frequency.push_back(reach.first * std::pow(reach.last / reach.first, i / (reach.count - 1.0)));
            density.push_back(density_at(frequency.back()));
        }
        const auto scaled = Correlation::of_spectrum(frequency, density, false);
        const Correlation& shape = scaled.shape;
        const std::string name = "spectrum from " + shortest(reach.first) + " to " + shortest(reach.last);
        const double turn = 2 * std::numbers::pi * scaled.length;
        WorstCase sum_rule{name + ", integral of D q dq", 2e-3};
        for (const double g : {1e-3, 0.1, 1.0, 8.0}) {
            constexpr double step = 0.01;
            double sum = 0;
            for (double log_q = -16; log_q < std::log(10 * turn * reach.last); log_q += step) {
                const double q = std::exp(log_q);
                sum += shape.lobe(g, q).value / 2 * q * q * step;
            }
            sum_rule.note(relative_error(sum, -std::expm1(-g)), [&] { return "g = " + shortest(g); });
        }
        sum_rule.check();
        // of small g the lobe is the spectrum
        WorstCase first_order{name + ", first order", 2e-3};
        const double g = 1e-4;
        for (double f = 1.3 * reach.first; f < 0.7 * reach.last; f *= 1.1) {
            const double q = turn * f;
            if (density_at(f) < 1e-4) continue;
            first_order.note(
                relative_error(shape.lobe(g, q).value, 2 * g * std::exp(-g + shape.log_spectrum(q))),
                [&] { return "f = " + shortest(f); });
        }
        if (reach.last > 3 * reach.first) first_order.check();
    }
}

}  // namespace hts

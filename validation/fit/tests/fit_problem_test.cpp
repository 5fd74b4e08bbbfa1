#include "validation/fit/fit_problem.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "fit_samples.hpp"

using namespace hts;
using namespace hts::validation;
using namespace hts::validation::testing;

TEST_CASE("derivatives of residuals are those of differences") {
    const auto grid = spectral::WavelengthGrid::from_micrometres({0.9, 1.0});
    const auto data = seen(he(0.2, 1.5, 0.1), in_plane(), 0.01, grid);
    for (const std::string model : {"he", "kurt", "ggx"}) {
        for (const Residual residual : {Residual::logarithmic, Residual::relative, Residual::cosine}) {
            for (const Loss loss : {Loss::squares, Loss::huber, Loss::cauchy}) {
                const FitRequest request{.model = model,
                                         .freed = {"scale"},
                                         .residual = residual,
                                         .loss = loss,
                                         .loss_scale = 0.3};
                const FitProblem problem{request, data};
                auto x = problem.completed(problem.starts().front());
                for (double& each : x) each *= 0.97;  // off every bound
                const auto [values, columns] = problem.residuals(x, true);
                REQUIRE(columns.size() == x.size());
                for (std::size_t k = 0; k < x.size(); ++k) {
                    const double step = 1e-4 * std::max(1.0, std::abs(x[k]));
                    auto above = x, below = x;
                    above[k] += step;
                    below[k] -= step;
                    const auto high = problem.residuals(above, false).residuals;
                    const auto low = problem.residuals(below, false).residuals;
                    double error = 0, size = 0;
                    for (std::size_t r = 0; r < high.size(); ++r) {
                        error = std::max(error, std::abs((high[r] - low[r]) / (2 * step) - columns[k][r]));
                        size = std::max(size, std::abs(columns[k][r]));
                    }
                    INFO(model << ", " << name(residual) << ", " << name(loss) << ", "
                               << problem.places()[problem.free()[k]].parameter.name);
                    CHECK(error < 2e-2 * size);
                }
            }
        }
    }
}

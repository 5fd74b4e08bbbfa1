#include "spectral/energy/expected_distance.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <optional>

#include "spectral/text/csv.hpp"

using namespace hts::spectral;
using hts::RefractiveIndex;

namespace {

const RefractiveIndex aluminium{1, 6.5}, glass{1.5, 0}, silicon{4, 0.1};
const hts::Surface gaussian{1, 1};

}  // namespace

TEST_CASE("where a case was solved the expected distance is near what was found, and every case is studied") {
    const auto table = CsvTable::read(HTS_SOURCE_DIR "/spectral/energy/data/model-distances.csv");
    const auto number = [&](std::size_t row, const char* column) {
        return table.number(row, table.column(column));
    };
    std::size_t conductors = 0, k_correlated = 0;
    double worst = 1, squares = 0;
    for (std::size_t row = 0; row < table.row_count(); ++row) {
        const bool conductor = number(row, "index_k") > 0;
        const double nu = number(row, "nu");
        conductors += conductor && nu == 0 ? 1U : 0U;
        k_correlated += nu > 0 ? 1U : 0U;
        const auto expected =
            expected_distance({number(row, "sigma0_over_lambda"), number(row, "tau_over_lambda"),
                               number(row, "theta_i_deg"), nu > 0 ? std::optional{nu} : std::nullopt},
                              conductor ? aluminium : glass);
        CHECK(expected.studied);
        for (const auto& [value, column] : {std::pair{expected.distance.he.te, "he_te_db"},
                                            {expected.distance.he.unpolarised, "he_db"},
                                            {expected.distance.unified.tm, "he_unified_tm_db"},
                                            {expected.distance.unified.unpolarised, "he_unified_db"}}) {
            const double off = std::fabs(std::log(value / number(row, column)));
            worst = std::fmax(worst, std::exp(off));
            squares += off * off / static_cast<double>(4 * table.row_count());
        }
    }
    std::printf("expected distance of the cases themselves: factor %.2f rms, %.2f at worst\n",
                std::exp(std::sqrt(squares)), worst);
    CHECK(std::exp(std::sqrt(squares)) < 1.3);
    CHECK(distance_study(gaussian, aluminium).cases == conductors);
    CHECK(distance_study(gaussian, glass).cases == table.row_count() - conductors - k_correlated);
    const hts::Surface exponential = hts::Surface{1, 1}.correlated(hts::Correlation::exponential());
    CHECK(distance_study(exponential, glass).cases == k_correlated);
}

TEST_CASE("a case that is left out is met within the factor that is said") {
    for (const RefractiveIndex& index : {aluminium, glass}) {
        const auto& [he, unified] = distance_study(gaussian, index).left_out;
        for (const double factor :
             {he.te, he.tm, he.unpolarised, unified.te, unified.tm, unified.unpolarised}) {
            CHECK(factor > 1.05);
            CHECK(factor < 2);
        }
    }
    CHECK(distance_study(gaussian, aluminium).left_out.unified.unpolarised < 1.6);
    const auto& [he, unified] =
        distance_study(hts::Surface{1, 1}.correlated(hts::Correlation::matern(1)), aluminium).left_out;
    std::printf("K-correlated, left out: factors %.2f %.2f %.2f of he, %.2f %.2f %.2f of he_unified\n", he.te,
                he.tm, he.unpolarised, unified.te, unified.tm, unified.unpolarised);
    for (const double factor : {he.te, he.tm, he.unpolarised, unified.te, unified.tm, unified.unpolarised})
        CHECK(factor < 2);
}

TEST_CASE("he_unified is expected nearer to exact than he on a gentle surface between the cases") {
    const auto [distance, studied] = expected_distance({0.18, 1.4, 40}, aluminium);
    CHECK(studied);
    CHECK(distance.unified.te < distance.he.te);
    CHECK(distance.unified.tm < distance.he.tm / 2);
    CHECK(distance.unified.tm > 0.05);
    CHECK(distance.he.tm < 2);
}

TEST_CASE("what was not studied is said to be so") {
    CHECK_FALSE(expected_distance({0.25, 2, 85}, aluminium).studied);
    CHECK_FALSE(expected_distance({1, 1.5, 30}, aluminium).studied);
    CHECK_FALSE(expected_distance({5, 40, 30}, aluminium).studied);
    CHECK_FALSE(expected_distance({0.01, 1, 30}, aluminium).studied);
    CHECK_FALSE(expected_distance({0.25, 2, 30}, silicon).studied);
    CHECK_FALSE(expected_distance({0.25, 4, 30}, glass).studied);
    CHECK(expected_distance({0.25, 2, 30}, glass).studied);
    CHECK(expected_distance({0.15, 2.5, 30, 0.5}, aluminium).studied);
    CHECK_FALSE(expected_distance({0.15, 2.5, 30, 2.5}, aluminium).studied);
    CHECK_FALSE(expected_distance({0.15, 2.5, 30, 0.5}, glass).studied);  // conductors alone were solved
    CHECK_FALSE(expected_distance({0.4, 2.5, 30, 0.5}, aluminium).studied);
    const auto [distance, studied] = expected_distance({0, 1, 89}, silicon);  // a mirror: Fresnel's equations
    CHECK(studied);
    CHECK(distance.he.unpolarised == 0);
}

#include "validation/scattering/moment_method.hpp"

#include <omp.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <optional>

#include "hts/error.hpp"

using namespace hts::validation;

namespace {

MomentSettings small() {
    MomentSettings settings;
    settings.realisations = 20;
    settings.length = 16;
    return settings;
}

}  // namespace

TEST_CASE("moment method: a flat plate mirrors everything") {
    for (const MomentResult& result : moment_results({0, 1}, {0, 40}, small())) {
        INFO(result.of.theta_i_deg << " " << name(result.of.polarisation));
        CHECK(result.energy == Approx(1).epsilon(2e-3));
        CHECK(result.mirror == Approx(1).epsilon(2e-3));
        CHECK(result.kirchhoff_energy == Approx(1).epsilon(2e-3));
        for (const AngularBin& bin : result.bins) CHECK(std::fabs(bin.exact) < 1e-9);
    }
}

TEST_CASE("moment method: a rough profile scatters all the light, gently sloped nearly as Kirchhoff has it") {
    const auto results = moment_results({0.1, 2}, {0, 30}, small());
    REQUIRE(results.size() == 6);
    for (const MomentResult& result : results) {
        INFO(result.of.theta_i_deg << " " << name(result.of.polarisation));
        CHECK(result.energy == Approx(1).epsilon(5e-3));
        CHECK(distance(result, ProfileModel::kirchhoff).rms < 0.3);
        CHECK(chance(result) < 0.1);
        double incoherent = 0, kirchhoff = 0;  // of the same realisations
        for (const AngularBin& bin : result.bins) {
            incoherent += bin.exact * bin_width_deg * std::numbers::pi / 180;
            kirchhoff += bin.kirchhoff * bin_width_deg * std::numbers::pi / 180;
        }
        CHECK(incoherent == Approx(kirchhoff).epsilon(0.01));
        CHECK(result.past_ends < 1e-3);
        CHECK(result.transmitted == 0);
    }
    // unpolarised is half of each
    CHECK(results[2].of.polarisation == Polarisation::unpolarised);
    CHECK(results[2].bins[20].exact == Approx((results[0].bins[20].exact + results[1].bins[20].exact) / 2));
}

TEST_CASE("moment method: a rough profile of glass reflects and transmits all the light") {
    MomentSettings settings = small();
    settings.length = 12;
    settings.points_per_wavelength = 12;
    settings.index = hts::RefractiveIndex{1.5, 0};
    const auto results = moment_results({0.05, 1}, {40}, settings);
    for (const MomentResult& result : results) {
        INFO(name(result.of.polarisation));
        CHECK(result.energy == Approx(1).epsilon(5e-3));
        const double plane = facet_reflectance(result.of, 40 * std::numbers::pi / 180);
        CHECK(1 - result.transmitted == Approx(plane).epsilon(0.15));  // a little rough
        CHECK(result.kirchhoff_energy == Approx(plane).epsilon(0.15));
        CHECK(distance(result, ProfileModel::kirchhoff).rms < 1.5);
    }
    CHECK(results[0].transmitted + 0.03 < results[1].transmitted);
    CHECK(results[2].of.polarisation == Polarisation::unpolarised);
    CHECK(results[2].bins[25].model[0] ==
          Approx((results[0].bins[25].model[0] + results[1].bins[25].model[0]) / 2));
}

TEST_CASE("moment method: the longer the profile, the less passes its ends") {
    MomentSettings settings = small();
    std::vector<std::vector<MomentResult>> results;
    for (const double length : {8, 12, 16}) {
        settings.length = length;
        results.push_back(moment_results({0.2, 1}, {60}, settings));
    }
    for (std::size_t i = 0; i < polarisations.size(); ++i) {
        INFO(name(polarisations[i]));
        CHECK(results[1][i].past_ends < results[0][i].past_ends);
        CHECK(results[2][i].past_ends < results[1][i].past_ends);
        CHECK(results[2][i].past_ends > 0);
    }
}

TEST_CASE("moment method: more points per wavelength change nothing that matters") {
    MomentSettings coarse = small(), fine = small();
    coarse.realisations = fine.realisations = 20;
    coarse.length = fine.length = 10;
    fine.points_per_wavelength = 20;
    const RoughnessStatistics surface{0.2, 1};
    // the same seeds draw other surfaces at another step, so energy is compared, and lobes within chance
    const auto a = moment_results(surface, {20}, coarse), b = moment_results(surface, {20}, fine);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(a[i].energy == Approx(b[i].energy).epsilon(0.01));
        CHECK(std::fabs(distance(a[i], ProfileModel::kirchhoff).bias -
                        distance(b[i], ProfileModel::kirchhoff).bias) <
              4 * std::hypot(chance(a[i]), chance(b[i])));
    }
}

TEST_CASE("moment method: the same bits on one thread and on more") {
    MomentSettings settings = small();
    settings.length = 6;
    for (const auto index : {std::optional<hts::RefractiveIndex>{}, {hts::RefractiveIndex{1.5, 0}}}) {
        settings.index = index;
        const int threads = omp_get_max_threads();
        omp_set_num_threads(1);
        const auto one = moment_results({0.2, 1}, {10}, settings);
        omp_set_num_threads(3);
        const auto three = moment_results({0.2, 1}, {10}, settings);
        omp_set_num_threads(threads);
        for (std::size_t i = 0; i < one.size(); ++i) {
            CHECK(one[i].energy == three[i].energy);
            CHECK(one[i].past_ends == three[i].past_ends);
            CHECK(one[i].transmitted == three[i].transmitted);
            CHECK((one[i].transmitted > 0.5) == index.has_value());
            for (std::size_t bin = 0; bin < one[i].bins.size(); ++bin)
                CHECK(one[i].bins[bin].exact == three[i].bins[bin].exact);
        }
    }
}

TEST_CASE("moment method: too few realisations for a standard error are refused") {
    MomentSettings settings = small();
    settings.realisations = 19;
    CHECK_THROWS_WITH(moment_results({0.2, 1}, {10}, settings), "realisations 19: must be at least 20");
}

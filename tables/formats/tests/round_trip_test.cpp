#include "tables/formats/round_trip.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "hts/error.hpp"
#include "materials.hpp"
#include "tables/formats/specular_box.hpp"

namespace {

using namespace hts;
using namespace hts::tables;
using hts::tables::testing::brdf_of;

const auto grid = spectral::WavelengthGrid::from_micrometres({0.45, 0.6});

/// A reflectance seen through a fault, which also draws in proportion to the cosine.
class Faulty final : public spectral::Evaluator, public HasDensity {
  public:
    using Fault = std::function<double(const DirectionPair&, std::size_t, double)>;
    Faulty(spectral::Reflectance brdf, Fault fault)
        : spectral::Evaluator{brdf.name(), brdf.wavelengths()},
          brdf_{std::move(brdf)},
          fault_{std::move(fault)} {}

    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        brdf_.evaluator().brdf(pair, values);
        for (std::size_t k = 0; k < values.size(); ++k) values[k] = fault_(pair, k, values[k]);
    }
    void specular_reflectance(const Direction& in, std::span<double> values) const noexcept override {
        brdf_.evaluator().specular_reflectance(in, values);
    }
    [[nodiscard]] double density(const DirectionPair& pair) const noexcept override {
        return pair.out.cos_theta() / std::numbers::pi;
    }

  private:
    spectral::Reflectance brdf_;
    Fault fault_;
};

spectral::Reflectance faulty(const spectral::Reflectance& brdf, Faulty::Fault fault) {
    return spectral::Reflectance{std::make_shared<const Faulty>(brdf, std::move(fault))};
}

const RoundTripOptions few{2000, 5};

}  // namespace

TEST_CASE("a reflectance read back unchanged has no error, and its albedo is the model's") {
    const auto plastic = brdf_of("smooth-plastic.json", grid);  // sigma_0 = 0: the uniform-diffuse 0.15 alone
    const RoundTrip same = round_trip(plastic, plastic, few);
    CHECK(same.pairs == 2000);
    CHECK(same.worst.error == 0);
    CHECK(same.density.empty());
    REQUIRE(same.worst_mueller);
    CHECK(same.worst_mueller->error == 0);
    REQUIRE(same.albedo.size() == 7);
    for (const AlbedoError& each : same.albedo) {
        CHECK(each.original == Approx(0.15).epsilon(2e-3));
        CHECK(each.read_back == each.original);
    }
}

TEST_CASE("a fault is found with its size and its place") {
    const auto aluminium = brdf_of("rough-aluminium.json", grid);
    const spectral::Reflectance brighter = faulty(
        aluminium, [](const DirectionPair&, std::size_t k, double f) { return k == 1 ? 1.03 * f : f; });
    const RoundTrip everywhere = round_trip(aluminium, brighter, few);
    CHECK(everywhere.worst.error == Approx(0.03).epsilon(0.02));  // at the peak
    CHECK(everywhere.worst.wavelength_um == 0.6);
    for (const AlbedoError& each : everywhere.albedo) {
        CHECK(each.wavelength_um == 0.6);
        CHECK(each.read_back == Approx(1.03 * each.original).epsilon(1e-12));
    }
    const spectral::Reflectance dark_corner =
        faulty(aluminium, [](const DirectionPair& pair, std::size_t, double f) {
            return pair.in.cos_theta() < std::cos(1.4) && pair.out.cos_theta() < std::cos(1.3) ? 0 : f;
        });
    const RoundTrip corner = round_trip(aluminium, dark_corner, few);
    CHECK(corner.worst.error > 0.5);
    CHECK(corner.worst.read_back == 0);
    CHECK(corner.worst.theta_i > 1.4);
    CHECK(corner.worst.theta_r > 1.3);
    CHECK(corner.median == 0);
    const spectral::Reflectance not_a_number =
        faulty(aluminium, [](const DirectionPair&, std::size_t, double) { return std::nan(""); });
    CHECK(std::isinf(round_trip(aluminium, not_a_number, few).worst.error));
}

TEST_CASE("the integrals see a specular term that is spread") {
    const auto plastic = brdf_of("smooth-plastic.json", grid);
    std::vector<double> mirror(2);
    for (const double solid_angle : {1e-5, 1e-3, 0.1}) {
        for (const auto& spread :
             {with_specular_box(plastic, solid_angle), with_specular_lobe(plastic, solid_angle)}) {
            const RoundTrip result = round_trip(plastic, spread, {2000, 5, 0, solid_angle});
            for (const AlbedoError& each : result.albedo) {
                if (each.theta_i > 1.1) continue;  // part of the wide ones is below the horizon
                plastic.specular_reflectance(Direction::from_angles(each.theta_i, 0), mirror);
                const double specular = mirror[each.wavelength_um < 0.5 ? 0 : 1];
                CHECK(each.read_back - each.original == Approx(specular).epsilon(0.02));
            }
            CHECK(result.worst.theta_r == Approx(result.worst.theta_i).margin(0.4));
        }
    }
}

TEST_CASE("a density is integrated") {
    const auto aluminium = brdf_of("rough-aluminium.json", grid);
    const spectral::Reflectance read =
        faulty(aluminium, [](const DirectionPair&, std::size_t, double f) { return f; });
    const RoundTrip result = round_trip(aluminium, read, few);
    REQUIRE(result.density.size() == 7);
    for (const DensityIntegral& each : result.density) CHECK(each.integral == Approx(1).epsilon(2e-3));
    CHECK(nlohmann::json::parse(result.json())["density"].size() == 7);
    CHECK(result.text().find("worst") != std::string::npos);
}

TEST_CASE("reflectances at different wavelengths are not compared") {
    const auto a = brdf_of("rough-aluminium.json", grid);
    const auto b = brdf_of("rough-aluminium.json", spectral::WavelengthGrid::from_micrometres({0.45, 0.61}));
    const auto c = brdf_of("rough-aluminium.json", spectral::WavelengthGrid::from_micrometres({0.45}));
    CHECK_THROWS_WITH(round_trip(a, b), Catch::Contains("wavelength read back 0.61 um"));
    CHECK_THROWS_WITH(round_trip(a, c), Catch::Contains("number of wavelengths read back 1"));
}

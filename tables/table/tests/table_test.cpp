#include "tables/table/table.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "hts/tests/support/comparison.hpp"
#include "spectral/models/material.hpp"
#include "table_fixture.hpp"

namespace {

using namespace hts;
using namespace hts::tables;
using namespace hts::tables::testing;

const DirectionPair pair{Direction::from_degrees(40, 10), Direction::from_degrees(50, 200)};

spectral::Reflectance model(const std::string& text) {
    return exact_model({"test", text, "test.json"}, std::array{0.5, 0.6});
}

}  // namespace

TEST_CASE("a table keeps its promise on directions it never saw, the Mueller matrix included") {
    const auto exact = exact_model(small_job().source, small_job().wavelengths_um);
    const TableError error = table_error(small_table().reflectance(), exact, 10'000, 4711);
    INFO("largest " << error.largest << ", 99 % " << error.percentile_99);
    CHECK(error.largest <= small_job().request.tolerance);
    CHECK(error.largest > 0.2 * small_job().request.tolerance);  // no finer than needed
    CHECK(error.percentile_99 < error.largest);
    CHECK(error.median < error.percentile_99);
    const auto other = model(small_job().source.material);
    CHECK_THROWS_AS(table_error(small_table().reflectance(), other, 10, 1), Error);
}

TEST_CASE("half as many nodes on any axis would fail the tolerance") {
    const TablePlan plan = plan_table(small_exact(), small_job().request);
    CHECK(plan.nodes.grazing == small_table().info().nodes.grazing);
    for (std::size_t TableNodes::*axis : {&TableNodes::grazing, &TableNodes::ratio, &TableNodes::turn}) {
        TablePlan half = plan;
        half.nodes.*axis /= 2;
        const auto table =
            measured_table(small_exact(), small_job().source, half, computed_slices(small_exact())(half));
        CHECK(table.error.largest > small_job().request.tolerance);
    }
}

TEST_CASE("a table is a spectral BRDF: parts, sums, batches, the other side") {
    const Table& table = small_table();
    std::array<double, 3> lobe, uniform, sum, mirror, albedo;
    table.directional_diffuse(pair, lobe);
    table.uniform_diffuse(uniform);
    table.brdf(pair, sum);
    table.specular_reflectance(pair.in, mirror);
    table.diffuse_albedo(pair.in, albedo);
    std::array<double, 6> batch;
    table.brdf(std::array{pair, DirectionPair{pair.out, pair.in}}, batch);
    std::array<Mueller, 3> matrices;
    table.mueller(pair, matrices);
    std::array<double, 3> exact_mirror;
    small_exact().specular_reflectance(pair.in, exact_mirror);
    for (std::size_t w = 0; w < 3; ++w) {
        CHECK(sum[w] == lobe[w] + uniform[w]);
        CHECK(uniform[w] == 0.1 / std::numbers::pi);
        CHECK(batch[w] == sum[w]);
        CHECK(batch[3 + w] == Approx(sum[w]).epsilon(1e-5));
        CHECK(matrices[w](0, 0) == Approx(sum[w]).epsilon(1e-12));
        CHECK(std::abs(mirror[w] - exact_mirror[w]) <= 3e-2 * (exact_mirror[w] + 1e-3));
    }
    CHECK(table.name() == "rough aluminium");
    CHECK(table.properties().polarised);
    CHECK(table.properties().isotropic);
    const Direction level = Direction::from_degrees(90, 0);
    table.directional_diffuse({pair.in, level}, lobe);
    CHECK(lobe == std::array{0.0, 0.0, 0.0});
    CHECK(Table::covers(pair));
    CHECK(Table::covers({Direction::from_degrees(88, 0), Direction::from_degrees(88, 9)}));
    CHECK_FALSE(Table::covers({Direction::from_degrees(88.01, 0), pair.out}));
}

TEST_CASE("the albedo of a table is the energy that the exact model reflects") {
    const auto reflector = spectral::material_from_text(small_job().source.material, "rough.json");
    hts::testing::WorstCase worst{"diffuse albedo of a table", 1.5e-2};
    for (const double degrees : {0.0, 20.0, 45.0, 70.0, 85.0}) {
        const Direction in = Direction::from_degrees(degrees, 0);
        std::array<double, 3> albedo;
        small_table().diffuse_albedo(in, albedo);
        const auto exact = reflector.at(Wavelength::from_micrometres(0.55)).albedo(in, 0);
        worst.note(std::abs(albedo[1] - exact.directional_diffuse - exact.uniform_diffuse),
                   [&] { return std::to_string(degrees) + " deg"; });
    }
    worst.check();
}

TEST_CASE("every isotropic model can be tabulated") {
    for (const char* text :
         {R"({"model": "walter", "distribution": "ggx", "alpha": 0.4, "index": {"n": 1.5, "k": 0}})",
          R"({"model": "lambert", "diffuse_albedo": 0.5})"}) {
        const auto exact = model(text);
        const Table table = build_table(exact, {"test", text, "test.json"}, {.tolerance = 0.1});
        const TableError error = table_error(table.reflectance(), exact, 10'000, 5);
        INFO(text << ": " << error.largest);
        CHECK(error.largest <= 0.1);
        CHECK_FALSE(table.properties().polarised);
        std::array<double, 2> values, expected;
        table.brdf(pair, values);
        exact.brdf(pair, expected);
        CHECK(values[0] == Approx(expected[0]).epsilon(0.1));
    }
}

TEST_CASE("what cannot be tabulated is refused by name") {
    const auto refusal = [](const std::string& text, const TableRequest& request) {
        const auto exact = model(text);
        return error_of([&] { return plan_table(exact, request); });
    };
    CHECK_THAT(refusal(R"({"model": "ward", "lobes": [{"ks": 0.3, "mx": 0.2, "my": 0.4}]})", {}),
               Catch::Contains("must be of an isotropic surface"));
    const std::string lambert = R"({"model": "lambert", "diffuse_albedo": 0.5})";
    CHECK_THAT(refusal(lambert, {.polarised = true}), Catch::Contains("must be of model he"));
    CHECK_THAT(refusal(lambert, {.tolerance = 0}), Catch::Contains("from 1e-9 to 0.5"));
    CHECK_THAT(refusal(lambert, {.tolerance = std::numeric_limits<double>::quiet_NaN()}),
               Catch::Contains("tolerance"));
    CHECK_THAT(refusal(small_job().source.material, {.tolerance = 1e-4, .largest_bytes = 100'000}),
               Catch::Contains("100000 bytes can meet"));
    CHECK_THAT(error_of([] {
                   return exact_model({"imported", "", ""}, std::array{0.5});
               }),
               Catch::Contains("has no material file"));
}

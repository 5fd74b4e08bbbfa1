// Tables as rungs of plans: what the planner's file says is what is looked up.

#include <catch2/catch.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "spectral/plans/plan.hpp"
#include "table_fixture.hpp"
#include "temporary_folder.hpp"

using hts::Direction;
using hts::testing::complaint;
using hts::testing::TemporaryFolder;
using namespace hts::tables;
using namespace hts::tables::testing;

namespace {

/// The small table under another name.
std::string renamed_bytes() {
    TableSource source = small_job().source;
    source.name = "gold";
    return finished_table(small_exact(), source, plan_table(small_exact(), small_job().request),
                          computed_slices(small_exact()));
}

}  // namespace

TEST_CASE("a plan that names a table looks it up, and is refused where the table is not what it says") {
    const TemporaryFolder folder;
    const auto scene_file =
        folder.write("scene.json", R"({"materials": [)" + small_job().source.material +
                                       R"(], "wavelengths_um": [0.45, 0.55, 0.65], "output": "spectral",
        "largest_theta_i_deg": 80, "largest_theta_r_deg": 80, "tolerance": {"relative_brdf_error": 5e-2}})");
    folder.write("small.htst", small_bytes());
    const auto scene = hts::spectral::read_scene(scene_file);
    auto plan = make_plan(scene, {1, 300}, scene.tolerance);
    auto& material = plan.materials.front();
    material.choice.rung.wavelengths = scene.wavelengths;
    material.choice.rung.table = {"small.htst", small_table().checksum()};
    material.form = hts::spectral::PlannedForm{scene, material.choice.rung, small_table().reflectance()};
    const auto path = folder.write("plan.json", plan_text(plan, folder.path()));
    const auto read = hts::spectral::read_plan(path, hts::spectral::built_in_models(), open_for_plan);
    CHECK(plan_text(read, folder.path()) == plan_text(plan, folder.path()));

    const hts::DirectionPair pair{Direction::from_degrees(30, 0), Direction::from_degrees(40, 170)};
    std::vector<double> looked_up(3), exact(3);
    small_table().brdf(pair, looked_up);
    small_exact().brdf(pair, exact);
    const auto planned = read.reflectances().front();
    CHECK(planned.brdf(pair) == looked_up);
    CHECK(planned.brdf(pair) != exact);
    CHECK(read.materials.front().form.bytes() > small_bytes().size());
    CHECK(measured_errors(read, {2, 300}).front().worst <= scene.tolerance);

    CHECK(complaint(folder, [&] { static_cast<void>(hts::spectral::read_plan(path)); }) ==
          R"(plan.json: key "materials[1].choice.table": must be read by a program that has tables)");
    const auto refusal = [&] {
        return complaint(folder, [&] {
            static_cast<void>(
                hts::spectral::read_plan(path, hts::spectral::built_in_models(), open_for_plan));
        });
    };
    material.choice.rung.wavelengths = hts::spectral::WavelengthGrid::linear(0.45, 0.65, 2);
    folder.write("plan.json", plan_text(plan, folder.path()));
    CHECK(refusal().find("wavelengths of what is evaluated: must be the rung's") != std::string::npos);
    folder.write("small.htst", "no table");
    CHECK(refusal().find("small.htst") != std::string::npos);

    material.choice.rung.wavelengths = scene.wavelengths;
    folder.write("plan.json", plan_text(plan, folder.path()));
    const std::string place = R"(plan.json: key "materials[1].choice.table": )", file = "small.htst: ";
    folder.write("small.htst", renamed_bytes());
    const std::string checksum = Table::open(folder.path() / "small.htst").checksum();
    CHECK(refusal() == place + file + "checksum " + checksum + ": must be " + small_table().checksum() +
                           ", of the table that was planned; plan the scene again");
    material.choice.rung.table.checksum = checksum;
    folder.write("plan.json", plan_text(plan, folder.path()));
    CHECK(refusal() == place + file + R"(table of "gold": must be of "rough aluminium")");
}

#include <omp.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "plan_cases.hpp"
#include "temporary_folder.hpp"

using hts::Direction;
using hts::DirectionPair;
using hts::testing::complaint;
using hts::testing::TemporaryFolder;
using namespace hts::spectral;
using namespace hts::spectral::testing;

namespace {

std::string text_of(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream{path}.rdbuf();
    return text.str();
}

}  // namespace

TEST_CASE("plans and their files are the same for any number of threads") {
    const Scene scene = rgb_scene({metal("ground", 0.18, 3)}, 1);
    const int before = omp_get_max_threads();
    std::vector<std::string> texts;
    for (const int threads : {1, 2, 3, 1}) {
        omp_set_num_threads(threads);
        texts.push_back(plan_text(plan_of(scene), ""));
    }
    omp_set_num_threads(before);
    CHECK(std::count(texts.begin(), texts.end(), texts[0]) == 4);
}

TEST_CASE("a plan file gives the plan back") {
    const TemporaryFolder folder;
    std::filesystem::copy(examples / "figure-14", folder.path() / "figure-14",
                          std::filesystem::copy_options::recursive);
    std::filesystem::copy(examples / "figure-14.json", folder.path() / "scene.json");
    const Plan plan = plan_of(read_scene(folder.path() / "scene.json"));
    std::filesystem::create_directory(folder.path() / "plans");
    const std::string text = plan_text(plan, folder.path() / "plans");
    const auto path = folder.write("plans/plan.json", text);
    const Plan read = read_plan(path);
    CHECK(plan_text(read, folder.path() / "plans") == text);

    const auto before = plan.reflectances(), after = read.reflectances();
    const DirectionPair pair{Direction::from_degrees(30, 0), Direction::from_degrees(40, 170)};
    for (std::size_t i = 0; i < before.size(); ++i) {
        CHECK(before[i].name() == after[i].name());
        CHECK(before[i].brdf(pair) == after[i].brdf(pair));
        CHECK(before[i].bytes() == after[i].bytes());
    }

    const auto refusal = [&](const std::string& what, const std::string& by) {
        folder.write("plans/plan.json", replaced(text, what, by));
        return complaint(folder, [&] { static_cast<void>(read_plan(path)); });
    };
    CHECK(refusal(R"("hts plan")", R"("recipe")") ==
          R"(plans/plan.json: key "format": "recipe": must be "hts plan")");
    CHECK(refusal(R"("format_version": 1)", R"("format_version": 2)") ==
          R"(plans/plan.json: key "format_version": 2: the plan was made for another format than 1; plan )"
          R"(the scene again)");
    CHECK(refusal(R"("library_version": ")", R"("library_version": "9)")
              .find("another version of the library") != std::string::npos);
    CHECK(refusal(R"("../scene.json")", R"("../none.json")") ==
          R"(plans/plan.json: key "scene": plans/../none.json: no such file)");
    CHECK(refusal(R"("full")", R"("half")") ==
          R"(plans/plan.json: key "materials[1].choice.lobe": "half": must be none, first_order, )"
          R"(rough_limit or full)");
    CHECK(refusal(R"("seed": 1)", R"("seed": -1)").find(R"(key "seed": -1: must be a whole number)") !=
          std::string::npos);
    CHECK(refusal("0.4,", "0.39,") ==
          R"(plans/plan.json: key "materials[1].choice.wavelengths_um": must be from 0.4 to 0.7 um, the )"
          R"(range of the scene)");

    folder.write("plans/plan.json", text);
    const std::string sphere = text_of(folder.path() / "figure-14/copper-sphere.json");
    folder.write("figure-14/copper-sphere.json", replaced(sphere, "0.13", "0.14"));
    const std::string changed = complaint(folder, [&] { static_cast<void>(read_plan(path)); });
    INFO(changed);
    CHECK(changed.starts_with(R"(plans/plan.json: key "scene_fingerprint": )"));
    CHECK(changed.find(
              "the plan was made for another scene, or plans/../scene.json or its materials have changed") !=
          std::string::npos);
}

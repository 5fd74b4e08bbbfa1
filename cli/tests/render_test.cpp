#include <catch2/catch.hpp>
#include <string>

#include "command.hpp"

using hts::cli::testing::Workplace;

namespace {

std::string lambert_file(const Workplace& place) {
    return place.file("m.json", R"({"model": "lambert", "diffuse_albedo": 0.5})");
}

}  // namespace

TEST_CASE("hts render writes a PNG of any material, the same for one thread and two") {
    const Workplace place;
    lambert_file(place);
    const std::string arguments = "render sphere --material m.json --size 24 --samples 2 --output ";
    CHECK(place.hts(arguments + "a.png", "OMP_NUM_THREADS=1").exit_code == 0);
    const auto result = place.hts(arguments + "b.png", "OMP_NUM_THREADS=2");
    CHECK(result.exit_code == 0);
    CHECK(result.output.empty());
    CHECK(result.errors.empty());  // no bar where nobody watches
    CHECK(place.read("a.png").starts_with("\x89PNG"));
    CHECK(place.read("a.png") == place.read("b.png"));
    CHECK(place.hts("render cloth --material m.json --size 24 --samples 1 --path-trace --output c.png")
              .exit_code == 0);
}

TEST_CASE("hts render names what is wrong and leaves nothing behind") {
    const Workplace place;
    lambert_file(place);
    const auto fails = [&](const std::string& arguments, int code, const std::string& says) {
        INFO(arguments);
        const auto result = place.hts("render " + arguments);
        CHECK(result.exit_code == code);
        CHECK(result.errors.find(says) != std::string::npos);
    };
    fails("", 2, "scene");
    fails("moon --output a.png", 2, "fig12");
    fails("sphere --output a.png", 2, "sphere: --material is missing");
    fails("fig14 --material m.json --output a.png", 2, "--material: must not come with fig14");
    fails("fig14 --output a.jpg", 2, "a.jpg: must end in .png");
    fails("fig14 --output a.png --size 8", 2, "--size");
    fails("fig14 --output a.png --samples 0", 2, "--samples");
    fails("fig14 --output a.png --exposure 0", 2, "--exposure");
    fails("sphere --material none.json --output a.png", 1, "none.json");
    place.file("far.json", R"({"model": "he", "rms_roughness_um": 1, "correlation_length_um": 9,
        "index": {"table": [[0.5, 1.5, 0], [0.6, 1.5, 0]]}})");
    fails("sphere --material far.json --output a.png", 1, "0.5 to 0.6 um");
    CHECK(place.names() == std::vector<std::string>{"far.json", "m.json"});
}

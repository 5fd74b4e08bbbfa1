#include "validation/topography/surface_report.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "synthetic_map.hpp"

using namespace hts::validation;

namespace {

HeightMap map_of(const RoughnessScales& scales, const Ellipse& ellipse = {}, std::size_t side = 128) {
    const SyntheticSurface surface{0.4, scales, ellipse, 0.25, side};
    return surface.map(surface.draw(17).first);
}

const RoughnessScales exponential_scales{{1, 2, 0.5}}, k_scales{{1, 1, 1.4}},
    two_scales{{0.7, 3, HUGE_VAL}, {0.3, 0.7, HUGE_VAL}};

/// Printed values of a description, by what a material calls them.
std::map<std::string, FittedValue> printed(const SpectrumFit& fit, const Ellipse& ellipse) {
    std::map<std::string, FittedValue> result{{"rms_roughness_um", fit.rms_of_band}};
    const std::map<std::string, std::string> names{{"correlation_length_um", "correlation_length_um"},
                                                   {"B_um", "correlation/B_um"},
                                                   {"C", "correlation/C"},
                                                   {"longer_length_um", "correlation/of/0/1/length_um"},
                                                   {"shorter_length_um", "correlation/of/1/1/length_um"},
                                                   {"weight_of_longer", "correlation/of/0/0"}};
    for (const FittedValue& value : fit.values) {
        const auto name = names.find(value.name);
        if (name == names.end()) continue;
        const bool length = value.name == "correlation_length_um" || value.name == "B_um";
        if (!length || ellipse.ratio == 1) {
            // a weight beside another one that is held changes a share by so much less
            const double rest = value.name == "weight_of_longer" ? 1 - value.value : 1;
            result[name->second] = {value.name, value.value, value.error / rest};
            continue;
        }
        const double root = std::sqrt(ellipse.ratio);
        result[name->second + "/0"] = {value.name, value.value * root, value.error * root};
        result[name->second + "/1"] = {value.name, value.value / root, value.error / root};
    }
    return result;
}

}  // namespace

TEST_CASE("a material states the errors that are printed beside the same numbers") {
    int compared = 0;
    for (const auto& [scales, ellipse] : {std::pair{k_scales, Ellipse{}},
                                          {two_scales, Ellipse{}},
                                          {RoughnessScales{{1, 1.5, HUGE_VAL}}, Ellipse{3, 0.6}}}) {
        const SurfaceStudy study = studied({map_of(scales, ellipse)}, {});
        for (const SpectrumFit& fit : study.fits) {
            INFO(fit.model);
            const auto own = static_cast<std::size_t>(std::sqrt(fit.covariances.size()));
            REQUIRE(own * own == fit.covariances.size());
            for (std::size_t i = 0; i < own; ++i) {
                const FittedValue& value = i == 0 ? fit.rms_of_band : fit.values[i];
                CHECK(std::sqrt(fit.covariances[i * own + i]) * value.value ==
                      Approx(value.error).epsilon(1e-12));
            }
            if (study.ellipse.ratio != 1 && fit.scales.size() > 1) continue;  // no material has it
            const auto material =
                nlohmann::json::parse(surface_material(study, fit, R"({"n": 1.5, "k": 0})"));
            for (const auto& [key, value] : printed(fit, study.ellipse)) {
                INFO(key);
                const bool open = std::ranges::find(fit.at_bounds, value.name) == fit.at_bounds.end();
                CHECK(material["uncertainty"].contains(key) == open);
                if (!open) continue;
                CHECK(material["uncertainty"][key].get<double>() == Approx(value.error).epsilon(1e-9));
                CHECK(value.error >= 0.015 * value.value);
                ++compared;
            }
        }
    }
    CHECK(compared >= 25);
}

TEST_CASE("a free amplitude tells a description that does not hold, the held one does not") {
    const SurfaceStudy study = studied({map_of(exponential_scales)}, {});
    const double rms = study.statistics.rms;
    const SpectrumFit &right = fit_named(study, "exponential"), &wrong = fit_named(study, "gaussian");
    INFO(right.free_rms.value / rms << " " << wrong.free_rms.value / rms);
    CHECK(std::fabs(right.free_rms.value - rms) < 3 * right.free_rms.error);
    CHECK(std::fabs(wrong.free_rms.value - rms) > 2 * wrong.free_rms.error);
    CHECK(surface_text(study).find("its amplitude left free") != std::string::npos);
}

TEST_CASE("a study keeps how many frequencies its windows leave independent") {
    HeightMap whole = map_of(k_scales);
    std::vector<double> heights{whole.heights().begin(), whole.heights().end()};
    for (std::size_t k = 0; k < heights.size(); ++k)
        if (k % 128 >= 40 && k % 128 < 80 && k / 128 < 80) heights[k] = std::nan("");
    SurfaceRequest request;
    request.levelling.gaps = Gaps::mask;
    const SurfaceStudy study =
        studied({HeightMap{"gaps", 128, 128, 0.25, 0.25, heights}, std::move(whole)}, request);
    for (const StudiedMap& map : study.maps)
        CHECK(map.inflation == MapWindow{map.levelled.map, Window::hann}.inflation);
    CHECK(study.maps[0].inflation > 1.02 * study.maps[1].inflation);
    CHECK(study.maps[1].inflation == Approx(3.78).epsilon(0.01));
}

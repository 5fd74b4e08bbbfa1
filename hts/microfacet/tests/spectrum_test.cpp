#include "hts/microfacet/spectrum.hpp"

#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/microfacet/ashikhmin.hpp"
#include "hts/microfacet/cook_torrance.hpp"
#include "hts/microfacet/cosine_lobes.hpp"
#include "hts/microfacet/diffuse.hpp"
#include "hts/microfacet/kurt.hpp"
#include "hts/microfacet/walter.hpp"
#include "hts/microfacet/ward.hpp"

namespace hts {
namespace {

/// All models of a spectrum at once have the bits of each alone, whether or not
/// neighbours share their geometry.
template <ReflectanceModel Model>
void check(const std::string& name, const std::vector<Model>& models) {
    testing::Random random{17};
    std::vector<double> together(models.size());
    std::size_t different = 0, dark = 0;
    for (int i = 0; i < 2000; ++i) {
        const Direction in =
            Direction::from_degrees(i == 0 ? 90 : random.uniform(0, 89.9), random.uniform(0, 360));
        const Direction out = i % 4 == 0
                                  ? in.mirror()
                                  : Direction::from_degrees(random.uniform(0, 89.9), random.uniform(0, 360));
        spectral_brdf<Model>(models, in, out, together);
        for (std::size_t k = 0; k < models.size(); ++k) {
            different += together[k] != models[k].brdf(in, out);
            dark += together[k] == 0;
        }
    }
    INFO(name);
    CHECK(different == 0);
    CHECK(dark < 200 * models.size());
}

}  // namespace

TEST_CASE("spectra of lobes, two shapes among them") {
    check<Kurt>("Kurt", {{0.1, {{0.7, {0.5, 0.2, 0.3, 0.2}}}},
                         {0.2, {{0.6, {0.4, 0.2, 0.3, 0.2}}}},
                         {0.2, {{0.6, {0.4, 0.2, 0.3, 0.3}}}},
                         {0.2, {{0.6, {0.4, 0.2, 0.3, 0.3}}, {0.1, {0.04, 0.5, 0.5, 0}}}},
                         Kurt::coupled(0.5, {0.6, {0.04, 0.3, 0.1, 0.1}}),
                         Kurt::coupled(0.4, {0.5, {0.05, 0.3, 0.1, 0.1}}),
                         {0.4, {{0.5, {0.05, 0.3, 0.1, 0.1}}}}});
    check<Ward>("Ward", {{0.2, {{0.5, {0.3, 0.6}}}}, {0.1, {{0.6, {0.3, 0.6}}}}, {0.1, {{0.6, {0.3, 0.5}}}}});
    check<WardDuer>("Ward-Duer", {{0.2, {{0.5, {0.3, 0.6}}}}, {0.3, {}}, {0.1, {{0.6, {0.3, 0.6}}}}});
    check<CookTorrance>("Cook-Torrance", {{0.1, {{0.5, {0.3, 0.4}}}}, {0.1, {{0.5, {0.9, 0.4}}}}});
    check<BlinnPhong>("Blinn-Phong",
                      {{0.2, {{0.5, BlinnPhongLobe{50}}}}, {0.1, {{0.2, BlinnPhongLobe{51}}}}});
    check<AshikhminShirley>("Ashikhmin-Shirley",
                            {{0.5, {0.1, 10, 50}}, {0.3, {0.2, 10, 50}, 0.4}, {0.3, {0.2, 10, 60}}});
    check<Lafortune>("Lafortune", {{0.2, {{0.5, {-0.9, -1.1, 30}}, {0.1, {0.8, 0.8, 10}}}},
                                   {0.3, {{0.2, {-0.9, -1.1, 30}}, {0.2, {0.8, 0.8, 10}}}},
                                   {0.3, {{0.2, {-0.9, -1.1, 30}}}}});
}

TEST_CASE("spectra of diffuse models") {
    check<LambertianModel>("Lambert", {LambertianModel{0.7}, LambertianModel{0.2}});
    check<OrenNayar>("Oren-Nayar", {{0.7, 0.4}, {0.2, 0.4}, {0.3, 0.2}});
}

TEST_CASE("spectra of facets that reflect as planes do") {
    const auto wide = FacetDistribution::ggx(0.5), wider = FacetDistribution::beckmann(0.5);
    check<WalterBrdf>("Walter", {{wide, {0.2, 3}}, {wide, {1.5, 0}}, {wide, {0.5, 0.1}}, {wider, {0.2, 3}}});
    check<WalterInterface>(
        "Walter, glass",
        {{wide, {0.2, 3}, 1}, {wide, {1.5, 0}, 1}, {wide, {1.4, 0}, 1.1}, {wide, {1.4, 0}, 1.1, 0.3}});
    const AshikhminFacets rough{NormalDensity::gaussian(0.3, 0.3)},
        velvet{NormalDensity::inverse_gaussian(0.5)};
    check<AshikhminBrdf>("Ashikhmin", {{rough, FacetFresnel::schlick(0.05), 0.5},
                                       {rough, FacetFresnel::schlick(0.4), 0},
                                       {rough, FacetFresnel::exact({1.5, 0}), 0.3},
                                       AshikhminBrdf::metal(rough, 0.9),
                                       {velvet, FacetFresnel::schlick(0.4), 0.2}});
}

}  // namespace hts

#include "hts/microfacet/walter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "hts/error.hpp"
#include "hts/microfacet/lobes.hpp"

namespace hts {
namespace {

constexpr double smallest = std::numeric_limits<double>::min();

constexpr Facet no_facet{{0, 0, -1}, 0, 0, 0};

/// Whether light comes and goes above the horizon.
bool lit_and_seen(const Direction& in, const Direction& out) {
    return in.cos_theta() > 0 && out.cos_theta() > 0;
}

/// G |i.m| D / ((i.n)(o.n)) times the Jacobian: (20) and (21) but for F and 1 - F.
double lobe(const FacetDistribution& facets, const Facet& facet, const Direction& in, const Direction& out) {
    return facet.cos_in * facet.jacobian * facets.density(facet.normal) * facets.shadowing_over_cosine(in) *
           facets.shadowing_over_cosine(out);
}

/// G |i.m| D / ((i.n) p_m): the weight (41), for any density of normals.
double weight(const FacetDistribution& facets, const Facet& facet, const Direction& in, const Direction& out,
              double normal_pdf) {
    return facets.shadowing(in) * facets.shadowing(out) * facet.cos_in * facets.density(facet.normal) /
           (in.cos_theta() * normal_pdf);
}

/// (39).
Vector3 mirrored(Vector3 in, const Facet& facet) {
    return (2 * facet.cos_in) * facet.normal - in;
}

/// (40) in the frame of the side of `in`.
Vector3 refracted(Vector3 in, const Facet& facet, double eta) {
    return (eta * facet.cos_in - facet.cos_out) * facet.normal - eta * in;
}

Facet drawn_mirror_facet(Vector3 normal, double cos_in) {
    return {normal, cos_in, cos_in, 1 / (4 * cos_in)};
}

Facet drawn_refracting_facet(Vector3 normal, double cos_in, double eta_in, double eta_out) {
    const double sine = eta_in / eta_out * std::sqrt((1 - cos_in) * (1 + cos_in));
    const double cos_out = std::sqrt(std::max(0.0, (1 - sine) * (1 + sine)));
    const double length = eta_in * cos_in - eta_out * cos_out;
    return {normal, cos_in, cos_out, eta_out * eta_out * cos_out / (length * length)};
}

/// Refraction: h_t of (16), turned towards the side of `in`. `out` is on the other side: its z is negative.
/// No facet where the directions do not lie on opposite sides of it.
Facet refracting_facet(Vector3 in, Vector3 out, double eta_in, double eta_out) {
    const Vector3 sum = eta_in * in + eta_out * out;
    const double length_squared = dot(sum, sum);
    const Vector3 m = (eta_out > eta_in ? -1 : 1) / std::sqrt(length_squared) * sum;
    const double cos_in = dot(in, m);
    const double cos_out = -dot(out, m);
    if (!(m.z > 0 && cos_in > 0 && cos_out > 0)) return no_facet;
    return {m, cos_in, cos_out, eta_out * eta_out * cos_out / length_squared};
}

/// 1 - F of a facet between transparent media, without the cancellation of the difference.
double transmittance(double cos_in, double cos_out, double eta_in, double eta_out) {
    const double s = eta_in * cos_in + eta_out * cos_out;
    const double p = eta_out * cos_in + eta_in * cos_out;
    return 2 * eta_in * eta_out * cos_in * cos_out * (1 / (s * s) + 1 / (p * p));
}

/// (|F_s|^2 + |F_p|^2)/2 in real arithmetic. With N = n + ik, d = N^2 - 1, sqrt(N^2 - sin^2)
/// = A + iB, M = A^2 + B^2:
///   |F_s|^2 = |d|^2/(M + c^2 + 2Ac)^2,   |F_p|^2 = |F_s|^2 (M c^2 + s^4 - 2Ac s^2)/(M c^2 + s^4 + 2Ac s^2)
/// Where A is the smaller of A and B it is nk/B, so that nothing cancels. No branch keeps a loop over
/// wavelengths from vectors.
inline double reflectance(double c, double n, double k) {
    const double c2 = c * c;
    const double s2 = (1 - c) * (1 + c);
    const double nk = n * k;
    const double d_real = (n - 1) * (n + 1) - k * k;
    const double real = d_real + c2;  // of N^2 - sin^2
    const double modulus = std::sqrt(real * real + 4 * (nk * nk));
    const double larger = std::sqrt((modulus + std::abs(real)) / 2);
    const double smaller = nk / larger;
    const double two_ac = 2 * c * (real >= 0 ? larger : smaller);
    const double p = modulus * c2 + s2 * s2 + 1e-300;  // 0 at normal incidence on N = 0, which reflects all
    const double s_below = modulus + c2 + two_ac;
    const double below = s_below * s_below * (p + two_ac * s2);
    const double kept = (d_real * d_real + 4 * (nk * nk)) * p / (below + smallest);
    return std::min(kept, 1.0);
}

/// (20) of models with one lobe.
template <class Model>
void lobe_spectrum(std::span<const Model> alike, const Direction& in, const Direction& out,
                   std::span<double> result) {
    const FacetLobe lobe = alike.front().lobe(in, out);
    if (!(lobe.value > 0)) return std::fill(result.begin(), result.end(), 0.0);
    constexpr std::size_t block = 32;
    for (std::size_t first = 0; first < alike.size(); first += block) {
        std::array<double, block> n, k;
        const std::size_t count = std::min(block, alike.size() - first);
        for (std::size_t j = 0; j < count; ++j) {
            n[j] = alike[first + j].index().substrate().n();
            k[j] = alike[first + j].index().substrate().k();
        }
        for (std::size_t j = 0; j < count; ++j)
            result[first + j] = lobe.value * reflectance(lobe.cos_in, n[j], k[j]);
        for (std::size_t j = first; j < first + count; ++j) {
            const CoatedIndex& index = alike[j].index();
            if (index.coated()) result[j] = lobe.value * facet_reflectance(lobe.cos_in, index);
        }
    }
}

Side opposite(Side side) {
    return side == Side::front ? Side::back : Side::front;
}

}  // namespace

Facet mirror_facet(const Direction& in, const Direction& out) noexcept {
    const Vector3 sum = in.vector() + out.vector();
    const double length = std::sqrt(dot(sum, sum));
    if (!(length > 0)) return no_facet;
    return drawn_mirror_facet(1 / length * sum, std::min(1.0, length / 2));
}

double facet_reflectance(double cos_in, const CoatedIndex& index) noexcept {
    if (index.coated()) return index.amplitudes(cos_in).unpolarised_reflectance();
    return reflectance(cos_in, index.substrate().n(), index.substrate().k());
}

FacetLobe facet_lobe(const FacetDistribution& facets, const Direction& in, const Direction& out) noexcept {
    if (!lit_and_seen(in, out)) return {0, 0};
    const Vector3 sum = in.vector() + out.vector();  // along the normal, 2 cos_in long
    return {std::min(1.0, std::sqrt(dot(sum, sum)) / 2),
            facets.density(sum) / 4 * facets.shadowing_over_cosine(in) * facets.shadowing_over_cosine(out)};
}

void WalterBrdf::brdf(std::span<const WalterBrdf> alike, const Direction& in, const Direction& out,
                      std::span<double> result) noexcept {
    lobe_spectrum(alike, in, out, result);
}

double WalterBrdf::pdf(const Direction& in, const Direction& out) const noexcept {
    if (!lit_and_seen(in, out)) return 0;
    const Facet facet = mirror_facet(in, out);
    return facets_.normal_pdf(in, facet.normal, normals_) * facet.jacobian;
}

Draw WalterBrdf::sample(const Direction& in, const Uniforms& uniforms) const noexcept {
    const Draw none = Draw::none(in);
    if (!(in.cos_theta() > 0)) return none;
    const Vector3 normal = facets_.normal(in, uniforms[0], uniforms[1], normals_);
    const double cos_in = dot(in.vector(), normal);
    if (!(cos_in > 0)) return none;
    const Facet facet = drawn_mirror_facet(normal, cos_in);
    const Vector3 mirrored_in = mirrored(in.vector(), facet);
    const double normal_pdf = facets_.normal_pdf(in, normal, normals_);
    if (!(mirrored_in.z > 0 && normal_pdf > 0)) return none;
    const Direction out = Direction::from_unit_vector(mirrored_in);
    const double kept = facet_reflectance(std::min(1.0, cos_in), index_);
    return {out, kept * weight(facets_, facet, in, out, normal_pdf), normal_pdf * facet.jacobian};
}

WalterBsdf::WalterBsdf(const FacetDistribution& facets, double front_index, double back_index,
                       NormalDraw normals)
    : facets_{facets},
      front_{front_index, back_index, {1, 0}},
      back_{back_index, front_index, {1, 0}},
      normals_{normals} {
    const auto require_index = [](const char* quantity, double eta) {
        if (!(eta >= 0.01 && eta <= 100)) throw out_of_range(quantity, eta, "", "from 0.01 to 100");
    };
    require_index("refractive index of the front", front_index);
    require_index("refractive index of the back", back_index);
    if (std::abs(back_index - front_index) < 1e-6 * std::max(back_index, front_index)) {
        throw out_of_range("refractive index of the back", back_index, "",
                           std::string{"apart from the front's, "}.append(shortest(front_index)) +
                               ", by at least 1e-06 of it");
    }
    front_.relative = {back_index / front_index, 0};
    back_.relative = {front_index / back_index, 0};
}

WalterBsdf::WalterBsdf(const FacetDistribution& facets, double front_index, const CoatedIndex& back,
                       NormalDraw normals)
    : WalterBsdf{facets, front_index, back.substrate().n(), normals} {
    if (!back.coated()) return;
    front_.relative = back.seen_from(front_index);
    back_.relative = front_.relative.turned_over();
}

/// F or T: what a facet sends the way of the pair.
double WalterBsdf::share(const Facet& facet, const Media& media, bool reflected) const noexcept {
    if (!reflected && media.relative.coated())
        return media.relative.transmittance(std::min(1.0, facet.cos_in));
    if (!reflected) return transmittance(facet.cos_in, facet.cos_out, media.eta_in, media.eta_out);
    return facet_reflectance(std::min(1.0, facet.cos_in), media.relative);
}

/// F or 1 - F: how often `sample` sends light that way.
double WalterBsdf::chance(const Facet& facet, const Media& media, bool reflected) const noexcept {
    if (reflected || !media.relative.coated()) return share(facet, media, reflected);
    return 1 - share(facet, media, true);
}

WalterBsdf::Event WalterBsdf::event(const SidedDirection& in, const SidedDirection& out) const noexcept {
    if (!lit_and_seen(in.direction, out.direction)) return {no_facet, 0, 0};
    const Media& here = media(in.side);
    const bool reflected = in.side == out.side;
    const Vector3 o = out.direction.vector();
    const Facet facet =
        reflected ? mirror_facet(in.direction, out.direction)
                  : refracting_facet(in.direction.vector(), {o.x, o.y, -o.z}, here.eta_in, here.eta_out);
    if (!(facet.normal.z > 0)) return {no_facet, 0, 0};
    return {facet, share(facet, here, reflected), chance(facet, here, reflected)};
}

double WalterBsdf::bsdf(const SidedDirection& in, const SidedDirection& out) const noexcept {
    const auto [facet, share, chance] = event(in, out);
    return share > 0 ? share * lobe(facets_, facet, in.direction, out.direction) : 0;
}

double WalterBsdf::pdf(const SidedDirection& known, const SidedDirection& out) const noexcept {
    const auto [facet, share, chance] = event(known, out);
    return chance > 0 ? chance * facet.jacobian * facets_.normal_pdf(known.direction, facet.normal, normals_)
                      : 0;
}

DrawnScattering WalterBsdf::sample(const SidedDirection& known, const Uniforms& uniforms,
                                   PathFrom from) const noexcept {
    const Direction& in = known.direction;
    const DrawnScattering none{{known.side, in.mirror()}, 0, 0};
    if (!(in.cos_theta() > 0)) return none;
    const Media& here = media(known.side);
    const Vector3 normal = facets_.normal(in, uniforms[0], uniforms[1], normals_);
    const double cos_in = std::min(1.0, dot(in.vector(), normal));
    const double normal_pdf = facets_.normal_pdf(in, normal, normals_);
    if (!(cos_in > 0 && normal_pdf > 0)) return none;
    Facet facet = drawn_mirror_facet(normal, cos_in);
    const bool reflected = uniforms[2] < share(facet, here, true);
    if (!reflected) facet = drawn_refracting_facet(normal, cos_in, here.eta_in, here.eta_out);
    const Vector3 out =
        reflected ? mirrored(in.vector(), facet) : -refracted(in.vector(), facet, here.eta_in / here.eta_out);
    if (!(out.z > 0 && facet.cos_out > 0)) return none;
    const SidedDirection drawn{reflected ? known.side : opposite(known.side),
                               Direction::from_unit_vector(reflected ? out : Vector3{-out.x, -out.y, out.z})};
    const double ratio = from == PathFrom::eye && !reflected ? here.eta_in / here.eta_out : 1;
    const double drawn_as_often = chance(facet, here, reflected);
    const double kept = here.relative.coated() ? share(facet, here, reflected) / drawn_as_often : 1;
    return {drawn, kept * ratio * ratio * weight(facets_, facet, in, drawn.direction, normal_pdf),
            drawn_as_often * normal_pdf * facet.jacobian};
}

WalterInterface::WalterInterface(const FacetDistribution& facets, const CoatedIndex& index,
                                 double exterior_index, double diffuse_albedo)
    : WalterBrdf{facets, index.seen_from(exterior_index)},
      diffuse_albedo_{checked_reflectance("diffuse albedo", diffuse_albedo)} {
    if (index.substrate().k() == 0 && diffuse_albedo_ == 0) glass_.emplace(facets, exterior_index, index);
}

void WalterInterface::brdf(std::span<const WalterInterface> alike, const Direction& in, const Direction& out,
                           std::span<double> result) noexcept {
    lobe_spectrum(alike, in, out, result);
    if (!lit_and_seen(in, out)) return;
    for (std::size_t i = 0; i < alike.size(); ++i)
        result[i] += alike[i].diffuse_albedo_ * std::numbers::inv_pi;
}

double WalterInterface::diffuse_share(const Direction& in) const noexcept {
    constexpr double least = 0.02;  // of the facets, which reflect more than a plane at normal incidence
    const double lobe = std::max(least, facet_reflectance(std::min(1.0, in.cos_theta()), index()));
    return diffuse_albedo_ / (diffuse_albedo_ + lobe);
}

double WalterInterface::pdf(const Direction& in, const Direction& out) const noexcept {
    const double lobe = WalterBrdf::pdf(in, out);
    if (diffuse_albedo_ == 0 || !lit_and_seen(in, out)) return lobe;
    const double share = diffuse_share(in);
    return share * out.cos_theta() * std::numbers::inv_pi + (1 - share) * lobe;
}

Draw WalterInterface::sample(const Direction& in, const Uniforms& uniforms) const noexcept {
    if (diffuse_albedo_ == 0) return WalterBrdf::sample(in, uniforms);
    if (!(in.cos_theta() > 0)) return Draw::none(in);
    if (uniforms[2] < diffuse_share(in)) return weighted(*this, in, cosine_vector(uniforms[0], uniforms[1]));
    const Draw drawn = WalterBrdf::sample(in, uniforms);
    return drawn.lobe == Lobe::none ? drawn : weighted(*this, in, drawn.out.vector());
}

WalterBsdf MeasuredGlass::bsdf(FacetShape shape) const {
    const auto facets = shape == FacetShape::ggx ? FacetDistribution::ggx(ggx_alpha)
                                                 : FacetDistribution::beckmann(beckmann_alpha);
    return {facets, 1, measured_glass_index};
}

}  // namespace hts

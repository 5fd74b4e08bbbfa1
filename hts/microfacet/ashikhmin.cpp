#include "hts/microfacet/ashikhmin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include <boost/math/quadrature/gauss.hpp>

#include "hts/error.hpp"
#include "hts/microfacet/lobes.hpp"
#include "hts/microfacet/normals/hemisphere_table.hpp"
#include "hts/microfacet/walter.hpp"

namespace hts {
namespace {

using std::numbers::pi;

/// t of (14): exp(-(phi/15 deg)^2), phi the azimuth between the directions.
double correlation(Vector3 in, Vector3 out) {
    const double phi = std::atan2(in.x * out.y - in.y * out.x, in.x * out.x + in.y * out.y) * (12 / pi);
    return std::exp(-phi * phi);
}

/// int f(k) cos theta dw over the hemisphere, quarter turn by quarter turn.
double cosine_integral(const std::function<double(Vector3)>& f) {
    using boost::math::quadrature::gauss;
    double sum = 0;
    for (int quarter = 0; quarter < 4; ++quarter) {
        const auto over_azimuth = [&](double phi) {
            const auto over_cosine = [&](double c) {
                const double s = std::sqrt((1 - c) * (1 + c));
                return c * f({s * std::cos(phi), s * std::sin(phi), c});
            };
            return gauss<double, 30>::integrate(over_cosine, 0, 0.2) +
                   gauss<double, 30>::integrate(over_cosine, 0.2, 1);
        };
        sum += gauss<double, 15>::integrate(over_azimuth, quarter * pi / 2, (quarter + 1) * pi / 2);
    }
    return sum;
}

constexpr std::size_t elevations_of_g = 64, azimuths_of_g = 32, elevations_of_g_alone = 512;
constexpr std::size_t elevations_of_r = 32, azimuths_of_r = 16, elevations_of_r_alone = 64;
constexpr double settled = 3e-4;  // change of R(k) from one set of points to the next, twice as fine

/// max(x, 0) rounded off over d.
double smooth_positive_part(double x, double d) {
    return (x + std::sqrt(x * x + d * d)) / 2;
}

/// R(k) for two F at once.
using Pair = std::array<double, 2>;

}  // namespace

FacetFresnel FacetFresnel::schlick(double f0) {
    return {checked_reflectance("f0", f0), std::nullopt};
}

FacetFresnel FacetFresnel::exact(const CoatedIndex& index) {
    return {index.amplitudes(1).unpolarised_reflectance(), index};
}

double FacetFresnel::operator()(double cosine) const noexcept {
    if (index_) return facet_reflectance(cosine, *index_);
    return hts::schlick(f0_, cosine);
}

/// What the copies share.
struct AshikhminFacets::Data {
    NormalDensity density;
    FacetShadowing shadowing;
    double reach_x, reach_y;  // what rounds off `area_guess`
    HemisphereTable area_over_guess;
    std::array<std::vector<WeightedNormal>, 3> points;
    std::vector<HemisphereTable> reflectance;  // at f0 = 0 and 1

    Data(NormalDensity p, FacetShadowing s, const std::function<double(Vector3)>& g)
        : density{std::move(p)},
          shadowing{s},
          reach_x{std::sqrt(dot(density.mean(), density.mean()) / pi) * density.width_x()},
          reach_y{std::sqrt(dot(density.mean(), density.mean()) / pi) * density.width_y()},
          area_over_guess{density, density.symmetry().isotropic ? elevations_of_g_alone : elevations_of_g,
                          azimuths_of_g, [&](Vector3 k) { return std::fmax(g(k), 1e-12) / area_guess(k); }},
          points{density.quadrature(24), density.quadrature(48), density.quadrature(96)} {
        std::vector<double> at_one;
        reflectance.push_back(table_of_reflectance([&](Vector3 k) {
            const auto [zero, one] = integrated(k, FacetFresnel::schlick(0), FacetFresnel::schlick(1));
            at_one.push_back(one);
            return zero;
        }));
        std::size_t node = 0;
        reflectance.push_back(table_of_reflectance([&](Vector3) { return at_one[node++]; }));
    }

    [[nodiscard]] HemisphereTable table_of_reflectance(const std::function<double(Vector3)>& r) const {
        return {density, density.symmetry().isotropic ? elevations_of_r_alone : elevations_of_r,
                azimuths_of_r, r};
    }

    /// Near g(k): <h>.k, rounded off to 0 about as far as slopes reach.
    [[nodiscard]] double area_guess(Vector3 k) const noexcept {
        const double x = reach_x * k.x, y = reach_y * k.y;
        return smooth_positive_part(dot(density.mean(), k), std::sqrt(x * x + y * y));
    }

    [[nodiscard]] double area(Vector3 k, const HemisphereTable::Position& at) const noexcept {
        return area_over_guess(at) * area_guess(k);
    }
    [[nodiscard]] double area(Vector3 k) const noexcept { return area(k, area_over_guess.position(k)); }

    /// P_12/(cos cos <h.n>), by (13) or (14): what remains of (10), finite on the horizon.
    [[nodiscard]] double visible(Vector3 in, double g_in, Vector3 out, double g_out) const noexcept {
        const double apart = density.projection() / (g_in * g_out);
        if (shadowing == FacetShadowing::uncorrelated) return apart;
        const double t = correlation(in, out);
        return (1 - t) * apart + t / std::fmax(std::fmax(out.z * g_in, in.z * g_out), 1e-290);
    }

    /// Of directions above the horizon at these positions.
    [[nodiscard]] FacetPair pair(Vector3 in, const HemisphereTable::Position& at_in, Vector3 out,
                                 const HemisphereTable::Position& at_out) const noexcept {
        const Vector3 sum = in + out;
        const double length = std::sqrt(dot(sum, sum));
        const double p = density((1 / length) * sum);
        const double lobe = p > 0 ? p / 4 * visible(in, area(in, at_in), out, area(out, at_out)) : 0;
        return {std::min(length / 2, 1.0), lobe};
    }

    [[nodiscard]] Pair sums(const std::vector<WeightedNormal>& normals, Vector3 k, const FacetFresnel& first,
                            const FacetFresnel& second) const {
        const double g = area(k);
        Pair total{};
        for (const auto& [h, weight] : normals) {
            const double cosine = dot(k, h);
            const Vector3 out = 2 * cosine * h - k;
            if (!(cosine > 0 && out.z > 0)) continue;
            const double mirrored = weight * cosine * out.z * visible(k, g, out, area(out));
            total[0] += mirrored * first(std::fmin(cosine, 1));
            total[1] += mirrored * second(std::fmin(cosine, 1));
        }
        return total;
    }

    [[nodiscard]] Pair integrated(Vector3 k, const FacetFresnel& first, const FacetFresnel& second) const {
        Pair coarse = sums(points[0], k, first, second);
        for (std::size_t i = 1; i < points.size(); ++i) {
            const Pair fine = sums(points[i], k, first, second);
            const double change = std::fmax(std::fabs(fine[0] - coarse[0]), std::fabs(fine[1] - coarse[1]));
            if (change < settled) return fine;
            coarse = fine;
        }
        return coarse;
    }
};

/// What tables say of a direction.
struct AshikhminFacets::Seen {
    HemisphereTable::Position at;
    double zero, one;  // R(k) at f0 = 0 and 1

    Seen(const Data& data, Vector3 k)
        : at{data.area_over_guess.position(k)}, zero{data.reflectance[0](at)}, one{data.reflectance[1](at)} {}
    [[nodiscard]] double reflectance(double f0) const noexcept { return zero + f0 * (one - zero); }
};

AshikhminFacets::AshikhminFacets(NormalDensity density, FacetShadowing shadowing)
    : data_{
          std::make_shared<Data>(density, shadowing, [&](Vector3 k) { return density.projected_area(k); })} {}

AshikhminFacets::AshikhminFacets(const std::vector<Share>& shares, FacetShadowing shadowing) {
    std::vector<NormalDensity::Share> densities;
    double sum = 0;
    for (const auto& [weight, facets] : shares) {
        densities.push_back({weight, facets.density()});
        sum += weight;
    }
    const auto added = [&](Vector3 k) {
        double g = 0;
        for (const auto& [weight, facets] : shares) g += weight / sum * facets.data_->area(k);
        return g;
    };
    data_ = std::make_shared<Data>(NormalDensity::mixture(densities), shadowing, added);
}

const NormalDensity& AshikhminFacets::density() const noexcept {
    return data_->density;
}

FacetShadowing AshikhminFacets::shadowing() const noexcept {
    return data_->shadowing;
}

double AshikhminFacets::projected_area(const Direction& k) const noexcept {
    return data_->area(k.vector());
}

double AshikhminFacets::visibility(const Direction& k) const noexcept {
    return k.cos_theta() * data_->density.projection() / data_->area(k.vector());
}

FacetPair AshikhminFacets::pair(const Direction& in, const Direction& out) const noexcept {
    if (!(in.cos_theta() > 0 && out.cos_theta() > 0)) return {0, 0};
    const Vector3 k_in = in.vector(), k_out = out.vector();
    const HemisphereTable& table = data_->area_over_guess;
    return data_->pair(k_in, table.position(k_in), k_out, table.position(k_out));
}

double AshikhminFacets::integrated_reflectance(const Direction& k, const FacetFresnel& fresnel) const {
    return data_->integrated(k.vector(), fresnel, fresnel)[0];
}

double AshikhminFacets::reflectance(const Direction& k, double f0) const noexcept {
    return Seen{*data_, k.vector()}.reflectance(f0);
}

// The model

AshikhminBrdf::AshikhminBrdf(AshikhminFacets facets, FacetFresnel fresnel, double diffuse_albedo, double top)
    : facets_{std::move(facets)},
      fresnel_{std::move(fresnel)},
      diffuse_albedo_{checked_reflectance("diffuse albedo", diffuse_albedo)},
      top_{top} {
    if (diffuse_albedo_ == 0) return;
    if (!fresnel_.is_schlick()) {
        exact_reflectance_ = std::make_shared<HemisphereTable>(facets_.data_->table_of_reflectance(
            [&](Vector3 k) { return facets_.data_->integrated(k, fresnel_, fresnel_)[0]; }));
    }
    const double left = cosine_integral([&](Vector3 k) { return left_over({*facets_.data_, k}); });
    c_ = left > 0 ? 1 / left : 0;
}

AshikhminBrdf::AshikhminBrdf(AshikhminFacets facets, FacetFresnel fresnel, double diffuse_albedo)
    : AshikhminBrdf{std::move(facets), std::move(fresnel), diffuse_albedo, 1} {}

AshikhminBrdf AshikhminBrdf::metal(AshikhminFacets facets, double f0) {
    return {std::move(facets), FacetFresnel::schlick(f0), f0, f0};
}

double AshikhminBrdf::facets_reflectance(const AshikhminFacets::Seen& k) const noexcept {
    return exact_reflectance_ ? (*exact_reflectance_)(k.at) : k.reflectance(fresnel_.at_normal());
}

double AshikhminBrdf::left_over(const AshikhminFacets::Seen& k) const noexcept {
    return std::max(top_ - facets_reflectance(k), 0.0);
}

void AshikhminBrdf::brdf(std::span<const AshikhminBrdf> alike, const Direction& in, const Direction& out,
                         std::span<double> result) noexcept {
    if (!(in.cos_theta() > 0 && out.cos_theta() > 0)) return std::fill(result.begin(), result.end(), 0.0);
    const AshikhminFacets::Data& data = *alike.front().facets_.data_;
    const AshikhminFacets::Seen lit{data, in.vector()}, seen{data, out.vector()};
    const FacetPair pair = data.pair(in.vector(), lit.at, out.vector(), seen.at);
    for (std::size_t i = 0; i < alike.size(); ++i) {
        const AshikhminBrdf& one = alike[i];
        result[i] = pair.lobe > 0 ? one.fresnel_(pair.cos_theta_d) * pair.lobe : 0;
        if (one.c_ != 0)
            result[i] += one.c_ * one.diffuse_albedo_ * (one.left_over(lit) * one.left_over(seen));
    }
}

double AshikhminBrdf::albedo(const Direction& in) const noexcept {
    const AshikhminFacets::Seen lit{*facets_.data_, in.vector()};
    return facets_reflectance(lit) + (c_ == 0 ? 0 : diffuse_albedo_ * left_over(lit));
}

double AshikhminBrdf::facets_probability(const Direction& in) const noexcept {
    if (c_ == 0) return 1;
    const AshikhminFacets::Seen lit{*facets_.data_, in.vector()};
    const double mirrored = facets_reflectance(lit), diffuse = diffuse_albedo_ * left_over(lit);
    if (!(diffuse > 0)) return 1;
    return std::clamp(mirrored / (mirrored + diffuse), 0.1, 0.9);
}

double AshikhminBrdf::pdf(const Direction& in, const Direction& out) const noexcept {
    if (!(in.cos_theta() > 0 && out.cos_theta() > 0)) return 0;
    const Vector3 sum = in.vector() + out.vector();
    const double length = std::sqrt(dot(sum, sum));
    const double mirrored =
        facets_.density().pdf((1 / length) * sum) / (2 * length);  // 4 k.h = 2 |k_1 + k_2|
    const double probability = facets_probability(in);
    return probability * mirrored + (1 - probability) * out.cos_theta() / pi;
}

Draw AshikhminBrdf::sample(const Direction& in, const Uniforms& uniforms) const noexcept {
    const double probability = facets_probability(in);
    Direction out = in;
    if (uniforms[0] < probability) {
        const Vector3 h = facets_.density().sample({uniforms[0] / probability, uniforms[1], uniforms[2]});
        const double cosine = dot(in.vector(), h);
        const Vector3 mirrored = 2 * cosine * h - in.vector();
        if (!(cosine > 0 && mirrored.z > 0)) return Draw::none(in);
        out = Direction::from_vector(mirrored);
    } else {
        out = Direction::from_vector(cosine_vector(uniforms[1], uniforms[2]));
    }
    const double density = pdf(in, out);
    if (!(density > 0)) return Draw::none(in);
    return {out, brdf(in, out) * out.cos_theta() / density, density};
}

// Lambertian facets

namespace {

constexpr std::size_t elevations = 24,
                      azimuths = 13;  // elevations even in sqrt(cos theta), azimuths over half a turn

/// Cell and fraction of a position in 0 ... 1 among nodes.
struct Cell {
    std::size_t first;
    double fraction;
    Cell(double position, std::size_t nodes)
        : first{std::min(static_cast<std::size_t>(position * static_cast<double>(nodes - 1)), nodes - 2)},
          fraction{position * static_cast<double>(nodes - 1) - static_cast<double>(first)} {}
};

Direction elevated(std::size_t node, std::size_t azimuth) {
    const double root = static_cast<double>(node) / (elevations - 1);
    const double c = root * root, s = std::sqrt((1 - c) * (1 + c));
    const double phi = pi * static_cast<double>(azimuth) / (azimuths - 1);
    return Direction::from_vector({s * std::cos(phi), s * std::sin(phi), c});
}

/// <h.n> int (h.k_1)+ (h.k_2)+ p dw/(g g) at all nodes: 1 for a flat surface.
std::vector<double> lambertian_table(const AshikhminFacets& facets) {
    const auto points = facets.density().quadrature(128);
    std::vector<double> table(elevations * elevations * azimuths);
    for (std::size_t i = 0; i < elevations; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            for (std::size_t a = 0; a < azimuths; ++a) {
                const auto first = elevated(i, 0), second = elevated(j, a);
                double sum = 0, sum_first = 0, sum_second = 0;  // g by the same points: their errors cancel
                for (const auto& [h, weight] : points) {
                    const double one = std::fmax(dot(h, first.vector()), 0),
                                 two = std::fmax(dot(h, second.vector()), 0);
                    sum += weight * one * two;
                    sum_first += weight * one;
                    sum_second += weight * two;
                }
                const double value =
                    facets.density().projection() * sum / std::fmax(sum_first * sum_second, 1e-300);
                table[(i * elevations + j) * azimuths + a] = value;
                table[(j * elevations + i) * azimuths + a] = value;
            }
        }
    }
    return table;
}

}  // namespace

LambertianFacets::LambertianFacets(const AshikhminFacets& facets, double albedo)
    : albedo_{checked_reflectance("albedo of the facets", albedo)} {
    if (!facets.density().symmetry().isotropic)
        throw Error{"Lambertian facets: the density of normals must be isotropic"};
    table_ = std::make_shared<const std::vector<double>>(lambertian_table(facets));
}

double LambertianFacets::brdf(const Direction& in, const Direction& out) const noexcept {
    if (!(in.cos_theta() > 0 && out.cos_theta() > 0)) return 0;
    const double cosine = std::clamp(in.cos_phi() * out.cos_phi() + in.sin_phi() * out.sin_phi(), -1.0, 1.0);
    const double low = std::fmin(in.cos_theta(), out.cos_theta()),
                 high = std::fmax(in.cos_theta(), out.cos_theta());
    const Cell i{std::sqrt(low), elevations}, j{std::sqrt(high), elevations},
        a{std::acos(cosine) / pi, azimuths};
    const auto at = [&](std::size_t di, std::size_t dj) {
        const double* const from =
            &(*table_)[((i.first + di) * elevations + j.first + dj) * azimuths + a.first];
        return std::lerp(from[0], from[1], a.fraction);
    };
    return albedo_ / pi *
           std::lerp(std::lerp(at(0, 0), at(0, 1), j.fraction), std::lerp(at(1, 0), at(1, 1), j.fraction),
                     i.fraction);
}

double LambertianFacets::pdf(const Direction& in, const Direction& out) const noexcept {
    return in.cos_theta() > 0 ? out.cos_theta() / pi : 0;
}

Draw LambertianFacets::sample(const Direction& in, const Uniforms& uniforms) const noexcept {
    const auto out = Direction::from_vector(cosine_vector(uniforms[1], uniforms[2]));
    const double density = pdf(in, out);
    if (!(density > 0)) return Draw::none(in);
    return {out, brdf(in, out) * pi, density};
}

}  // namespace hts

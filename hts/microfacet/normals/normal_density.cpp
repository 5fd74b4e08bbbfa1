#include "hts/microfacet/normals/normal_density.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hts/error.hpp"
#include "hts/microfacet/normals/normal_lobe.hpp"

namespace hts {
namespace {

using std::numbers::pi;

void require_width(const char* name, double sigma, double least) {
    if (!(sigma >= least)) {
        throw out_of_range(name, sigma, "", "at least " + shortest(least) + " (infinity allowed)");
    }
}

void require_grid(const ValueGrid& grid) {
    const auto require_count = [](const char* what, std::size_t count, std::size_t least) {
        if (count < least || count > 4096) {
            throw out_of_range(what, static_cast<double>(count), "",
                               "from " + std::to_string(least) + " to 4096");
        }
    };
    require_count("rows of a grid of normals", grid.rows, 2);
    require_count("columns of a grid of normals", grid.columns, 1);
    if (grid.values.size() != grid.rows * grid.columns) {
        throw out_of_range("number of values of a grid of normals", static_cast<double>(grid.values.size()),
                           "", "rows times columns, " + std::to_string(grid.rows * grid.columns));
    }
    double most = 0;
    for (const double value : grid.values) {
        if (!(value >= 0 && std::isfinite(value)))
            throw out_of_range("value of a grid of normals", value, "", ">= 0 and finite");
        most = std::fmax(most, value);
    }
    if (most == 0) throw out_of_range("largest value of a grid of normals", most, "", "> 0");
}

/// Scaled so that sums of values stay finite.
ValueGrid scaled(ValueGrid grid) {
    const double most = *std::max_element(grid.values.begin(), grid.values.end());
    for (double& value : grid.values) value /= most;
    return grid;
}

double angle_to_normal(Vector3 mean) {
    return std::atan2(std::hypot(mean.x, mean.y), mean.z);
}

}  // namespace

std::string TiltedMean::text() const {
    std::string text{"mean normal of the microfacets is "};
    text.append(shortest(std::round(angle * 1800 / pi) / 10));
    return text.append(
        " deg off the surface normal: no surface is like that, and more light may be reflected than came");
}

NormalDensity::NormalDensity(std::vector<Part> parts, NormalSymmetry symmetry, double width_x, double width_y)
    : parts_{std::move(parts)},
      symmetry_{symmetry},
      width_x_{std::fmin(width_x, 1)},
      width_y_{std::fmin(width_y, 1)},
      mean_{} {
    for (const auto& part : parts_) {
        mean_ = mean_ + part.share * part.lobe->mean();
        projection_ += part.share * part.lobe->projection();
    }
    if (!(projection_ > 0)) throw out_of_range("mean projection of the normals", projection_, "", "> 0");
}

NormalDensity NormalDensity::gaussian(double sigma_x, double sigma_y) {
    require_width("sigma_x of the normals", sigma_x, 1e-4);
    require_width("sigma_y of the normals", sigma_y, 1e-4);
    return {{{1, std::make_shared<GaussianFacets>(sigma_x, sigma_y)}},
            {sigma_x == sigma_y, true, true},
            sigma_x,
            sigma_y};
}

NormalDensity NormalDensity::grooves(double slope, double sigma) {
    if (!(slope >= 0 && slope < pi / 2))
        throw out_of_range("slope of the grooves", slope, "rad", "from 0 to below pi/2 rad");
    require_width("sigma of the grooves", sigma, 1e-4);
    return {{{0.5, std::make_shared<GaussianFacets>(sigma, sigma, slope)},
             {0.5, std::make_shared<GaussianFacets>(sigma, sigma, -slope)}},
            {slope == 0, true, true},
            std::fmax(sigma, std::sin(slope)),
            sigma};
}

NormalDensity NormalDensity::inverse_gaussian(double sigma) {
    require_width("sigma of the fibres", sigma, 0.1);
    return {{{1, std::make_shared<UprightFibres>(sigma)}}, {true, true, true}, 1, 1};
}

NormalDensity NormalDensity::slanted_fibres(double sigma, double slant) {
    require_width("sigma of the fibres", sigma, 1e-4);
    if (!(slant >= 0 && slant <= pi / 2))
        throw out_of_range("slant of the fibres", slant, "rad", "from 0 to pi/2 rad");
    const double endless = std::numeric_limits<double>::infinity();
    return {{{1, std::make_shared<GaussianFacets>(sigma, endless, slant - pi / 2, 1)}},
            {false, false, true},
            1,
            1};
}

NormalDensity NormalDensity::tabulated(ValueGrid grid) {
    require_grid(grid);
    const bool isotropic = grid.columns == 1;
    const auto facets = std::make_shared<TabulatedFacets>(scaled(std::move(grid)));
    const NormalSymmetry symmetry{isotropic, facets->mirror_x(), facets->mirror_y()};
    return {{{1, facets}}, symmetry, 0.5, 0.5};
}

NormalDensity NormalDensity::image(double sigma_x, double sigma_y, ValueGrid pixels, double extent) {
    require_width("sigma_x of the normals", sigma_x, 1e-4);
    require_width("sigma_y of the normals", sigma_y, 1e-4);
    if (!(extent > 0 && extent <= 1))
        throw out_of_range("extent of the image of normals", extent, "", "> 0 and at most 1");
    require_grid(pixels);
    return {{{1, std::make_shared<PicturedFacets>(GaussianFacets{sigma_x, sigma_y}, scaled(std::move(pixels)),
                                                  extent)}},
            {false, false, false},
            sigma_x,
            sigma_y};
}

NormalDensity NormalDensity::mixture(const std::vector<Share>& shares) {
    double sum = 0;
    for (const auto& share : shares) {
        if (!(share.weight > 0 && std::isfinite(share.weight))) {
            throw out_of_range("weight in a mixture of normals", share.weight, "", "> 0 and finite");
        }
        sum += share.weight;
    }
    if (shares.empty())
        throw out_of_range("number of densities in a mixture of normals", 0, "", "at least 1");
    std::vector<Part> parts;
    NormalSymmetry common{true, true, true};
    double width_x = 1, width_y = 1;
    for (const auto& [weight, density] : shares) {
        for (const auto& part : density.parts_) parts.push_back({part.share * weight / sum, part.lobe});
        common.isotropic = common.isotropic && density.symmetry_.isotropic;
        common.mirror_x = common.mirror_x && density.symmetry_.mirror_x;
        common.mirror_y = common.mirror_y && density.symmetry_.mirror_y;
        width_x = std::fmin(width_x, density.width_x_);
        width_y = std::fmin(width_y, density.width_y_);
    }
    return {std::move(parts), common, width_x, width_y};
}

double NormalDensity::operator()(Vector3 h) const noexcept {
    double sum = 0;
    for (const auto& part : parts_) sum += part.share * part.lobe->value(h);
    return sum;
}

std::optional<TiltedMean> NormalDensity::tilted_mean() const {
    const double angle = angle_to_normal(mean_);
    return angle > 0.01 ? std::optional{TiltedMean{angle}} : std::nullopt;
}

double NormalDensity::projected_area(Vector3 k) const {
    double sum = 0;
    for (const auto& part : parts_) sum += part.share * part.lobe->projected_area(k);
    return sum;
}

Vector3 NormalDensity::sample(const Uniforms& uniforms) const noexcept {
    double u = uniforms[0];
    std::size_t i = 0;
    for (; i + 1 < parts_.size() && u >= parts_[i].share; ++i) u -= parts_[i].share;
    return parts_[i].lobe->draw(
        {std::fmin(u / parts_[i].share, 0x1.fffffffffffffp-1), uniforms[1], uniforms[2]});
}

double NormalDensity::pdf(Vector3 h) const noexcept {
    double sum = 0;
    for (const auto& part : parts_) sum += part.share * part.lobe->draw_density(h);
    return sum;
}

std::vector<WeightedNormal> NormalDensity::quadrature(std::size_t per_side) const {
    std::vector<WeightedNormal> points;
    const auto count = static_cast<double>(per_side);
    const auto middle = [count](std::size_t i) { return (static_cast<double>(i) + 0.5) / count; };
    for (const auto& [share, lobe] : parts_) {
        const std::size_t first = points.size();
        double sum = 0;
        for (std::size_t cell = 0; cell < per_side * per_side; ++cell) {
            const Vector3 h = lobe->spread(middle(cell / per_side), middle(cell % per_side));
            const double weight = lobe->value(h) / lobe->spread_density(h);
            if (!(weight > 0)) continue;
            points.push_back({h, weight});
            sum += weight;
        }
        for (std::size_t i = first; i < points.size(); ++i) points[i].weight *= share / sum;
    }
    return points;
}

}  // namespace hts

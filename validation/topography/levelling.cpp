#include "validation/topography/levelling.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "spectral/statistics.hpp"

namespace hts::validation {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// Heights of a point and those beside it that have a value; the point's own counts too.
class Neighbours {
  public:
    Neighbours(const HeightMap& map, std::size_t column, std::size_t row) {
        const std::size_t left = column == 0 ? 0 : column - 1, top = row == 0 ? 0 : row - 1;
        for (std::size_t j = top; j <= std::min(row + 1, map.rows() - 1); ++j) {
            for (std::size_t i = left; i <= std::min(column + 1, map.columns() - 1); ++i) {
                if (const double z = map.at(i, j); !std::isnan(z)) values_[count_++] = z;
            }
        }
    }
    [[nodiscard]] double median() {
        const auto middle = values_.begin() + static_cast<std::ptrdiff_t>(count_ / 2);
        std::nth_element(values_.begin(), middle, values_.begin() + static_cast<std::ptrdiff_t>(count_));
        return *middle;
    }

  private:
    std::array<double, 9> values_{};
    std::size_t count_ = 0;
};

/// NaN in place of outliers; returns how many.
std::size_t mark_outliers(const HeightMap& map, double limit, std::vector<double>& heights) {
    if (limit == 0) return 0;
    std::vector<double> distances(heights.size(), no_value), known;
    known.reserve(map.value_count());
    for (std::size_t j = 0; j < map.rows(); ++j) {
        for (std::size_t i = 0; i < map.columns(); ++i) {
            const double z = map.at(i, j);
            if (std::isnan(z)) continue;
            const double distance = std::fabs(z - Neighbours{map, i, j}.median());
            distances[j * map.columns() + i] = distance;
            // a point that is the median itself says nothing of the others
            if (distance > 0) known.push_back(distance);
        }
    }
    const double most = limit * 1.4826 * spectral::median(std::move(known));
    std::size_t count = 0;
    for (std::size_t k = 0; k < heights.size(); ++k) {
        if (!(distances[k] > most)) continue;
        heights[k] = no_value;
        ++count;
    }
    return count;
}

/// Coordinates -1 … 1 over the field, and their powers.
std::array<double, 6> powers(const HeightMap& map, std::size_t column, std::size_t row) {
    const double x = 2 * (static_cast<double>(column) + 0.5) / static_cast<double>(map.columns()) - 1;
    const double y = 1 - 2 * (static_cast<double>(row) + 0.5) / static_cast<double>(map.rows());
    return {1, x, y, x * x, x * y, y * y};
}

/// Least squares of a polynomial with so many of the powers.
Eigen::VectorXd polynomial(const HeightMap& map, const std::vector<double>& heights, int count) {
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(count, count);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(count);
    for (std::size_t j = 0; j < map.rows(); ++j) {
        for (std::size_t i = 0; i < map.columns(); ++i) {
            const double z = heights[j * map.columns() + i];
            if (std::isnan(z)) continue;
            const auto all = powers(map, i, j);
            const Eigen::Map<const Eigen::VectorXd> row{all.data(), count};
            a += row * row.transpose();
            b += z * row;
        }
    }
    return a.ldlt().solve(b);
}

void subtract(const HeightMap& map, const Eigen::VectorXd& coefficients, std::vector<double>& heights) {
    for (std::size_t j = 0; j < map.rows(); ++j) {
        for (std::size_t i = 0; i < map.columns(); ++i) {
            const auto all = powers(map, i, j);
            for (Eigen::Index k = 0; k < coefficients.size(); ++k)
                heights[j * map.columns() + i] -= coefficients[k] * all[static_cast<std::size_t>(k)];
        }
    }
}

/// Harmonic heights in gaps: each is the mean of its neighbours.
class Filling {
  public:
    Filling(const HeightMap& map, std::vector<double>& heights)
        : columns_{map.columns()}, rows_{map.rows()}, heights_{heights} {
        for (std::size_t k = 0; k < heights.size(); ++k) {
            if (std::isnan(heights[k])) open_.push_back(k);
        }
    }
    void fill() {
        grow();
        for (int sweep = 0; sweep < 400; ++sweep) {
            for (const std::size_t k : open_) heights_[k] = mean_beside(k);
        }
    }

  private:
    /// From the rims inwards, so that sweeps have something to begin with.
    void grow() {
        std::vector<std::size_t> rest = open_;
        while (!rest.empty()) {
            std::vector<std::size_t> later;
            std::vector<std::pair<std::size_t, double>> found;
            for (const std::size_t k : rest) {
                if (const double z = mean_beside(k); std::isnan(z))
                    later.push_back(k);
                else
                    found.emplace_back(k, z);
            }
            for (const auto& [k, z] : found) heights_[k] = z;
            rest.swap(later);
        }
    }
    [[nodiscard]] double mean_beside(std::size_t k) const {
        const std::size_t i = k % columns_, j = k / columns_;
        double sum = 0;
        int count = 0;
        const auto add = [&](std::size_t neighbour) {
            if (std::isnan(heights_[neighbour])) return;
            sum += heights_[neighbour];
            ++count;
        };
        if (i > 0) add(k - 1);
        if (i + 1 < columns_) add(k + 1);
        if (j > 0) add(k - columns_);
        if (j + 1 < rows_) add(k + columns_);
        return count > 0 ? sum / count : no_value;
    }

    std::size_t columns_, rows_;
    std::vector<double>& heights_;
    std::vector<std::size_t> open_;
};

}  // namespace

std::string_view name(Level level) {
    switch (level) {
        case Level::mean:
            return "mean";
        case Level::plane:
            return "plane";
        case Level::quadratic:
            return "quadratic";
    }
    return "";
}

int coefficient_count(Level level) noexcept {
    return level == Level::mean ? 1 : level == Level::plane ? 3 : 6;
}

std::string_view name(Gaps gaps) {
    return gaps == Gaps::mask ? "mask" : "fill";
}

LevelledMap levelled(const HeightMap& map, const Levelling& how) {
    std::vector<double> heights{map.heights().begin(), map.heights().end()};
    const std::size_t gaps = heights.size() - map.value_count();
    const std::size_t outliers = mark_outliers(map, how.outlier, heights);
    const HeightMap kept = map.with(heights);  // whether enough is left
    const Eigen::VectorXd plane = polynomial(kept, heights, 3);
    subtract(kept, polynomial(kept, heights, coefficient_count(how.level)), heights);
    if (how.gaps == Gaps::fill && gaps + outliers > 0) {
        Filling{kept, heights}.fill();
        double sum = 0;
        for (const double z : heights) sum += z;
        for (double& z : heights) z -= sum / static_cast<double>(heights.size());
    }
    return {map.with(std::move(heights)), how, gaps, outliers, 2 * plane[1] / map.width(),
            2 * plane[2] / map.height()};
}

}  // namespace hts::validation

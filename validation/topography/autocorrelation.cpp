#include "validation/topography/autocorrelation.hpp"

#include <algorithm>
#include <cmath>

#include "validation/topography/plane_transform.hpp"

namespace hts::validation {
namespace {

/// The next product of 2, 3 and 5.
std::size_t quick_size(std::size_t least) {
    for (std::size_t size = least;; ++size) {
        std::size_t rest = size;
        for (const std::size_t factor : {2U, 3U, 5U}) {
            while (rest % factor == 0) rest /= factor;
        }
        if (rest == 1) return size;
    }
}

/// Autocorrelations of two real fields at once, summed over a rectangle that is long enough for lags up to
/// `across` and `down`; the first is the real part, the second the imaginary one.
struct Correlations {
    std::size_t columns, rows;
    ComplexField field;

    template <class First, class Second>
    Correlations(const HeightMap& map, std::size_t across, std::size_t down, const First& first,
                 const Second& second)
        : columns{quick_size(map.columns() + across)},
          rows{quick_size(map.rows() + down)},
          field(columns * rows) {
        for (std::size_t j = 0; j < map.rows(); ++j) {
            for (std::size_t i = 0; i < map.columns(); ++i) {
                const std::size_t k = j * map.columns() + i;
                field[j * columns + i] = {first(k), second(k)};
            }
        }
        transform_forward(field, columns, rows);
        ComplexField powers(field.size());
        for (std::size_t j = 0; j < rows; ++j) {
            for (std::size_t i = 0; i < columns; ++i) {
                const auto here = field[j * columns + i];
                const auto there =
                    std::conj(field[(j == 0 ? 0 : rows - j) * columns + (i == 0 ? 0 : columns - i)]);
                powers[j * columns + i] = {std::norm(here + there) / 4, std::norm(here - there) / 4};
            }
        }
        field.swap(powers);
        transform_inverse(field, columns, rows);
    }
    /// At a lag, which may be negative.
    [[nodiscard]] const std::complex<double>& at(std::ptrdiff_t x, std::ptrdiff_t y) const {
        const auto wrapped = [](std::ptrdiff_t lag, std::size_t size) {
            return static_cast<std::size_t>(lag < 0 ? lag + static_cast<std::ptrdiff_t>(size) : lag);
        };
        return field[wrapped(y, rows) * columns + wrapped(x, columns)];
    }
};

std::vector<double> correlation_of_line(const std::vector<double>& line) {
    std::vector<double> result(line.size());
    for (std::size_t lag = 0; lag < line.size(); ++lag) {
        for (std::size_t i = 0; i + lag < line.size(); ++i) result[lag] += line[i] * line[i + lag];
    }
    return result;
}

/// Weights of lags gathered by distance; lag 0 stays alone. A bin is so narrow that what J0 does inside it,
/// at the highest frequency, is 1e-4 of it at most.
class LagBins {
  public:
    LagBins(const HeightMap& map, const Ellipse& ellipse)
        : map_{map}, ellipse_{ellipse}, width_{std::min(map.step_x(), map.step_y()) / 64} {}

    void add(std::ptrdiff_t x, std::ptrdiff_t y, double weight) {
        const double r = ellipse_.distance(static_cast<double>(x) * map_.step_x(),
                                           -static_cast<double>(y) * map_.step_y());
        const std::size_t bin = r == 0 ? 0 : 1 + static_cast<std::size_t>(r / width_);
        if (bin >= weights_.size()) weights_.resize(bin + 1), moments_.resize(bin + 1);
        weights_[bin] += weight;
        moments_[bin] += weight * r;
    }
    [[nodiscard]] std::vector<Lag> lags(double scale) const {
        std::vector<Lag> result;
        for (std::size_t k = 0; k < weights_.size(); ++k) {
            if (weights_[k] > 0) result.push_back({moments_[k] / weights_[k], scale * weights_[k]});
        }
        return result;
    }

  private:
    const HeightMap& map_;
    const Ellipse& ellipse_;
    double width_;
    std::vector<double> weights_, moments_;
};

}  // namespace

double Autocorrelation::length() const {
    const double wanted = std::exp(-1);
    for (std::size_t i = 1; i < value.size(); ++i) {
        if (value[i] > wanted) continue;
        const double share = (value[i - 1] - wanted) / (value[i - 1] - value[i]);
        return distance[i - 1] + share * (distance[i] - distance[i - 1]);
    }
    return 0;
}

double Autocorrelation::gaussian_length_at(double r) const {
    for (std::size_t i = 1; i < value.size(); ++i) {
        if (distance[i] < r) continue;
        const double share = (r - distance[i - 1]) / (distance[i] - distance[i - 1]);
        const double c = value[i - 1] + share * (value[i] - value[i - 1]);
        return c > 0 && c < 1 ? r / std::sqrt(-std::log(c)) : 0;
    }
    return 0;
}

Autocorrelation autocorrelation_of(const HeightMap& map) {
    const std::size_t across = map.columns() / 2, down = map.rows() / 2;
    const auto heights = map.heights();
    double mean = 0;
    for (const double z : heights) mean += std::isnan(z) ? 0 : z / static_cast<double>(map.value_count());
    const Correlations sums{map, across, down,
                            [&](std::size_t k) { return std::isnan(heights[k]) ? 0 : heights[k] - mean; },
                            [&](std::size_t k) { return std::isnan(heights[k]) ? 0.0 : 1.0; }};
    const double step = std::min(map.step_x(), map.step_y());
    const double farthest = std::min(map.width(), map.height()) / 2;
    const auto count = static_cast<std::size_t>(farthest / step);
    std::vector<double> products(count + 1), pairs(count + 1), moments(count + 1);
    Autocorrelation result{{}, {}, 0, 0};
    const double variance = sums.at(0, 0).real() / sums.at(0, 0).imag();
    for (auto y = -static_cast<std::ptrdiff_t>(down); y <= static_cast<std::ptrdiff_t>(down); ++y) {
        for (auto x = -static_cast<std::ptrdiff_t>(across); x <= static_cast<std::ptrdiff_t>(across); ++x) {
            const auto& sum = sums.at(x, y);
            if (!(sum.imag() > 0.5)) continue;
            const double c = sum.real() / sum.imag() / variance;
            // pairs that the map has there, as a share of its points
            const double share = sum.imag() / sums.at(0, 0).imag();
            result.cubes += share * c * c * c;
            result.fourths += share * c * c * c * c;
            const double r =
                std::hypot(static_cast<double>(x) * map.step_x(), static_cast<double>(y) * map.step_y());
            const auto bin = static_cast<std::size_t>(std::lround(r / step));
            if (bin > count) continue;
            products[bin] += sum.real();
            pairs[bin] += sum.imag();
            moments[bin] += sum.imag() * r;
        }
    }
    const auto points = static_cast<double>(map.value_count());
    result.cubes /= points;
    result.fourths /= points;
    for (std::size_t k = 0; k <= count; ++k) {
        if (!(pairs[k] > 0)) continue;
        result.distance.push_back(moments[k] / pairs[k]);
        result.value.push_back(products[k] / pairs[k] / variance);
    }
    return result;
}

std::vector<Lag> window_lags(const HeightMap& map, const MapWindow& window, const Ellipse& ellipse) {
    LagBins bins{map, ellipse};
    const auto columns = static_cast<std::ptrdiff_t>(map.columns()),
               rows = static_cast<std::ptrdiff_t>(map.rows());
    const auto add_all = [&](const auto& weight) {
        for (std::ptrdiff_t y = 0; y < rows; ++y) {
            for (std::ptrdiff_t x = 1 - columns; x < columns; ++x) {
                if (y == 0 && x < 0) continue;  // each lag and its opposite once
                bins.add(x, y, (x == 0 && y == 0 ? 1 : 2) * weight(x, y));
            }
        }
    };
    if (window.whole) {
        const auto across = correlation_of_line(window.across), down = correlation_of_line(window.down);
        add_all([&](std::ptrdiff_t x, std::ptrdiff_t y) {
            return across[static_cast<std::size_t>(std::abs(x))] * down[static_cast<std::size_t>(y)];
        });
    } else {
        const Correlations sums{map, map.columns(), map.rows(),
                                [&](std::size_t k) { return window.weights[k]; },
                                [](std::size_t) { return 0.0; }};
        add_all([&](std::ptrdiff_t x, std::ptrdiff_t y) { return std::max(0.0, sums.at(x, y).real()); });
    }
    return bins.lags(map.step_x() * map.step_y() / window.squares);
}

}  // namespace hts::validation

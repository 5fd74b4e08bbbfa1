#include "validation/topography/map_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "validation/topography/plane_transform.hpp"

namespace hts::validation {
namespace {

std::vector<double> window_line(std::size_t count, Window kind) {
    std::vector<double> line(count, 1);
    if (kind == Window::none) return line;
    for (std::size_t i = 0; i < count; ++i) {
        const double sine =
            std::sin(std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(count));
        line[i] = sine * sine;
    }
    return line;
}

/// Calls f(frequency_x, frequency_y, power) for each frequency but 0.
template <class Function>
void for_each_frequency(const MapSpectrum& spectrum, const Function& f) {
    for (std::size_t j = 0; j < spectrum.rows; ++j) {
        for (std::size_t i = 0; i < spectrum.columns; ++i) {
            if (i == 0 && j == 0) continue;
            f(spectrum.frequency_x(i), spectrum.frequency_y(j), spectrum.power[j * spectrum.columns + i]);
        }
    }
}

/// The highest frequency that every direction has, as the ellipse sees it.
double highest_frequency(const MapSpectrum& spectrum, const Ellipse& ellipse) {
    const double x = spectrum.cell_x * static_cast<double>(spectrum.columns) / 2;
    const double y = spectrum.cell_y * static_cast<double>(spectrum.rows) / 2;
    double highest = HUGE_VAL;
    for (int k = 0; k <= 64; ++k) {  // along the two sides of the rectangle
        const double share = k / 32.0 - 1;
        highest = std::min({highest, ellipse.frequency(x, share * y), ellipse.frequency(share * x, y)});
    }
    return highest;
}

int ring(double frequency) {
    return static_cast<int>(std::floor(RadialBin::rings * std::log10(frequency)));
}

/// Of bins that hold sums over the rings.
std::vector<RadialBin> means(const std::map<int, RadialBin>& sums) {
    std::vector<RadialBin> result;
    for (auto [number, bin] : sums) {
        bin.frequency /= bin.cells;
        bin.power /= bin.cells;
        result.push_back(bin);
    }
    return result;
}

}  // namespace

std::string_view name(Window window) {
    return window == Window::hann ? "hann" : "none";
}

MapWindow::MapWindow(const HeightMap& map, Window kind)
    : across{window_line(map.columns(), kind)},
      down{window_line(map.rows(), kind)},
      weights(map.heights().size()),
      whole{map.value_count() == map.heights().size()} {
    double fourths = 0;
    std::size_t k = 0;
    for (const double of_row : down) {
        for (const double of_column : across) {
            weights[k] = std::isnan(map.heights()[k]) ? 0 : of_column * of_row;
            const double square = weights[k] * weights[k];
            squares += square;
            fourths += square * square;
            ++k;
        }
    }
    inflation = static_cast<double>(weights.size()) * fourths / (squares * squares);
}

double Ellipse::distance(double x, double y) const noexcept {
    const double c = std::cos(azimuth), s = std::sin(azimuth), root = std::sqrt(ratio);
    return std::hypot((x * c + y * s) / root, (y * c - x * s) * root);
}

double Ellipse::frequency(double x, double y) const noexcept {
    return Ellipse{1 / ratio, azimuth}.distance(x, y);
}

double MapSpectrum::frequency_x(std::size_t column) const noexcept {
    return cell_x * signed_frequency(column, columns);
}

double MapSpectrum::frequency_y(std::size_t row) const noexcept {
    return -cell_y * signed_frequency(row, rows);
}

double MapSpectrum::variance() const noexcept {
    double sum = 0;
    for (const double p : power) sum += p;
    return sum * cell();
}

MapSpectrum spectrum_of(const HeightMap& map, const MapWindow& window) {
    const auto heights = map.heights();
    double weighted = 0, weight = 0, sum = 0, squares = 0;
    for (std::size_t k = 0; k < heights.size(); ++k) {
        if (std::isnan(heights[k])) continue;
        weighted += window.weights[k] * heights[k];
        weight += window.weights[k];
        sum += heights[k];
        squares += heights[k] * heights[k];
    }
    const auto count = static_cast<double>(map.value_count());
    const double mean = weighted / weight, variance = squares / count - (sum / count) * (sum / count);
    ComplexField field(heights.size());
    double windowed = 0;
    for (std::size_t k = 0; k < heights.size(); ++k) {
        if (std::isnan(heights[k])) continue;
        field[k] = window.weights[k] * (heights[k] - mean);
        windowed += std::norm(field[k]);
    }
    windowed /= window.squares;
    transform_forward(field, map.columns(), map.rows());
    MapSpectrum result{map.columns(), map.rows(), 1 / map.width(), 1 / map.height(), {}, windowed / variance};
    const double scale = map.step_x() * map.step_y() / window.squares / result.window_share;
    result.power.reserve(field.size());
    for (const auto& amplitude : field) result.power.push_back(scale * std::norm(amplitude));
    return result;
}

std::vector<RadialBin> radial_spectrum(const MapSpectrum& spectrum, const Ellipse& ellipse) {
    std::map<int, RadialBin> bins;
    const double highest = highest_frequency(spectrum, ellipse);
    for_each_frequency(spectrum, [&](double x, double y, double p) {
        const double f = ellipse.frequency(x, y);
        if (f > highest) return;
        RadialBin& bin = bins.try_emplace(ring(f), RadialBin{ring(f), 0, 0, 0}).first->second;
        bin.frequency += f;
        bin.power += p;
        ++bin.cells;
    });
    return means(bins);
}

std::vector<RadialBin> merged(const std::vector<std::vector<RadialBin>>& spectra) {
    std::map<int, RadialBin> bins;
    for (const auto& spectrum : spectra) {
        for (const RadialBin& bin : spectrum) {
            RadialBin& sum = bins.try_emplace(bin.number, RadialBin{bin.number, 0, 0, 0}).first->second;
            sum.frequency += bin.cells * bin.frequency;
            sum.power += bin.cells * bin.power;
            sum.cells += bin.cells;
        }
    }
    return means(bins);
}

std::vector<PolarBin> polar_spectrum(const MapSpectrum& spectrum) {
    std::map<std::pair<int, int>, PolarBin> bins;
    const double highest = highest_frequency(spectrum, {});
    for_each_frequency(spectrum, [&](double x, double y, double p) {
        const double f = std::hypot(x, y);
        if (f > highest) return;
        double azimuth = std::atan2(y, x);
        if (azimuth < 0) azimuth += std::numbers::pi;
        const int sector =
            std::min(static_cast<int>(azimuth / std::numbers::pi * sector_count), sector_count - 1);
        PolarBin& bin = bins.try_emplace({ring(f), sector}, PolarBin{0, 0, 0, 0}).first->second;
        bin.azimuth += azimuth;
        bin.frequency += f;
        bin.power += p;
        ++bin.cells;
    });
    std::vector<PolarBin> result;
    for (auto& [key, bin] : bins) {
        bin.azimuth /= bin.cells;
        bin.frequency /= bin.cells;
        bin.power /= bin.cells;
        result.push_back(bin);
    }
    return result;
}

ProfileSpectrum profile_spectrum(const MapSpectrum& spectrum, bool along_x) {
    const std::size_t count = along_x ? spectrum.columns : spectrum.rows;
    const double cell = along_x ? spectrum.cell_x : spectrum.cell_y;
    std::vector<double> both(count);
    for (std::size_t j = 0; j < spectrum.rows; ++j) {
        for (std::size_t i = 0; i < spectrum.columns; ++i)
            both[along_x ? i : j] += spectrum.power[j * spectrum.columns + i];
    }
    ProfileSpectrum result;
    for (std::size_t i = 1; 2 * i <= count; ++i) {
        result.frequency.push_back(cell * static_cast<double>(i));
        // f and -f; the highest of an even count is both at once
        const double sides = 2 * i == count ? both[i] : both[i] + both[count - i];
        result.power.push_back(sides * spectrum.cell() / cell);
    }
    return result;
}

}  // namespace hts::validation

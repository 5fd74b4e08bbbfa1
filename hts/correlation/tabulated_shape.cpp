#include "hts/correlation/tabulated_shape.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "hts/correlation/log_transform.hpp"
#include "hts/error.hpp"

namespace hts::correlation_detail {
namespace {

constexpr std::size_t points = 8192, middle = points / 2;
constexpr double step = 80.0 / points;
constexpr std::ptrdiff_t margin = 600;  // of its points a transform feels its own ends
constexpr double edge = 0.05;           // ln f over which a spectrum falls to 0
using Complexes = std::vector<std::complex<double>>;

/// Spectrum W of unit variance over q = k length.
class TabulatedSpectrum final : public HeightShape {
  public:
    ///   log_scale   added to ln q and to -ln of the curve's x; log_norm to ln of its values
    ///   log_end     ln f where it ends unless it is continued
    TabulatedSpectrum(std::string name, LogCurve curve, bool continued, double log_end, double log_scale,
                      double log_norm)
        : name_{std::move(name)},
          curve_{std::move(curve)},
          continued_{continued},
          log_end_{log_end},
          log_scale_{log_scale},
          log_norm_{log_norm} {}

    [[nodiscard]] double log_spectrum(double q) const override {
        return log_norm_ + log_density(std::log(q) - log_scale_);
    }
    [[nodiscard]] Heights heights(const LogGrid& grid) const override {
        // the transform's own grid, about the middle of the table
        const double centre = (curve_.first_log_x() + curve_.last_log_x()) / 2 + log_scale_;
        const auto log_q = [&](std::size_t i) {
            return centre + (static_cast<double>(i) - static_cast<double>(middle)) * step;
        };
        const LogTransform transform{points, step};
        const double bias = continued_ ? std::min(1.0, (-curve_.last_power() - 2) / 2) : 1;
        Complexes whole(points), rest(points);
        for (std::size_t i = 0; i < points; ++i) {
            const double log_w = log_norm_ + log_density(log_q(i) - log_scale_);
            whole[i] = std::exp(log_w + log_q(i));
            rest[i] = std::exp(log_w + (2 + bias) * log_q(i));
        }
        transform.hankel(whole);
        transform.complement(rest, bias);
        std::vector<double> correlation(points), log_complement(points);
        double total = 0;
        for (std::size_t i = 0; i < points; ++i)
            total += step * std::exp(log_norm_ + log_density(log_q(i) - log_scale_) + 2 * log_q(i));
        for (std::size_t i = 0; i < points; ++i) {
            const double log_x = -centre + (static_cast<double>(i) - static_cast<double>(middle)) * step;
            correlation[i] = whole[i].real() * std::exp(-log_x) / total;
            log_complement[i] = std::log(std::max(rest[i].real() / total, 1e-300)) + bias * log_x;
        }
        // Far beyond the first period C is what rounding and the points' own corners leave. The factor smears
        // the spectrum over a thirtieth of the first frequency.
        const double least_q = std::exp(curve_.first_log_x() + log_scale_);
        for (std::size_t i = 0; i < points; ++i) {
            const double log_x = -centre + (static_cast<double>(i) - static_cast<double>(middle)) * step;
            const double far = least_q * std::exp(log_x) / 60;
            correlation[i] *= std::exp(-far * far);
        }
        // towards x = 0 the transform of 1 - C falls into its rounding
        constexpr double sound = 1e-8;
        const auto real = [](const std::complex<double>& a, const std::complex<double>& b) {
            return a.real() < b.real();
        };
        const auto greatest = std::max_element(rest.begin(), rest.end(), real);
        auto first = greatest;
        while (first - rest.begin() > margin && first->real() > sound * greatest->real()) --first;
        const auto begin = first - rest.begin();
        const auto half = std::find_if(log_complement.begin() + begin, log_complement.end(),
                                       [](double log) { return log > -std::numbers::ln2; });
        return on(grid, centre,
                  {static_cast<double>(begin), static_cast<double>(half - log_complement.begin())},
                  correlation, log_complement);
    }
    [[nodiscard]] bool oscillates() const override { return true; }
    [[nodiscard]] bool ends() const override { return !continued_; }
    [[nodiscard]] std::string name() const override { return name_; }
    [[nodiscard]] std::vector<double> identity() const override {
        std::vector<double> numbers{4, continued_ ? 1.0 : 0.0, log_scale_ + curve_.first_log_x(),
                                    log_scale_ + curve_.last_log_x(), log_scale_ + log_end_};
        for (int i = 0; i <= 400; ++i) {
            const double at = curve_.first_log_x() + (curve_.last_log_x() - curve_.first_log_x()) * i / 400;
            numbers.push_back(log_norm_ + curve_(at).log);
        }
        numbers.insert(numbers.end(), curve_.log_values().begin(), curve_.log_values().end());
        return numbers;
    }

    [[nodiscard]] double log_density(double log_f) const {
        if (log_f < curve_.first_log_x()) return curve_(curve_.first_log_x()).log;
        if (continued_) return curve_(log_f).log;
        const double beyond = (log_f - log_end_) / (edge * std::numbers::sqrt2);
        if (beyond > 6) return -std::numeric_limits<double>::infinity();
        const double known = std::max(log_end_ + edge, curve_.last_log_x());
        return curve_(std::min(log_f, known)).log + std::log(std::erfc(beyond) / 2);
    }

  private:
    /// Points from which 1 - C is known, and where it has come to a half: each transform has its digits on
    /// its side of that, farther on it may say anything.
    struct Rise {
        double first, half;
    };
    [[nodiscard]] static Heights on(const LogGrid& grid, double centre, const Rise& rise,
                                    const std::vector<double>& correlation,
                                    const std::vector<double>& log_complement) {
        const auto [first, half] = rise;
        constexpr double last = points - margin;
        // near x = 0 a power of x, no steeper than the square
        const double log_rise =
            (interpolated(log_complement, first + 40) - interpolated(log_complement, first)) / (40 * step);
        const double power = std::clamp(log_rise, 0.0, 2.0);
        Heights result{std::vector<double>(grid.count), std::vector<double>(grid.count)};
        for (std::size_t i = 0; i < grid.count; ++i) {
            const double position = (grid[i] + centre) / step + points / 2.0;
            double c = 0, rest = 1;
            if (position < first) {
                rest = std::exp(interpolated(log_complement, first) + power * (position - first) * step);
                c = 1 - rest;
            } else if (position < half) {
                rest = std::exp(interpolated(log_complement, position));
                c = 1 - rest;
            } else if (position < last) {
                c = interpolated(correlation, position);
                rest = 1 - c;
            }
            result.correlation[i] = c;
            result.complement[i] = rest;
        }
        return result;
    }

    std::string name_;
    LogCurve curve_;
    bool continued_;
    double log_end_, log_scale_, log_norm_;
};

/// Integral of a spectrum's density over the plane of frequencies.
double variance_of(const TabulatedSpectrum& spectrum, double first, double last) {
    // below the first frequency the density is held; far beyond the last, what is continued is
    // below rounding or refused
    double sum = 0;
    const double from = first - 20, to = last + 400;
    constexpr double fine = 0.005;
    for (double log_f = from; log_f < to; log_f += fine) {
        const double term = std::exp(spectrum.log_density(log_f) + 2 * log_f);
        sum += term;
        if (log_f > last && term < 1e-17 * sum) break;
    }
    return 2 * std::numbers::pi * fine * sum;
}

/// Of a curve over frequencies: W(q) = S2(f)/(2 pi sigma^2 length^2) 2 pi ... with q = 2 pi f length.
ScaledShape scaled(const LogCurve& curve, bool continued, double log_end, const std::string& name) {
    const TabulatedSpectrum plain{name, curve, continued, log_end, 0, 0};
    const double variance = variance_of(plain, curve.first_log_x(), curve.last_log_x());
    const auto of_length = [&](double length) {
        // W q dq = S2 2 pi f df / sigma^2
        const double log_scale = std::log(2 * std::numbers::pi * length);
        return std::make_shared<const TabulatedSpectrum>(
            name, curve, continued, log_end, log_scale,
            std::log(2 * std::numbers::pi / variance) - 2 * log_scale);
    };
    const LogGrid grid{-4000, 8000, 0.01};
    const Heights heights = of_length(1)->heights(grid);
    const double wanted = 1 - 1 / std::numbers::e;
    const auto found = std::ranges::lower_bound(heights.complement, wanted) - heights.complement.begin();
    const auto above =
        static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(found, 1, std::ssize(heights.complement) - 1));
    const double low = heights.complement[above - 1], high = heights.complement[above];
    const double length = std::exp(grid[above] - grid.step * (high - wanted) / (high - low));
    return {of_length(length), length, variance};
}

}  // namespace

LogCurve::LogCurve(std::span<const double> x, std::span<const double> values) {
    const std::size_t n = x.size();
    for (std::size_t i = 0; i < n; ++i) {
        log_x_.push_back(std::log(x[i]));
        log_values_.push_back(std::log(values[i]));
    }
    std::vector<double> width(n - 1), rise(n - 1);
    for (std::size_t i = 0; i + 1 < n; ++i) {
        width[i] = log_x_[i + 1] - log_x_[i];
        rise[i] = (log_values_[i + 1] - log_values_[i]) / width[i];
    }
    slopes_.push_back(rise.front());
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const double a = 2 * width[i] + width[i - 1], b = width[i] + 2 * width[i - 1];
        slopes_.push_back(rise[i - 1] * rise[i] > 0 ? (a + b) / (a / rise[i - 1] + b / rise[i]) : 0);
    }
    slopes_.push_back(rise.back());
    double count = 0, mean_x = 0, mean_value = 0, square = 0, product = 0;
    for (std::size_t i = n; i-- > 0;) {
        if (count >= 2 && log_x_.back() - log_x_[i] > std::log(3.0)) break;
        const double dx = log_x_[i] - mean_x;
        ++count;
        mean_x += dx / count;
        square += dx * (log_x_[i] - mean_x);
        product += dx * (log_values_[i] - (mean_value += (log_values_[i] - mean_value) / count));
    }
    last_power_ = product / square;
}

LogCurve::Value LogCurve::operator()(double log_x) const noexcept {
    if (log_x <= log_x_.front())
        return {log_values_.front() + slopes_.front() * (log_x - log_x_.front()), slopes_.front()};
    if (log_x >= log_x_.back())
        return {log_values_.back() + last_power_ * (log_x - log_x_.back()), last_power_};
    const auto above = static_cast<std::size_t>(std::ranges::upper_bound(log_x_, log_x) - log_x_.begin());
    const std::size_t i = above - 1;
    const double h = log_x_[above] - log_x_[i], s = (log_x - log_x_[i]) / h;
    const double rise = (log_values_[above] - log_values_[i]) / h;
    const double b = 3 * rise - 2 * slopes_[i] - slopes_[above], c = slopes_[i] + slopes_[above] - 2 * rise;
    return {log_values_[i] + h * s * (slopes_[i] + s * (b + s * c)), slopes_[i] + s * (2 * b + 3 * s * c)};
}

ScaledShape spectrum_shape(std::span<const double> frequency, std::span<const double> density,
                           bool continued) {
    return scaled(LogCurve{frequency, density}, continued, std::log(frequency.back()), "tabulated");
}

ScaledShape fractal_shape(double slope, double periods) {
    // so close together that cubic pieces are as good as the formula
    constexpr double rows_per_e = 50, first = 1e-3;
    const double last = periods * (1 + 10 * edge);  // beyond the end, which is smooth
    const auto rows = static_cast<std::size_t>(std::ceil(rows_per_e * std::log(last / first))) + 1;
    std::vector<double> frequency, density;
    for (std::size_t i = 0; i < rows; ++i) {
        frequency.push_back(first *
                            std::pow(last / first, static_cast<double>(i) / static_cast<double>(rows - 1)));
        density.push_back(std::pow(1 + frequency.back() * frequency.back(), -slope / 2));
    }
    return scaled(LogCurve{frequency, density}, false, std::log(periods),
                  "fractal, C " + shortest(slope) + " over periods of 1 : " + shortest(periods));
}

std::vector<double> abel_transform(std::span<const double> frequency, std::span<const double> density) {
    const LogCurve curve{frequency, density};
    constexpr double fine = 0.01;
    std::vector<double> result;
    for (const double f : frequency) {
        double sum = 0;
        for (int i = 0; i < 40000; ++i) {
            const double s = i * fine, u = f * std::cosh(s);
            const auto [log, slope] = curve(std::log(u));
            const double term = std::exp(log) * slope / u;
            sum += i == 0 ? term / 2 : term;
            if (std::log(u) > curve.last_log_x() && std::abs(term) < 1e-17 * std::abs(sum)) break;
        }
        result.push_back(-sum * fine / (2 * std::numbers::pi));
    }
    return result;
}

ScaledShape autocorrelation_shape(std::span<const double> distance, std::span<const double> correlation) {
    // 1 - C to the first distances where it is not near 1, then C itself
    std::vector<double> complement;
    for (const double c : correlation) complement.push_back(std::max(1 - c, 1e-12));
    const LogCurve rest{distance, complement};
    const double first = rest.first_log_x(), last = rest.last_log_x();
    const double first_power = distance.size() > 1 ? std::clamp(rest(first).slope, 0.05, 2.0) : 2;
    const LogTransform transform{points, step};
    const double centre = (first + last) / 2;
    const auto log_of = [&](std::size_t i, double sign) {
        return sign * centre + (static_cast<double>(i) - static_cast<double>(middle)) * step;
    };
    Complexes values(points);
    for (std::size_t i = 0; i < points; ++i) {
        const double log_x = log_of(i, 1);
        double c = 0;
        if (log_x < first) {
            c = 1 - std::exp(rest(first).log + first_power * (log_x - first));
        } else {
            const double beyond = std::exp(log_x - last);  // 1 at the last distance, 2 where C has come to 0
            const double fade = beyond <= 1   ? 1
                                : beyond >= 2 ? 0
                                              : 0.5 + 0.5 * std::cos(std::numbers::pi * (beyond - 1));
            c = fade * (1 - std::exp(rest(std::min(log_x, last)).log));
        }
        values[i] = std::exp(log_x) * c;
    }
    transform.hankel(values);
    // W over q, S2 = 2 pi W(2 pi f) of unit variance
    constexpr std::size_t stride = 8;
    std::vector<double> q, spectrum;
    double greatest = 0;
    for (std::size_t i = 0; i < points; i += stride) {
        const double log_q = log_of(i, -1);
        // from a hundredth of the reach of the table to where it is known no finer
        if (log_q < std::log(0.03) - last || log_q > std::log(3.0) - first) continue;
        q.push_back(std::exp(log_q));
        spectrum.push_back(values[i].real() / q.back());
        greatest = std::max(greatest, spectrum.back());
    }
    for (std::size_t i = 0; i < q.size(); ++i) {
        if (spectrum[i] < -most_negative * greatest) {
            throw Error{"autocorrelation: its power spectrum is negative, " +
                        shortest(100 * spectrum[i] / greatest) + " % of its greatest value at " +
                        shortest(q[i] / (2 * std::numbers::pi)) +
                        "/um: must be that of a surface, which has no negative power"};
        }
    }
    std::vector<double> frequency, density;
    for (std::size_t i = 0; i < q.size(); ++i) {
        frequency.push_back(q[i] / (2 * std::numbers::pi));
        density.push_back(std::max(spectrum[i], 1e-9 * greatest) * 2 * std::numbers::pi);
    }
    const LogCurve curve{frequency, density};
    ScaledShape result = scaled(curve, curve.last_power() < -2.1, curve.last_log_x(), "tabulated");
    result.variance = 1;
    return result;
}

}  // namespace hts::correlation_detail

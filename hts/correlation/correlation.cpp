#include "hts/correlation/correlation.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "hts/correlation/height_shape.hpp"
#include "hts/correlation/kept_tables.hpp"
#include "hts/correlation/table_cache.hpp"
#include "hts/correlation/tabulated_shape.hpp"
#include "hts/error.hpp"

namespace hts {
namespace {

namespace detail = correlation_detail;
using detail::LobeTable;

/// So that a material read again has its table.
detail::TableCache& tables() {
    static detail::TableCache cache;
    return cache;
}

/// Integrals of W q and of W q^3/2 up to the points of a grid of ln q.
struct Moments {
    static constexpr double first = -40, step = 0.005;
    static constexpr std::size_t points = 16001;
    std::vector<double> log_variance, log_slope;

    explicit Moments(const detail::HeightShape& shape) {
        std::vector<double> variance(points), slope(points);
        for (std::size_t i = 0; i < points; ++i) {
            const double log_q = first + static_cast<double>(i) * step;
            const double log_w = shape.log_spectrum(std::exp(log_q));
            variance[i] = std::exp(log_w + 2 * log_q);
            slope[i] = std::exp(log_w + 4 * log_q) / 2;
        }
        log_variance = logs_of_integral(variance, 2);
        log_slope = logs_of_integral(slope, 4);
    }

    /// By the cubic polynomial through four values; below the grid the integrand goes with a power of q.
    static std::vector<double> logs_of_integral(const std::vector<double>& f, double power) {
        std::vector<double> result;
        double sum = f[0] / power;
        for (std::size_t i = 0; i < points; ++i) {
            result.push_back(std::log(sum));
            if (i + 1 == points) break;
            const double before = f[i > 0 ? i - 1 : i], beyond = f[std::min(i + 2, points - 1)];
            sum += step * std::max(0.0, 13 * (f[i] + f[i + 1]) - before - beyond) / 24;
        }
        return result;
    }
    static double below(const std::vector<double>& logs, double q, double power) {
        if (!(q > 0)) return 0;
        const double position = (std::log(q) - first) / step;
        if (position < 0) return std::exp(logs.front() + power * position * step);
        const double last = static_cast<double>(points) - 1;
        return std::exp(detail::interpolated(logs, std::min(position, last)));
    }
};

void require_increasing(const char* what, std::span<const double> values) {
    if (values.size() < 3)
        throw Error{std::string{what} + ": " + std::to_string(values.size()) + " rows: must be 3 or more"};
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!(values[i] > 0 && std::isfinite(values[i]))) throw out_of_range(what, values[i], "", "> 0");
        if (i > 0 && !(values[i] > values[i - 1]))
            throw out_of_range(what, values[i], "", "above the one before, " + shortest(values[i - 1]));
    }
}

void require_spectrum(std::span<const double> frequency, std::span<const double> density) {
    require_increasing("frequency", frequency);
    for (const double value : density)
        if (!(value > 0 && std::isfinite(value))) throw out_of_range("power spectrum", value, "", "> 0");
}

void require_integrable(std::span<const double> frequency, std::span<const double> density, double least,
                        double finite) {
    const double power = detail::LogCurve{frequency, density}.last_power();
    if (power < -least) return;
    throw Error{"power spectrum: ends as the power " + shortest(power) + " of the frequency: must be below " +
                shortest(-least) + " to be continued, or the variance of heights is " +
                (power < -finite ? "mostly that of frequencies beyond the table" : "infinite")};
}

}  // namespace

void keep_correlation_tables_in(const std::filesystem::path& folder) {
    tables().keep_in(folder);
}

std::filesystem::path user_cache_folder() {
    const auto of = [](const char* name) -> std::string {
        const char* const value = std::getenv(name);
        return value == nullptr ? "" : value;
    };
    if (const std::string own = of("HTS_CACHE"); !own.empty())
        return own == "off" ? std::filesystem::path{} : std::filesystem::path{own};
    if (const std::string cache = of("XDG_CACHE_HOME"); std::filesystem::path{cache}.is_absolute())
        return std::filesystem::path{cache} / "hts";
    const std::string home = of("HOME");
    return home.empty() ? std::filesystem::path{} : std::filesystem::path{home} / ".cache" / "hts";
}

struct Correlation::Shared {
    explicit Shared(detail::ShapePointer of) : shape{std::move(of)}, moments{*shape} {}

    const LobeTable& made(detail::Keep keep = detail::Keep::yes) {
        if (const LobeTable* const there = table.load(std::memory_order_acquire)) return *there;
        std::call_once(once, [&] {
            kept = tables().of(shape, keep);
            table.store(kept.get(), std::memory_order_release);
        });
        return *kept;
    }

    detail::ShapePointer shape;
    Moments moments;
    std::once_flag once;
    std::shared_ptr<const LobeTable> kept;
    std::atomic<const LobeTable*> table{nullptr};
};

Correlation Correlation::gaussian() {
    return Correlation{std::make_shared<Shared>(detail::gaussian_shape())};
}

Correlation Correlation::exponential() {
    return matern(0.5);
}

Correlation Correlation::matern(double nu) {
    if (!(nu >= 0.05 && nu <= 50))
        throw out_of_range("nu of a Matern correlation", nu, "", "from 0.05 to 50");
    return Correlation{std::make_shared<Shared>(detail::matern_shape(nu))};
}

Correlation Correlation::sum(std::span<const Part> parts) {
    if (parts.empty()) throw Error{"sum of correlations: no parts: must be one or more"};
    double whole = 0;
    for (const Part& part : parts) {
        if (!(part.weight > 0 && std::isfinite(part.weight)))
            throw out_of_range("weight in a sum of correlations", part.weight, "", "> 0 and finite");
        if (!(part.length > 0 && std::isfinite(part.length)))
            throw out_of_range("length in a sum of correlations", part.length, "", "> 0 and finite");
        whole += part.weight;
    }
    std::vector<detail::WeightedShape> shapes;
    for (const Part& part : parts)
        shapes.push_back({part.weight / whole, part.shape.shared_->shape, part.length});
    return Correlation{std::make_shared<Shared>(detail::sum_of_shapes(std::move(shapes)))};
}

Correlation::Scaled Correlation::fractal(double slope, double periods) {
    if (!(slope >= 0.1 && slope <= 10))
        throw out_of_range("slope of a fractal spectrum", slope, "", "from 0.1 to 10");
    if (!(periods >= 2 && periods <= 1e7))
        throw out_of_range("longest over shortest period of a fractal spectrum", periods, "",
                           "from 2 to 1e+07");
    const detail::ScaledShape made = detail::fractal_shape(slope, periods);
    return {Correlation{std::make_shared<Shared>(made.shape)}, made.length, 1};
}

Correlation::Scaled Correlation::of_spectrum(std::span<const double> frequency,
                                             std::span<const double> density, bool continued) {
    require_spectrum(frequency, density);
    if (continued) require_integrable(frequency, density, 2.5, 2);
    const detail::ScaledShape made = detail::spectrum_shape(frequency, density, continued);
    return {Correlation{std::make_shared<Shared>(made.shape)}, made.length, std::sqrt(made.variance)};
}

Correlation::Scaled Correlation::of_profile_spectrum(std::span<const double> frequency,
                                                     std::span<const double> density, bool continued) {
    require_spectrum(frequency, density);
    require_integrable(frequency, density, 1, 1);
    const std::vector<double> surface = detail::abel_transform(frequency, density);
    for (std::size_t i = 0; i < surface.size(); ++i) {
        if (surface[i] > 0) continue;
        throw Error{"power spectrum of a profile: its Abel transform is not positive at " +
                    shortest(frequency[i]) +
                    "/um: must fall with frequency, as that of an isotropic surface does; smooth it first"};
    }
    return of_spectrum(frequency, surface, continued);
}

Correlation::Scaled Correlation::of_autocorrelation(std::span<const double> distance,
                                                    std::span<const double> correlation) {
    require_increasing("distance", distance);
    for (const double value : correlation)
        if (!(std::abs(value) < 1))
            throw out_of_range("autocorrelation", value, "", "between -1 and 1, C(0) = 1");
    if (const double last = correlation.back(); std::abs(last) > 0.1)
        throw out_of_range("last autocorrelation", last, "",
                           "within 0.1 of 0: the table must reach as far as heights correlate");
    const detail::ScaledShape made = detail::autocorrelation_shape(distance, correlation);
    return {Correlation{std::make_shared<Shared>(made.shape)}, made.length, 1};
}

std::string Correlation::name() const {
    return shared_->shape->name();
}

std::optional<double> Correlation::nu() const {
    return shared_->shape->nu();
}

double Correlation::log_spectrum(double q) const {
    return shared_->shape->log_spectrum(q);
}

double Correlation::variance_below(double q) const noexcept {
    return std::min(1.0, Moments::below(shared_->moments.log_variance, q, 2));
}

double Correlation::slope_variance_below(double q) const noexcept {
    return Moments::below(shared_->moments.log_slope, q, 4);
}

void Correlation::prepare() const {
    static_cast<void>(shared_->made());
}

void Correlation::prepare_unkept() const {
    static_cast<void>(shared_->made(detail::Keep::no));
}

ScatteringIntegral Correlation::lobe(double g, double q) const noexcept {
    if (!(g > 0)) return {0, -std::numeric_limits<double>::infinity(), 1};
    const auto [log, log_inverse_mean] = shared_->made()(g, q);
    return {std::exp(log), log, std::exp(log_inverse_mean)};
}

ScatteringSlopes Correlation::lobe_slopes(double g, double t) const noexcept {
    const auto [by_log_g, by_t] = shared_->made().slopes(g, t);
    return {by_log_g, by_t};
}

const correlation_detail::LobeTable& Correlation::table() const {
    return shared_->made();
}

std::size_t Correlation::table_bytes() const noexcept {
    const LobeTable* const table = shared_->table.load(std::memory_order_acquire);
    return table == nullptr ? 0 : table->bytes();
}

bool operator==(const Correlation& a, const Correlation& b) {
    return a.shared_ == b.shared_ || a.shared_->shape->identity() == b.shared_->shape->identity();
}

}  // namespace hts

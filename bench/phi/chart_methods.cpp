#include "bench/phi/chart_methods.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bench/phi/phi_methods.hpp"
#include "hts/phi.hpp"

namespace hts::bench {
namespace {

/// Where a method stands in the legend. Okabe and Ito's colours, for all kinds of colour vision.
struct Family {
    const char* heading;
    const char* colour;
    bool hollow;
};

constexpr Family fixed_series{"series of fixed length", "#e69f00", false};
constexpr Family long_series{"series as long as needed", "#009e73", false};
constexpr Family saddle_point{"saddle point", "#0072b2", false};
constexpr Family table{"table", "#aa4499", false};
constexpr Family cheap{"cheap but wrong", "#707070", false};
constexpr Family single{"single precision", "#56b4e9", true};
constexpr Family ours_scalar{"hts, one at a time", "#d55e00", false};
constexpr Family ours_batch{"hts, batch", "#000000", false};

/// The family of a method and the words of its setting there.
std::pair<Family, std::string> place_of(const PhiMethodEntry& method) {
    const std::string with_setting = method.setting.empty() ? "" : ", " + method.setting;
    if (method.ours) return {ours_scalar, method.setting};
    if (method.name == "series, fixed") return {fixed_series, method.setting};
    if (method.name.starts_with("series, ")) return {long_series, method.name.substr(8) + with_setting};
    if (method.name == "saddle point") return {saddle_point, method.setting};
    if (method.name.starts_with("spline")) return {table, method.name + with_setting};
    if (method.name.starts_with("float ")) return {single, method.name.substr(6) + with_setting};
    if (method.name == "rough limit") return {cheap, "rough limit = Beckmann"};
    return {cheap, method.name + with_setting};
}

/// Gnuplot's circle, square, triangles, diamond and pentagon, filled; the number before is the hollow one.
constexpr std::array markers{7, 5, 9, 11, 13, 15};

/// "1e-6" of a power of ten.
std::string setting_of(double tolerance) {
    return "1e" + std::to_string(std::lround(std::log10(tolerance)));
}

/// Adds a method to the list and gives it the next marker of its family.
void add(std::vector<ChartMethod>& list, const Family& family, const std::string& label, ChartMethod method) {
    const auto same = std::count_if(list.begin(), list.end(), [&family](const ChartMethod& other) {
        return other.style.family == family.heading;
    });
    const int marker = markers[static_cast<std::size_t>(same) % markers.size()] - (family.hollow ? 1 : 0);
    method.style = {family.heading, label, family.colour, marker};
    list.push_back(std::move(method));
}

PhiBlock one_at_a_time(std::function<double(double, double)> value) {
    return [value = std::move(value)](std::span<const double> g, std::span<const double> t,
                                      std::span<double> result) {
        for (std::size_t i = 0; i < g.size(); ++i) result[i] = value(g[i], t[i]);
    };
}

void add_listed(std::vector<ChartMethod>& list, bool ours) {
    for (const PhiMethodEntry& method : phi_methods()) {
        if (method.ours != ours) continue;
        const auto [family, label] = place_of(method);
        add(list, family, label,
            {method.name,
             method.setting,
             one_at_a_time(method.value),
             ours,
             false,
             ours ? method.error : 0,
             method.bytes,
             {}});
    }
}

void add_batches(std::vector<ChartMethod>& list) {
    for (const double error : {1e-3, 1e-6, 1e-12}) {
        const Tolerance tolerance{error};
        const PhiBlock values = [tolerance](std::span<const double> g, std::span<const double> t,
                                            std::span<double> result) { phi(g, t, result, tolerance); };
        add(list, ours_batch, setting_of(error),
            {"hts::phi", setting_of(error), values, true, true, error, phi_table_bytes(tolerance), {}});
    }
}

}  // namespace

double phi_ggx(double g, double t) noexcept {
    const double stretch = g + t;
    return g / (stretch * stretch);
}

const std::vector<ChartMethod>& chart_methods() {
    static const std::vector<ChartMethod> list = [] {
        std::vector<ChartMethod> methods;
        add_listed(methods, false);
        add(methods, cheap, "GGX lobe", {"GGX lobe", "", one_at_a_time(phi_ggx), false, false, 0, 0, {}});
        add_listed(methods, true);
        add_batches(methods);
        return methods;
    }();
    return list;
}

}  // namespace hts::bench

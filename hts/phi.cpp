#include "hts/phi.hpp"

#include <string>

#include "hts/error.hpp"
#include "hts/phi/phi_simd.hpp"
#include "hts/phi/tables/phi_table.hpp"

namespace hts {
namespace {

enum Form : std::size_t { low, medium, high };

Form cheapest_form(Tolerance tolerance) {
    if (tolerance.relative_error() >= phi_detail::Low::error) return low;
    return tolerance.relative_error() >= phi_detail::Medium::error ? medium : high;
}

/// Chosen at the first call.
const phi_detail::PhiForms& forms() {
    static const phi_detail::PhiForms chosen = phi_detail::phi_forms();
    return chosen;
}

}  // namespace

const char* name(PhiMethod method) noexcept {
    switch (method) {
        case PhiMethod::zero:
            return "zero";
        case PhiMethod::table:
            return "table";
        case PhiMethod::sum:
            return "sum";
        case PhiMethod::trapezoid:
            return "trapezoid";
        case PhiMethod::limit:
            return "limit";
        case PhiMethod::spline:
            return "spline";
    }
    return "";
}

Phi phi(double g, double t) noexcept {
    return forms().with_log(g, t);
}

double phi(double g, double t, Tolerance tolerance) noexcept {
    return forms().one[cheapest_form(tolerance)](g, t);
}

void phi(std::span<const double> g, std::span<const double> t, std::span<double> result,
         Tolerance tolerance) {
    if (g.size() != t.size() || result.size() != g.size()) {
        throw Error{"phi: g has " + std::to_string(g.size()) + " values, t " + std::to_string(t.size()) +
                    ", result " + std::to_string(result.size()) + ": must be equally many"};
    }
    forms().many[cheapest_form(tolerance)](g.data(), t.data(), result.data(), result.size());
}

PhiGradient phi_gradient(double g, double t, Tolerance tolerance) noexcept {
    const bool tabled = tolerance.relative_error() >= accuracy::tabled_phi_gradient;
    return tabled ? forms().gradient(g, t) : phi_gradient(g, t);
}

std::size_t phi_table_bytes(Tolerance tolerance) noexcept {
    switch (cheapest_form(tolerance)) {
        case low:
            return phi_detail::table_low.bytes;
        case medium:
            return phi_detail::table_medium.bytes;
        default:
            return phi_detail::table_high.bytes;
    }
}

}  // namespace hts

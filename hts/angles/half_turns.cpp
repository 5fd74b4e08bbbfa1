#include "hts/angles/half_turns.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include <boost/math/special_functions/cos_pi.hpp>
#include <boost/math/special_functions/sin_pi.hpp>

#include "hts/angles/degrees_simd.hpp"

namespace hts {
namespace {

using Extended = long double;

/// sin and cos of pi i / 256 up to pi / 4.
struct Octant {
    std::array<Extended, 65> sine, cosine;

    Octant() {
        for (std::size_t i = 0; i < sine.size(); ++i) {
            const Extended angle = std::numbers::pi_v<Extended> * static_cast<Extended>(i) / 256;
            sine[i] = std::sin(angle);
            cosine[i] = std::cos(angle);
        }
    }
};

const Octant& octant() {
    static const Octant octant;
    return octant;
}

/// The nearest place of an octant's table, and sin a and cos a - 1 of the angle a from there, |a| < 0.0062.
struct Step {
    Extended sine, cosine, sin_a, cos_a_1;

    ///   r   0 ... 1/4
    explicit Step(double r) {
        const auto i =
            static_cast<std::size_t>(256 * r + 0.5);  // NOLINT(bugprone-incorrect-roundings): r >= 0
        const Extended a = std::numbers::pi_v<Extended> * (r - static_cast<double>(i) / 256);  // exact
        const Extended s = a * a;
        sine = octant().sine[i];
        cosine = octant().cosine[i];
        sin_a = a - a * s * (1 / Extended{6} - s * (1 / Extended{120} - s / 5040));
        cos_a_1 = -s * (1 / Extended{2} - s * (1 / Extended{24} - s / 720));
    }
    [[nodiscard]] Extended sin() const { return sine + (cosine * sin_a + sine * cos_a_1); }
    [[nodiscard]] Extended cos() const { return cosine + (cosine * cos_a_1 - sine * sin_a); }
};

/// The double nearest to a value and to all within 2^-61 of it, relative; Boost's where there is none.
template <class Exact>
double rounded(Extended value, const Exact& exact) {
    if constexpr (std::numeric_limits<Extended>::digits < 64) return exact();
    const Extended error = value * 0x1p-61L;
    const auto low = static_cast<double>(value - error), high = static_cast<double>(value + error);
    return low == high ? low : exact();
}

double signed_sine(Extended size, double x) {
    const double sine = rounded(size, [x] { return std::fabs(boost::math::sin_pi(x)); });
    return std::copysign(sine, std::fabs(x) < 1 ? x : -x);
}

}  // namespace

const angles_detail::OctantTable& angles_detail::octant_table() {
    static const OctantTable made = [] {
        OctantTable table;
        double* to = table.values.data();
        for (std::size_t i = 0; i < octant().sine.size(); ++i) {
            for (const Extended value : {octant().sine[i], octant().cosine[i]}) {
                const auto nearest = static_cast<double>(value);
                *to++ = nearest;
                *to++ = static_cast<double>(value - static_cast<Extended>(nearest));
            }
        }
        return table;
    }();
    return made;
}

double sin_half_turns(double x) noexcept {
    const double size = std::fabs(x), r = size <= 0.5 ? size : 1 - size;
    const Extended sine = r <= 0.25 ? Step{r}.sin() : Step{0.5 - r}.cos();
    return signed_sine(sine, x);
}

SineCosine half_turns(double x) noexcept {
    const double size = std::fabs(x), r = size <= 0.5 ? size : 1 - size;
    const bool low = r <= 0.25;
    const Step step{low ? r : 0.5 - r};
    const Extended sin = step.sin(), cos = step.cos();
    const double cosine = rounded(low ? cos : sin, [x] { return std::fabs(boost::math::cos_pi(x)); });
    return {signed_sine(low ? sin : cos, x), size <= 0.5 ? cosine : -cosine};
}

}  // namespace hts

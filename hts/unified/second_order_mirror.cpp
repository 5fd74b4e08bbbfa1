#include "hts/unified/second_order_mirror.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/bessel.hpp>

namespace hts {
namespace {

using Complex = std::complex<double>;

/// Nodes equally spaced in asinh(tan theta): from the normal to 89.9 degrees.
constexpr std::size_t node_count = 128;
constexpr double farthest = 7.0437600274740995;

double square(double x) {
    return x * x;
}

/// exp(-z) I_nu(z), nu = 0 or 1. In double throughout: long double is emulated in WebAssembly.
double scaled_bessel(int nu, double z) {
    using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
    if (z < 40) return boost::math::cyl_bessel_i(nu, z, InDouble{}) * std::exp(-z);
    double sum = 1, term = 1;
    for (int j = 1; j <= 12; ++j) {
        term *= -(4.0 * nu * nu - square(2 * j - 1)) / (8 * z * j);
        sum += term;
    }
    return sum / std::sqrt(2 * std::numbers::pi * z);
}

/// Integrals over the azimuth of W(q - k) times 1, cos, sin^2 and cos^2, W = (k tau)^2/(4 pi)
/// exp(-(k tau)^2 |q - k|^2/4).
struct Azimuths {
    double one, cosine, sines, cosines;

    Azimuths(double k_tau, double k, double q) {
        const double z = square(k_tau) * k * q / 2;
        const double scale = square(k_tau) / 2 * std::exp(-square(k_tau * (q - k)) / 4);
        const double first = scaled_bessel(1, z);
        one = scale * scaled_bessel(0, z);
        cosine = scale * first;
        sines = z > 1e-8 ? cosine / z : scale / 2;
        cosines = one - sines;
    }
};

/// A plane wave of horizontal wave number q, in vacuum and below.
struct Wave {
    double q;
    Complex above, below;  // a0, a
    Complex n_s, n_p;

    Wave(double of, Complex vacuum, Complex square_of_index) : q{of}, above{vacuum} {
        below = std::sqrt(square_of_index - square(q));
        if (below.imag() < 0) below = -below;
        n_s = below - above;
        n_p = n_s / (square(q) + below * above);
    }
};

/// The integral of f(wave, azimuths) over all waves, in pieces that end where the spectrum does, at k, and at
/// the horizon: q = sin u up to there and cosh u beyond, which has no root left.
template <class Function>
Complex over_waves(double k, double k_tau, Complex square_of_index, Function&& f) {
    using Rule = boost::math::quadrature::gauss_kronrod<double, 21>;
    constexpr unsigned levels = 12;
    constexpr double enough = 1e-11;
    const double reach = 12.5 / k_tau;  // exp(-39)
    const auto value = [&](const Wave& wave, double dq) {
        return f(wave, Azimuths{k_tau, k, wave.q}) * (wave.q * dq);
    };
    const auto seen = [&](double u) {
        return value(Wave{std::sin(u), std::cos(u), square_of_index}, std::cos(u));
    };
    const auto evanescent = [&](double u) {
        return value(Wave{std::cosh(u), {0, std::sinh(u)}, square_of_index}, std::sinh(u));
    };
    const double u_k = std::asin(k), first = std::asin(std::max(0.0, k - reach));
    Complex sum = 0;
    const auto add = [&](const auto& integrand, double from, double to) {
        if (to > from) sum += Rule::integrate(integrand, from, to, levels, enough);
    };
    add(seen, first, u_k);
    add(seen, u_k, k + reach < 1 ? std::asin(k + reach) : std::numbers::pi / 2);
    if (k + reach > 1) add(evanescent, 0, std::acosh(k + reach));
    return sum;
}

/// A perfect conductor loses from the mirror what it scatters: R2/F is minus half of the scattered
/// power over (k sigma_0)^2.
FresnelAmplitudes of_conductor(double c, double k_tau, const FresnelAmplitudes& flat) {
    const double k = std::sqrt((1 - c) * (1 + c));
    const auto power = [&](auto&& share) {
        return 4 * c * over_waves(k, k_tau, {1, 0}, [&](const Wave& wave, const Azimuths& w) {
                           const double out = wave.above.real();
                           return Complex{out > 0 ? out * share(wave.q, out, w) : 0};
                       }).real();
    };
    const double s =
        power([](double, double out, const Azimuths& w) { return w.cosines + w.sines / square(out); });
    const double p = power([&](double q, double out, const Azimuths& w) {
        return (w.sines + (w.cosines - 2 * k * q * w.cosine + square(k * q) * w.one) / square(out)) /
               square(c);
    });
    return {-s / 2 * flat.s, -p / 2 * flat.p};
}

/// 0 below 0, 1 above 1.
double smooth_step(double x) {
    const double inside = std::clamp(x, 0.0, 1.0);
    return inside * inside * (3 - 2 * inside);
}

Complex amplitude(const Complex& flat, const Complex& change, double g, double linear) {
    Complex result = linear < 1 ? (1 - linear) * flat * std::exp(change / flat) : 0;
    if (linear > 0) result += linear * std::exp(-g / 2) * (flat + change + flat * (g / 2));
    const double size = std::abs(result);
    return size > 1 ? result / size : result;
}

}  // namespace

FresnelAmplitudes second_order(double cos_theta, double k_tau, const RefractiveIndex& index) {
    constexpr double metal = 1e12;  // |N^2| beyond which the differences below keep too little
    const double c = cos_theta, k = std::sqrt((1 - c) * (1 + c));
    const Complex n{index.n(), index.k()}, square_of_index = n * n;
    const FresnelAmplitudes flat = fresnel(c, index);
    if (c == 0 || (flat.s == 0.0 && flat.p == 0.0)) return {0.0, 0.0};
    if (std::abs(square_of_index) > metal) return of_conductor(c, k_tau, flat);
    const Wave in{k, c, square_of_index};
    const Complex both = in.below * in.above;
    const auto integral = [&](auto&& f) { return over_waves(k, k_tau, square_of_index, f); };

    const Complex s_plus = 1.0 + flat.s, p_plus = 1.0 + flat.p, p_minus = 1.0 - flat.p;
    const Complex s =
        ((in.below + in.above) + in.n_s * flat.s) / 2.0 - integral([&](const Wave& wave, const Azimuths& w) {
            return s_plus * (wave.n_s * w.cosines + wave.above * wave.below * wave.n_p * w.sines);
        });
    const Complex p =
        ((in.below + in.above) * (k * k - both) + in.n_s * (k * k + both) * flat.p) / 2.0 -
        integral([&](const Wave& wave, const Azimuths& w) {
            const Complex straight = k * wave.q * p_plus, turned = -wave.below * c * p_minus;
            const Complex out = in.below * wave.above;
            return wave.n_p * (k * wave.q * straight * w.one +
                               (k * wave.q * turned + out * straight) * w.cosine + out * turned * w.cosines) -
                   both * wave.n_s * p_minus * w.sines;
        });
    return {in.n_s * s, in.n_p * p};
}

SecondOrderMirror::SecondOrderMirror(double k_sigma, double k_tau, const RefractiveIndex& index)
    : k_sigma_{k_sigma}, index_{index} {
    for (std::size_t i = 0; i < node_count; ++i) {
        const double c = 1 / std::cosh(farthest * static_cast<double>(i) / (node_count - 1));
        const FresnelAmplitudes r2 = second_order(c, k_tau, index);
        table_.push_back({r2.s / (2 * c), r2.p / (2 * c)});
    }
}

std::size_t SecondOrderMirror::bytes() const noexcept {
    return sizeof *this + table_.size() * sizeof(FresnelAmplitudes);
}

FresnelAmplitudes SecondOrderMirror::operator()(const Direction& in) const noexcept {
    const double c = in.cos_theta();
    const FresnelAmplitudes flat = fresnel(c, index_);
    if (c == 0 || flat.s == 0.0) return flat;
    const double steps = std::min(std::log((1 + in.sin_theta()) / c), farthest) / farthest * (node_count - 1);
    const auto second = static_cast<std::size_t>(std::min(steps, node_count - 3.0));
    const std::size_t first = second == 0 ? 1 : second - 1;  // even about the normal
    const double b = steps - static_cast<double>(second), a = b + 1, d = b - 1, e = b - 2;
    const auto value = [&](Complex FresnelAmplitudes::*of) {
        return 2 * c *
               (-b * d * e / 6 * (table_[first].*of) + a * d * e / 2 * (table_[second].*of) -
                a * b * e / 2 * (table_[second + 1].*of) + a * b * d / 6 * (table_[second + 2].*of));
    };
    const double roughness = square(k_sigma_), g = 4 * roughness * c * c;
    const double small = std::norm(flat.p) / std::norm(flat.s);
    return {amplitude(flat.s, roughness * value(&FresnelAmplitudes::s), g, 0),
            amplitude(flat.p, roughness * value(&FresnelAmplitudes::p), g,
                      1 - smooth_step((small - 0.02) / 0.08))};
}

}  // namespace hts

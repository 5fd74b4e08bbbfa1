// The rotations of a Mueller matrix into and out of the facet's plane; included once per instruction set.
#if defined(HTS_EVALUATION_TURNS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HTS_EVALUATION_TURNS_INL
#undef HTS_EVALUATION_TURNS_INL
#else
#define HTS_EVALUATION_TURNS_INL
#endif

#include <array>

#include "hts/he_torrance_spectrum.hpp"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace hts::evaluation_detail::HWY_NAMESPACE {

/// Cosine and sine of twice the angle by which a ray's frame is turned into that of the facet.
struct Turn {
    double cosine, sine;
};

/// Turns of both rays, as facet_jones has them, written out with delta = phi_out - phi_in.
struct Turns {
    Turn in, out;
};

HWY_INLINE Turns turns(const DirectionPair& pair) {
    const auto& [in, out] = pair;
    const double cos_delta = in.cos_phi() * out.cos_phi() + in.sin_phi() * out.sin_phi();
    const double sin_delta = in.cos_phi() * out.sin_phi() - in.sin_phi() * out.cos_phi();
    const double cos_in = in.sin_theta() * out.cos_theta() - in.cos_theta() * out.sin_theta() * cos_delta;
    const double sin_in = -out.sin_theta() * sin_delta;
    const double cos_out = out.sin_theta() * in.cos_theta() - out.cos_theta() * in.sin_theta() * cos_delta;
    const double sin_out = -in.sin_theta() * sin_delta;
    const double squared = cos_in * cos_in + sin_in * sin_in;
    const auto doubled = [](double c, double s, double over) {
        return Turn{(c - s) * (c + s) * over, 2 * c * s * over};
    };
    // at backscatter s of the incident ray serves as s of the facet
    if (HWY_UNLIKELY(squared < 1e-16)) return {{1, 0}, doubled(-cos_delta, -out.cos_theta() * sin_delta, 1)};
    return {doubled(cos_in, sin_in, 1 / squared), doubled(cos_out, sin_out, 1 / squared)};
}

/// The matrix is p, q, real or imaginary part times one factor, and in the middle four a second real part.
struct TurnedMueller {
    std::array<double, 16> first;
    std::array<double, 4> middle;  // elements 11, 12, 21, 22

    explicit HWY_INLINE TurnedMueller(const Turns& turns) {
        const auto& [i, o] = turns;
        first = {1,
                 i.cosine,
                 i.sine,
                 0,
                 o.cosine,
                 o.cosine * i.cosine,
                 o.cosine * i.sine,
                 -o.sine,
                 o.sine,
                 o.sine * i.cosine,
                 o.sine * i.sine,
                 o.cosine,
                 0,
                 i.sine,
                 -i.cosine,
                 1};
        middle = {o.sine * i.sine, -o.sine * i.cosine, -o.cosine * i.sine, o.cosine * i.cosine};
    }

    /// Into the 16 elements of a matrix.
    HWY_INLINE void store(double p, double q, double real, double imaginary, double uniform,
                          double* m) const {
        const auto& a = first;
        m[0] = p + uniform;
        m[1] = a[1] * q;
        m[2] = a[2] * q;
        m[3] = 0;
        m[4] = a[4] * q;
        m[5] = a[5] * p + middle[0] * real;
        m[6] = a[6] * p + middle[1] * real;
        m[7] = a[7] * imaginary;
        m[8] = a[8] * q;
        m[9] = a[9] * p + middle[2] * real;
        m[10] = a[10] * p + middle[3] * real;
        m[11] = a[11] * imaginary;
        m[12] = 0;
        m[13] = a[13] * imaginary;
        m[14] = a[14] * imaginary;
        m[15] = real;
    }
};

}  // namespace hts::evaluation_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

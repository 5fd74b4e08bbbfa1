// Compiled for every instruction set and chosen at run time.
#include "validation/scattering/vector/vector_lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "validation/scattering/vector/vector_lanes.cpp"
#include "hwy/foreach_target.h"  // includes this file again for each instruction set

#include "hts/lanes/lanes_plain.hpp"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace hts::validation::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, block>;
using V = hn::Vec<Tag>;

constexpr std::size_t tile = 32;  // sources whose kernels stay in the first cache
constexpr float two_pi = 6.283185307F;

HWY_INLINE V set(float value) {
    return hn::Set(Tag{}, value);
}

struct Turn {
    V sine, cosine;
};

/// Of 2 pi turns, to 1e-7: from those of half the angle.
HWY_INLINE Turn turn(V turns) {
    const V x = hn::Sub(turns, hn::Round(turns)), y = hn::Mul(x, x);
    V s = set(0.077655912276F), c = set(0.219682423575F);
    for (const float a : {-0.598290411283F, 2.55007738653F, -5.16771007667F, 3.14159264008F})
        s = hn::MulAdd(s, y, set(a));
    for (const float a : {-1.33187297279F, 4.05841079076F, -4.93479280249F, 0.999999953028F})
        c = hn::MulAdd(c, y, set(a));
    s = hn::Mul(s, x);
    const V twice = hn::Add(s, s);
    return {hn::Mul(twice, c), hn::NegMulAdd(twice, s, set(1))};
}

/// The eight real numbers of a pair's matrix: xx, xy, yx, yy, each real and imaginary.
struct Matrix {
    V of[8];
};

struct Target {
    V x, y, z, slope_x, slope_y;
};

HWY_INLINE Matrix matrix(const Target& at, const NodeArrays& nodes, std::size_t source, V scale) {
    const V dx = hn::Sub(at.x, set(nodes.x[source])), dy = hn::Sub(at.y, set(nodes.y[source])),
            dz = hn::Sub(at.z, set(nodes.z[source]));
    // of the node itself all is 0 but the kernel, which must be finite
    const V square = hn::Max(hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz))), set(1e-10F));
    V inverse = hn::ApproximateReciprocalSqrt(square);
    inverse =
        hn::Mul(inverse, hn::NegMulAdd(hn::Mul(hn::Mul(square, set(0.5F)), inverse), inverse, set(1.5F)));
    const V distance = hn::Mul(square, inverse), phase = hn::Mul(distance, set(two_pi));
    const Turn e = turn(distance);
    const V strength = hn::Mul(hn::Mul(hn::Mul(inverse, inverse), inverse), scale);
    const V re = hn::Mul(hn::NegMulAdd(phase, e.sine, hn::Neg(e.cosine)), strength),
            im = hn::Mul(hn::MulSub(phase, e.cosine, e.sine), strength);
    // N . R, and the source's slopes less the target's
    const V across = hn::NegMulAdd(at.slope_y, dy, hn::NegMulAdd(at.slope_x, dx, dz));
    const V ax = hn::Sub(set(nodes.slope_x[source]), at.slope_x),
            ay = hn::Sub(set(nodes.slope_y[source]), at.slope_y);
    const V xx = hn::MulSub(dx, ax, across), xy = hn::Mul(dx, ay), yx = hn::Mul(dy, ax),
            yy = hn::MulSub(dy, ay, across);
    return {{hn::Mul(xx, re), hn::Mul(xx, im), hn::Mul(xy, re), hn::Mul(xy, im), hn::Mul(yx, re),
             hn::Mul(yx, im), hn::Mul(yy, re), hn::Mul(yy, im)}};
}

/// Adds the currents of a group, times the matrices of a tile of sources.
///   currents   of the group at the first of them      stride   to the next source's
HWY_INLINE void add_group(const float* matrices, std::size_t sources, const float* currents,
                          std::size_t stride, float* sums) {
    const Tag d;
    const std::size_t lanes = hn::Lanes(d);
    V xr[group], xi[group], yr[group], yi[group];
    HTS_UNROLL
    for (std::size_t g = 0; g < group; ++g) {
        xr[g] = hn::LoadU(d, sums + (4 * g) * block);
        xi[g] = hn::LoadU(d, sums + (4 * g + 1) * block);
        yr[g] = hn::LoadU(d, sums + (4 * g + 2) * block);
        yi[g] = hn::LoadU(d, sums + (4 * g + 3) * block);
    }
    for (std::size_t i = 0; i < sources; ++i, currents += stride, matrices += 8 * lanes) {
        const V xxr = hn::Load(d, matrices), xxi = hn::Load(d, matrices + lanes),
                xyr = hn::Load(d, matrices + 2 * lanes), xyi = hn::Load(d, matrices + 3 * lanes),
                yxr = hn::Load(d, matrices + 4 * lanes), yxi = hn::Load(d, matrices + 5 * lanes),
                yyr = hn::Load(d, matrices + 6 * lanes), yyi = hn::Load(d, matrices + 7 * lanes);
        HTS_UNROLL
        for (std::size_t g = 0; g < group; ++g) {
            const V ar = set(currents[4 * g]), ai = set(currents[4 * g + 1]), br = set(currents[4 * g + 2]),
                    bi = set(currents[4 * g + 3]);
            xr[g] = hn::NegMulAdd(xxi, ai, hn::MulAdd(xxr, ar, xr[g]));
            xi[g] = hn::MulAdd(xxi, ar, hn::MulAdd(xxr, ai, xi[g]));
            yr[g] = hn::NegMulAdd(yxi, ai, hn::MulAdd(yxr, ar, yr[g]));
            yi[g] = hn::MulAdd(yxi, ar, hn::MulAdd(yxr, ai, yi[g]));
            xr[g] = hn::NegMulAdd(xyi, bi, hn::MulAdd(xyr, br, xr[g]));
            xi[g] = hn::MulAdd(xyi, br, hn::MulAdd(xyr, bi, xi[g]));
            yr[g] = hn::NegMulAdd(yyi, bi, hn::MulAdd(yyr, br, yr[g]));
            yi[g] = hn::MulAdd(yyi, br, hn::MulAdd(yyr, bi, yi[g]));
        }
    }
    HTS_UNROLL
    for (std::size_t g = 0; g < group; ++g) {
        hn::StoreU(xr[g], d, sums + (4 * g) * block);
        hn::StoreU(xi[g], d, sums + (4 * g + 1) * block);
        hn::StoreU(yr[g], d, sums + (4 * g + 2) * block);
        hn::StoreU(yi[g], d, sums + (4 * g + 3) * block);
    }
}

HWY_ATTR void add_field_to(const NodeArrays& nodes, float area, const float* currents, std::size_t groups,
                           std::size_t first, float* sums) {
    const Tag d;
    const std::size_t lanes = hn::Lanes(d), stride = 4 * group * groups;
    const V scale = set(area / two_pi);
    alignas(64) float matrices[tile * 8 * block];
    for (std::size_t lane = 0; lane < block; lane += lanes) {
        const std::size_t at = first + lane;
        const Target target{hn::LoadU(d, nodes.x.data() + at), hn::LoadU(d, nodes.y.data() + at),
                            hn::LoadU(d, nodes.z.data() + at), hn::LoadU(d, nodes.slope_x.data() + at),
                            hn::LoadU(d, nodes.slope_y.data() + at)};
        for (std::size_t start = 0; start < nodes.count; start += tile) {
            const std::size_t sources = nodes.count - start < tile ? nodes.count - start : tile;
            for (std::size_t i = 0; i < sources; ++i) {
                const Matrix m = matrix(target, nodes, start + i, scale);
                HTS_UNROLL
                for (std::size_t e = 0; e < 8; ++e) hn::Store(m.of[e], d, matrices + (8 * i + e) * lanes);
            }
            for (std::size_t g = 0; g < groups; ++g)
                add_group(matrices, sources, currents + start * stride + g * 4 * group, stride,
                          sums + g * 4 * group * block + lane);
        }
    }
}

/// Adds the currents of a group, times the phases of a tile of sources.
HWY_INLINE void radiate_group(const float* phases, std::size_t sources, const float* currents,
                              std::size_t stride, float* sums) {
    const Tag d;
    const std::size_t lanes = hn::Lanes(d);
    V re[3 * group], im[3 * group];
    HTS_UNROLL
    for (std::size_t c = 0; c < 3 * group; ++c) {
        re[c] = hn::LoadU(d, sums + 2 * c * block);
        im[c] = hn::LoadU(d, sums + (2 * c + 1) * block);
    }
    for (std::size_t i = 0; i < sources; ++i, currents += stride, phases += 2 * lanes) {
        const V er = hn::Load(d, phases), ei = hn::Load(d, phases + lanes);
        HTS_UNROLL
        for (std::size_t c = 0; c < 3 * group; ++c) {
            const V jr = set(currents[2 * c]), ji = set(currents[2 * c + 1]);
            re[c] = hn::NegMulAdd(ei, ji, hn::MulAdd(er, jr, re[c]));
            im[c] = hn::MulAdd(ei, jr, hn::MulAdd(er, ji, im[c]));
        }
    }
    HTS_UNROLL
    for (std::size_t c = 0; c < 3 * group; ++c) {
        hn::StoreU(re[c], d, sums + 2 * c * block);
        hn::StoreU(im[c], d, sums + (2 * c + 1) * block);
    }
}

HWY_ATTR void add_radiation_to(const NodeArrays& nodes, const DirectionArrays& s, const float* currents,
                               std::size_t groups, std::size_t first, float* sums) {
    const Tag d;
    const std::size_t lanes = hn::Lanes(d), stride = 6 * group * groups;
    alignas(64) float phases[tile * 2 * block];
    for (std::size_t lane = 0; lane < block; lane += lanes) {
        const std::size_t at = first + lane;
        const V sx = hn::LoadU(d, s.x.data() + at), sy = hn::LoadU(d, s.y.data() + at),
                sz = hn::LoadU(d, s.z.data() + at);
        for (std::size_t start = 0; start < nodes.count; start += tile) {
            const std::size_t sources = nodes.count - start < tile ? nodes.count - start : tile;
            for (std::size_t i = 0; i < sources; ++i) {
                const V turns =
                    hn::MulAdd(sx, set(nodes.x[start + i]),
                               hn::MulAdd(sy, set(nodes.y[start + i]), hn::Mul(sz, set(nodes.z[start + i]))));
                const Turn e = turn(hn::Neg(turns));
                hn::Store(e.cosine, d, phases + 2 * i * lanes);
                hn::Store(e.sine, d, phases + (2 * i + 1) * lanes);
            }
            for (std::size_t g = 0; g < groups; ++g)
                radiate_group(phases, sources, currents + start * stride + g * 6 * group, stride,
                              sums + g * 6 * group * block + lane);
        }
    }
}

}  // namespace hts::validation::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hts::validation {

HWY_EXPORT(add_field_to);
HWY_EXPORT(add_radiation_to);

void add_field(const NodeArrays& nodes, float area, const float* currents, std::size_t groups,
               std::size_t first, float* sums) {
    HWY_DYNAMIC_DISPATCH(add_field_to)(nodes, area, currents, groups, first, sums);
}

void add_radiation(const NodeArrays& nodes, const DirectionArrays& s, const float* currents,
                   std::size_t groups, std::size_t first, float* sums) {
    HWY_DYNAMIC_DISPATCH(add_radiation_to)(nodes, s, currents, groups, first, sums);
}

}  // namespace hts::validation
#endif

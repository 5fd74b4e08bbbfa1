#include "bench/rivals/ggx_lanes.hpp"

#include <algorithm>
#include <numbers>

#include "hts/error.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/rivals/ggx_lanes.cpp"
#include "hwy/foreach_target.h"  // includes this file again for each instruction set

#include "hts/evaluation/kernel-inl.hpp"
#include "hts/evaluation/pairs-inl.hpp"
#include "hwy/highway.h"

#ifndef HTS_BENCH_GGX_LANES
#define HTS_BENCH_GGX_LANES
namespace hts::bench {
/// What the lanes need of a conductor.
struct ConductorColumns {
    double alpha_squared;
    std::size_t count;
    const double *d_real, *d_imaginary_squared, *d_squared;
};
}  // namespace hts::bench
#endif

HWY_BEFORE_NAMESPACE();
namespace hts::bench::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace he = evaluation_detail::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

template <class V>
struct GgxTerms {
    V lobe, cos_squared;
};

/// D V of a pair with one division: cos^2 theta_h = v_z^2/|v|^2, sin^2 theta_h = |v_xy|^2/|v|^2.
template <class Lanes, class V>
HWY_INLINE GgxTerms<V> ggx_terms(const Lanes& o, double alpha_squared, const he::PairAngles<V>& a) {
    const V alpha2 = o.real(alpha_squared);
    const V vertical = a.cos_in + a.cos_out;
    const V vertical_squared = vertical * vertical;
    const V horizontal = he::horizontal_squared(o, a);
    const V squared = horizontal + vertical_squared;
    const V bracket = o.mul_add(alpha2, vertical_squared, horizontal);
    const auto reach = [&](V c)
                           HWY_ATTR { return o.sqrt(o.mul_add(o.real(1 - alpha_squared), c * c, alpha2)); };
    const V reaches = o.mul_add(a.cos_out, reach(a.cos_in), a.cos_in * reach(a.cos_out));
    return {
        o.real(alpha_squared / 2 * std::numbers::inv_pi) * squared * squared / (bracket * bracket * reaches),
        o.min(squared * o.real(0.25), o.real(1))};
}

template <std::size_t most_lanes>
HWY_INLINE void one(const ConductorColumns& p, const DirectionPair& pair, double* result) {
    using Tag = hn::CappedTag<double, most_lanes>;
    using Lanes = lanes::HWY_NAMESPACE::WideLanes<Tag>;
    using V = hn::Vec<Tag>;
    constexpr Tag d{};
    constexpr Lanes o{};
    const auto& [in, out] = pair;
    const auto terms =
        ggx_terms(o, p.alpha_squared,
                  he::PairAngles<V>{o.real(in.cos_theta()), o.real(in.sin_theta()), o.real(in.cos_phi()),
                                    o.real(in.sin_phi()), o.real(out.cos_theta()), o.real(out.sin_theta()),
                                    o.real(out.cos_phi()), o.real(out.sin_phi())});
    constexpr std::size_t lanes = hn::MaxLanes(d);
    for (std::size_t i = 0; i < p.count; i += lanes) {
        const auto fresnel = he::fresnel_terms(
            o, terms.cos_squared,
            he::IndexTerms<V>{hn::LoadU(d, p.d_real + i), hn::LoadU(d, p.d_imaginary_squared + i)});
        const V value = he::unpolarised(terms.lobe * hn::LoadU(d, p.d_squared + i), fresnel);
        if (HWY_LIKELY(i + lanes <= p.count)) {
            hn::StoreU(value, d, result + i);
        } else {
            HWY_ALIGN double rest[lanes];
            hn::Store(value, d, rest);
            std::copy_n(rest, p.count - i, result + i);
        }
    }
}

HWY_ATTR void brdf_one(const ConductorColumns& p, const DirectionPair& pair, double* result) {
    if (p.count <= 4)
        one<4>(p, pair, result);
    else
        one<8>(p, pair, result);
}

HWY_INLINE void block_of_pairs(const ConductorColumns& p, std::span<const DirectionPair> pairs,
                               std::span<const DirectionPair> next, double* result) {
    using Block = he::PairBlock;
    using V = Block::V;
    constexpr auto d = Block::d;
    constexpr Block::Lanes o{};
    Block block;
    block.load(pairs, next);
    const auto at = [](const double* a, std::size_t i) HWY_ATTR { return hn::Load(Block::d, a + i); };
    for (std::size_t i = 0; i < pairs.size(); i += Block::lanes) {
        const auto terms =
            ggx_terms(o, p.alpha_squared,
                      he::PairAngles<V>{at(block.cos_in, i), at(block.sin_in, i), at(block.cos_phi_in, i),
                                        at(block.sin_phi_in, i), at(block.cos_out, i), at(block.sin_out, i),
                                        at(block.cos_phi_out, i), at(block.sin_phi_out, i)});
        hn::Store(terms.lobe, d, block.lobe + i);
        hn::Store(terms.cos_squared, d, block.cos_squared + i);
    }
    for (std::size_t j = 0; j < p.count; ++j) {
        const he::IndexTerms<V> index{o.real(p.d_real[j]), o.real(p.d_imaginary_squared[j])};
        HWY_ALIGN double values[Block::size];
        for (std::size_t i = 0; i < pairs.size(); i += Block::lanes) {
            const auto fresnel = he::fresnel_terms(o, at(block.cos_squared, i), index);
            hn::Store(he::unpolarised(at(block.lobe, i) * o.real(p.d_squared[j]), fresnel), d, values + i);
        }
        for (std::size_t i = 0; i < pairs.size(); ++i) result[i * p.count + j] = values[i];
    }
}

HWY_ATTR void brdf_many(const ConductorColumns& p, std::span<const DirectionPair> pairs, double* result) {
    constexpr std::size_t size = he::PairBlock::size;
    for (std::size_t first = 0; first < pairs.size(); first += size) {
        const auto block = [pairs, size](std::size_t at) {
            const std::size_t begin = std::min(at, pairs.size());
            return pairs.subspan(begin, std::min(size, pairs.size() - begin));
        };
        block_of_pairs(p, block(first), block(first + size), result + first * p.count);
    }
}

#else  // the yardstick is not needed on a processor without vectors

void brdf_one(const ConductorColumns&, const DirectionPair&, double*) {}
void brdf_many(const ConductorColumns&, std::span<const DirectionPair>, double*) {}

#endif

}  // namespace hts::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hts::bench {

HWY_EXPORT(brdf_one);
HWY_EXPORT(brdf_many);

LaneConductor::LaneConductor(double alpha, std::span<const double> n, std::span<const double> k)
    : alpha_squared_{alpha * alpha}, count_{n.size()} {
    if (!(alpha > 0 && alpha < 1e150)) throw out_of_range("GGX width alpha", alpha, "", "> 0 and finite");
    if (n.empty() || n.size() != k.size()) {
        throw Error{"optical constants: n and k must have the same number of wavelengths, at least one"};
    }
    for (std::size_t i = 0; i < (count_ + 7) / 8 * 8; ++i) {
        const std::size_t j = std::min(i, count_ - 1);
        const double real = (n[j] - 1) * (n[j] + 1) - k[j] * k[j];
        const double imaginary = 2 * n[j] * k[j];
        d_real_.push_back(real);
        d_imaginary_squared_.push_back(imaginary * imaginary);
        d_squared_.push_back(real * real + imaginary * imaginary);
    }
}

void LaneConductor::brdf(const DirectionPair& pair, std::span<double> result) const noexcept {
    const ConductorColumns columns{alpha_squared_, count_, d_real_.data(), d_imaginary_squared_.data(),
                                   d_squared_.data()};
    HWY_DYNAMIC_DISPATCH(brdf_one)(columns, pair, result.data());
}

void LaneConductor::brdf(std::span<const DirectionPair> pairs, std::span<double> result) const noexcept {
    const ConductorColumns columns{alpha_squared_, count_, d_real_.data(), d_imaginary_squared_.data(),
                                   d_squared_.data()};
    HWY_DYNAMIC_DISPATCH(brdf_many)(columns, pairs, result.data());
}

}  // namespace hts::bench
#endif

// A surface and its optical constants as the lanes of either precision read them.
#pragma once

#include <algorithm>
#include <numbers>
#include <span>

#include "hts/evaluation/evaluation_simd.hpp"

namespace hts::evaluation_detail {

/// d = N^2 - 1 of a sample. N = i, which reflects everything at every angle, stands for what has films.
struct IndexColumns {
    double d_real, d_imaginary_squared;
    [[nodiscard]] double modulus_squared() const noexcept { return d_real * d_real + d_imaginary_squared; }
};
[[nodiscard]] inline IndexColumns index_columns(const SpectralSample& sample) noexcept {
    if (sample.index.coated()) return {-2, 0};
    const double n = sample.index.substrate().n(), k = sample.index.substrate().k();
    const double d_imaginary = 2 * n * k;
    return {(n - 1) * (n + 1) - k * k, d_imaginary * d_imaginary};
}

template <class Number>
[[nodiscard]] PreparedAs<Number> prepared_as(const Surface& surface,
                                             std::span<const SpectralSample> samples) {
    using Columns = PreparedAs<Number>;
    constexpr std::size_t padding = 8;  // the longest vector whose lanes are wavelengths
    const double sigma = surface.rms_roughness(), tau = surface.correlation_length();
    const std::size_t padded = (samples.size() + padding - 1) / padding * padding;
    const auto number = [](double x) { return static_cast<Number>(x); };
    Columns p{{number(surface.slope_width()), number(sigma * sigma), number(1 / (sigma * sigma)),
               number(tau * tau / 4), number(tau * tau * std::numbers::inv_pi), axis_terms(surface)},
              samples.size(),
              padded,
              std::vector<Number>(Columns::columns * padded)};
    for (std::size_t i = 0; i < padded; ++i) {
        const SpectralSample& s = samples[std::min(i, samples.size() - 1)];
        const IndexColumns index = index_columns(s);
        const double wave_number = s.wavelength.wave_number(), wave_squared = wave_number * wave_number;
        const auto set = [&p, number, padded, i](typename Columns::Column column, double value) {
            p.data[column * padded + i] = number(value);
        };
        set(Columns::wave_squared, wave_squared);
        set(Columns::inverse_wave_squared, 1 / wave_squared);
        set(Columns::d_real, index.d_real);
        set(Columns::d_imaginary_squared, index.d_imaginary_squared);
        set(Columns::weight, sizeof(Number) == sizeof(float) ? index.modulus_squared()
                                                             : wave_squared * index.modulus_squared());
        set(Columns::uniform, s.index.coated() ? 0 : s.uniform_diffuse);
    }
    return p;
}

}  // namespace hts::evaluation_detail

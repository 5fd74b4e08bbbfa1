#include "validation/scattering/gaussian_surface.hpp"

#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>

#include "hts/error.hpp"
#include "hts/sampling/random.hpp"
#include "validation/topography/plane_transform.hpp"

namespace hts::validation {
namespace {

using Complex = std::complex<double>;
using Field = ComplexField;

/// Pairs of independent normal numbers, by Box and Muller's transform.
Field white_noise(std::size_t count, std::uint64_t seed) {
    Random random{seed};
    Field noise(count);
    for (Complex& pair : noise) {
        const double radius = std::sqrt(-2 * std::log1p(-random.uniform()));
        pair = std::polar(radius, 2 * std::numbers::pi * random.uniform());
    }
    return noise;
}

/// Noise with a real transform of its own in each part: only the real one is wanted.
Field real_noise(std::size_t count, std::uint64_t seed) {
    Field noise = white_noise((count + 1) / 2, seed);
    Field result(count);
    for (std::size_t i = 0; i < count; ++i)
        result[i] = i % 2 == 0 ? noise[i / 2].real() : noise[i / 2].imag();
    return result;
}

/// Wave numbers of a discrete transform.
std::vector<double> wave_numbers(std::size_t samples, double step) {
    std::vector<double> result(samples);
    const double lowest = 2 * std::numbers::pi / (static_cast<double>(samples) * step);
    for (std::size_t i = 0; i < samples; ++i) {
        result[i] = lowest * signed_frequency(i, samples);
    }
    return result;
}

/// Square root of the transform of a Gaussian C over samples a step apart: sqrt(tau sqrt(pi)/step)
/// exp(-(kappa tau)^2/8).
double amplitude_filter(double wave_number, double step, double correlation_length) {
    const double scaled = wave_number * correlation_length;
    return std::sqrt(correlation_length / (std::numbers::inv_sqrtpi * step)) * std::exp(-scaled * scaled / 8);
}

/// The same of a profile at all its wave numbers; a K-correlated one has the variance 1 at the samples.
std::vector<double> amplitude_filters(const RoughnessStatistics& statistics, double step,
                                      const std::vector<double>& waves) {
    std::vector<double> filters;
    if (!statistics.nu) {
        for (const double wave : waves)
            filters.push_back(amplitude_filter(wave, step, statistics.correlation_length));
        return filters;
    }
    constexpr double most = 2 * std::numbers::pi * most_frequency;
    double sum = 0;
    for (const double wave : waves) {
        const double scaled = wave * statistics.correlation_length;
        filters.push_back(
            std::fabs(wave) > most ? 0 : std::pow(1 + scaled * scaled, -(*statistics.nu + 0.5) / 2));
        sum += filters.back() * filters.back();
    }
    const double scale = std::sqrt(static_cast<double>(waves.size()) / sum);
    for (double& filter : filters) filter *= scale;
    return filters;
}

std::vector<double> part(const Field& field, double (*of)(const Complex&)) {
    std::vector<double> result;
    result.reserve(field.size());
    for (const Complex& value : field) result.push_back(of(value));
    return result;
}

double real_part(const Complex& value) {
    return value.real();
}
double imaginary_part(const Complex& value) {
    return value.imag();
}

}  // namespace

std::uint64_t seed_of(std::uint64_t study, std::uint64_t part, std::uint64_t realisation) noexcept {
    std::uint64_t state = (study * 0x9e3779b97f4a7c15U + part) * 0xd1342543de82ef95U + realisation;
    state = (state ^ (state >> 30U)) * 0xbf58476d1ce4e5b9U;
    state = (state ^ (state >> 27U)) * 0x94d049bb133111ebU;
    return state ^ (state >> 31U);
}

RandomProfile random_profile(const RoughnessStatistics& statistics, double step, std::size_t samples,
                             std::uint64_t seed) {
    const std::vector<double> waves = wave_numbers(samples, step);
    const std::vector<double> filters = amplitude_filters(statistics, step, waves);
    Eigen::FFT<double> transform;
    Field spectrum, first(samples), second(samples), result;
    transform.fwd(spectrum, real_noise(samples, seed));
    for (std::size_t i = 0; i < samples; ++i) {
        const Complex height = spectrum[i] * (statistics.rms_roughness * filters[i]);
        first[i] = height * (1 - waves[i]);  // z + i z', since i (i kappa) = -kappa
        second[i] = -height * (waves[i] * waves[i]);
    }
    transform.inv(result, first);
    RandomProfile profile{step, part(result, real_part), part(result, imaginary_part), {}};
    transform.inv(result, second);
    profile.second_derivative = part(result, real_part);
    return profile;
}

std::vector<double> profile_correlation(const RoughnessStatistics& statistics, double step,
                                        std::size_t samples) {
    Field spectrum(samples), covariance;
    const std::vector<double> filters = amplitude_filters(statistics, step, wave_numbers(samples, step));
    for (std::size_t i = 0; i < samples; ++i) spectrum[i] = filters[i] * filters[i];
    Eigen::FFT<double> transform;
    transform.inv(covariance, spectrum);
    covariance.resize(samples / 2 + 1);
    return part(covariance, real_part);
}

RandomField random_field(const RoughnessStatistics& statistics, double step, std::size_t samples,
                         std::uint64_t seed) {
    if (statistics.nu) throw Error{"a random field: must be of a Gaussian correlation"};
    return random_field(statistics.rms_roughness,
                        {statistics.correlation_length, statistics.correlation_length}, step, samples, seed);
}

RandomField random_field(double rms_roughness, const CorrelationLengths& lengths, double step,
                         std::size_t samples, std::uint64_t seed) {
    const std::vector<double> waves = wave_numbers(samples, step);
    Field first = real_noise(samples * samples, seed);
    transform_forward(first, samples, samples);
    Field second(first.size());
    for (std::size_t j = 0; j < samples; ++j) {
        const double across = amplitude_filter(waves[j], step, lengths.across);
        for (std::size_t i = 0; i < samples; ++i) {
            const double along = amplitude_filter(waves[i], step, lengths.along);
            const Complex height = first[j * samples + i] * (rms_roughness * along * across);
            first[j * samples + i] = height * (1 - waves[i]);
            second[j * samples + i] = height * Complex{0, waves[j]};
        }
    }
    transform_inverse(first, samples, samples);
    transform_inverse(second, samples, samples);
    return {step, samples, part(first, real_part), part(first, imaginary_part), part(second, real_part)};
}

FieldCurvature curvature_of(const RandomField& field) {
    const std::size_t samples = field.samples;
    const std::vector<double> waves = wave_numbers(samples, field.step);
    Field first(field.height.begin(), field.height.end());
    transform_forward(first, samples, samples);
    Field second(first.size());
    for (std::size_t j = 0; j < samples; ++j) {
        for (std::size_t i = 0; i < samples; ++i) {
            Complex& height = first[j * samples + i];
            second[j * samples + i] = -height * (waves[i] * waves[j]);
            height *= Complex{-waves[i] * waves[i], -waves[j] * waves[j]};
        }
    }
    transform_inverse(first, samples, samples);
    transform_inverse(second, samples, samples);
    return {part(first, real_part), part(second, real_part), part(first, imaginary_part)};
}

}  // namespace hts::validation

/// Random surfaces to be scattered from: heights of normal distribution with autocorrelation
/// C(r) = exp(-r^2/tau^2) [He91 (48)], in one dimension or two, with exact derivatives; in one dimension also
/// K-correlated, with a spectrum that is cut.
///
/// A surface is periodic and sampled evenly: white noise is filtered by the square root of the spectrum, so
/// that covariances at the samples are those of C, wrapped round the period. Derivatives are those of the
/// trigonometric polynomial through the samples. Lengths are in any one unit. The same seed gives the same
/// surface on every machine with the same mathematical library.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "hts/surface.hpp"

namespace hts::validation {

/// A seed of its own for each realisation and part of a study; neighbours give unrelated streams.
[[nodiscard]] std::uint64_t seed_of(std::uint64_t study, std::uint64_t part,
                                    std::uint64_t realisation) noexcept;

/// What is known of a surface's statistics.
struct RoughnessStatistics {
    double rms_roughness;       ///< sigma_0
    double correlation_length;  ///< tau; l of a K-correlation
    /// Of a K-correlated profile, C = 2^(1 - nu)/Gamma(nu) x^nu K_nu(x), x = r/l, whose spectrum
    /// (1 + (kappa l)^2)^(-nu - 1/2) is cut beyond most_frequency; sigma_0 is the rms of what remains.
    /// None of a Gaussian.
    std::optional<double> nu{};
};
/// Of K-correlated profiles, in one over the unit of length.
inline constexpr double most_frequency = 2.5;

/// Height over a line, z(x), x = i step.
struct RandomProfile {
    double step;
    std::vector<double> height, slope, second_derivative;
};

///   samples   of a period, products of 2, 3 and 5 are quick; step at most tau/3, period at least 6 tau
[[nodiscard]] RandomProfile random_profile(const RoughnessStatistics& statistics, double step,
                                           std::size_t samples, std::uint64_t seed);
/// C of these heights at the distances 0, step, 2 step, … half the period.
[[nodiscard]] std::vector<double> profile_correlation(const RoughnessStatistics& statistics, double step,
                                                      std::size_t samples);

/// Height over a square, z(x, y), sample (i, j) at x = i step, y = j step in row j.
struct RandomField {
    double step;
    std::size_t samples;  ///< along each side
    std::vector<double> height, slope_x, slope_y;
};

///   samples   as above, along a side      domain   Gaussian correlation, else hts::Error
///   cost      0.2 microseconds a sample
[[nodiscard]] RandomField random_field(const RoughnessStatistics& statistics, double step,
                                       std::size_t samples, std::uint64_t seed);
/// The same with another correlation length along y than along x.
[[nodiscard]] RandomField random_field(double rms_roughness, const CorrelationLengths& lengths, double step,
                                       std::size_t samples, std::uint64_t seed);

/// Second derivatives at the samples of a field.
struct FieldCurvature {
    std::vector<double> xx, xy, yy;
};
[[nodiscard]] FieldCurvature curvature_of(const RandomField& field);

}  // namespace hts::validation

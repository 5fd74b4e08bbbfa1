/// How the heights of a surface correlate, whatever their rms and scale: a shape C(x), x = r/length,
/// and what scatters by it.
///
///   C(x)       1 at 0, falling to 0
///   W(q)       its spectrum, integral of C(x) J0(q x) x dx; integral of W q dq = 1. The power spectrum of
///              the heights is S2(f) = 2 pi sigma_0^2 length^2 W(2 pi f length)
///   D(g, q)    integral of (e^(-g (1 - C)) - e^-g) J0(q x) x dx = e^-g sum of g^m/m! W_m(q), W_m of C^m
///
/// 2 D(g, q) takes the place of Phi(g, q^2/4) wherever the published model has that, the length the place of
/// tau: for C = exp(-x^2) they are the same. D comes from a logarithmic Hankel transform [Hamilton 2000],
/// made once per shape into a table.
///
/// W_m of the exponential is m/(m^2 + q^2)^(3/2). K-correlation ("ABC") is the Matern shape:
/// docs/models/correlations.md.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace hts {

namespace correlation_detail {
class LobeTable;
}

// Of `Correlation::lobe`, for g <= 1e8 and Gaussian and Matern shapes (nu from 1/2 to 10); the tests hold
// them against series, quadrature, and the transform on another grid.
namespace accuracy {
/// Relative, of 2 D and of the mean of 1/m, where D is over 1e-3 of its greatest value.
inline constexpr double correlation_lobe = 1e-6;
/// The same of nu = 1/4 and of two-scale shapes, whose lengths differ by up to 100.
inline constexpr double correlation_two_scales = 5e-5;
/// The same from there down to 1e-8.
inline constexpr double correlation_tail = 1e-4;
/// Of derivatives of ln D, absolute beside 1 plus the derivative; of the exponential, where D is over 1e-3.
inline constexpr double correlation_slopes = 9e-6;
/// Of `variance_below` and `slope_variance_below`, relative.
inline constexpr double correlation_moments = 1e-8;
}  // namespace accuracy

/// 2 D of a pair of g and q, and the mean of 1/m over the terms of its series.
struct ScatteringIntegral {
    double value;         ///< 2 D
    double log;           ///< its logarithm
    double inverse_mean;  ///< beta
};

/// Derivatives of ln D.
struct ScatteringSlopes {
    double by_log_g;  ///< by ln g
    double by_t;      ///< by t = q^2/4
};

/// A shape; copies share what they hold. Every call is const and may run on any thread; the table is made
/// at the first need of it.
class Correlation {
  public:
    /// C = exp(-x^2).
    [[nodiscard]] static Correlation gaussian();
    /// C = exp(-x), the Matern shape of nu = 1/2.
    [[nodiscard]] static Correlation exponential();
    /// C = 2^(1 - nu)/Gamma(nu) x^nu K_nu(x), W = 2 nu/(1 + q^2)^(nu + 1).
    ///   nu   0.05 ... 50, else hts::Error; slopes are finite above 1
    [[nodiscard]] static Correlation matern(double nu);
    struct Part;
    /// Roughness of several scales, each independent of the others.
    ///   parts   at least one; weights > 0, of the variance of heights, lengths > 0; else hts::Error
    /// The lengths of the parts are in units of the sum's length.
    [[nodiscard]] static Correlation sum(std::span<const Part> parts);
    struct Scaled;
    /// Self-affine between two cut-offs: S2 ~ 1/(1 + (L f)^2)^(slope/2), L the longest period, which ends at
    /// the shortest one (over a twentieth, in ln f). K-correlation, but that the slope may be so small that
    /// the variance of heights would be infinite without an end. The length is in units of L.
    ///   slope   0.1 ... 10      periods   the longest over the shortest, 2 ... 1e7; else hts::Error
    [[nodiscard]] static Scaled fractal(double slope, double periods);
    /// Of a power spectrum that is known at some frequencies. Between, powers of f; below the first it is
    /// held; beyond the last it is 0, or goes on as the power of f with which it ends.
    ///   frequency   > 0, increasing, at least 3 [1/um]      density   S2 > 0 [um^4]; else hts::Error
    ///   continued   where the power at the end is not below -2.5: hts::Error. Above -2 the variance is
    ///               infinite; below, it is mostly of unknown frequencies, and the tables do not hold it
    [[nodiscard]] static Scaled of_spectrum(std::span<const double> frequency,
                                            std::span<const double> density, bool continued);
    /// The same of a profile's one-sided spectrum S1 [um^3], by Abel's transform. hts::Error
    /// where that is not positive.
    [[nodiscard]] static Scaled of_profile_spectrum(std::span<const double> frequency,
                                                    std::span<const double> density, bool continued);
    /// Of a correlation function that is known at some distances.
    ///   distance   > 0, increasing, at least 3 [um]      correlation   -1 ... 1, C(0) = 1; else hts::Error
    /// hts::Error also where no surface can have it: where its spectrum is negative.
    [[nodiscard]] static Scaled of_autocorrelation(std::span<const double> distance,
                                                   std::span<const double> correlation);

    /// For people: "exponential", "matern, nu 1.5", "sum of 0.9 of gaussian + 0.1 of exponential",
    /// "tabulated".
    [[nodiscard]] std::string name() const;
    /// Of a Matern shape, K-correlation; none of others.
    [[nodiscard]] std::optional<double> nu() const;
    /// ln W(q); -infinity where there is no power.
    [[nodiscard]] double log_spectrum(double q) const;
    /// Share of the variance of heights that frequencies below q carry, integral of W q dq.
    [[nodiscard]] double variance_below(double q) const noexcept;
    /// Variance of the slope along one axis that frequencies below q give, over (sigma_0/length)^2: half the
    /// integral of W q^3 dq. It grows without bound where C has a cusp, as the exponential.
    [[nodiscard]] double slope_variance_below(double q) const noexcept;

    /// Makes the table where there is none yet.
    ///   cost   some 0.2 s, once for every shape of the same numbers
    void prepare() const;
    /// The same, but the table serves this shape and its copies alone: it is left neither in the process's
    /// cache nor in the folder. For shapes that are wanted once, such as a small change of another one.
    void prepare_unkept() const;
    /// 2 D and beta.
    ///   g       0 ... most_phase_variance; beyond, the value there      q   >= 0
    ///   error   accuracy::correlation_lobe, accuracy::correlation_tail
    [[nodiscard]] ScatteringIntegral lobe(double g, double q) const noexcept;
    /// Derivatives of its logarithm.
    ///   t       q^2/4
    ///   error   accuracy::correlation_slopes of g d/dg and of t d/dt, where D is over 1e-3 of its peak
    [[nodiscard]] ScatteringSlopes lobe_slopes(double g, double t) const noexcept;
    static constexpr double most_phase_variance = 1e8;
    /// The table, for vector lanes; made where there is none yet.
    [[nodiscard]] const correlation_detail::LobeTable& table() const;
    /// Of the table, which shapes of the same numbers share; 0 before it is made.
    [[nodiscard]] std::size_t table_bytes() const noexcept;

    /// Whether two are of the same numbers.
    friend bool operator==(const Correlation& a, const Correlation& b);

  private:
    struct Shared;
    explicit Correlation(std::shared_ptr<Shared> shared) : shared_{std::move(shared)} {}
    std::shared_ptr<Shared> shared_;
};

struct Correlation::Part {
    double weight;
    Correlation shape;
    double length;
};

struct Correlation::Scaled {
    Correlation shape;
    double length;  ///< where C = 1/e [um]
    /// sigma_0 by the whole spectrum, with what is held and continued [um]; 1 where none is known
    double rms_roughness;
};

}  // namespace hts

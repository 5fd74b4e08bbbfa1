/// What the instrument behind a set of curves would have measured on a surface that a model describes.
///
/// The source fills a cone about `in`, the detector one about `out`, and a detector of a band adds up
/// wavelengths. With projected solid angles, dw' = cos theta dw,
///
///   f_measured = integral f dw'_i dw'_r / (W'_i W'_r) + specular     averaged over the band
///   specular   = integral rho_s(in) dw'_i over the light whose mirror direction the detector sees
///                / (W'_i W'_r)
///
/// which is rho_s/(cos theta_i w_i) where the source's cone holds the detector's [He91 (70)]. The average is
/// reciprocal. What of a cone is below the horizon neither lights nor is seen. A cone that nobody stated is
/// taken as a single direction; where neither is stated, the specular term, which has no finite value then,
/// is left out.
///
/// A hemispherical reflectance is the sum of the specular term and the BRDF times cos theta_r over all
/// directions of view, from a single direction of light.
///
/// Everything geometric is prepared once:
///
///     const Prediction prediction{set};
///     for (…) residuals = prediction.values(material) …      // any number of times, a few ns per node
///
/// Averaging is linear, so `average` carries derivatives of the nodes as well as values, and `change` takes
/// them to the values.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "spectral/models/evaluator.hpp"
#include "spectral/models/material.hpp"
#include "validation/curves/curve.hpp"

namespace hts::validation {

namespace accuracy {
/// Of the specular term, relative: rho_s is taken at the middle of the light that reaches the detector. For
/// cones up to 2e-3 sr and incidence up to 75 deg.
inline constexpr double specular_average = 5e-3;
/// Of the band 2 ... 5.7 um with 8 wavelengths, relative to the largest value of a curve, sigma_0 0.1 ... 2
/// um.
inline constexpr double band_average = 4e-6;
/// Of hemispherical reflectances, relative, for sigma_0/tau from 0.03 on and incidence up to 80 deg.
inline constexpr double hemisphere_average = 1e-2;
/// Of `common_solid_angle`, relative, for half angles from 0.01 and parts from 1 % of the overlapping range
/// on.
inline constexpr double common_solid_angle = 5e-9;
}  // namespace accuracy

/// Nodes of the averages.
struct AveragingNodes {
    int wavelengths = 8;  ///< per band, of Gauss and Legendre; 1 for a single wavelength
    /// Per cone, with 4 nodes per ring each: exact for polynomials of degree 4 rings - 2; 0: the axis alone.
    int rings = 2;
};

/// Part of two cones that they share [sr].
///   half_angle_a, half_angle_b   0 … pi/2 [rad]      apart   angle between the axes, 0 … pi [rad]
[[nodiscard]] double common_solid_angle(double half_angle_a, double half_angle_b, double apart) noexcept;

/// A pair of directions at one of the wavelengths of a grid.
struct PairAtWavelength {
    DirectionPair pair;
    std::size_t wavelength;  ///< its place in the grid
};

class Prediction {
  public:
    /// Diffuse and specular terms to be had at every wavelength of one band.
    struct Job {
        spectral::WavelengthGrid wavelengths;
        std::vector<double> wavelength_weights;  ///< add up to 1
        std::vector<DirectionPair> pairs;        ///< where the BRDF is needed
        std::vector<Direction> incidences;       ///< where the specular reflectance is needed
    };
    /// What a model answers to a job, all wavelengths of a pair (an incidence) together.
    struct Answer {
        std::vector<double> brdf, specular_reflectance;
    };

    /// hts::Error for numbers of nodes outside 1 … 64 wavelengths and 0 … 8 rings.
    explicit Prediction(const CurveSet& set, AveragingNodes nodes = {});
    /// The same of several sets of one surface, the points of all in their order.
    explicit Prediction(std::span<const CurveSet> sets, AveragingNodes nodes = {});
    /// Of an instrument that sees the BRDF itself at single pairs; neighbours of the same pair share its
    /// evaluation.
    Prediction(const spectral::WavelengthGrid& wavelengths, std::span<const PairAtWavelength> points);

    [[nodiscard]] const std::vector<Job>& jobs() const noexcept { return jobs_; }
    [[nodiscard]] std::size_t point_count() const noexcept { return point_count_; }
    /// Whether values are affine functions of the BRDF; not so where curves are divided by their own value.
    [[nodiscard]] bool is_affine() const noexcept { return rows_.size() == point_count_; }
    /// All that a job asks for, on the calling thread.
    ///   model   at the job's wavelengths
    [[nodiscard]] static Answer answer(const Job& job, const spectral::Evaluator& model);

    /// The points of all curves in order, in the quantity and scale of the set; a set of unknown scale is
    /// predicted as if it were absolute. Runs on the calling thread.
    ///   error   of the engine: at most 1e-6, relative; of the averages: see AveragingNodes
    [[nodiscard]] std::vector<double> values(
        const spectral::Material& material,
        spectral::OutsideRange policy = spectral::OutsideRange::error) const;
    /// The same from answers to all jobs.
    [[nodiscard]] std::vector<double> values(std::span<const Answer> answers) const {
        return seen(average(answers));
    }
    /// The measured BRDF [1/sr] of each point, then of the mirror direction of each where the scale is
    /// specular: linear in the answers, before quantity and scale.
    [[nodiscard]] std::vector<double> average(std::span<const Answer> answers) const;
    /// The values of all points from these averages.
    [[nodiscard]] std::vector<double> seen(std::span<const double> averages) const;
    /// By how much the values change where the averages change by so little.
    [[nodiscard]] std::vector<double> change(std::span<const double> averages,
                                             std::span<const double> change_of_averages) const;

  private:
    /// Nodes of one measurement: ranges of a job's pairs and incidences.
    struct Row {
        std::size_t job, first_pair, last_pair;
        std::size_t first_wavelength, last_wavelength;
        std::size_t incidence;   // where the specular term is seen
        double specular_weight;  // 0: it is not [1/sr]
        double factor;           // from BRDF to the quantity
        std::size_t mirror;      // row of the mirror direction, itself where the scale is not specular
    };
    class Builder;

    std::vector<Job> jobs_;
    std::vector<std::vector<double>> pair_weights_;  // one list per job
    std::vector<Row> rows_;                          // points, then mirror directions
    std::size_t point_count_ = 0;
};

}  // namespace hts::validation

/// A rough square of a perfect conductor under beams of light: currents by the magnetic-field integral
/// equation, and what they radiate. The wavelength is the unit of length, E and H have the same unit.
///
/// With r = (x, y, z(x, y)), N = (-z_x, -z_y, 1) and j = N x H the current per area of the plane,
///
///   j - 2 N x PV integral grad G x j' dx' dy' = 2 N x H_in,   G = exp(ikR)/(4 pi R),   R = r - r' [Tsang00]
///
/// The trapezoidal rule on the lattice leaves out the node itself. Near it the kernel is the curvature over
/// R, and `lattice_sums` give what the node stands for, so that the error is of third order in the step.
/// All pairs are computed anew in every product, in single precision and for all right-hand sides at once:
/// there is no matrix. GMRES solves each right-hand side without restarts.
/// The same bits for any number of threads.
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "validation/scattering/gaussian_surface.hpp"
#include "validation/scattering/vector/plane_wave_beam.hpp"
#include "validation/scattering/vector/vector_lanes.hpp"

namespace hts::validation {

/// j_x and j_y of each node in turn.
using Currents = std::vector<std::complex<float>>;

/// Amplitude of the far field in a direction along s and p of the reflected ray (polarisation.hpp): E = F
/// exp(ikr)/r.
struct FarAmplitude {
    std::complex<float> s, p;
};

struct SolvedCurrents {
    std::vector<Currents> of;
    std::vector<int> iterations;
};

class ConductorPatch {
  public:
    ///   heights   in wavelengths; the square of all samples, about the origin
    explicit ConductorPatch(const RandomField& heights);

    [[nodiscard]] std::size_t node_count() const noexcept { return nodes_.count; }

    /// Kirchhoff's currents 2 N x H_in under a beam, of s and of p.
    [[nodiscard]] std::array<Currents, 2> kirchhoff(const PlaneWaveBeam& beam) const;
    /// The solution of the integral equation.
    ///   right     2 N x H_in of each      tolerance   of the residual, of its right-hand side
    ///   cost      a product has node_count^2 pairs; some 10 to 30 products
    ///   hts::Error where 100 products do not suffice
    [[nodiscard]] SolvedCurrents solved(const std::vector<Currents>& right, double tolerance) const;
    /// j - 2 N x PV integral grad G x j'.
    [[nodiscard]] std::vector<Currents> applied(std::span<const Currents* const> currents) const;
    /// What currents radiate, by current and direction.
    [[nodiscard]] std::vector<std::vector<FarAmplitude>> radiated(std::span<const Currents* const> currents,
                                                                  std::span<const Direction> out) const;

  private:
    struct SelfMatrix {
        float xx, xy, yx, yy;
    };

    NodeArrays nodes_;
    double step_;
    std::vector<SelfMatrix> self_;
};

}  // namespace hts::validation

/// The table of He et al. 1992 ("A fast and accurate light reflection model"), rebuilt: Phi as a natural
/// cubic spline surface through 80 x 80 points. They tabulate over (g, h), h proportional to v_xy tau, on an
/// uneven grid with more points near the origin, where the sum changes fast, and state an error below 1 %.
///
/// Here the uneven grid is an even one in x = ln g and y = sqrt(t/(1 + g)), and the surface is that of ln
/// Phi: worst error 1e-3, next to the edges, where a natural spline is straight and ln Phi is not.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "bench/phi/phi_methods.hpp"

namespace hts::bench {

/// A natural cubic spline through points one apart: their second derivatives, 0 at both ends.
[[nodiscard]] std::vector<double> natural_second_derivatives(const std::vector<double>& values);

class PhiSpline {
  public:
    static constexpr std::size_t points = 80;
    static constexpr double least_g = 0.01, most_g = 1e4;
    static constexpr double most_y = 5;
    /// Where `error` holds, inside y <= most_y.
    static constexpr PhiDomain domain{least_g, most_g, most_y* most_y};
    static constexpr double error = 2e-3;

    PhiSpline();
    /// Built at the first call.
    [[nodiscard]] static const PhiSpline& shared();

    /// Phi from the table; NaN outside it.
    [[nodiscard]] double operator()(double g, double t) const noexcept;
    [[nodiscard]] std::size_t bytes() const noexcept { return nodes_.size() * sizeof(Node); }

  private:
    /// ln Phi and its derivatives along x, along y and both, each of second order.
    struct Node {
        double value, xx, yy, xxyy;
    };
    void fill_values();
    void fill_derivatives(double Node::*from, double Node::*to, bool along_x);
    [[nodiscard]] Node& node(std::size_t x, std::size_t y) { return nodes_[x * points + y]; }

    std::vector<Node> nodes_;
};

}  // namespace hts::bench

// What the reference values must satisfy among themselves. Any failure stops the generator with a message.
#pragma once

#include <iostream>
#include <utility>

#include "reference_model.hpp"

namespace reference {

/// The largest of many relative differences, and where it was found. The bounds below are at most 4 times the
/// worst that was seen; the differences of the sum rules are those of the finite step, the rest is rounding.
class Worst {
  public:
    Worst(std::string name, const char* bound) : name_(std::move(name)), bound_(bound) {}
    void add(const Real& value, const Real& expected, const std::string& where) {
        const Real difference = value == expected ? Real(0) : Real(abs(value / expected - 1));
        ++count_;
        if (difference <= largest_) return;
        largest_ = difference;
        where_ = where;
    }
    /// Prints the worst case to standard error, also on success.
    void finish() const {
        std::cerr << name_ << ": " << count_ << " cases, worst " << largest_.str(3, std::ios_base::scientific)
                  << (where_.empty() ? "" : " at ") << where_ << '\n';
        if (largest_ > bound_ || count_ == 0) throw std::runtime_error("check failed: " + name_);
    }

  private:
    std::string name_;
    Real bound_, largest_{0};
    std::string where_;
    int count_ = 0;
};

/// The trapezoid rule against the plain sum; 340 000 terms at g = 1e8.
inline void check_stride() {
    Worst worst("Phi and Psi, stride against every term", "1.6e-70");
    for (const double g : {2e4, 1.5e5, 1e6, 1e8})
        for (const double t_over_g : {0.0, 0.3, 40.0, 700.0, 9000.0}) {
            if (g > 1e6 && t_over_g != 0.3 && t_over_g != 700.0) continue;
            const Real t = Real(g) * Real(t_over_g);
            const PhiSums plain = phi_by_every_term(g, t), strided = phi_by_stride(g, t);
            const std::string where = "g = " + text(g) + ", t/g = " + text(t_over_g);
            worst.add(strided.phi, plain.phi, where);
            worst.add(strided.psi, plain.psi, where);
        }
    worst.finish();
}

/// g (dPhi/dg + Phi) = Psi and dPsi/dt = -Phi, by central differences of relative step 1e-14.
inline void check_sum_rules() {
    Worst worst("g (dPhi/dg + Phi) = Psi, dPsi/dt = -Phi", "6e-26");
    for (const double g : {1e-6, 0.3, 7.0, 250.0, 1.2e4, 3e5, 4e9})
        for (const double ratio : {0.01, 1.0, 30.0}) {
            const Real G = g, t = G * Real(ratio), dg = G * Real("1e-14"), dt = t * Real("1e-14");
            const PhiSums here = phi_sums(G, t);
            const Real by_g = (phi_sums(G + dg, t).phi - phi_sums(G - dg, t).phi) / (2 * dg);
            const Real by_t = (phi_sums(G, t + dt).psi - phi_sums(G, t - dt).psi) / (2 * dt);
            const std::string where = "g = " + text(g) + ", t/g = " + text(ratio);
            worst.add(G * (by_g + here.phi), here.psi, where);
            worst.add(-by_t, here.phi, where);
        }
    worst.finish();
}

/// Checks that hold at every point of the model: give it each point, then ask for the verdict.
class ModelChecks {
  public:
    void add(const Point& p, const Reflection& f) {
        const Reflection back = reflection(reversed(p));
        std::string where;
        for (const std::string& cell : cells(p)) where += (where.empty() ? "" : ",") + cell;
        reciprocity_.add(back.directional_diffuse, f.directional_diffuse, where);
        jones_.add(f.jones.half_sum_of_squares(), f.fresnel, where);
        mueller_.add(f.mueller[0][0], f.directional_diffuse, where);
        for (std::size_t row = 0; row < 4; ++row)  // reversing the ray transposes M and flips the sign of S2
            for (std::size_t column = 0; column < 4; ++column) {
                const Real sign = (row == 2) == (column == 2) ? 1 : -1;
                transpose_.add(sign * back.mueller[column][row], f.mueller[row][column], where);
            }
    }
    void finish() const {
        reciprocity_.finish();
        jones_.finish();
        mueller_.finish();
        transpose_.finish();
    }

  private:
    Worst reciprocity_{"reciprocity of the directional-diffuse term", "6e-80"};
    Worst jones_{"sum |M|^2 / 2 = |F|^2", "2.4e-75"};
    Worst mueller_{"m00 = directional-diffuse term of (71)", "2.4e-75"};
    Worst transpose_{"reciprocity of the Mueller matrix", "2.4e-65"};
};

}  // namespace reference

#include "validation/scattering/boundary_integral.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "validation/scattering/hankel.hpp"

namespace hts::validation {
namespace {

using Complex = std::complex<double>;
using Matrix = Eigen::MatrixXcd;
using Index = Eigen::Index;

constexpr double pi = std::numbers::pi;

// zeta'(-2) and zeta'(-4)
constexpr double zeta_2 = -0.030448457058393271, zeta_4 = 0.0079838114502686243;

/// By how much the rule's weight of the logarithm's coefficient differs from the step at the nodes 0, 1 and 2
/// steps off, in steps: integral log|t| f(t) dt = h sum' log|t_j| f(t_j) + h (log(h/2pi) f(0) + zeta'(-2) D2
/// f + zeta'(-4)/12 D4 f), D2 and D4 the second and fourth differences over five nodes; the first correction
/// is at the node itself.
struct Corrections {
    double own;
    std::array<double, 2> neighbours;

    explicit Corrections(double step)
        : own{std::log(step / (2 * pi)) - 2.5 * zeta_2 + 0.5 * zeta_4},
          neighbours{(4 * zeta_2 - zeta_4) / 3, (zeta_4 - zeta_2) / 12} {}
};

struct Distance {
    double length, flux,
        flux_back;  // |r - r'|; n'(r - r')/|r - r'| |dr'/dt| at the second node, at the first

    Distance(const Contour& c, std::size_t i, std::size_t j)
        : length{std::hypot(c.x[i] - c.x[j], c.z[i] - c.z[j])},
          flux{(c.dx[j] * (c.z[i] - c.z[j]) - c.dz[j] * (c.x[i] - c.x[j])) / length},
          flux_back{(c.dx[i] * (c.z[j] - c.z[i]) - c.dz[i] * (c.x[j] - c.x[i])) / length} {}
};

/// G between two nodes, and dG/dr.
struct Kernels {
    Complex value, slope;
};

Kernels kernels(const Hankel& h, Complex k) {
    return {Complex{0, 0.25} * h.order_0, Complex{0, -0.25} * k * h.order_1};
}

/// Coefficients of the logarithms in them.
Kernels logarithms(double distance, Complex k) {
    const Bessel j = bessel(k * distance);
    return {-j.order_0 / (2 * pi), k / (2 * pi) * j.order_1};
}

/// The operators of one side; S acts on u |dr/dt|, which makes it symmetric.
struct Operators {
    Matrix s, half_minus_k;
};

class Assembly {
  public:
    Assembly(const Contour& contour, Complex k)
        : contour_{contour}, k_{k}, table_{diameter(contour), k}, corrections_{contour.step} {}

    [[nodiscard]] Operators operators() const {
        const auto n = static_cast<Index>(contour_.size());
        Operators result{Matrix(n, n), Matrix(n, n)};
        for (std::size_t j = 0; j < contour_.size(); ++j) {
            for (std::size_t i = 0; i < j; ++i) set_pair(result, i, j);
            set_own(result, j);
        }
        return result;
    }

  private:
    static double diameter(const Contour& c) {
        const auto [left, right] = std::minmax_element(c.x.begin(), c.x.end());
        const auto [low, high] = std::minmax_element(c.z.begin(), c.z.end());
        return std::hypot(*right - *left, *high - *low);
    }

    /// With the correction of the rule near the singular node.
    [[nodiscard]] Kernels corrected(double distance, std::size_t i, std::size_t j) const {
        Kernels kernel = kernels(table_(distance), k_);
        const std::size_t apart = contour_.closed ? std::min(j - i, i + contour_.size() - j) : j - i;
        if (apart <= 2) {
            const Kernels logarithm = logarithms(distance, k_);
            kernel.value += corrections_.neighbours[apart - 1] * logarithm.value;
            kernel.slope += corrections_.neighbours[apart - 1] * logarithm.slope;
        }
        return kernel;
    }

    void set_pair(Operators& operators, std::size_t i, std::size_t j) const {
        const Distance distance{contour_, i, j};
        const Kernels kernel = corrected(distance.length, i, j);
        const double h = contour_.step;
        const auto a = static_cast<Index>(i), b = static_cast<Index>(j);
        operators.s(a, b) = operators.s(b, a) = h * kernel.value;
        operators.half_minus_k(a, b) = h * distance.flux * kernel.slope;
        operators.half_minus_k(b, a) = h * distance.flux_back * kernel.slope;
    }

    /// Limits of the kernels without their logarithm.
    void set_own(Operators& operators, std::size_t i) const {
        const Contour& c = contour_;
        const double squared = c.dx[i] * c.dx[i] + c.dz[i] * c.dz[i];
        const Complex s =
            Complex{0, 0.25} -
            (std::log(k_ * std::sqrt(squared) / 2.0) + std::numbers::egamma + corrections_.own) / (2 * pi);
        const double k = (c.dx[i] * c.ddz[i] - c.dz[i] * c.ddx[i]) / (4 * pi * squared);
        const auto n = static_cast<Index>(i);
        operators.s(n, n) = c.step * s;
        operators.half_minus_k(n, n) = 0.5 - c.step * k;
    }

    const Contour& contour_;
    Complex k_;
    HankelTable table_;
    Corrections corrections_;
};

Matrix matrix_of(std::span<const SurfaceField> columns) {
    Matrix result(columns.empty() ? 0 : static_cast<Index>(columns[0].size()),
                  static_cast<Index>(columns.size()));
    for (std::size_t j = 0; j < columns.size(); ++j)
        result.col(static_cast<Index>(j)) =
            Eigen::Map<const Eigen::VectorXcd>(columns[j].data(), static_cast<Index>(columns[j].size()));
    return result;
}

std::vector<SurfaceField> columns_of(const Matrix& matrix) {
    std::vector<SurfaceField> result;
    for (Index j = 0; j < matrix.cols(); ++j) result.emplace_back(matrix.col(j).begin(), matrix.col(j).end());
    return result;
}

using Factors = Eigen::PartialPivLU<Eigen::Ref<Matrix>>;

/// A, the operator from psi to u on top of a ground, but for rho.
Matrix admittance(const Contour& contour, Complex wave_number) {
    Operators ground = Assembly{contour, wave_number}.operators();
    Matrix half_plus_k = -ground.half_minus_k;
    half_plus_k.diagonal().array() += 1;
    return Factors{ground.s}.solve(half_plus_k);
}

/// Of one polarisation on a ground.
SurfaceFields on_ground(Matrix&& system, const Matrix& a, const Matrix& waves) {
    const Matrix psi = Factors{system}.solve(waves);
    return {columns_of(psi), columns_of(a * psi)};
}

Eigen::Map<const Matrix> transform(const std::vector<Complex>& waves, std::size_t nodes) {
    const auto rows = static_cast<Index>(nodes);
    return {waves.data(), rows, static_cast<Index>(waves.size()) / rows};
}

}  // namespace

PolarisedFields surface_fields(const Contour& contour, double wave_number,
                               std::span<const SurfaceField> incident) {
    const Matrix waves = matrix_of(incident);
    Operators above = Assembly{contour, wave_number}.operators();
    const std::vector<SurfaceField> dark(incident.size(), SurfaceField(contour.size()));
    return {{dark, columns_of(Factors{above.s}.solve(waves))},
            {columns_of(Factors{above.half_minus_k}.solve(waves)), dark}};
}

PolarisedFields surface_fields(const Contour& contour, double wave_number,
                               std::span<const SurfaceField> incident, Complex index) {
    const Matrix waves = matrix_of(incident);
    const Matrix a = admittance(contour, index * wave_number);
    const Operators above = Assembly{contour, wave_number}.operators();
    const Matrix s_a = above.s * a;
    const Complex rho = index * index;
    return {on_ground(above.half_minus_k + s_a, a, waves),
            on_ground(above.half_minus_k + s_a / rho, a / rho, waves)};
}

FarField::FarField(const Contour& contour, double wave_number, std::span<const double> angles)
    : nodes_{contour.size()},
      directions_{angles.size()},
      of_psi_(nodes_ * directions_),
      of_u_(nodes_ * directions_) {
    for (std::size_t s = 0; s < directions_; ++s) {
        const double sine = std::sin(angles[s]), cosine = std::cos(angles[s]);
        for (std::size_t i = 0; i < nodes_; ++i) {
            const double path = contour.x[i] * sine + contour.z[i] * cosine;
            const Complex wave = std::polar(contour.step, -wave_number * path);
            of_u_[s * nodes_ + i] = wave;
            of_psi_[s * nodes_ + i] =
                wave * Complex{0, wave_number * (contour.dx[i] * cosine - contour.dz[i] * sine)};
        }
    }
}

std::vector<SurfaceField> FarField::amplitudes(const SurfaceFields& fields) const {
    return columns_of(transform(of_u_, nodes_).transpose() * matrix_of(fields.u) +
                      transform(of_psi_, nodes_).transpose() * matrix_of(fields.psi));
}

}  // namespace hts::validation

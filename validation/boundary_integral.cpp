#include "validation/boundary_integral.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "validation/hankel.hpp"

namespace hts::validation {
namespace {

using Complex = std::complex<double>;
using Matrix = Eigen::MatrixXcd;
using Index = Eigen::Index;

constexpr double pi = std::numbers::pi;

// zeta'(-2) and zeta'(-4)
constexpr double zeta_2 = -0.030448457058393271, zeta_4 = 0.0079838114502686243;

/// By how much the rule's weight of the logarithm's coefficient differs from the step at the nodes 0, 1 and 2 steps off,
/// in steps: integral log|t| f(t) dt = h sum' log|t_j| f(t_j) + h (log(h/2pi) f(0) + zeta'(-2) D2 f + zeta'(-4)/12 D4 f),
/// D2 and D4 the second and fourth differences over five nodes; the first correction is at the node itself.
struct Corrections {
    double own;
    std::array<double, 2> neighbours;

    explicit Corrections(double step)
        : own{std::log(step / (2 * pi)) - 2.5 * zeta_2 + 0.5 * zeta_4},
          neighbours{(4 * zeta_2 - zeta_4) / 3, (zeta_4 - zeta_2) / 12} {}
};

/// Both kernels between two nodes, with the coefficients of their logarithms.
struct Kernels {
    Complex te, tm, tm_back;  // G; dG/dn' |dr'/dt| at the second node, at the first
    double log_te, log_tm, log_tm_back;
};

struct Distance {
    double length, flux,
        flux_back;  // |r - r'|; n'(r - r')/|r - r'| |dr'/dt| at the second node, at the first

    Distance(const Contour& c, std::size_t i, std::size_t j)
        : length{std::hypot(c.x[i] - c.x[j], c.z[i] - c.z[j])},
          flux{(c.dx[j] * (c.z[i] - c.z[j]) - c.dz[j] * (c.x[i] - c.x[j])) / length},
          flux_back{(c.dx[i] * (c.z[j] - c.z[i]) - c.dz[i] * (c.x[j] - c.x[i])) / length} {}
};

Kernels kernels(const Distance& distance, double k, const HankelTable& table) {
    const Hankel h = table(k * distance.length);
    const Complex normal = Complex{0, k / 4} * h.order_1;
    const double log_normal = -k / (2 * pi) * h.order_1.real();
    return {Complex{0, 0.25} * h.order_0, normal * distance.flux,     normal * distance.flux_back,
            -h.order_0.real() / (2 * pi), log_normal * distance.flux, log_normal * distance.flux_back};
}

/// Both systems; TE for u |dr/dt| as unknown, which makes it symmetric.
struct Systems {
    Matrix te, tm;
};

class Assembly {
  public:
    Assembly(const Contour& contour, double k)
        : contour_{contour}, k_{k}, table_{k * diameter(contour)}, corrections_{contour.step} {}

    [[nodiscard]] Systems systems() const {
        const auto n = static_cast<Index>(contour_.size());
        Systems result{Matrix(n, n), Matrix(n, n)};
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

    [[nodiscard]] double correction(std::size_t i, std::size_t j) const {
        const std::size_t apart = contour_.closed ? std::min(j - i, i + contour_.size() - j) : j - i;
        return apart <= 2 ? corrections_.neighbours[apart - 1] : 0;
    }

    void set_pair(Systems& systems, std::size_t i, std::size_t j) const {
        const Kernels kernel = kernels(Distance{contour_, i, j}, k_, table_);
        const double correct = correction(i, j), h = contour_.step;
        const auto a = static_cast<Index>(i), b = static_cast<Index>(j);
        systems.te(a, b) = systems.te(b, a) = h * (kernel.te + correct * kernel.log_te);
        systems.tm(a, b) = -h * (kernel.tm + correct * kernel.log_tm);
        systems.tm(b, a) = -h * (kernel.tm_back + correct * kernel.log_tm_back);
    }

    /// Limits of the kernels without their logarithm.
    void set_own(Systems& systems, std::size_t i) const {
        const Contour& c = contour_;
        const double squared = c.dx[i] * c.dx[i] + c.dz[i] * c.dz[i];
        const Complex te{-(std::log(k_ * std::sqrt(squared) / 2) + std::numbers::egamma) / (2 * pi), 0.25};
        const double tm = (c.dx[i] * c.ddz[i] - c.dz[i] * c.ddx[i]) / (4 * pi * squared);
        const auto n = static_cast<Index>(i);
        systems.te(n, n) = c.step * (te - corrections_.own / (2 * pi));
        systems.tm(n, n) = 0.5 - c.step * tm;
    }

    const Contour& contour_;
    double k_;
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

std::vector<SurfaceField> transformed(const std::vector<Complex>& nodes_by_directions, std::size_t nodes,
                                      const std::vector<SurfaceField>& fields) {
    const auto rows = static_cast<Index>(nodes);
    const Eigen::Map<const Matrix> waves(nodes_by_directions.data(), rows,
                                         static_cast<Index>(nodes_by_directions.size()) / rows);
    return columns_of(waves.transpose() * matrix_of(fields));
}

}  // namespace

SurfaceFields surface_fields(const Contour& contour, double wave_number,
                             std::span<const SurfaceField> incident) {
    const Matrix waves = matrix_of(incident);
    Systems systems = Assembly{contour, wave_number}.systems();
    const Eigen::PartialPivLU<Eigen::Ref<Matrix>> te{systems.te};
    const Eigen::PartialPivLU<Eigen::Ref<Matrix>> tm{systems.tm};
    return {columns_of(te.solve(waves)), columns_of(tm.solve(waves))};
}

FarField::FarField(const Contour& contour, double wave_number, std::span<const double> angles)
    : nodes_{contour.size()},
      directions_{angles.size()},
      te_(nodes_ * directions_),
      tm_(nodes_ * directions_) {
    for (std::size_t s = 0; s < directions_; ++s) {
        const double sine = std::sin(angles[s]), cosine = std::cos(angles[s]);
        for (std::size_t i = 0; i < nodes_; ++i) {
            const double path = contour.x[i] * sine + contour.z[i] * cosine;
            const Complex wave = std::polar(contour.step, -wave_number * path);
            te_[s * nodes_ + i] = wave;
            tm_[s * nodes_ + i] =
                wave * Complex{0, -wave_number * (contour.dx[i] * cosine - contour.dz[i] * sine)};
        }
    }
}

std::vector<SurfaceField> FarField::te(const std::vector<SurfaceField>& u) const {
    return transformed(te_, nodes_, u);
}

std::vector<SurfaceField> FarField::tm(const std::vector<SurfaceField>& psi) const {
    return transformed(tm_, nodes_, psi);
}

}  // namespace hts::validation

#include "validation/scattering/vector/conductor_patch.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "hts/error.hpp"
#include "hts/polarisation.hpp"
#include "spectral/parallel.hpp"
#include "validation/scattering/vector/lattice_sums.hpp"

namespace hts::validation {
namespace {

constexpr double pi = std::numbers::pi;

std::size_t padded(std::size_t count) {
    return (count + block - 1) / block * block;
}

std::vector<float> single_precision(const std::vector<double>& values) {
    std::vector<float> result(values.begin(), values.end());
    result.resize(padded(values.size()), result.back());
    return result;
}

using Vector = Eigen::Map<Eigen::VectorXcf>;
using ConstantVector = Eigen::Map<const Eigen::VectorXcf>;

ConstantVector vector_of(const Currents& currents) {
    return {currents.data(), static_cast<Eigen::Index>(currents.size())};
}
Vector vector_of(Currents& currents) {
    return {currents.data(), static_cast<Eigen::Index>(currents.size())};
}

/// In double precision, in an order of its own.
std::complex<double> product(const Currents& a, const Currents& b) {
    std::complex<double> sum = 0;
    for (std::size_t first = 0; first < a.size(); first += 1024) {
        const auto count = static_cast<Eigen::Index>(std::min<std::size_t>(1024, a.size() - first));
        sum += std::complex<double>{
            ConstantVector{a.data() + first, count}.dot(ConstantVector{b.data() + first, count})};
    }
    return sum;
}
double length(const Currents& a) {
    return std::sqrt(product(a, a).real());
}

/// GMRES of one right-hand side: the basis of its Krylov space, and the Hessenberg matrix made triangular by
/// rotations.
class Krylov {
  public:
    explicit Krylov(const Currents& right) : size_{length(right)} {
        residual_.emplace_back(size_);
        basis_.push_back(right);
        vector_of(basis_.back()) *= size_ > 0 ? static_cast<float>(1 / size_) : 0;
    }

    /// What the operator is to be applied to next.
    [[nodiscard]] const Currents& last() const { return basis_.back(); }
    /// Of the right-hand side.
    [[nodiscard]] double residual() const { return size_ > 0 ? std::abs(residual_.back()) / size_ : 0; }
    [[nodiscard]] int dimension() const { return static_cast<int>(basis_.size()) - 1; }

    /// Takes the operator applied to the last vector.
    void add(Currents image) {
        std::vector<std::complex<double>> column;
        for (const Currents& earlier : basis_) {
            column.push_back(product(earlier, image));
            vector_of(image) -= std::complex<float>{column.back()} * vector_of(earlier);
        }
        const double rest = length(image);
        for (std::size_t i = 0; i < cosines_.size(); ++i) {
            const auto above = column[i], below = column[i + 1];
            column[i] = cosines_[i] * above + sines_[i] * below;
            column[i + 1] = -std::conj(sines_[i]) * above + cosines_[i] * below;
        }
        const double modulus = std::hypot(std::abs(column.back()), rest);
        const std::complex<double> turn =
            std::abs(column.back()) > 0 ? column.back() / std::abs(column.back()) : 1;
        cosines_.push_back(std::abs(column.back()) / modulus);
        sines_.push_back(turn * rest / modulus);
        column.back() = turn * modulus;
        columns_.push_back(std::move(column));
        residual_.push_back(-std::conj(sines_.back()) * residual_.back());
        residual_[residual_.size() - 2] *= cosines_.back();
        vector_of(image) *= static_cast<float>(1 / rest);
        basis_.push_back(std::move(image));
    }

    [[nodiscard]] Currents solution() const {
        std::vector<std::complex<double>> weights(residual_.begin(), residual_.end() - 1);
        for (std::size_t i = weights.size(); i-- > 0;) {
            for (std::size_t j = i + 1; j < weights.size(); ++j) weights[i] -= columns_[j][i] * weights[j];
            weights[i] /= columns_[i][i];
        }
        Currents sum(basis_[0].size());
        for (std::size_t i = 0; i < weights.size(); ++i)
            vector_of(sum) += std::complex<float>{weights[i]} * vector_of(basis_[i]);
        return sum;
    }

  private:
    double size_;
    std::vector<Currents> basis_;
    std::vector<std::vector<std::complex<double>>> columns_;
    std::vector<double> cosines_;
    std::vector<std::complex<double>> sines_, residual_;
};

/// Groups that so many take; the last one is filled with zeros.
std::size_t groups_of(std::size_t count) {
    return (count + group - 1) / group;
}

}  // namespace

ConductorPatch::ConductorPatch(const RandomField& heights) : step_{heights.step} {
    const std::size_t side = heights.samples;
    std::vector<double> x, y;
    for (std::size_t i = 0; i < side * side; ++i) {
        const auto from_middle = [&](std::size_t index) {
            return step_ * (static_cast<double>(index) - (static_cast<double>(side) - 1) / 2);
        };
        x.push_back(from_middle(i % side));
        y.push_back(from_middle(i / side));
    }
    nodes_ = {single_precision(x),
              single_precision(y),
              single_precision(heights.height),
              single_precision(heights.slope_x),
              single_precision(heights.slope_y),
              side * side};
    const FieldCurvature curvature = curvature_of(heights);
    self_.resize(side * side);
    spectral::parallel_blocks(side * side, side, [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) {
            const LatticeSums sums = lattice_sums(heights.slope_x[i], heights.slope_y[i]);
            const double xx = curvature.xx[i], xy = curvature.xy[i], yy = curvature.yy[i];
            const auto whole = [&](double sum) { return static_cast<float>(-step_ / (2 * pi) * sum); };
            const double along = (xx * sums.xx - yy * sums.yy) / 2;
            self_[i] = {whole(along), whole(xy * sums.xx + yy * sums.xy), whole(xx * sums.xy + xy * sums.yy),
                        whole(-along)};
        }
    });
}

std::array<Currents, 2> ConductorPatch::kirchhoff(const PlaneWaveBeam& beam) const {
    std::array<Currents, 2> currents{Currents(2 * nodes_.count), Currents(2 * nodes_.count)};
    spectral::parallel_blocks(nodes_.count, 256, [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) {
            const auto fields = beam.magnetic_field({nodes_.x[i], nodes_.y[i], nodes_.z[i]});
            for (const Incident state : incident_states) {
                const auto& h = fields[static_cast<std::size_t>(state)];
                auto& of = currents[static_cast<std::size_t>(state)];
                of[2 * i] = std::complex<float>{-2.0 * (double{nodes_.slope_y[i]} * h[2] + h[1])};
                of[2 * i + 1] = std::complex<float>{2.0 * (h[0] + double{nodes_.slope_x[i]} * h[2])};
            }
        }
    });
    return currents;
}

std::vector<Currents> ConductorPatch::applied(std::span<const Currents* const> currents) const {
    const std::size_t groups = groups_of(currents.size());
    std::vector<float> packed(nodes_.count * groups * group * 4);
    for (std::size_t c = 0; c < currents.size(); ++c) {
        for (std::size_t i = 0; i < nodes_.count; ++i) {
            float* at = packed.data() + (i * groups * group + c) * 4;
            const auto x = (*currents[c])[2 * i], y = (*currents[c])[2 * i + 1];
            at[0] = x.real();
            at[1] = x.imag();
            at[2] = y.real();
            at[3] = y.imag();
        }
    }
    std::vector<Currents> result(currents.size(), Currents(2 * nodes_.count));
    const auto area = static_cast<float>(step_ * step_);
    spectral::parallel_blocks(nodes_.count, block, [&](std::size_t first, std::size_t count) {
        std::vector<float> sums(groups * group * 4 * block);
        add_field(nodes_, area, packed.data(), groups, first, sums.data());
        for (std::size_t c = 0; c < currents.size(); ++c) {
            const float* of = sums.data() + c * 4 * block;
            for (std::size_t lane = 0; lane < count; ++lane) {
                const std::size_t i = first + lane;
                const SelfMatrix& self = self_[i];
                const auto x = (*currents[c])[2 * i], y = (*currents[c])[2 * i + 1];
                result[c][2 * i] =
                    x - self.xx * x - self.xy * y - std::complex<float>{of[lane], of[block + lane]};
                result[c][2 * i + 1] = y - self.yx * x - self.yy * y -
                                       std::complex<float>{of[2 * block + lane], of[3 * block + lane]};
            }
        }
    });
    return result;
}

SolvedCurrents ConductorPatch::solved(const std::vector<Currents>& right, double tolerance) const {
    constexpr int most_products = 100;
    std::vector<Krylov> spaces;
    spaces.reserve(right.size());
    for (const Currents& each : right) spaces.emplace_back(each);
    for (int products = 0;; ++products) {
        std::vector<Krylov*> open;
        std::vector<const Currents*> last;
        for (Krylov& each : spaces) {
            if (each.residual() <= tolerance) continue;
            open.push_back(&each);
            last.push_back(&each.last());
        }
        if (open.empty()) break;
        if (products == most_products)
            throw Error{"scattering by a rough patch: " + std::to_string(most_products) +
                        " products do not solve the integral equation"};
        auto images = applied(last);
        spectral::parallel_for(open.size(), [&](std::size_t i) { open[i]->add(std::move(images[i])); });
    }
    SolvedCurrents result;
    for (const Krylov& each : spaces) {
        result.of.push_back(each.solution());
        result.iterations.push_back(each.dimension());
    }
    return result;
}

std::vector<std::vector<FarAmplitude>> ConductorPatch::radiated(std::span<const Currents* const> currents,
                                                                std::span<const Direction> out) const {
    const std::size_t groups = groups_of(currents.size());
    std::vector<float> packed(nodes_.count * groups * group * 6);
    for (std::size_t c = 0; c < currents.size(); ++c) {
        for (std::size_t i = 0; i < nodes_.count; ++i) {
            const auto x = (*currents[c])[2 * i], y = (*currents[c])[2 * i + 1];
            const auto z = nodes_.slope_x[i] * x + nodes_.slope_y[i] * y;
            float* at = packed.data() + (i * groups * group + c) * 6;
            for (const auto part : {x, y, z}) {
                *at++ = part.real();
                *at++ = part.imag();
            }
        }
    }
    DirectionArrays directions;
    for (std::size_t i = 0; i < padded(out.size()); ++i) {
        const Vector3 s = out[std::min(i, out.size() - 1)].vector();
        directions.x.push_back(static_cast<float>(s.x));
        directions.y.push_back(static_cast<float>(s.y));
        directions.z.push_back(static_cast<float>(s.z));
    }
    std::vector<std::vector<FarAmplitude>> result(currents.size(), std::vector<FarAmplitude>(out.size()));
    const std::complex<double> factor{0, step_ * step_ / 2};  // i k/(4 pi)
    spectral::parallel_blocks(out.size(), block, [&](std::size_t first, std::size_t count) {
        std::vector<float> sums(groups * group * 6 * block);
        add_radiation(nodes_, directions, packed.data(), groups, first, sums.data());
        for (std::size_t c = 0; c < currents.size(); ++c) {
            for (std::size_t lane = 0; lane < count; ++lane) {
                const auto part = [&](std::size_t i) {
                    return std::complex<double>{sums[(c * 6 + 2 * i) * block + lane],
                                                sums[(c * 6 + 2 * i + 1) * block + lane]};
                };
                const Direction& to = out[first + lane];
                const Vector3 s = s_vector_of_reflected(to), p = cross(s, to.vector());
                const auto along = [&](Vector3 v) {
                    return std::complex<float>{factor * (v.x * part(0) + v.y * part(1) + v.z * part(2))};
                };
                result[c][first + lane] = {along(s), along(p)};
            }
        }
    });
    return result;
}

}  // namespace hts::validation

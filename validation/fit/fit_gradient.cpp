#include "validation/fit/fit_gradient.hpp"

#include <array>
#include <optional>

#include "hts/he_torrance_gradient.hpp"
#include "hts/terms.hpp"

namespace hts::validation {
namespace {

constexpr std::size_t parameter_count = 5;

/// The view of a direction, found anew only where it is not that of the call before: neighbours share one.
class Views {
  public:
    explicit Views(const Surface& surface) : surface_{surface} {}

    const ViewGradient& of(const Direction& direction) {
        const Vector3 v = direction.vector();
        if (!last_ || v.x != at_.x || v.y != at_.y || v.z != at_.z)
            last_ = view_gradient(surface_, direction);
        at_ = v;
        return *last_;
    }

  private:
    const Surface& surface_;
    Vector3 at_{};
    std::optional<ViewGradient> last_;
};

/// The numbers of a fit among the derivatives.
std::array<double, parameter_count> in_order(const Gradient<>& by) {
    return {by.rms_roughness, by.correlation_length, by.diffuse_albedo, by.n, by.k};
}

}  // namespace

std::vector<Prediction::Answer> he_torrance_gradient(std::span<const ModelNumbers> numbers,
                                                     const Prediction::Job& job) {
    const Surface surface{numbers[0].own[0], numbers[0].own[1]};
    const std::size_t count = numbers.size();
    std::vector<Prediction::Answer> result(parameter_count, {std::vector<double>(job.pairs.size() * count),
                                                     std::vector<double>(job.incidences.size() * count)});
    Views ins{surface}, outs{surface};
    for (std::size_t i = 0; i < job.pairs.size(); ++i) {
        const PairGradient pair{surface, ins.of(job.pairs[i].in), outs.of(job.pairs[i].out)};
        for (std::size_t w = 0; w < count; ++w) {
            const ModelNumbers& at = numbers[w];
            const auto by =
                in_order(brdf_gradient(pair, at.wavelength, at.index, hts::uniform_diffuse(at.own[2])).by);
            for (std::size_t c = 0; c < parameter_count; ++c) result[c].brdf[i * count + w] = by[c];
        }
    }
    for (std::size_t i = 0; i < job.incidences.size(); ++i) {
        const ViewGradient view = view_gradient(surface, job.incidences[i]);
        for (std::size_t w = 0; w < count; ++w) {
            const auto by = in_order(
                specular_reflectance_gradient(surface, view, numbers[w].wavelength, numbers[w].index).by);
            for (std::size_t c = 0; c < parameter_count; ++c) result[c].specular_reflectance[i * count + w] = by[c];
        }
    }
    return result;
}

}  // namespace hts::validation

#include "validation/fit/fit_gradient.hpp"

#include <array>

#include "hts/he_torrance_gradient.hpp"
#include "hts/terms.hpp"

namespace hts::validation {
namespace {

constexpr std::size_t columns = 5;

/// The numbers of a fit among the derivatives.
std::array<double, columns> in_order(const Gradient<>& by) {
    return {by.rms_roughness, by.correlation_length, by.diffuse_albedo, by.n, by.k};
}

}  // namespace

std::vector<Prediction::Answer> he_torrance_gradient(std::span<const ModelNumbers> numbers,
                                                     const Prediction::Job& job) {
    const Surface surface{numbers[0].own[0], numbers[0].own[1]};
    const std::size_t count = numbers.size();
    std::vector<Prediction::Answer> result(columns, {std::vector<double>(job.pairs.size() * count),
                                                     std::vector<double>(job.incidences.size() * count)});
    for (std::size_t i = 0; i < job.pairs.size(); ++i) {
        const PairGradient pair{surface, job.pairs[i].in, job.pairs[i].out};
        for (std::size_t w = 0; w < count; ++w) {
            const ModelNumbers& at = numbers[w];
            const auto by =
                in_order(brdf_gradient(pair, at.wavelength, at.index, hts::uniform_diffuse(at.own[2])).by);
            for (std::size_t c = 0; c < columns; ++c) result[c].brdf[i * count + w] = by[c];
        }
    }
    for (std::size_t i = 0; i < job.incidences.size(); ++i) {
        const ViewGradient view = view_gradient(surface, job.incidences[i]);
        for (std::size_t w = 0; w < count; ++w) {
            const auto by = in_order(
                specular_reflectance_gradient(surface, view, numbers[w].wavelength, numbers[w].index).by);
            for (std::size_t c = 0; c < columns; ++c) result[c].specular_reflectance[i * count + w] = by[c];
        }
    }
    return result;
}

}  // namespace hts::validation

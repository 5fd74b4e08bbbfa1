#include "tables/plans/plan_cost.hpp"

#include <omp.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "hts/sampling/random.hpp"
#include "spectral/colour/spectrum_interpolation.hpp"
#include "spectral/processor_time.hpp"
#include "spectral/statistics.hpp"

namespace hts::tables {
namespace {

using spectral::PlannedForm;
using spectral::Xyz;

constexpr std::size_t pair_count = 256;

/// One thread while it lives.
class OneThread {
  public:
    OneThread() { omp_set_num_threads(1); }
    ~OneThread() { omp_set_num_threads(before_); }
    OneThread(const OneThread&) = delete;
    OneThread& operator=(const OneThread&) = delete;

  private:
    int before_ = omp_get_max_threads();
};

std::vector<DirectionPair> pairs_of(const spectral::Scene& scene) {
    Random random{1};
    std::vector<DirectionPair> pairs;
    while (pairs.size() < pair_count) {
        const Direction in = random.direction(std::cos(scene.largest_theta_i));
        pairs.push_back({in, random.direction(std::cos(scene.largest_theta_r))});
    }
    return pairs;
}

/// Median over passes of what `work` takes per pair [ns].
template <class Work>
double nanoseconds(const Work& work) {
    constexpr double least_seconds = 1e-3;
    std::array<double, 7> passes{};
    for (double& pass : passes) {
        const double start = spectral::thread_seconds();
        double taken = 0;
        std::size_t repeats = 0;
        for (; taken < least_seconds; taken = spectral::thread_seconds() - start, ++repeats) work();
        pass = taken / static_cast<double>(repeats);
    }
    return spectral::median({passes.begin(), passes.end()}) * 1e9 / pair_count;
}

/// Times the parts of one evaluator.
class Timing {
  public:
    explicit Timing(const spectral::Scene& scene) : scene_{scene}, pairs_{pairs_of(scene)} {}

    /// At the rung's own wavelengths.
    [[nodiscard]] double diffuse(const spectral::Reflectance& reflectance) const {
        const std::size_t width = reflectance.size();
        const spectral::Evaluator& evaluator = reflectance.evaluator();
        if (scene_.polarised) {
            std::vector<Mueller> result(width);
            return nanoseconds([&] {
                for (const DirectionPair& pair : pairs_) evaluator.mueller(pair, result);
            });
        }
        std::vector<double> result(pairs_.size() * width);
        return nanoseconds([&] { evaluator.brdf_batch(pairs_, result); });
    }

    [[nodiscard]] double mirror(const PlannedForm& form) const {
        if (!form.rung().specular) return 0;
        const spectral::Reflectance& reflectance = form.reflectance();
        std::vector<double> spectrum(reflectance.size());
        double sum = 0;  // so that nothing is optimised away
        return nanoseconds([&] {
                   for (const DirectionPair& pair : pairs_) {
                       if (scene_.polarised)
                           spectrum[0] = reflectance.specular_mueller(pair.in)[0](0, 0);
                       else
                           reflectance.specular_reflectance(pair.in, spectrum);
                       sum += spectrum[0];
                   }
               }) +
               0 * sum;
    }

    /// From the rung's wavelengths to the scene's.
    [[nodiscard]] double interpolation(const spectral::Rung& rung) const {
        const spectral::SpectrumInterpolation interpolation{rung.wavelengths, scene_.wavelengths};
        if (interpolation.is_identity() || scene_.illuminant) return 0;
        std::vector<double> nodes(rung.wavelengths.size(), 0.1), spectrum(scene_.wavelengths.size());
        return nanoseconds([&] {
            for (std::size_t i = 0; i < pair_count; ++i) {
                interpolation(nodes, spectrum);
                nodes[0] = spectrum[0];  // so that nothing is optimised away
            }
        });
    }

    [[nodiscard]] double colour(const spectral::Rung& rung) const {
        if (!scene_.illuminant) return 0;
        const std::vector<Xyz> weights(rung.wavelengths.size(), Xyz{1, 1, 1});
        std::vector<double> spectrum(rung.wavelengths.size(), 0.1);
        return nanoseconds([&] {
            for (std::size_t i = 0; i < pair_count; ++i) {
                Xyz sum{0, 0, 0};
                for (std::size_t j = 0; j < weights.size(); ++j) sum = sum + spectrum[j] * weights[j];
                spectrum[0] = 1e-3 * sum.Y;
            }
        });
    }

  private:
    const spectral::Scene& scene_;
    std::vector<DirectionPair> pairs_;
};

/// What does not grow with the wavelengths, from the times of all and of one.
double fixed_part(double all, double one, std::size_t count) {
    if (count == 1) return all;
    const auto n = static_cast<double>(count);
    return std::clamp((n * one - all) / (n - 1), 0., all);
}

}  // namespace

PlanCost plan_cost(const spectral::Scene& scene, const spectral::MaterialForms& forms,
                   const PlannedForm& form) {
    const OneThread one_thread;
    const Timing timing{scene};
    const spectral::Rung& rung = form.rung();
    const double at_nodes = timing.diffuse(form.at_nodes()), interpolation = timing.interpolation(rung);
    PlanCost cost{
        at_nodes + interpolation, timing.mirror(form), timing.colour(rung), 0, 0, at_nodes, interpolation};
    if (rung.lobe == DiffuseLobe::none || !rung.table.empty() || !forms.material().properties().surface)
        return cost;
    spectral::Rung simple = rung;
    if (rung.lobe == DiffuseLobe::full) simple.lobe = DiffuseLobe::first_order;
    const double simple_time =
        rung.lobe == DiffuseLobe::full ? timing.diffuse(forms.at_nodes(simple)) : at_nodes;
    simple.wavelengths = spectral::WavelengthGrid::from_micrometres({rung.wavelengths.micrometres().front()});
    cost.phi = std::max(0., at_nodes - simple_time);
    cost.directions =
        std::min(fixed_part(simple_time, timing.diffuse(forms.at_nodes(simple)), rung.wavelengths.size()),
                 at_nodes - cost.phi);
    cost.rest = at_nodes - cost.phi - cost.directions;
    return cost;
}

}  // namespace hts::tables

#include "cli/answers/charts/model_chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string_view>

#include "bench/charts/machine.hpp"
#include "bench/rivals/pbrt_conductor.hpp"
#include "cli/answers/charts/timed_evaluator.hpp"
#include "hts/error.hpp"
#include "hts/phi.hpp"
#include "hts/sampling/random.hpp"
#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/models/he_torrance_material.hpp"
#include "spectral/statistics.hpp"
#include "tables/table/build_table.hpp"
#include "validation/fit/fit.hpp"

namespace hts::cli {
namespace {

using Spectrum = std::array<double, chart_channels>;

struct ChartSurface {
    const char* title;
    Surface surface;
    const char* substance;
    double diffuse_albedo;
};

std::vector<ChartSurface> surfaces() {
    return {{"fine: σ₀ 0.05 µm, τ 1 µm, glass", {0.05, 1.0}, "SiO2", 0},
            {"aluminium: σ₀ 0.28 µm, τ 1.77 µm", {0.28, 1.77}, "Al", 0},
            {"ceramic: σ₀ 1.45 µm, τ 13.2 µm, a 0.9", {1.45, 13.2}, "MgO", 0.9},
            {"very rough: σ₀ 2.5 µm, τ 16 µm, copper", {2.5, 16.0}, "Cu", 0}};
}

spectral::Material material(const ChartSurface& chosen) {
    return spectral::he_torrance_material(chosen.title, chosen.surface,
                                          spectral::built_in_optical_constants(chosen.substance),
                                          spectral::DiffuseAlbedo{chosen.diffuse_albedo});
}

/// As exact as it can be.
spectral::Reflectance exact(const spectral::Material& material) {
    return material.at(chart_wavelengths(), {.tolerance = Tolerance{hts::accuracy::finest_tolerance}});
}

/// He-Torrance on a surface, its pairs for fitting and for judging, and the peak of the lobe for each
/// incidence.
class Truth {
  public:
    Truth(const ChartSurface& chosen, std::size_t fitted, std::size_t judged, std::uint64_t seed)
        : surface_{chosen}, exact_{exact(material(chosen))} {
        Random random{seed};
        for (std::size_t i = 0; i < fitted + judged; ++i) pairs_.push_back(pair(random, i % 2 == 0));
        values_.resize(pairs_.size());
        peaks_.resize(pairs_.size());
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            exact_.brdf(pairs_[i], values_[i]);
            peaks_[i] = peak(pairs_[i].in);
        }
        fitted_ = fitted;
    }

    [[nodiscard]] std::span<const DirectionPair> judged_pairs() const {
        return std::span{pairs_}.subspan(fitted_);
    }

    /// |f - f_he|/(f_he + peak/100) of all judged pairs and wavelengths.
    [[nodiscard]] std::vector<double> errors(const Evaluator& model) const {
        std::vector<double> errors;
        Spectrum spectrum{};
        for (std::size_t i = fitted_; i < pairs_.size(); ++i) {
            model(pairs_[i], spectrum);
            for (std::size_t k = 0; k < chart_channels; ++k) {
                errors.push_back(std::abs(spectrum[k] - values_[i][k]) / floor_of(i, k));
            }
        }
        return errors;
    }

    /// For fits: the uncertainty is what errors are measured by.
    [[nodiscard]] validation::FitData fit_data() const {
        std::vector<validation::FitSample> samples;
        for (std::size_t i = 0; i < fitted_; ++i) {
            for (std::size_t k = 0; k < chart_channels; ++k) {
                samples.push_back({pairs_[i], k, values_[i][k], floor_of(i, k)});
            }
        }
        return validation::fit_data(surface_.title, chart_wavelengths(), samples);
    }

  private:
    [[nodiscard]] double floor_of(std::size_t i, std::size_t k) const {
        return values_[i][k] + peaks_[i][k] / 100;
    }

    /// Half of them near the mirror direction, where the light is.
    static DirectionPair pair(Random& random, bool near_mirror) {
        constexpr double lowest = 0.1736;  // 80 deg
        const Direction in = random.direction(lowest);
        if (!near_mirror) return {in, random.direction(lowest)};
        const Vector3 off = random.direction().vector();
        const Vector3 out = in.mirror().vector() + 0.3 * random.uniform() * (off - Vector3{0, 0, 0.5});
        if (out.z <= lowest * std::sqrt(dot(out, out))) return {in, in.mirror()};
        return {in, Direction::from_vector(out)};
    }

    /// The largest value within the plane of incidence, from -85 to 85 deg.
    [[nodiscard]] Spectrum peak(const Direction& in) const {
        Spectrum largest{}, spectrum{};
        for (int degrees = -85; degrees <= 85; degrees += 5) {
            const double angle = degrees * std::numbers::pi / 180;
            const Direction mirror = in.mirror();
            const Direction out = Direction::from_vector(
                {std::sin(angle) * mirror.cos_phi(), std::sin(angle) * mirror.sin_phi(), std::cos(angle)});
            exact_.brdf({in, out}, spectrum);
            for (std::size_t k = 0; k < chart_channels; ++k) largest[k] = std::max(largest[k], spectrum[k]);
        }
        return largest;
    }

    ChartSurface surface_;
    spectral::Reflectance exact_;
    std::vector<DirectionPair> pairs_;
    std::vector<Spectrum> values_, peaks_;
    std::size_t fitted_ = 0;
};

ModelPoint point(const Truth& truth, const std::string& surface, const std::string& model,
                 const Evaluator& evaluator, std::size_t bytes = 0) {
    const std::vector<double> errors = truth.errors(evaluator);
    return {surface,
            model,
            spectral::in_order(errors, errors.size() / 2),
            spectral::in_order(errors, errors.size() * 99 / 100),
            nanoseconds(evaluator, truth.judged_pairs()),
            bytes};
}

/// The rungs of the model itself.
struct Rung {
    const char* name;
    DiffuseLobe lobe;
    double tolerance;
};
constexpr std::array rungs{
    Rung{"He-Torrance, 1e-6", DiffuseLobe::full, 1e-6}, Rung{"He-Torrance, 1e-3", DiffuseLobe::full, 1e-3},
    Rung{"first order", DiffuseLobe::first_order, 1e-3}, Rung{"rough limit", DiffuseLobe::rough_limit, 1e-3}};

/// Lookup tables of the model.
struct ChartTolerance {
    const char* title;
    double tolerance;
};
constexpr std::array table_tolerances{ChartTolerance{"table, 1e-2", 1e-2},
                                      ChartTolerance{"table, 1e-4", 1e-4}};

/// What is fitted, apart from He-Torrance.
struct Rival {
    const char* family;
    const char* title;
};
constexpr std::array rivals{Rival{"beckmann", "Walter, Beckmann"},
                            Rival{"ggx", "Walter, GGX"},
                            Rival{"ashikhmin", "Ashikhmin, Gaussian"},
                            Rival{"kurt", "Kurt"},
                            Rival{"ward", "Ward"},
                            Rival{"ward_duer", "Ward-Duer"},
                            Rival{"cook_torrance", "Cook-Torrance"},
                            Rival{"blinn_phong", "Blinn-Phong"},
                            Rival{"ashikhmin_shirley", "Ashikhmin-Shirley"},
                            Rival{"lafortune", "Lafortune"},
                            Rival{"oren_nayar", "Oren-Nayar"},
                            Rival{"lambert", "Lambert"}};

/// The optical constants are no free parameters of models that have them.
std::string index_of(const Rival& rival, const ChartSurface& chosen) {
    const auto& families = validation::fit_families();
    const auto family =
        std::find_if(families.begin(), families.end(),
                     [&](const validation::FitFamily& each) { return each.name == rival.family; });
    return family != families.end() && family->has_index ? '"' + std::string{chosen.substance} + '"'
                                                         : std::string{};
}

validation::Fit fit_of(const Rival& rival, const ChartSurface& chosen, const validation::FitData& data,
                       bool quick) {
    validation::FitRequest request{.model = rival.family, .index = index_of(rival, chosen)};
    request.residual = validation::Residual::weighted;
    request.followed_starts = quick ? 2 : 8;
    return validation::fitted(request, data);
}

/// The fitted GGX facets as pbrt-v4 computes them, timed on vectors that were converted beforehand.
ModelPoint pbrt_point(const Truth& truth, const ChartSurface& chosen, double alpha, const char* title,
                      bench::Compilation compilation) {
    const auto reflectance = exact(material(chosen));
    std::vector<double> n, k;
    for (const SpectralSample& sample : reflectance.samples()) {
        n.push_back(sample.index.substrate().n());
        k.push_back(sample.index.substrate().k());
    }
    const bench::PbrtConductor conductor{alpha, n, k, compilation};
    const auto brdf = [&](const VectorPair& pair, std::span<double> values) {
        std::array<float, chart_channels> spectrum;
        conductor.brdf(pair.in, pair.out, spectrum);
        std::ranges::copy(spectrum, values.begin());
    };
    const auto vectors = [](const DirectionPair& pair) {
        return VectorPair{bench::single(pair.in), bench::single(pair.out)};
    };
    ModelPoint result =
        point(truth, chosen.title, title,
              [&](const DirectionPair& pair, std::span<double> values) { brdf(vectors(pair), values); });
    std::vector<VectorPair> converted;
    std::ranges::transform(truth.judged_pairs(), std::back_inserter(converted), vectors);
    std::size_t next = 0;
    result.nanoseconds = nanoseconds(
        [&](const DirectionPair&, std::span<double> values) {
            brdf(converted[next], values);
            next = next + 1 < converted.size() ? next + 1 : 0;
        },
        truth.judged_pairs());
    return result;
}

void add_rungs(ModelChart& chart, const ChartSurface& chosen, const Truth& truth) {
    for (const Rung& rung : rungs) {
        const Tolerance tolerance{rung.tolerance};
        const auto form =
            material(chosen).at(chart_wavelengths(), {.tolerance = tolerance, .lobe = rung.lobe});
        chart.points.push_back(point(truth, chosen.title, rung.name, evaluator_of(form),
                                     rung.lobe == DiffuseLobe::full ? phi_table_bytes(tolerance) : 0));
    }
}

void add_tables(ModelChart& chart, const ChartSurface& chosen, const Truth& truth) {
    const auto model = exact(material(chosen));
    for (const auto& [title, tolerance] : table_tolerances) {
        const tables::Table table =
            tables::build_table(model, {model.name(), "", ""}, {.tolerance = tolerance});
        const auto evaluator = [&](const DirectionPair& pair, std::span<double> values) {
            table.brdf(pair, values);
        };
        chart.points.push_back(point(truth, chosen.title, title, evaluator, table.bytes()));
    }
}

}  // namespace

std::size_t model_chart_steps() {
    return surfaces().size() * (1 + rivals.size());
}

ModelChart measured_models(bool quick, std::uint64_t seed,
                           const std::function<void(const std::string& step)>& progress) {
    ModelChart chart{{}, seed, bench::machine().text()};
    for (const ChartSurface& chosen : surfaces()) {
        const Truth truth{chosen, quick ? std::size_t{200} : std::size_t{800},
                          quick ? std::size_t{500} : std::size_t{4000}, seed};
        add_rungs(chart, chosen, truth);
        progress(std::string{chosen.title} + ", tables");
        add_tables(chart, chosen, truth);
        const validation::FitData data = truth.fit_data();
        for (const Rival& rival : rivals) {
            progress(std::string{chosen.title} + ", " + rival.title);
            const validation::Fit fit = fit_of(rival, chosen, data, quick);
            chart.points.push_back(point(truth, chosen.title, rival.title,
                                         evaluator_of(exact(validation::fitted_material(fit)))));
            if (std::string_view{rival.family} != "ggx") continue;
            const double alpha = fit.parameter("alpha").value;
            chart.points.push_back(pbrt_point(truth, chosen, alpha, "GGX as pbrt is built",
                                              bench::Compilation::as_pbrt_is_built));
            chart.points.push_back(pbrt_point(truth, chosen, alpha, "GGX of pbrt without errno",
                                              bench::Compilation::without_errno));
        }
    }
    return chart;
}

}  // namespace hts::cli

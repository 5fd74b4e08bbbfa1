#include "validation/moment_method.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "hts/error.hpp"
#include "validation/tapered_beam.hpp"

namespace hts::validation {
namespace {

using Complex = std::complex<double>;

constexpr double pi = std::numbers::pi;
constexpr double k = 2 * pi;  // the wavelength is the unit of length
constexpr double degree = pi / 180;
constexpr int angles_per_bin = 10;
constexpr int bin_count = static_cast<int>(180 / bin_width_deg);
constexpr int jackknife_blocks = 10;

/// Middles of the angular steps from -90 to 90 degrees, so that sums are integrals.
std::vector<double> scattering_angles() {
    constexpr int count = bin_count * angles_per_bin;
    std::vector<double> angles;
    angles.reserve(count);
    for (int i = 0; i < count; ++i) angles.push_back((i + 0.5) * pi / count - pi / 2);
    return angles;
}

/// The middle of a period.
Contour contour_of(const RandomProfile& profile, std::size_t nodes) {
    const std::size_t first = (profile.height.size() - nodes) / 2;
    const auto middle = [&](const std::vector<double>& all) {
        const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
        return std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(nodes));
    };
    Contour contour{profile.step,
                    std::vector<double>(nodes),
                    middle(profile.height),
                    std::vector<double>(nodes, 1),
                    middle(profile.slope),
                    std::vector<double>(nodes, 0),
                    middle(profile.second_derivative)};
    for (std::size_t i = 0; i < nodes; ++i)
        contour.x[i] = profile.step * (static_cast<double>(i) - (static_cast<double>(nodes) - 1) / 2);
    return contour;
}

/// Incident fields and Kirchhoff's TE currents at the nodes, a column per beam.
struct Lit {
    std::vector<SurfaceField> field, twice_field, twice_derivative;
};

Lit lit(const Contour& contour, const std::vector<TaperedBeam>& beams) {
    Lit result;
    for (const TaperedBeam& beam : beams) {
        SurfaceField field, twice, derivative;
        for (std::size_t i = 0; i < contour.size(); ++i) {
            const double x = contour.x[i], z = contour.z[i];
            field.push_back(beam.field(x, z));
            twice.push_back(2.0 * field.back());
            derivative.push_back(2.0 * beam.derivative(x, z, -contour.dz[i], contour.dx[i]));
        }
        result.field.push_back(std::move(field));
        result.twice_field.push_back(std::move(twice));
        result.twice_derivative.push_back(std::move(derivative));
    }
    return result;
}

/// Far fields of one realisation: per polarisation, per beam, per angle.
struct Realisation {
    std::array<std::vector<SurfaceField>, 2> exact, kirchhoff;
};

class ProfileStudy {
  public:
    ProfileStudy(const RoughnessStatistics& surface, const std::vector<double>& theta_i_deg,
                 const MomentSettings& settings)
        : surface_{surface}, settings_{settings}, angles_{scattering_angles()} {
        for (const double theta : theta_i_deg) beams_.emplace_back(theta * degree, settings.length / 4, k);
        nodes_ = static_cast<std::size_t>(std::lround(settings.length * settings.points_per_wavelength));
        const double margin = 8 * surface.correlation_length * settings.points_per_wavelength;
        while (static_cast<double>(period_) < static_cast<double>(nodes_) + margin) period_ *= 2;
    }

    [[nodiscard]] const std::vector<double>& angles() const { return angles_; }
    [[nodiscard]] const std::vector<TaperedBeam>& beams() const { return beams_; }

    [[nodiscard]] Realisation realisation(int number) const {
        const auto seed = seed_of(settings_.study, surface_number(), static_cast<std::uint64_t>(number));
        const double step = 1.0 / settings_.points_per_wavelength;
        const Contour contour = contour_of(random_profile(surface_, step, period_, seed), nodes_);
        const Lit light = lit(contour, beams_);
        const SurfaceFields fields = surface_fields(contour, k, light.field);
        const FarField far{contour, k, angles_};
        return {{far.te(fields.te), far.tm(fields.tm)},
                {far.te(light.twice_derivative), far.tm(light.twice_field)}};
    }

    [[nodiscard]] std::vector<Realisation> realisations() const {
        std::vector<Realisation> all(static_cast<std::size_t>(settings_.realisations));
#pragma omp parallel for schedule(dynamic, 1)
        for (int i = 0; i < settings_.realisations; ++i) all[static_cast<std::size_t>(i)] = realisation(i);
        return all;
    }

  private:
    /// A number for the surface, so that each has seeds of its own.
    [[nodiscard]] std::uint64_t surface_number() const {
        return static_cast<std::uint64_t>(std::lround(1e4 * surface_.rms_roughness)) * 1000000U +
               static_cast<std::uint64_t>(std::lround(1e4 * surface_.correlation_length));
    }

    RoughnessStatistics surface_;
    MomentSettings settings_;
    std::vector<double> angles_;
    std::vector<TaperedBeam> beams_;
    std::size_t nodes_ = 0, period_ = 64;
};

/// Sums over realisations at one angle.
struct Sums {
    double intensity = 0;
    Complex field;
    double count = 0;

    void add(Complex amplitude) {
        intensity += std::norm(amplitude);
        field += amplitude;
        ++count;
    }
    Sums& operator+=(const Sums& other) {
        intensity += other.intensity;
        field += other.field;
        count += other.count;
        return *this;
    }
    [[nodiscard]] double mean() const { return intensity / count; }
    /// Unbiased estimate of <|N|^2> - |<N>|^2.
    [[nodiscard]] double incoherent() const { return (intensity - std::norm(field) / count) / (count - 1); }
};

/// Of one polarisation and beam: sums per block of realisations and angle.
class Lobe {
  public:
    explicit Lobe(std::size_t angles) : blocks_(jackknife_blocks, std::vector<Sums>(angles)) {}

    void add(std::size_t realisation, const SurfaceField& amplitudes) {
        auto& block = blocks_[realisation % jackknife_blocks];
        for (std::size_t i = 0; i < amplitudes.size(); ++i) block[i].add(amplitudes[i]);
    }
    /// At one angle over all blocks but one; over all if there is no such block.
    [[nodiscard]] Sums without(std::size_t left_out, std::size_t angle) const {
        Sums sum;
        for (std::size_t b = 0; b < blocks_.size(); ++b) {
            if (b != left_out) sum += blocks_[b][angle];
        }
        return sum;
    }
    /// Mean over a bin of what is incoherent.
    [[nodiscard]] double incoherent(std::size_t bin, std::size_t left_out = jackknife_blocks) const {
        double sum = 0;
        for (std::size_t i = 0; i < angles_per_bin; ++i)
            sum += without(left_out, bin * angles_per_bin + i).incoherent();
        return sum / angles_per_bin;
    }
    /// Mean over all angles of everything, and of what is coherent.
    [[nodiscard]] double mean() const {
        return mean_of([](const Sums& s) { return s.mean(); });
    }
    [[nodiscard]] double coherent() const {
        return mean_of([](const Sums& s) { return s.mean() - s.incoherent(); });
    }

  private:
    template <class Quantity>
    [[nodiscard]] double mean_of(const Quantity& quantity) const {
        double sum = 0;
        for (std::size_t i = 0; i < blocks_[0].size(); ++i) sum += quantity(without(jackknife_blocks, i));
        return sum / static_cast<double>(blocks_[0].size());
    }

    std::vector<std::vector<Sums>> blocks_;
};

double decibels(double ratio) {
    return 10 * std::log10(ratio);
}

/// Standard error of the ratio of two lobes in a bin.
double ratio_error_db(const Lobe& exact, const Lobe& kirchhoff, std::size_t bin) {
    std::array<double, jackknife_blocks> ratios{};
    double mean = 0, squares = 0;
    for (std::size_t b = 0; b < jackknife_blocks; ++b) {
        ratios[b] = decibels(kirchhoff.incoherent(bin, b) / exact.incoherent(bin, b));
        mean += ratios[b] / jackknife_blocks;
    }
    for (const double ratio : ratios) squares += (ratio - mean) * (ratio - mean);
    return std::sqrt(squares * (jackknife_blocks - 1) / jackknife_blocks);
}

/// Closed form, averaged over the angles of a bin.
double model_lobe(ProfileModel model, const MomentCase& of, const std::vector<double>& angles,
                  std::size_t bin) {
    double sum = 0;
    for (std::size_t i = 0; i < angles_per_bin; ++i)
        sum += profile_lobe(model, of.surface, of.theta_i_deg * degree, angles[bin * angles_per_bin + i]);
    return sum / angles_per_bin;
}

/// Lobes of one polarisation under one beam.
struct LobePair {
    Lobe exact, kirchhoff;

    LobePair(const std::vector<Realisation>& all, Polarisation polarisation, std::size_t beam,
             std::size_t angles)
        : exact{angles}, kirchhoff{angles} {
        const auto p = static_cast<std::size_t>(polarisation);
        for (std::size_t i = 0; i < all.size(); ++i) {
            exact.add(i, all[i].exact[p][beam]);
            kirchhoff.add(i, all[i].kirchhoff[p][beam]);
        }
    }
};

MomentResult result_of(const MomentCase& of, const LobePair& lobes, const std::vector<double>& angles,
                       double power, int realisations) {
    const double per_radian = 1 / (8 * pi * k * power);
    MomentResult result{of,
                        realisations,
                        pi * per_radian * lobes.exact.mean(),
                        pi * per_radian * lobes.exact.coherent(),
                        pi * per_radian * lobes.kirchhoff.mean(),
                        {}};
    for (std::size_t bin = 0; bin < bin_count; ++bin) {
        AngularBin one{(static_cast<double>(bin) + 0.5) * bin_width_deg - 90,
                       per_radian * lobes.exact.incoherent(bin),
                       per_radian * lobes.kirchhoff.incoherent(bin),
                       {},
                       ratio_error_db(lobes.exact, lobes.kirchhoff, bin)};
        for (std::size_t m = 0; m < profile_models.size(); ++m)
            one.model[m] = model_lobe(profile_models[m], of, angles, bin);
        result.bins.push_back(one);
    }
    return result;
}

/// Half of each.
MomentResult unpolarised(const MomentResult& te, const MomentResult& tm) {
    MomentResult both = te;
    both.of.polarisation = Polarisation::unpolarised;
    both.energy = (te.energy + tm.energy) / 2;
    both.mirror = (te.mirror + tm.mirror) / 2;
    both.kirchhoff_energy = (te.kirchhoff_energy + tm.kirchhoff_energy) / 2;
    for (std::size_t i = 0; i < both.bins.size(); ++i) {
        const AngularBin &a = te.bins[i], &b = tm.bins[i];
        both.bins[i].exact = (a.exact + b.exact) / 2;
        both.bins[i].kirchhoff = (a.kirchhoff + b.kirchhoff) / 2;
        both.bins[i].ratio_error_db = (a.ratio_error_db + b.ratio_error_db) / 2;
    }
    return both;
}

/// Weighted with the exact energy, and the median where it is bright.
Distance distance_of(const MomentResult& result, const std::function<double(const AngularBin&)>& ratio) {
    double weight = 0, squares = 0, sum = 0, brightest = 0;
    for (const AngularBin& bin : result.bins) brightest = std::max(brightest, bin.exact);
    std::vector<double> bright;
    for (const AngularBin& bin : result.bins) {
        if (!(bin.exact > 0) || !(bin.kirchhoff > 0)) continue;
        const double difference = decibels(ratio(bin));
        if (bin.exact > brightest / 100) bright.push_back(std::fabs(difference));
        weight += bin.exact;
        sum += bin.exact * difference;
        squares += bin.exact * difference * difference;
    }
    const auto middle = bright.begin() + static_cast<std::ptrdiff_t>(bright.size() / 2);
    std::nth_element(bright.begin(), middle, bright.end());
    return {std::sqrt(squares / weight), *middle, sum / weight};
}

}  // namespace

const char* name(Polarisation polarisation) noexcept {
    constexpr std::array names{"te", "tm", "unpolarised"};
    return names[static_cast<std::size_t>(polarisation)];
}

std::vector<MomentResult> moment_results(const RoughnessStatistics& surface,
                                         const std::vector<double>& theta_i_deg,
                                         const MomentSettings& settings) {
    if (settings.realisations < 2 * jackknife_blocks)
        throw out_of_range("realisations", settings.realisations, "",
                           "at least " + std::to_string(2 * jackknife_blocks));
    const ProfileStudy study{surface, theta_i_deg, settings};
    const auto all = study.realisations();
    std::vector<MomentResult> results;
    for (std::size_t beam = 0; beam < theta_i_deg.size(); ++beam) {
        for (const Polarisation polarisation : {Polarisation::te, Polarisation::tm}) {
            const LobePair lobes{all, polarisation, beam, study.angles().size()};
            results.push_back(result_of({surface, theta_i_deg[beam], polarisation}, lobes, study.angles(),
                                        study.beams()[beam].power(), settings.realisations));
        }
        results.push_back(unpolarised(results[results.size() - 2], results.back()));
    }
    return results;
}

Distance distance(const MomentResult& result, ProfileModel model) {
    const auto m = static_cast<std::size_t>(model);
    return distance_of(result, [m](const AngularBin& bin) {
        return bin.model[m] / bin.model[0] * (bin.kirchhoff / bin.exact);
    });
}

Distance kirchhoff_distance(const MomentResult& result) {
    return distance_of(result, [](const AngularBin& bin) { return bin.kirchhoff / bin.model[0]; });
}

double chance(const MomentResult& result) {
    double weight = 0, squares = 0;
    for (const AngularBin& bin : result.bins) {
        weight += bin.exact;
        squares += bin.exact * bin.ratio_error_db * bin.ratio_error_db;
    }
    return std::sqrt(squares / weight);
}

}  // namespace hts::validation

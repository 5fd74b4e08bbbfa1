#include "validation/scattering/moment_method.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "hts/error.hpp"
#include "spectral/jobs/progress.hpp"
#include "spectral/statistics.hpp"
#include "validation/scattering/moment_log.hpp"
#include "validation/scattering/profile_study.hpp"

namespace hts::validation {
namespace {

using Complex = std::complex<double>;

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180;
constexpr int jackknife_blocks = 10;

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

/// One polarisation under one beam, or both.
class PolarisedLobes {
  public:
    PolarisedLobes(const MomentCase& of, const std::vector<double>& angles, double power)
        : of_{of}, power_{power}, exact_{angles.size()}, kirchhoff_{angles.size()} {
        const ProfileHeights heights{of.surface};
        for (const double angle : angles) {
            reflectances_.push_back(facet_reflectance(of, (of.theta_i_deg * degree + angle) / 2));
            for (std::size_t m = 0; m < profile_models.size(); ++m)
                lobes_[m].push_back(reflectances_.back() *
                                    profile_lobe(profile_models[m], heights, of.theta_i_deg * degree, angle));
        }
    }

    void add(std::size_t number, const Scattered& scattered, std::size_t beam) {
        exact_.add(number, scattered.exact[beam]);
        SurfaceField kirchhoff = scattered.kirchhoff[beam];
        for (std::size_t i = 0; i < kirchhoff.size(); ++i) kirchhoff[i] *= std::sqrt(reflectances_[i]);
        kirchhoff_.add(number, kirchhoff);
        past_ends_ += scattered.past_ends[beam] / power_;
        transmitted_ += scattered.transmitted[beam] / power_;
        ++count_;
    }

    [[nodiscard]] MomentResult result() const {
        const double per_radian = 1 / (8 * pi * wave_number * power_), past = past_ends_ / count_,
                     transmitted = transmitted_ / count_;
        MomentResult result{of_,
                            count_,
                            pi * per_radian * exact_.mean() + past + transmitted,
                            pi * per_radian * exact_.coherent(),
                            past,
                            transmitted,
                            pi * per_radian * kirchhoff_.mean(),
                            {}};
        for (std::size_t bin = 0; bin < bin_count; ++bin) {
            AngularBin one{(static_cast<double>(bin) + 0.5) * bin_width_deg - 90,
                           per_radian * exact_.incoherent(bin),
                           per_radian * kirchhoff_.incoherent(bin),
                           {},
                           0};
            for (std::size_t m = 0; m < profile_models.size(); ++m) one.model[m] = model(m, bin);
            result.bins.push_back(one);
        }
        return result;
    }

    /// Lobes in a bin without a block of the realisations.
    [[nodiscard]] double exact(std::size_t bin, std::size_t left_out) const {
        return exact_.incoherent(bin, left_out);
    }
    [[nodiscard]] double kirchhoff(std::size_t bin, std::size_t left_out) const {
        return kirchhoff_.incoherent(bin, left_out);
    }

  private:
    /// Closed form, averaged over the angles of a bin.
    [[nodiscard]] double model(std::size_t m, std::size_t bin) const {
        double sum = 0;
        for (std::size_t i = 0; i < angles_per_bin; ++i) sum += lobes_[m][bin * angles_per_bin + i];
        return sum / angles_per_bin;
    }

    MomentCase of_;
    double power_;
    std::vector<double> reflectances_;  // per angle
    std::array<std::vector<double>, profile_models.size()> lobes_;
    Lobe exact_, kirchhoff_;
    double past_ends_ = 0, transmitted_ = 0;
    int count_ = 0;
};

/// Standard error of the ratio of two lobes in a bin, each summed over polarisations.
double ratio_error_db(const std::vector<const PolarisedLobes*>& lobes, std::size_t bin) {
    std::array<double, jackknife_blocks> ratios{};
    double mean = 0, squares = 0;
    for (std::size_t b = 0; b < jackknife_blocks; ++b) {
        double kirchhoff = 0, exact = 0;
        for (const PolarisedLobes* each : lobes) {
            kirchhoff += each->kirchhoff(bin, b);
            exact += each->exact(bin, b);
        }
        ratios[b] = decibels(kirchhoff / exact);
        mean += ratios[b] / jackknife_blocks;
    }
    for (const double ratio : ratios) squares += (ratio - mean) * (ratio - mean);
    return std::sqrt(squares * (jackknife_blocks - 1) / jackknife_blocks);
}

/// Half of each.
MomentResult unpolarised(const MomentResult& te, const MomentResult& tm) {
    MomentResult both = te;
    const auto halve = [](double& value, double other) { value = (value + other) / 2; };
    both.of.polarisation = Polarisation::unpolarised;
    halve(both.energy, tm.energy);
    halve(both.mirror, tm.mirror);
    halve(both.past_ends, tm.past_ends);
    halve(both.transmitted, tm.transmitted);
    halve(both.kirchhoff_energy, tm.kirchhoff_energy);
    for (std::size_t i = 0; i < both.bins.size(); ++i) {
        halve(both.bins[i].exact, tm.bins[i].exact);
        halve(both.bins[i].kirchhoff, tm.bins[i].kirchhoff);
        for (std::size_t m = 0; m < profile_models.size(); ++m)
            halve(both.bins[i].model[m], tm.bins[i].model[m]);
    }
    return both;
}

/// In the three polarisations.
std::vector<MomentResult> results_of(const PolarisedLobes& te, const PolarisedLobes& tm) {
    std::vector<MomentResult> results{te.result(), tm.result()};
    results.push_back(unpolarised(results[0], results[1]));
    const std::array<std::vector<const PolarisedLobes*>, 3> summed{{{&te}, {&tm}, {&te, &tm}}};
    for (std::size_t i = 0; i < results.size(); ++i) {
        for (std::size_t bin = 0; bin < bin_count; ++bin)
            results[i].bins[bin].ratio_error_db = ratio_error_db(summed[i], bin);
    }
    return results;
}

/// Weighted with the exact energy, and the median where it is bright.
Distance distance_of(const MomentResult& result, const std::function<double(const AngularBin&)>& ratio) {
    double weight = 0, squares = 0, sum = 0, brightest = 0;
    for (const AngularBin& bin : result.bins) brightest = std::max(brightest, bin.exact);
    std::vector<double> bright;
    for (const AngularBin& bin : result.bins) {
        if (!(bin.exact > 0) || !(bin.kirchhoff > 0) || bin.model[0] < least_light) continue;
        const double difference = decibels(ratio(bin));
        if (bin.exact > brightest / 100) bright.push_back(std::fabs(difference));
        weight += bin.exact;
        sum += bin.exact * difference;
        squares += bin.exact * difference * difference;
    }
    if (bright.empty()) return {0, 0, 0};
    const double middle = spectral::in_order(bright, bright.size() / 2);
    return {std::sqrt(squares / weight), middle, sum / weight};
}

}  // namespace

const char* name(Polarisation polarisation) noexcept {
    constexpr std::array names{"te", "tm", "unpolarised"};
    return names[static_cast<std::size_t>(polarisation)];
}

double facet_reflectance(const MomentCase& of, double theta_d) {
    if (!of.index) return 1;
    const FresnelAmplitudes amplitudes = fresnel(std::cos(theta_d), *of.index);
    switch (of.polarisation) {
        case Polarisation::te:
            return std::norm(amplitudes.s);
        case Polarisation::tm:
            return std::norm(amplitudes.p);
        default:
            return amplitudes.unpolarised_reflectance();
    }
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
        const auto lobes = [&](Polarisation polarisation) {
            PolarisedLobes sums{{surface, theta_i_deg[beam], polarisation, settings.index},
                                study.angles(),
                                study.beams()[beam].power()};
            for (std::size_t i = 0; i < all.size(); ++i)
                sums.add(i, all[i][static_cast<std::size_t>(polarisation)], beam);
            return sums;
        };
        const auto three = results_of(lobes(Polarisation::te), lobes(Polarisation::tm));
        results.insert(results.end(), three.begin(), three.end());
    }
    return results;
}

std::vector<MomentResult> moment_results(const std::vector<LitSurface>& surfaces,
                                         const MomentSettings& settings, const std::string& unfinished) {
    MomentLog log{unfinished, settings};
    std::vector<MomentResult> results;
    const spectral::Job job{"", surfaces.size()};
    for (const auto& [surface, angles] : surfaces) {
        auto some = log.found(surface, angles);
        if (some.empty()) log.add(some = moment_results(surface, angles, settings));
        results.insert(results.end(), some.begin(), some.end());
        job.done();
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

#include "validation/scattering/vector/vector_results.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "hts/error.hpp"
#include "spectral/parallel.hpp"
#include "spectral/statistics.hpp"

namespace hts::validation {
namespace {

constexpr double pi = std::numbers::pi, degree = pi / 180;
constexpr std::array azimuth_limits_deg{0.0, 21.0, 69.0, 111.0, 159.0, 180.0};
constexpr double polar_width_deg = 10;

/// Sums over realisations of what goes into a direction.
struct Sums {
    std::array<double, channels.size()> intensity{};
    std::array<std::complex<double>, 2> field{};
    std::array<double, 2> squares{};  // of the fields' moduli

    void add(const std::array<float, channels.size()>& of, const std::array<std::complex<float>, 2>& fields,
             double sign = 1) {
        for (std::size_t c = 0; c < of.size(); ++c) intensity[c] += sign * of[c];
        for (std::size_t q = 0; q < 2; ++q) {
            field[q] += sign * std::complex<double>{fields[q]};
            squares[q] += sign * std::norm(std::complex<double>{fields[q]});
        }
    }
    /// Unbiased estimate of what is coherent, in ss or pp.
    [[nodiscard]] double coherent(std::size_t q, double count) const {
        return (std::norm(field[q]) - squares[q]) / (count * (count - 1));
    }
    [[nodiscard]] Channels incoherent(double count) const {
        Channels mean;
        for (const Channel c : channels) mean[c] = intensity[static_cast<std::size_t>(c)] / count;
        mean[Channel::ss] -= coherent(0, count);
        mean[Channel::pp] -= coherent(1, count);
        return mean;
    }
};

/// Exact and Kirchhoff's, by direction.
struct GridSums {
    std::vector<Sums> exact, kirchhoff;
};

/// Index of the bin of each polar step and azimuth step.
std::size_t bin_of(int polar_step, int azimuth_step) {
    const auto polar = static_cast<std::size_t>(polar_angle(polar_step) / degree / polar_width_deg);
    const double phi = azimuth(azimuth_step) / degree;
    std::size_t sector = 0;
    while (phi > azimuth_limits_deg[sector + 1]) ++sector;
    return polar * (azimuth_limits_deg.size() - 1) + sector;
}

std::size_t place(int polar_step, int azimuth_step) {
    return std::size_t{azimuth_steps} * static_cast<std::size_t>(polar_step) +
           static_cast<std::size_t>(azimuth_step);
}

/// Means over bins of what `at` says of a direction.
template <class At>
std::vector<Channels> bin_means(const At& at) {
    const std::size_t count = vector_bins().size();
    std::vector<Channels> means(count);
    std::vector<double> weights(count);
    for (int i = 0; i < polar_steps; ++i) {
        for (int j = 0; j < azimuth_steps; ++j) {
            const std::size_t bin = bin_of(i, j);
            means[bin].add(solid_angle(i), at(place(i, j)));
            weights[bin] += solid_angle(i);
        }
    }
    for (std::size_t bin = 0; bin < count; ++bin) {
        for (double& value : means[bin].values) value /= weights[bin];
    }
    return means;
}

/// Incoherent means over bins: of all, and with each realisation left out.
struct LeftOut {
    std::vector<Channels> all;
    std::vector<std::vector<Channels>> without;
};

LeftOut left_out(const std::vector<VectorRealisation>& realisations, std::size_t grid, bool exact) {
    std::vector<Sums> sums(realisations[0].grids[grid].size());
    const auto add = [&](Sums& to, const Scatter& from, double sign) {
        to.add(exact ? from.exact : from.kirchhoff, exact ? from.exact_field : from.kirchhoff_field, sign);
    };
    for (const VectorRealisation& each : realisations) {
        for (std::size_t i = 0; i < sums.size(); ++i) add(sums[i], each.grids[grid][i], 1);
    }
    const auto count = static_cast<double>(realisations.size());
    LeftOut result{bin_means([&](std::size_t i) { return sums[i].incoherent(count); }), {}};
    for (const VectorRealisation& each : realisations) {
        result.without.push_back(bin_means([&](std::size_t i) {
            Sums rest = sums[i];
            add(rest, each.grids[grid][i], -1);
            return rest.incoherent(count - 1);
        }));
    }
    return result;
}

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Mean, and its standard error, with and without the control variate.
struct Estimate {
    double mean, error, plain_error;
};

/// By the values of a jackknife.
///   exact, kirchhoff   of all, then with each realisation left out
Estimate controlled(double exact, double kirchhoff, double closed, const std::vector<double>& exact_without,
                    const std::vector<double>& kirchhoff_without) {
    const auto count = static_cast<double>(exact_without.size());
    const double e = mean(exact_without), k = mean(kirchhoff_without);
    double ee = 0, ek = 0, kk = 0;
    for (std::size_t i = 0; i < exact_without.size(); ++i) {
        ee += (exact_without[i] - e) * (exact_without[i] - e);
        ek += (exact_without[i] - e) * (kirchhoff_without[i] - k);
        kk += (kirchhoff_without[i] - k) * (kirchhoff_without[i] - k);
    }
    const double slope = kk > 0 ? ek / kk : 0;
    const double jackknife = (count - 1) / count;
    return {exact - slope * (kirchhoff - closed),
            std::sqrt(std::max(0.0, ee - slope * ek) * jackknife * (count - 1) / (count - 2)),
            std::sqrt(ee * jackknife)};
}

double decibels(double ratio) {
    return 10 * std::log10(ratio);
}

/// Of everything that goes up in s and in p incident light, per realisation.
std::array<double, 2> energy(const ScatterGrid& grid) {
    std::array<double, 2> sum{};
    for (int i = 0; i < polar_steps; ++i) {
        for (int j = 0; j < azimuth_steps; ++j) {
            const auto& exact = grid[place(i, j)].exact;
            sum[0] += solid_angle(i) * (double{exact[0]} + exact[2]);
            sum[1] += solid_angle(i) * (double{exact[1]} + exact[3]);
        }
    }
    return sum;
}

/// What is coherent, summed over all directions.
std::array<double, 2> mirrored(const std::vector<VectorRealisation>& all, std::size_t grid) {
    std::array<double, 2> sum{};
    for (int i = 0; i < polar_steps; ++i) {
        for (int j = 0; j < azimuth_steps; ++j) {
            Sums of;
            for (const VectorRealisation& each : all) {
                const Scatter& at = each.grids[grid][place(i, j)];
                of.add(at.exact, at.exact_field);
            }
            for (std::size_t q = 0; q < 2; ++q)
                sum[q] += solid_angle(i) * of.coherent(q, static_cast<double>(all.size()));
        }
    }
    return sum;
}

VectorResult result_of(const VectorCase& of, const VectorSettings& settings,
                       const std::vector<VectorRealisation>& all, std::size_t grid) {
    VectorResult result{of,           static_cast<int>(all.size()), 0, {}, mirrored(all, grid), {}, 0, 0,
                        vector_bins()};
    const auto count = static_cast<double>(all.size());
    std::array<double, 2> squares{};
    for (const VectorRealisation& each : all) {
        result.iterations += static_cast<double>(each.iterations) / count;
        const auto share = energy(each.grids[grid]);
        for (std::size_t q = 0; q < 2; ++q) {
            result.energy[q] += share[q] / count;
            squares[q] += share[q] * share[q] / count;
        }
    }
    for (std::size_t q = 0; q < 2; ++q)
        result.energy_error[q] =
            std::sqrt(std::max(0.0, squares[q] - result.energy[q] * result.energy[q]) / (count - 1));
    const LeftOut exact = left_out(all, grid, true), kirchhoff = left_out(all, grid, false);
    const auto closed = binned(ClosedForms{of.surface.surface()}, of, settings);
    std::vector<double> gains;
    double weight = 0, distance = 0;
    for (std::size_t bin = 0; bin < result.bins.size(); ++bin) {
        for (const Channel c : channels) {
            std::vector<double> e, k;
            for (std::size_t i = 0; i < all.size(); ++i) {
                e.push_back(exact.without[i][bin][c]);
                k.push_back(kirchhoff.without[i][bin][c]);
            }
            const Estimate estimate =
                controlled(exact.all[bin][c], kirchhoff.all[bin][c], closed[bin][0][c], e, k);
            result.bins[bin].exact[c] = estimate.mean;
            result.bins[bin].error[c] = estimate.error;
            if (estimate.error > 0)
                gains.push_back(estimate.plain_error * estimate.plain_error /
                                (estimate.error * estimate.error));
        }
        double of_realisations = 0, of_closed_form = 0;
        for (const Channel c : channels) {
            of_realisations += kirchhoff.all[bin][c];
            of_closed_form += closed[bin][0][c];
        }
        if (!(of_realisations > 0) || result.bins[bin].most_theta_deg > most_compared_theta_deg) continue;
        const double energy = result.bins[bin].solid_angle() * of_realisations,
                     off = decibels(of_realisations / of_closed_form);
        weight += energy;
        distance += energy * off * off;
    }
    result.kirchhoff_db = std::sqrt(distance / weight);
    result.gain = spectral::median(gains);
    return result;
}

/// Gauss and Legendre's places and weights, three of them.
struct Node {
    double place, weight;  // -1 … 1, the weights add up to 1
};
constexpr std::array nodes{Node{-0.7745966692414834, 5.0 / 18}, Node{0, 8.0 / 18},
                           Node{0.7745966692414834, 5.0 / 18}};

}  // namespace

double VectorBin::solid_angle() const noexcept {
    return 2 * (most_phi_deg - phi_deg) * degree *
           (std::cos(theta_deg * degree) - std::cos(most_theta_deg * degree));
}

std::vector<VectorBin> vector_bins() {
    std::vector<VectorBin> bins;
    for (int polar = 0; polar < 9; ++polar) {
        for (std::size_t sector = 0; sector + 1 < azimuth_limits_deg.size(); ++sector)
            bins.push_back({polar * polar_width_deg,
                            (polar + 1) * polar_width_deg,
                            azimuth_limits_deg[sector],
                            azimuth_limits_deg[sector + 1],
                            {},
                            {}});
    }
    return bins;
}

std::vector<std::array<Channels, vector_models.size()>> binned(const ClosedForms& forms, const VectorCase& of,
                                                               const VectorSettings& settings) {
    // the beam's Gaussian by steps of 1.6 of its standard deviations: its sums are exact to 1e-3
    const double forward = of.azimuth_deg * degree, width = settings.beam_width();
    const PlaneWaveBeam beam{of.theta_i_deg * degree, forward, width, 4 * width, 0.03};
    const auto bins = vector_bins();
    std::vector<std::array<Channels, vector_models.size()>> means(bins.size());
    spectral::parallel_for(bins.size(), [&](std::size_t bin) {
        const VectorBin& limits = bins[bin];
        double all = 0;
        const auto within = [](double from, double to, const Node& node) {
            return ((from + to) + (to - from) * node.place) / 2 * degree;
        };
        for (const Node& polar : nodes) {
            const double theta = within(limits.theta_deg, limits.most_theta_deg, polar);
            for (const Node& round : nodes) {
                const double phi = within(limits.phi_deg, limits.most_phi_deg, round);
                const double weight = std::sin(theta) * polar.weight * round.weight;
                const auto some = forms.lobes(beam, Direction::from_angles(theta, forward + phi));
                for (std::size_t m = 0; m < some.size(); ++m) means[bin][m].add(weight, some[m]);
                all += weight;
            }
        }
        for (Channels& each : means[bin]) {
            for (double& value : each.values) value /= all;
        }
    });
    return means;
}

std::vector<VectorResult> vector_results(const VectorSurface& surface, const VectorSettings& settings,
                                         const std::vector<VectorRealisation>& all) {
    if (all.size() < 3) throw out_of_range("realisations", static_cast<double>(all.size()), "", "at least 3");
    std::vector<VectorResult> results;
    for (std::size_t grid = 0; grid < all[0].grids.size(); ++grid) {
        const std::size_t angles = settings.theta_i_deg.size();
        results.push_back(
            result_of({surface, vector_azimuths_deg[grid / angles], settings.theta_i_deg[grid % angles]},
                      settings, all, grid));
    }
    return results;
}

const char* name(VectorLight light) noexcept {
    constexpr std::array names{"ss", "pp", "cross", "unpolarised"};
    return names[static_cast<std::size_t>(light)];
}

double of(const Channels& each, VectorLight light) noexcept {
    const double cross = (each[Channel::sp] + each[Channel::ps]) / 2;
    switch (light) {
        case VectorLight::ss:
            return each[Channel::ss];
        case VectorLight::pp:
            return each[Channel::pp];
        case VectorLight::cross:
            return cross;
        default:
            return (each[Channel::ss] + each[Channel::pp]) / 2 + cross;
    }
}

double error_of(const VectorBin& bin, VectorLight light) noexcept {
    double squares = 0;
    for (const Channel c : channels) {
        Channels one;
        one[c] = bin.error[c];
        squares += std::pow(of(one, light), 2);
    }
    return std::sqrt(squares);
}

const char* name(VectorRegion region) noexcept {
    constexpr std::array names{"all", "in_plane", "out_of_plane"};
    return names[static_cast<std::size_t>(region)];
}

VectorDistance distance(const std::vector<VectorBin>& exact, const std::vector<Channels>& model,
                        VectorLight light, VectorRegion region) {
    double weight = 0, squares = 0, sum = 0, chance = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        const VectorBin& bin = exact[i];
        const bool in_plane = bin.phi_deg == 0 || bin.most_phi_deg == 180;
        if (bin.most_theta_deg > most_compared_theta_deg ||
            (region != VectorRegion::all && in_plane != (region == VectorRegion::in_plane)))
            continue;
        const double power = of(bin.exact, light), own = of(model[i], light);
        if (!(power > 0) || !(own > 0)) continue;
        const double energy = power * bin.solid_angle(), off = decibels(own / power),
                     error_db = decibels(std::numbers::e) * error_of(bin, light) / power;
        weight += energy;
        sum += energy * off;
        squares += energy * off * off;
        chance += energy * error_db * error_db;
    }
    if (!(weight > 0)) {
        const double none = std::numeric_limits<double>::quiet_NaN();
        return {none, none, none};
    }
    return {std::sqrt(squares / weight), sum / weight, std::sqrt(chance / weight)};
}

}  // namespace hts::validation

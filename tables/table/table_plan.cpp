// How many nodes a table needs.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "hts/error.hpp"
#include "spectral/models/symmetry.hpp"
#include "spectral/parallel.hpp"
#include "tables/table/build_table.hpp"
#include "tables/table/lobe_nodes.hpp"
#include "tables/table/spline.hpp"
#include "tables/table/table_lobe.hpp"
#include "tables/table/table_probes.hpp"

namespace hts::tables {
namespace {

constexpr double floor_below_peak = 1e-12, lowest_floor = 1e-30;
constexpr std::size_t probe_wavelengths = 64;
constexpr std::size_t block = 256;

std::vector<double> floors(const LobePeaks& peaks, std::size_t wavelengths) {
    std::vector<double> floor(wavelengths);
    for (std::size_t w = 0; w < wavelengths; ++w) {
        floor[w] = std::max(lowest_floor, floor_below_peak * peaks.least(w));
    }
    return floor;
}

/// Few spectra of which that of any direction is a sum, to a small part of the tolerance.
std::vector<double> basis_of(const spectral::Reflectance& exact, const TableRequest& request,
                             const LobePeaks& peaks, const std::vector<double>& floor) {
    constexpr double share = 0.1;
    constexpr std::size_t most_pairs = 16384, most_values = std::size_t{1} << 21;
    const std::size_t width = floor.size();
    const auto pairs =
        RandomPairs{request.seed}.next(std::clamp(most_values / width, std::size_t{256}, most_pairs));
    std::vector<double> spectra(pairs.size() * width), weights(spectra.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const auto values = std::span{spectra}.subspan(i * width, width);
        exact.directional_diffuse(pairs[i], values);
        for (std::size_t w = 0; w < width; ++w) {
            weights[i * width + w] = values[w] / error_scale(values[w], peaks(pairs[i].in, w));
            values[w] = std::log(std::max(0.0, values[w]) + floor[w]);
        }
    }
    auto basis = spectral_basis(std::move(spectra), weights, width, share * request.tolerance);
    if (basis.size() > most_components * width) {
        throw Error{exact.name() + ": its spectra are sums of more than " + std::to_string(most_components) +
                    " others: the tolerance must be one that fewer can meet"};
    }
    return basis;
}

/// Both ends and some between.
std::vector<std::size_t> some_of(std::size_t wavelengths) {
    std::vector<std::size_t> chosen;
    const std::size_t count = std::min(wavelengths, probe_wavelengths);
    for (std::size_t i = 0; i < count; ++i) {
        chosen.push_back(count == 1 ? 0 : i * (wavelengths - 1) / (count - 1));
    }
    return chosen;
}

/// Random pairs with their exact values, at some of the wavelengths.
struct Probes {
    std::vector<DirectionPair> pairs;
    std::vector<double> lobe, scale;  // wavelengths side by side
};

/// Grids tried on random directions, at some of the wavelengths.
class Trials {
  public:
    Trials(const spectral::Reflectance& exact, const LobePeaks& peaks, const std::vector<double>& floor,
           const std::vector<double>& basis)
        : exact_{exact}, peaks_{peaks}, chosen_{some_of(floor.size())}, floor_{floor}, basis_{basis} {
        for (std::size_t from = 0; from < basis.size(); from += floor.size()) {
            for (const std::size_t w : chosen_) chosen_basis_.push_back(basis[from + w]);
        }
    }

    [[nodiscard]] Probes probes(std::vector<DirectionPair> pairs) const {
        const std::size_t width = chosen_.size();
        Probes probes{std::move(pairs), {}, {}};
        probes.lobe.resize(probes.pairs.size() * width);
        probes.scale.resize(probes.lobe.size());
        spectral::parallel_blocks(probes.pairs.size(), block, [&](std::size_t first, std::size_t count) {
            std::vector<double> values(exact_.wavelengths().size());
            for (std::size_t i = first; i < first + count; ++i) {
                exact_.directional_diffuse(probes.pairs[i], values);
                for (std::size_t w = 0; w < width; ++w) {
                    probes.lobe[i * width + w] = values[chosen_[w]];
                    probes.scale[i * width + w] =
                        error_scale(values[chosen_[w]], peaks_(probes.pairs[i].in, chosen_[w]));
                }
            }
        });
        return probes;
    }

    /// The error of a grid at each probe, the largest of its wavelengths.
    [[nodiscard]] std::vector<double> errors(const Probes& probes, const LobeNodes& nodes,
                                             const TableSpacing& spacing) const {
        std::vector<std::vector<double>> slices(nodes[0]);
        spectral::parallel_for(nodes[0], [&](std::size_t i) {
            slices[i] = slice_values(exact_, spacing, nodes, i, floor_, basis_);
        });
        const std::vector<double> coefficients = lobe_coefficients(slices, nodes, components());
        const CoordinateMap map{spacing};
        std::vector<double> errors(probes.pairs.size());
        const auto measure = [&](std::size_t i) {
            errors[i] = pair_error(coefficients, lobe_place<double>(map(probes.pairs[i]), nodes), probes, i);
        };
        spectral::parallel_for(errors.size(), measure, block);
        return errors;
    }

  private:
    [[nodiscard]] double pair_error(const std::vector<double>& coefficients, const LobePlace<double>& place,
                                    const Probes& probes, std::size_t pair) const noexcept {
        const LobeSpline<double> spline{chosen_basis_.data(), coefficients.data(), components(),
                                        chosen_.size()};
        double worst = 0;
        spline.visit(place, [&](std::size_t first, const double* logarithms, std::size_t width) {
            for (std::size_t w = first; w < first + width; ++w) {
                const std::size_t at = pair * chosen_.size() + w;
                const double value = std::exp(logarithms[w - first]) - floor_[chosen_[w]];
                worst = std::max(worst, std::abs(value - probes.lobe[at]) / probes.scale[at]);
            }
        });
        return worst;
    }
    [[nodiscard]] std::size_t components() const noexcept { return basis_.size() / floor_.size(); }

    const spectral::Reflectance& exact_;
    const LobePeaks& peaks_;
    std::vector<std::size_t> chosen_;
    const std::vector<double>& floor_;
    const std::vector<double>& basis_;
    std::vector<double> chosen_basis_;
};

double size(const LobeNodes& nodes) {
    return std::accumulate(nodes.begin(), nodes.end(), 1.0, [](double product, std::size_t n) {
        return product * static_cast<double>(n + spline_ghosts);
    });
}

/// A grid and what it gives.
struct Tried {
    LobeNodes nodes;
    TableSpacing spacing;
    double error;
};

/// Grows and shrinks a grid until it is as large as the error needs: on a set of probes, which takes in what
/// was worst on others until nothing worse turns up.
class Search {
  public:
    Search(const Trials& trials, const TableRequest& request, double bytes_per_node, const std::string& name,
           const TableProgress& progress)
        : trials_{trials},
          request_{request},
          bytes_per_node_{bytes_per_node},
          name_{name},
          progress_{progress},
          random_{request.seed},
          probes_{trials.probes(random_.next(first_pairs))},
          now_{tried({8, 8, 8}, {})},
          first_error_{now_.error} {}

    [[nodiscard]] Tried found() {
        grow_to(coarse_factor * target());
        choose_spacing();
        do {
            grow_to(target());
            shrink();
        } while (fails_elsewhere());
        return now_;
    }

  private:
    static constexpr std::size_t first_pairs = 16384, other_pairs = 131072;
    static constexpr double target_share = 0.75;  // of the tolerance, on the probes
    static constexpr double worse_share = 0.85;   // on other directions
    static constexpr double kept_share = 0.5;     // a probe must be so much of the tolerance
    static constexpr double coarse_factor = 10;   // the spacing is chosen at so many times the target
    static constexpr double growth = 1.25, worth = 0.3;

    [[nodiscard]] Tried tried(const LobeNodes& nodes, const TableSpacing& spacing) const {
        return {nodes, spacing, std::ranges::max(trials_.errors(probes_, nodes, spacing))};
    }
    [[nodiscard]] double target() const { return target_share * request_.tolerance; }

    /// Whether other directions, in several rounds, are worse than the probes; at last those that the
    /// finished table is measured on.
    bool fails_elsewhere() {
        constexpr int rounds = 5;
        for (int round = 0; round < rounds; ++round) {
            if (take_in_worse(random_.next(other_pairs))) return true;
        }
        return take_in_worse(RandomPairs{measured_seed(request_.seed)}.next(measured_pairs));
    }

    /// Measures the grid on other directions; whether it failed there. The worst become probes.
    bool take_in_worse(std::vector<DirectionPair> pairs_to_try) {
        const Probes others = trials_.probes(std::move(pairs_to_try));
        const std::vector<double> errors = trials_.errors(others, now_.nodes, now_.spacing);
        if (std::ranges::max(errors) <= worse_share * request_.tolerance) return false;
        std::vector<DirectionPair> pairs = probes_.pairs;
        for (std::size_t i = 0; i < errors.size(); ++i) {
            if (errors[i] > kept_share * request_.tolerance) pairs.push_back(others.pairs[i]);
        }
        probes_ = trials_.probes(std::move(pairs));
        now_ = tried(now_.nodes, now_.spacing);
        return true;
    }

    /// The axis whose nodes lower the error most for their bytes; all of them where none is worth it alone.
    void grow_to(double target) {
        while (now_.error > target) {
            report();
            Tried best = now_;
            double best_gain = worth;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const Tried next = tried(scaled(now_.nodes, axis, growth), now_.spacing);
                const double gain =
                    std::log(now_.error / next.error) / std::log(size(next.nodes) / size(now_.nodes));
                if (gain > best_gain) {
                    best = next;
                    best_gain = gain;
                }
            }
            if (best.nodes == now_.nodes) {
                LobeNodes all = now_.nodes;
                for (std::size_t axis = 0; axis < 3; ++axis) all = scaled(all, axis, 1.1);
                best = tried(all, now_.spacing);
            }
            now_ = best;
            require_size();
        }
    }

    void choose_spacing() {
        for (const double grazing : {2.0, 8.0}) take_if_better({grazing, now_.spacing.turn});
        for (const double turn : {1.5, 6.0, 12.0}) take_if_better({now_.spacing.grazing, turn});
    }

    void take_if_better(const TableSpacing& spacing) {
        const Tried other = tried(now_.nodes, spacing);
        if (other.error < 0.9 * now_.error) now_ = other;
    }

    /// Fewer nodes on every axis as long as the target is met.
    void shrink() {
        for (bool again = true; again;) {
            again = false;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                for (const double factor : {0.5, 0.8, 0.92}) {
                    const LobeNodes fewer = scaled(now_.nodes, axis, factor);
                    if (fewer == now_.nodes) continue;
                    const Tried smaller = tried(fewer, now_.spacing);
                    if (smaller.error > target()) continue;
                    now_ = smaller;
                    again = true;
                    break;
                }
            }
        }
    }

    [[nodiscard]] static LobeNodes scaled(LobeNodes nodes, std::size_t axis, double factor) {
        const double wanted = std::round(static_cast<double>(nodes[axis]) * factor);
        nodes[axis] = std::max(fewest_nodes, static_cast<std::size_t>(wanted));
        return nodes;
    }

    void require_size() const {
        const double bytes = size(now_.nodes) * bytes_per_node_;
        if (bytes <= static_cast<double>(request_.largest_bytes)) return;
        throw Error{name_ + ": error " + shortest(now_.error) + " still at " + shortest(std::round(bytes)) +
                    " bytes: the tolerance must be one that " + std::to_string(request_.largest_bytes) +
                    " bytes can meet; is the lobe narrow, or does it have edges?"};
    }

    void report() const {
        if (!progress_) return;
        const double done = std::log(first_error_ / now_.error) / std::log(first_error_ / target());
        progress_("planning", std::clamp(done, 0.0, 1.0));
    }

    const Trials& trials_;
    const TableRequest& request_;
    double bytes_per_node_;
    const std::string& name_;
    const TableProgress& progress_;
    RandomPairs random_;
    Probes probes_;
    Tried now_;
    double first_error_;
};

void require_tabulable(const spectral::Reflectance& exact, const TableRequest& request) {
    if (!(request.tolerance >= 1e-9 && request.tolerance <= 0.5)) {
        throw out_of_range("tolerance of a table", request.tolerance, "", "from 1e-9 to 0.5");
    }
    if (request.seed > std::uint64_t{1} << 52U) {
        throw out_of_range("seed of a table", static_cast<double>(request.seed), "", "from 0 to 2^52");
    }
    if (const double change = spectral::anisotropy(exact.evaluator()); change > 1e-6) {
        throw Error{exact.name() + ": turned about the normal it changes by a factor of up to 1 + " +
                    shortest(change) +
                    ": a table must be of an isotropic surface (with azimuths of the light it would have "
                    "four axes and gigabytes, and a lookup would take longer than the exact value)"};
    }
    if (const double change = spectral::irreciprocity(exact.evaluator()); change > 1e-6) {
        throw Error{exact.name() + ": with light and view exchanged it changes by a factor of up to 1 + " +
                    shortest(change) + ": a table must be of a reciprocal surface"};
    }
    if (request.polarised && !exact.properties().polarised) {
        throw Error{exact.name() + ": has no polarisation: a polarised table must be of model he"};
    }
}

}  // namespace

TablePlan plan_table(const spectral::Reflectance& exact, const TableRequest& request,
                     const TableProgress& progress) {
    require_tabulable(exact, request);
    const LobePeaks peaks{exact};
    const std::size_t width = exact.wavelengths().size();
    TablePlan plan{request, {}, {}, floors(peaks, width), {}};
    plan.basis = basis_of(exact, request, peaks, plan.floor);
    const Trials trials{exact, peaks, plan.floor, plan.basis};
    const std::size_t bytes =
        plan.basis.size() / width * (needs_double(request) ? sizeof(double) : sizeof(float));
    const auto bytes_per_node = static_cast<double>(bytes);
    const Tried found = Search{trials, request, bytes_per_node, exact.name(), progress}.found();
    plan.spacing = found.spacing;
    plan.nodes.grazing = found.nodes[0];
    plan.nodes.ratio = found.nodes[1];
    plan.nodes.turn = found.nodes[2];
    return plan;
}

}  // namespace hts::tables

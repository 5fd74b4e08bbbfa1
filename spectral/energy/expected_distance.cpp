#include "spectral/energy/expected_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "hts/error.hpp"
#include "spectral/energy/expected_distance_data.hpp"
#include "spectral/text/csv.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {
namespace {

constexpr std::size_t quantities = 6;  // TE, TM and unpolarised, of both theories
constexpr std::size_t terms = 5;       // of a plane over four coordinates
using Values = std::array<double, quantities>;
using Place = std::array<double, terms - 1>;

/// What was solved at a place: ln of the distances.
struct Case {
    StudiedPoint point;
    Place place;
    Values logs;
};

/// In units of what counts as near.
Place place_of(const StudiedPoint& point) {
    constexpr double octaves = 0.6, degrees = 10, shapes = 0.5;
    return {std::log2(point.rms_roughness) / octaves, std::log2(point.correlation_length) / octaves,
            point.theta_i_deg / degrees, point.nu.value_or(0) / shapes};
}

double squared_distance(const Place& a, const Place& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

BothTheories both(const Values& values) {
    return {{values[0], values[1], values[2]}, {values[3], values[4], values[5]}};
}

/// Normal equations of a plane for several quantities; Gauss's elimination without pivots, since the
/// matrix is positive definite.
using System = std::array<std::array<double, terms + quantities>, terms>;

Values constant_of(System system) {
    for (std::size_t pivot = terms; pivot-- > 0;) {  // from the last, so that the constant is left
        for (std::size_t row = 0; row < pivot; ++row) {
            const double factor = system[row][pivot] / system[pivot][pivot];
            for (std::size_t column = 0; column < system[row].size(); ++column)
                system[row][column] -= factor * system[pivot][column];
        }
    }
    Values values{};
    for (std::size_t q = 0; q < quantities; ++q) values[q] = system[0][terms + q] / system[0][0];
    return values;
}

/// Of each quantity over all cases but one; over all if there is no such.
struct Range {
    Values least, most;
};
Range range_of(std::span<const Case> cases, std::size_t left_out) {
    Range range;
    range.least.fill(std::numeric_limits<double>::infinity());
    range.most.fill(-std::numeric_limits<double>::infinity());
    for (std::size_t c = 0; c < cases.size(); ++c) {
        for (std::size_t q = 0; c != left_out && q < quantities; ++q) {
            range.least[q] = std::min(range.least[q], cases[c].logs[q]);
            range.most[q] = std::max(range.most[q], cases[c].logs[q]);
        }
    }
    return range;
}

/// The plane at a place, from the same cases, within their range.
Values predicted(std::span<const Case> cases, const Place& at, std::size_t left_out, const Range& range) {
    constexpr double stiffness = 0.03, floor = 1e-12;  // of slopes; of the weight of what is far
    System system{};
    for (std::size_t i = 1; i < terms; ++i) system[i][i] = stiffness;
    for (std::size_t c = 0; c < cases.size(); ++c) {
        if (c == left_out) continue;
        const double weight = std::exp(-squared_distance(cases[c].place, at) / 2) + floor;
        std::array<double, terms> basis{1};
        for (std::size_t i = 1; i < terms; ++i) basis[i] = cases[c].place[i - 1] - at[i - 1];
        for (std::size_t i = 0; i < terms; ++i) {
            for (std::size_t j = 0; j < terms; ++j) system[i][j] += weight * basis[i] * basis[j];
            for (std::size_t q = 0; q < quantities; ++q)
                system[i][terms + q] += weight * basis[i] * cases[c].logs[q];
        }
    }
    Values values = constant_of(system);
    for (std::size_t q = 0; q < quantities; ++q)
        values[q] = std::clamp(values[q], range.least[q], range.most[q]);
    return values;
}

struct Bounds {
    double least = std::numeric_limits<double>::infinity(), most = 0;

    void add(double value) {
        least = std::fmin(least, value);
        most = std::fmax(most, value);
    }
    [[nodiscard]] bool has(double value) const {
        constexpr double rounding = 1 + 1e-9;
        return value * rounding >= least && value <= most * rounding;
    }
    [[nodiscard]] std::string text() const { return brief(least, 3) + " to " + brief(most, 3); }
};

/// Cases of one kind of substance.
class Study {
  public:
    Study(std::string substance, bool conductor, bool k_correlated) {
        static const auto table = CsvTable::parse(
            std::string{embedded_text(distance_files(), "model-distances")}, "model-distances.csv");
        constexpr std::array<std::string_view, quantities> names{
            "he_te_db", "he_tm_db", "he_db", "he_unified_te_db", "he_unified_tm_db", "he_unified_db"};
        const auto number = [&](std::size_t row, std::string_view column) {
            return table.number(row, table.column(column));
        };
        for (std::size_t row = 0; row < table.row_count(); ++row) {
            if ((number(row, "index_k") > 0) != conductor) continue;
            const double nu = number(row, "nu");
            if ((nu > 0) != k_correlated) continue;
            const StudiedPoint point{number(row, "sigma0_over_lambda"), number(row, "tau_over_lambda"),
                                     number(row, "theta_i_deg"),
                                     k_correlated ? std::optional{nu} : std::nullopt};
            shape_.add(nu);
            Case found{point, place_of(point), {}};
            for (std::size_t q = 0; q < quantities; ++q) found.logs[q] = std::log(number(row, names[q]));
            roughness_.add(point.rms_roughness);
            length_.add(point.correlation_length);
            slope_.add(point.rms_roughness / point.correlation_length);
            angle_.add(point.theta_i_deg);
            cases_.push_back(found);
        }
        range_ = range_of(cases_, cases_.size());
        const std::string length = k_correlated ? "l" : "tau";
        summary_ = {std::move(substance), cases_.size(), both(factors()),
                    (k_correlated ? "nu " + shape_.text() + ", " : "") + "sigma0 " + roughness_.text() +
                        " lambda, " + length + " " + length_.text() + " lambda, sigma0/" + length + " " +
                        slope_.text() + ", light at " + angle_.text() + " deg"};
    }

    [[nodiscard]] const DistanceStudy& summary() const { return summary_; }

    [[nodiscard]] ExpectedDistance at(const StudiedPoint& point) const {
        const Place place = place_of(point);
        Values values = predicted(cases_, place, cases_.size(), range_);
        for (double& value : values) value = std::exp(value);
        double nearest = std::numeric_limits<double>::infinity();
        for (const Case& each : cases_) nearest = std::min(nearest, squared_distance(each.place, place));
        constexpr double far_from_all =
            2;  // the middle of a cell of the grid of cases is 1.9 from its corners
        const bool studied = roughness_.has(point.rms_roughness) && length_.has(point.correlation_length) &&
                             slope_.has(point.rms_roughness / point.correlation_length) &&
                             angle_.has(point.theta_i_deg) && shape_.has(point.nu.value_or(0)) &&
                             nearest <= far_from_all * far_from_all;
        return {both(values), studied};
    }

  private:
    [[nodiscard]] Values factors() const {
        Values squares{};
        for (std::size_t c = 0; c < cases_.size(); ++c) {
            const Values others = predicted(cases_, cases_[c].place, c, range_of(cases_, c));
            for (std::size_t q = 0; q < quantities; ++q) {
                const double off = others[q] - cases_[c].logs[q];
                squares[q] += off * off / static_cast<double>(cases_.size());
            }
        }
        for (double& value : squares) value = std::exp(std::sqrt(value));
        return squares;
    }

    std::vector<Case> cases_;
    Range range_{};
    Bounds roughness_, length_, slope_, angle_, shape_;
    DistanceStudy summary_;
};

/// Of the flat surface along the normal: glass of 1.5 has 0.04.
double normal_reflectance(const RefractiveIndex& index) {
    return fresnel(1, index).unpolarised_reflectance();
}
constexpr double most_of_glass = 0.1;

const Study& study_for(const RefractiveIndex& index, bool k_correlated) {
    static const Study conductors{"perfect conductors and metals", true, false},
        glass{"glass of index 1.5, he_unified with polarisation_mixing", false, false},
        other{"perfect conductors, K-correlated", true, true};
    if (k_correlated) return other;
    return reflects_as_metal(index) ? conductors : glass;
}

}  // namespace

bool reflects_as_metal(const RefractiveIndex& index) {
    return normal_reflectance(index) >= 0.5;
}

ExpectedDistance expected_distance(const StudiedPoint& at, const RefractiveIndex& index) {
    if (at.rms_roughness == 0) return {{{0, 0, 0}, {0, 0, 0}}, true};  // Fresnel's equations
    ExpectedDistance expected = study_for(index, at.nu.has_value()).at(at);
    if (!reflects_as_metal(index) && (at.nu || normal_reflectance(index) > most_of_glass))
        expected.studied = false;
    return expected;
}

ExpectedDistance expected_distance(const Surface& surface, const SpectralSample& sample,
                                   const Direction& in) {
    const double lambda = sample.wavelength.micrometres();
    const double theta_i_deg = std::acos(std::fmin(1, in.cos_theta())) * 180 / std::numbers::pi;
    const auto nu = surface.correlation() ? surface.correlation()->nu() : std::nullopt;
    const double seen = nu ? std::sqrt(surface.variance_share(0, most_studied_frequency / lambda)) : 1;
    ExpectedDistance expected =
        expected_distance({seen * surface.rms_roughness() / lambda,
                           surface.shortest_correlation_length() / lambda, theta_i_deg, nu},
                          sample.index.substrate());
    if (sample.index.coated() || (surface.correlation() && !nu)) expected.studied = false;
    return expected;
}

const DistanceStudy& distance_study(const Surface& surface, const RefractiveIndex& index) {
    return study_for(index, surface.correlation() && surface.correlation()->nu()).summary();
}

}  // namespace hts::spectral

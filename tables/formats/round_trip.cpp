#include "tables/formats/round_trip.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <sstream>

#include <nlohmann/json.hpp>

#include "hts/error.hpp"
#include "hts/sampling/random.hpp"
#include "spectral/jobs/progress.hpp"
#include "spectral/statistics.hpp"
#include "tables/formats/lobe.hpp"
#include "tables/formats/lobe_quadrature.hpp"

namespace hts::tables {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double largest_theta = 88 * degree;

double polar_angle(const Direction& direction) {
    return std::atan2(direction.sin_theta(), direction.cos_theta());
}

double azimuth_between(const DirectionPair& pair) {
    const Direction &in = pair.in, &out = pair.out;
    return std::abs(std::atan2(in.cos_phi() * out.sin_phi() - in.sin_phi() * out.cos_phi(),
                               in.cos_phi() * out.cos_phi() + in.sin_phi() * out.sin_phi()));
}

void require_same_wavelengths(const spectral::Reflectance& a, const spectral::Reflectance& b) {
    if (a.wavelengths().size() != b.wavelengths().size()) {
        throw out_of_range("number of wavelengths read back", static_cast<double>(b.wavelengths().size()), "",
                           "that of the original, " + std::to_string(a.wavelengths().size()));
    }
    for (std::size_t k = 0; k < a.wavelengths().size(); ++k) {
        const double expected = a.wavelengths().micrometres()[k], um = b.wavelengths().micrometres()[k];
        if (!(std::abs(um - expected) <= 1e-6 * expected))
            throw out_of_range("wavelength read back", um, "um", shortest(expected) + " um, as written");
    }
}

/// The original's largest BRDF for any light, from every degree of its polar angle.
class Peaks {
  public:
    Peaks(const spectral::Reflectance& brdf, double slope)
        : azimuths_{brdf.properties().isotropic ? 1U : 24U} {
        for (std::size_t a = 0; a < azimuths_; ++a)
            for (std::size_t t = 0; t < angles; ++t)
                rows_.push_back(lobe_peaks(brdf, light(t, a), slope, largest_theta));
    }

    /// One value per wavelength, between angles interpolated.
    void operator()(const Direction& in, std::vector<double>& peaks) const {
        const double at = std::min(polar_angle(in) / degree, static_cast<double>(angles - 1));
        const std::size_t t = std::min(static_cast<std::size_t>(at), angles - 2);
        const double upper = at - static_cast<double>(t);
        const std::size_t row = nearest_azimuth(in) * angles + t;
        for (std::size_t k = 0; k < peaks.size(); ++k)
            peaks[k] = (1 - upper) * rows_[row][k] + upper * rows_[row + 1][k];
    }

  private:
    static constexpr std::size_t angles = 89;

    [[nodiscard]] Direction light(std::size_t t, std::size_t a) const {
        return Direction::from_degrees(static_cast<double>(t),
                                       360.0 * static_cast<double>(a) / static_cast<double>(azimuths_));
    }
    [[nodiscard]] std::size_t nearest_azimuth(const Direction& in) const {
        const double turns = std::atan2(in.sin_phi(), in.cos_phi()) / (2 * std::numbers::pi);
        return static_cast<std::size_t>(std::lround((turns + 1) * static_cast<double>(azimuths_))) %
               azimuths_;
    }

    std::size_t azimuths_;
    std::vector<std::vector<double>> rows_;
};

/// Pairs by turns around the lobe, uniform, and in the specular term if that is spread.
class PairDraws {
  public:
    PairDraws(double slope, const RoundTripOptions& options)
        : facets_{slope},
          cone_{options.specular_solid_angle},
          kinds_{options.specular_solid_angle > 0 ? 3U : 2U},
          random_{options.seed} {}

    DirectionPair operator()() {
        turn_ = (turn_ + 1) % kinds_;
        const Direction in = random_.direction(std::cos(largest_theta));
        if (turn_ == 1) return {in, near_mirror(in, facets_)};
        if (turn_ == 2) return {in, near_mirror(in, cone_)};
        return {in, random_.direction(std::cos(largest_theta))};
    }

  private:
    template <class Draws>
    Direction near_mirror(const Direction& in, const Draws& draws) {
        for (int attempt = 0; attempt < 64; ++attempt) {
            const double u1 = random_.uniform(), u2 = random_.uniform();
            const Vector3 out = draws.draw(in, u1, u2);
            if (out.z >= std::cos(largest_theta)) return Direction::from_unit_vector(out);
        }
        return in.mirror();
    }

    FacetDraws facets_;
    SpecularCone cone_;
    unsigned kinds_, turn_ = 0;
    Random random_;
};

PeakError peak_error(const spectral::Reflectance& original, const DirectionPair& pair, std::size_t k,
                     double expected, double read, double peak) {
    const double error = peak > 0 ? std::abs(read - expected) / peak : (read == expected ? 0.0 : 1.0);
    return {std::isfinite(error) ? error : std::numeric_limits<double>::infinity(),
            polar_angle(pair.in),
            polar_angle(pair.out),
            azimuth_between(pair),
            original.wavelengths().micrometres()[k],
            expected,
            read};
}

void keep_worse(PeakError& worst, const PeakError& error) {
    if (!(error.error <= worst.error)) worst = error;
}

/// Compares pair by pair; buffers are made once.
class Comparison {
  public:
    Comparison(const spectral::Reflectance& original, const spectral::Reflectance& read, double slope)
        : original_{original},
          read_{read},
          peaks_of_{original, slope},
          peaks_(count()),
          expected_(count()),
          values_(count()),
          expected_matrices_(count()),
          matrices_(count()) {}

    /// Over all wavelengths, the worst.
    PeakError of_brdf(const DirectionPair& pair) {
        peaks_of_(pair.in, peaks_);
        original_.brdf(pair, expected_);
        read_.brdf(pair, values_);
        PeakError worst;
        for (std::size_t k = 0; k < count(); ++k) {
            const double peak = std::max(peaks_[k], expected_[k]);
            keep_worse(worst, peak_error(original_, pair, k, expected_[k], values_[k], peak));
        }
        return worst;
    }

    /// Over all elements and wavelengths, after of_brdf for the same pair.
    PeakError of_mueller(const DirectionPair& pair) {
        original_.mueller(pair, expected_matrices_);
        read_.mueller(pair, matrices_);
        PeakError worst;
        for (std::size_t k = 0; k < count(); ++k) {
            const double peak = std::max(peaks_[k], expected_[k]);
            for (std::size_t e = 0; e < 16; ++e)
                keep_worse(worst, peak_error(original_, pair, k, expected_matrices_[k].elements()[e],
                                             matrices_[k].elements()[e], peak));
        }
        return worst;
    }

  private:
    [[nodiscard]] std::size_t count() const { return original_.wavelengths().size(); }

    const spectral::Reflectance &original_, &read_;
    Peaks peaks_of_;
    std::vector<double> peaks_, expected_, values_;
    std::vector<Mueller> expected_matrices_, matrices_;
};

std::vector<double> albedos(const spectral::Reflectance& brdf, const Direction& in,
                            const std::vector<WeightedView>& views) {
    std::vector<double> sums(brdf.wavelengths().size()), values(sums.size());
    for (const WeightedView& view : views) {
        brdf.brdf({in, view.out}, values);
        for (std::size_t k = 0; k < sums.size(); ++k)
            sums[k] += view.weight * view.out.cos_theta() * values[k];
    }
    return sums;
}

AlbedoError albedo_error(const spectral::Reflectance& original, const spectral::Reflectance& read,
                         const Direction& in, const std::vector<WeightedView>& views) {
    const auto expected = albedos(original, in, views), values = albedos(read, in, views);
    std::size_t worst = 0;
    const auto error = [&](std::size_t k) { return std::abs(values[k] - expected[k]); };
    for (std::size_t k = 1; k < expected.size(); ++k)
        if (!(error(k) <= error(worst))) worst = k;
    return {polar_angle(in), original.wavelengths().micrometres()[worst], expected[worst], values[worst]};
}

double density_integral(const HasDensity& read, const Direction& in, const std::vector<WeightedView>& views) {
    double sum = 0;
    for (const WeightedView& view : views) sum += view.weight * read.density({in, view.out});
    return sum;
}

void add_integrals(RoundTrip& result, const spectral::Reflectance& original,
                   const spectral::Reflectance& read, double slope, double specular_solid_angle) {
    constexpr int points = 4096;
    const auto* density = dynamic_cast<const HasDensity*>(&read.evaluator());
    for (const double degrees : {0., 15., 30., 45., 60., 75., 85.}) {
        const Direction in = Direction::from_degrees(degrees, 0);
        const auto views = lobe_quadrature(in, slope, points, specular_solid_angle);
        result.albedo.push_back(albedo_error(original, read, in, views));
        if (density != nullptr)
            result.density.push_back({polar_angle(in), density_integral(*density, in, views)});
    }
}

std::ostream& operator<<(std::ostream& out, const PeakError& error) {
    return out << error.error * 100 << " % of the peak, at theta_i " << error.theta_i / degree << ", theta_r "
               << error.theta_r / degree << ", phi " << error.phi / degree << " deg, " << error.wavelength_um
               << " um: " << error.original << " became " << error.read_back << " /sr\n";
}

nlohmann::json as_json(const PeakError& error) {
    return {{"error_of_peak", error.error},          {"theta_i_deg", error.theta_i / degree},
            {"theta_r_deg", error.theta_r / degree}, {"phi_deg", error.phi / degree},
            {"wavelength_um", error.wavelength_um},  {"original", error.original},
            {"read_back", error.read_back}};
}

}  // namespace

RoundTrip round_trip(const spectral::Reflectance& original, const spectral::Reflectance& read_back,
                     const RoundTripOptions& options) {
    require_same_wavelengths(original, read_back);
    const double slope = options.slope > 0 ? options.slope : lobe_slope(original);
    Comparison comparison{original, read_back, slope};
    PairDraws draw{slope, options};
    RoundTrip result;
    result.pairs = options.pairs;
    result.wavelengths = original.wavelengths().size();
    if (original.properties().polarised && read_back.properties().polarised)
        result.worst_mueller = PeakError{};
    std::vector<double> errors;
    const spectral::Job job{"", options.pairs};
    for (std::size_t i = 0; i < options.pairs; ++i) {
        job.done();
        const DirectionPair pair = draw();
        const PeakError error = comparison.of_brdf(pair);
        errors.push_back(error.error);
        keep_worse(result.worst, error);
        if (result.worst_mueller) keep_worse(*result.worst_mueller, comparison.of_mueller(pair));
    }
    result.median = spectral::quantile(errors, 0.5);
    result.percentile_99 = spectral::quantile(std::move(errors), 0.99);
    add_integrals(result, original, read_back, slope, options.specular_solid_angle);
    return result;
}

std::string RoundTrip::text() const {
    std::ostringstream out;
    out.precision(4);
    out << "read back at " << pairs << " pairs of directions and " << wavelengths << " wavelengths\n"
        << "  worst        " << worst << "  99 %, median " << percentile_99 * 100 << ", " << median * 100
        << " % of the peak\n";
    if (worst_mueller) out << "  Mueller      " << *worst_mueller;
    for (const AlbedoError& each : albedo)
        out << "  albedo       " << each.original << " became " << each.read_back << " at theta_i "
            << each.theta_i / degree << " deg, " << each.wavelength_um << " um\n";
    for (const DensityIntegral& each : density)
        out << "  density      integral " << each.integral << " at theta_i " << each.theta_i / degree
            << " deg\n";
    return out.str();
}

std::string RoundTrip::json() const {
    nlohmann::json json{{"pairs", pairs},
                        {"wavelengths", wavelengths},
                        {"worst", as_json(worst)},
                        {"percentile_99_of_peak", percentile_99},
                        {"median_of_peak", median},
                        {"albedo", nlohmann::json::array()},
                        {"density", nlohmann::json::array()}};
    if (worst_mueller) json["worst_mueller"] = as_json(*worst_mueller);
    for (const AlbedoError& each : albedo)
        json["albedo"].push_back({{"theta_i_deg", each.theta_i / degree},
                                  {"wavelength_um", each.wavelength_um},
                                  {"original", each.original},
                                  {"read_back", each.read_back}});
    for (const DensityIntegral& each : density)
        json["density"].push_back({{"theta_i_deg", each.theta_i / degree}, {"integral", each.integral}});
    return json.dump(1);
}

}  // namespace hts::tables

// Row 11: the energy that the model itself gains and loses, with a perfect mirror for a facet.

#include <cmath>

#include "bench/stability/stability_rows.hpp"
#include "spectral/energy/energy.hpp"

namespace hts::bench {
namespace {

struct Setting {
    double slope;          ///< sigma_0/tau
    double roughness;      ///< sigma_0/lambda
    double theta_degrees;  ///< of incidence

    [[nodiscard]] std::string text() const {
        return place({{"sigma0/lambda", roughness}, {"theta_i", theta_degrees, "deg"}});
    }
};

double total_reflectance(const Setting& at) {
    const Surface surface{at.roughness, at.roughness / at.slope};
    return spectral::directional_hemispherical_reflectance(surface, spectral::PerfectMirror{},
                                                           Wavelength::from_micrometres(1),
                                                           Direction::from_degrees(at.theta_degrees, 0))
        .total();
}

/// The lowest and the highest total over roughness and incidence at one slope, and where they are.
struct Extremes {
    double lowest = INFINITY, highest = 0;
    std::string lowest_at, highest_at;

    void note(double total, const Setting& at) {
        if (total < lowest) {
            lowest = total;
            lowest_at = at.text();
        }
        if (total > highest) {
            highest = total;
            highest_at = at.text();
        }
    }
};

Extremes extremes_at(double slope) {
    Extremes extremes;
    for (const double roughness : {0.05, 0.3, 2.0}) {
        for (const double degrees : {0.0, 45.0, 70.0, 85.0}) {
            const Setting at{slope, roughness, degrees};
            extremes.note(total_reflectance(at), at);
        }
    }
    return extremes;
}

void judge(StabilityRow& row, double slope, const Extremes& extremes) {
    const Contestant model{
        "model, sigma0/tau = " + brief(slope), true, 0,
        "Shadowing of first order: what is shadowed or scattered twice never returns, and a lobe "
        "that leans to the normal is shadowed too little."};
    const std::string detail = "model: total " + brief(extremes.lowest) + " to " + brief(extremes.highest, 3);
    row.judge(model, {Verdict::model, std::fmax(1 - extremes.lowest, extremes.highest - 1), detail},
              "lowest at " + extremes.lowest_at + "; highest at " + extremes.highest_at);
}

}  // namespace

StabilityRow energy_of_the_model() {
    StabilityRow row{11, "energy: total reflectance of perfectly reflecting facets"};
    for (const double slope : {0.05, 0.1, 0.25, 0.5, 1.0}) judge(row, slope, extremes_at(slope));
    return row;
}

}  // namespace hts::bench

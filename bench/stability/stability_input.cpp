// Row 13: bad input is a clear error, never a silent number.

#include <cmath>
#include <functional>
#include <limits>
#include <string_view>

#include "bench/stability/stability_model.hpp"
#include "bench/stability/stability_rows.hpp"
#include "hts/error.hpp"
#include "hts/terms.hpp"
#include "spectral/wavelength_grid.hpp"

namespace hts::bench {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr ModelPoint ordinary{0.5, 30, 0, 40, 170, 1.2, 3.4, 0.1, 3};

/// The engine must throw an error that names the quantity.
void expect_error(StabilityRow& row, const std::string& where, std::string_view quantity,
                  const std::function<void()>& action) {
    const Contestant engine{"engine", true, 0,
                            "Constructors check once, and the error names value and legal range."};
    try {
        action();
    } catch (const Error& error) {
        const bool clear = std::string_view{error.what()}.find(quantity) != std::string_view::npos;
        const Verdict verdict = clear ? Verdict::ok : Verdict::wrong;
        row.judge(engine, {verdict, 0, std::string{"error: "} + error.what()}, where);
        return;
    }
    row.judge(engine, {Verdict::silent, 1, "no error"}, where);
}

/// Phi is a number for numbers only: NaN in is NaN out, as documented, at every tolerance.
void expect_nan(StabilityRow& row, double g, double t) {
    const Contestant engine{"engine", true, 0, "Phi of what is no number, or negative, is NaN."};
    const double low = phi(g, t, Tolerance{1e-3}), medium = phi(g, t, Tolerance{1e-6}),
                 high = phi(g, t).value;
    const bool right = std::isnan(low) && std::isnan(medium) && std::isnan(high);
    row.judge(engine, {right ? Verdict::ok : Verdict::silent, 0, "Phi = " + brief(high)},
              place({{"g", g}, {"t", t}}));
}

/// What the printed formulas make of the same input.
void judge_printed(StabilityRow& row, const std::string& where, double value) {
    const Contestant printed{"model as printed", false, 0,
                             "Squares and roots swallow the sign: formulas do not know their domain."};
    if (std::isfinite(value)) {
        row.judge(printed, {Verdict::silent, std::abs(value), "silent: " + brief(value) + " /sr"}, where);
    } else {
        row.judge(printed, {Verdict::not_a_number, infinity, brief(value)}, where);
    }
}

struct BadField {
    const char* name;
    double ModelPoint::*field;
    std::string_view quantity;
    std::vector<double> values;
};

std::vector<BadField> bad_fields() {
    return {{"theta_i", &ModelPoint::theta_i, "polar angle", {-1, 90.0000001, 120, nan_value, infinity}},
            {"theta_r", &ModelPoint::theta_r, "polar angle", {-30, 135, nan_value}},
            {"phi", &ModelPoint::phi_r, "azimuth", {nan_value, infinity}},
            {"wavelength", &ModelPoint::wavelength, "wavelength", {-0.5, 0, nan_value, infinity}},
            {"rms roughness", &ModelPoint::rms_roughness, "rms roughness", {-0.1, nan_value, infinity}},
            {"correlation length",
             &ModelPoint::correlation_length,
             "correlation length",
             {-3, 0, nan_value, infinity}},
            {"n", &ModelPoint::n, "refractive index", {-1.2, 0, nan_value, infinity}},
            {"k", &ModelPoint::k, "extinction", {-3.4, nan_value, infinity}}};
}

}  // namespace

StabilityRow bad_input() {
    StabilityRow row{13,
                     "directions below the horizon, NaN, negative and zero lengths, k < 0, empty spectra"};
    for (const BadField& bad : bad_fields()) {
        for (const double value : bad.values) {
            ModelPoint p = ordinary;
            p.*bad.field = value;
            const std::string where = place({{bad.name, value}});
            expect_error(row, where, bad.quantity, [&] { static_cast<void>(engine_model(p)); });
            judge_printed(row, where, Naive<double>::model(p));
        }
    }
    for (const double bad : {nan_value, -1.0}) {
        expect_nan(row, bad, 1);
        expect_nan(row, 1, bad);
    }
    expect_error(row, "vector (0, 0, 0)", "direction", [] {
        static_cast<void>(Direction::from_vector({0, 0, 0}));
    });
    expect_error(row, "vector (0, 0, -1)", "direction", [] {
        static_cast<void>(Direction::from_vector({0, 0, -1}));
    });
    expect_error(row, "albedo 1.2", "albedo", [] { static_cast<void>(uniform_diffuse(1.2)); });
    expect_error(row, "no wavelengths", "wavelength",
                 [] { static_cast<void>(spectral::WavelengthGrid::from_micrometres({})); });
    return row;
}

}  // namespace hts::bench

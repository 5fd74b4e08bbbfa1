#include "spectral/materials/dispersion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include "hts/error.hpp"

namespace hts::spectral {
namespace {

using Coefficients = std::span<const double>;  // c[1] is C1; c[0] is unused

constexpr std::size_t any_number = std::numeric_limits<std::size_t>::max();

// How many coefficients each formula takes. Those that are a sum over pairs go on for as long as there are
// pairs.
std::size_t most_coefficients(int number) noexcept {
    switch (number) {
        case 4:
            return 17;
        case 7:
            return 6;
        case 8:
            return 4;
        case 9:
            return 6;
        default:
            return any_number;
    }
}

// Where each formula's terms end: after C1, after C3 …
bool ends_a_term(int number, std::size_t count) noexcept {
    switch (number) {
        case 4:
            return count == 1 || count == 5 || (count >= 9 && count % 2 == 1);
        case 7:
            return count >= 1;
        case 8:
            return count == 1 || count == 3 || count == 4;
        case 9:
            return count == 1 || count == 3 || count == 6;
        default:
            return count % 2 == 1;
    }
}

// C1 + the sum over (C2, C3), (C4, C5), … of term(first, second), which is 0 where the first one is.
template <class Term>
double pair_sum(Coefficients c, const Term& term) noexcept {
    double sum = c[1];
    for (std::size_t i = 2; i + 1 < c.size(); i += 2) {
        if (c[i] != 0) sum += term(c[i], c[i + 1]);
    }
    return sum;
}

double sellmeier(Coefficients c, double um) noexcept {
    return std::sqrt(1 + pair_sum(c, [um](double strength, double resonance) {
                         return strength * um * um / ((um - resonance) * (um + resonance));
                     }));
}

double sellmeier_2(Coefficients c, double um) noexcept {
    return std::sqrt(1 + pair_sum(c, [um](double strength, double squared_resonance) {
                         return strength * um * um / (um * um - squared_resonance);
                     }));
}

double power_sum(Coefficients c, double um) noexcept {
    return pair_sum(c, [um](double factor, double power) { return factor * std::pow(um, power); });
}

// C_i l^C_{i+1} / (l^2 - C_{i+2}^C_{i+3}), formula 4. Files write an absent term as 0 0 0 1, so that its
// denominator does not matter.
double resonance_term(Coefficients c, std::size_t i, double um) noexcept {
    if (c[i] == 0) return 0;
    return c[i] * std::pow(um, c[i + 1]) / (um * um - std::pow(c[i + 2], c[i + 3]));
}

double refractive_index_info(Coefficients c, double um) noexcept {
    double square = c[1] + resonance_term(c, 2, um) + resonance_term(c, 6, um);
    for (std::size_t i = 10; i + 1 < c.size(); i += 2) {
        if (c[i] != 0) square += c[i] * std::pow(um, c[i + 1]);
    }
    return std::sqrt(square);
}

double gases(Coefficients c, double um) noexcept {
    const double wave_number_squared = 1 / (um * um);
    return 1 + pair_sum(c, [wave_number_squared](double strength, double resonance) {
               return strength / (resonance - wave_number_squared);
           });
}

double herzberger(Coefficients c, double um) noexcept {
    const double square = um * um;
    const double pole = 1 / (square - 0.028);
    return c[1] + pole * (c[2] + pole * c[3]) + square * (c[4] + square * (c[5] + square * c[6]));
}

double retro(Coefficients c, double um) noexcept {
    const double square = um * um;
    const double resonance = c[2] == 0 ? 0 : c[2] * square / (square - c[3]);
    const double ratio = c[1] + resonance + c[4] * square;  // (n^2 - 1)/(n^2 + 2)
    return std::sqrt((1 + 2 * ratio) / (1 - ratio));
}

double exotic(Coefficients c, double um) noexcept {
    const double first = c[2] == 0 ? 0 : c[2] / (um * um - c[3]);
    const double offset = um - c[5];
    const double second = c[4] == 0 ? 0 : c[4] * offset / (offset * offset + c[6]);
    return std::sqrt(c[1] + first + second);
}

void require_legal(int number, Coefficients coefficients, const WavelengthRange& range) {
    if (number < 1 || number > 9) throw out_of_range("dispersion formula", number, "", "from 1 to 9");
    if (coefficients.size() > most_coefficients(number)) {
        throw Error{"formula " + std::to_string(number) + " with " + std::to_string(coefficients.size()) +
                    " coefficients: must be at most " + std::to_string(most_coefficients(number))};
    }
    if (!ends_a_term(number, coefficients.size())) {
        throw Error{"formula " + std::to_string(number) + " with " + std::to_string(coefficients.size()) +
                    " coefficients: C" + std::to_string(coefficients.size() + 1) +
                    " is missing: must end with a whole term"};
    }
    for (std::size_t i = 0; i < coefficients.size(); ++i) {
        if (std::isfinite(coefficients[i])) continue;
        throw out_of_range("coefficient C" + std::to_string(i + 1), coefficients[i], "", "finite");
    }
    static_cast<void>(Wavelength::from_micrometres(range.shortest));
    static_cast<void>(Wavelength::from_micrometres(range.longest));
    if (range.shortest > range.longest) {
        throw out_of_range("end of the wavelength range", range.longest, "um",
                           ">= its beginning, " + shortest(range.shortest) + " um");
    }
}

}  // namespace

DispersionFormula::DispersionFormula(int number, std::vector<double> coefficients, WavelengthRange range)
    : number_{number}, coefficients_{std::move(coefficients)}, range_{range} {
    while (coefficients_.size() > most_coefficients(number) && coefficients_.back() == 0)
        coefficients_.pop_back();
    require_legal(number, coefficients_, range);
    coefficients_.insert(coefficients_.begin(), 0);
    coefficients_.resize(std::max<std::size_t>(18, coefficients_.size() + coefficients_.size() % 2));
}

double DispersionFormula::operator()(double um) const noexcept {
    switch (number_) {
        case 1:
            return sellmeier(coefficients_, um);
        case 2:
            return sellmeier_2(coefficients_, um);
        case 3:
            return std::sqrt(power_sum(coefficients_, um));
        case 4:
            return refractive_index_info(coefficients_, um);
        case 5:
            return power_sum(coefficients_, um);
        case 6:
            return gases(coefficients_, um);
        case 7:
            return herzberger(coefficients_, um);
        case 8:
            return retro(coefficients_, um);
        default:
            return exotic(coefficients_, um);
    }
}

WavelengthRange range_of(const Dispersion& dispersion) noexcept {
    return std::visit([](const auto& curve) { return curve.range(); }, dispersion);
}

double value_at(const Dispersion& dispersion, double um) noexcept {
    return std::visit([um](const auto& curve) { return curve(um); }, dispersion);
}

}  // namespace hts::spectral

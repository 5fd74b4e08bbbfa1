#include "spectral/wavelength_grid.hpp"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>

#include "hts/error.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {
namespace {

void require_increasing(const std::vector<double>& micrometres) {
    for (std::size_t i = 0; i < micrometres.size(); ++i) {
        static_cast<void>(Wavelength::from_micrometres(micrometres[i]));
        if (i > 0 && micrometres[i] <= micrometres[i - 1]) {
            throw out_of_range("wavelength", micrometres[i], "um",
                               "> the one before it, " + shortest(micrometres[i - 1]) + " um");
        }
    }
}

void require_ends(double first_um, double last_um, int count) {
    static_cast<void>(Wavelength::from_micrometres(first_um));
    static_cast<void>(Wavelength::from_micrometres(last_um));
    if (count < 1 || count > WavelengthGrid::most_wavelengths) {
        throw out_of_range("number of wavelengths", count, "",
                           "from 1 to " + std::to_string(WavelengthGrid::most_wavelengths));
    }
    if (count == 1 && first_um != last_um) {
        throw out_of_range("last wavelength", last_um, "um",
                           "the first, " + shortest(first_um) + " um, if there is only one");
    }
    if (count > 1 && !(first_um < last_um)) {
        throw out_of_range("last wavelength", last_um, "um", "> the first, " + shortest(first_um) + " um");
    }
}

int count_in(std::string_view text) {
    const auto digits = trimmed(text);
    int count = 0;
    const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), count);
    if (failure != std::errc{} || end != digits.data() + digits.size()) {
        throw Error{"number of wavelengths " + in_quotes(text) + ": must be a whole number from 1 to " +
                    std::to_string(WavelengthGrid::most_wavelengths)};
    }
    return count;
}

WavelengthGrid parse_linear(std::string_view text) {
    const auto parts = split(text, ':');
    if (parts.size() != 3) throw Error{"must be first:last:count or a list such as 0.45,0.55,0.65 [um]"};
    return WavelengthGrid::linear(number_in(parts[0]), number_in(parts[1]), count_in(parts[2]));
}

WavelengthGrid parse_list(std::string_view text) {
    std::vector<double> micrometres;
    for (const auto part : split(text, ',')) micrometres.push_back(number_in(part));
    return WavelengthGrid::from_micrometres(std::move(micrometres));
}

}  // namespace

WavelengthGrid WavelengthGrid::linear(double first_um, double last_um, int count) {
    require_ends(first_um, last_um, count);
    std::vector<double> micrometres(static_cast<std::size_t>(count), first_um);
    for (int i = 1; i < count; ++i) {
        micrometres[static_cast<std::size_t>(i)] = std::lerp(first_um, last_um, i / (count - 1.0));
    }
    return from_micrometres(std::move(micrometres));
}

WavelengthGrid WavelengthGrid::from_micrometres(std::vector<double> micrometres) {
    if (micrometres.empty()) throw Error{"list of wavelengths without an entry: must have at least one"};
    require_increasing(micrometres);
    return WavelengthGrid{std::move(micrometres)};
}

WavelengthGrid WavelengthGrid::parse(std::string_view text) {
    return located("wavelengths " + in_quotes(text), [text] {
        return text.find(':') == std::string_view::npos ? parse_list(text) : parse_linear(text);
    });
}

}  // namespace hts::spectral

/// The wavelengths at which spectra are sampled.
#pragma once

#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "hts/wavelength.hpp"

namespace hts::spectral {

/// Strictly increasing vacuum wavelengths, at least one.
class WavelengthGrid {
  public:
    static constexpr int most_wavelengths = 1'000'000;

    /// `count` equally spaced wavelengths [um], ends included; count from 1 (then first = last) to
    /// most_wavelengths, first < last, else hts::Error.
    [[nodiscard]] static WavelengthGrid linear(double first_um, double last_um, int count);
    /// From a list [um], strictly increasing, else hts::Error.
    [[nodiscard]] static WavelengthGrid from_micrometres(std::vector<double> micrometres);
    /// From text: "0.38:0.78:41" (first:last:count) or "0.45,0.55,0.65" [um]; hts::Error that quotes the
    /// text.
    [[nodiscard]] static WavelengthGrid parse(std::string_view text);

    [[nodiscard]] std::size_t size() const noexcept { return micrometres_.size(); }
    [[nodiscard]] std::span<const double> micrometres() const noexcept { return micrometres_; }
    [[nodiscard]] Wavelength operator[](std::size_t i) const {
        return Wavelength::from_micrometres(micrometres_[i]);
    }

  private:
    explicit WavelengthGrid(std::vector<double> micrometres) : micrometres_{std::move(micrometres)} {}
    std::vector<double> micrometres_;
};

}  // namespace hts::spectral

/// What fits take from the spectrum of a map, and what the map lets them see.
#pragma once

#include <optional>
#include <vector>

#include "validation/topography/autocorrelation.hpp"

namespace hts::validation {

/// Frequencies [1/um].
struct FrequencyBand {
    double first, last;
};

/// What a fit takes from a map.
class SeenSpectrum {
  public:
    ///   coefficients   that levelling took off: the heights know nothing below `known().first`
    ///   wanted         what is trusted, where that is less than the map has
    SeenSpectrum(const HeightMap& map, const MapWindow& window, const MapSpectrum& spectrum, int coefficients,
                 const Ellipse& ellipse, const std::optional<FrequencyBand>& wanted);

    /// From (coefficients/(pi area))^(1/2), below which are as many frequencies as were taken off, to half a
    /// cycle per step.
    [[nodiscard]] const FrequencyBand& known() const noexcept { return known_; }

  private:
    friend class SpectrumFitter;
    struct Bin {
        double frequency, power, cells;
        bool fitted;
    };
    std::vector<Bin> bins_;
    std::vector<double> distances_, kernel_;  // kernel: a row of all distances per bin
    // Frequencies below known_, which levelling took off, and what each adds to the correlation at each
    // distance per power: rows of frequencies.
    std::vector<double> taken_, taken_kernel_;
    FrequencyBand known_;
    double corners_ = 0;  // variance at frequencies that are in no ring
    double area_, variance_, noise_unit_, inflation_, cell_, window_share_;
};

}  // namespace hts::validation

/// A vacuum wavelength that is known to be a positive length.
#pragma once

namespace hts {

/// Lengths are micrometres inside the library. Every length lies between these two, so that no product of
/// them leaves the range of a double.
inline constexpr double shortest_length = 1e-24;  // um
inline constexpr double longest_length = 1e24;    // um

class Wavelength {
  public:
    ///   micrometres   [um]  shortest_length ... longest_length, else hts::Error
    [[nodiscard]] static Wavelength from_micrometres(double micrometres);
    ///   nanometres    [nm]  the same range in nm
    [[nodiscard]] static Wavelength from_nanometres(double nanometres);

    [[nodiscard]] double micrometres() const noexcept { return micrometres_; }
    /// 2 pi / wavelength [rad/um].
    [[nodiscard]] double wave_number() const noexcept;

  private:
    explicit Wavelength(double micrometres) noexcept : micrometres_{micrometres} {}
    double micrometres_;
};

}  // namespace hts

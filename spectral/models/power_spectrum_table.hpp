/// Tables of power spectra that material files name or hold. Not installed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "spectral/text/json_value.hpp"

namespace hts::spectral {

/// Whether "psd" says that a spectrum is a profile's: "1d one-sided" and not "2d"; hts::Error otherwise.
[[nodiscard]] bool is_of_profile(const JsonValue& psd);

struct PowerSpectrumTable {
    std::vector<double> frequency;  ///< [1/um], > 0, increasing
    std::vector<double> density;    ///< [um^4], of a profile [um^3], > 0
    std::vector<double> error;  ///< standard deviations of the density, row by row, >= 0; empty: not stated
    bool of_profile = false;
    std::string place;  ///< of the table, for messages
};

/// Reads what {"type": "psd", …} says:
///   "file"    CSV with columns frequency_per_um, psd_um4 or psd_um3, and their errors, psd_um4_error or
///             psd_um3_error, where they are known; or FRED's layout, with "psd"
///   "table"   [[f, S], …] or [[f, S, error], …], with "psd"
/// hts::Error of keys that do not belong beside one another and of rows that are out of range.
[[nodiscard]] PowerSpectrumTable power_spectrum_table(const JsonValue& correlation,
                                                      const std::filesystem::path& folder);

}  // namespace hts::spectral

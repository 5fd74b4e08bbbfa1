/// One pair of words for what is asked and what came out. Not installed.
#pragma once

namespace hts::spectral {

/// Of a criterion, a tolerance, a check: "met" or "missed".
[[nodiscard]] constexpr const char* verdict(bool met) noexcept {
    return met ? "met" : "missed";
}

}  // namespace hts::spectral

/// Doubles as decimal numbers that read back the same. Not installed.
#pragma once

#include <string>

namespace hts::spectral {

/// Appends what `printf("%.17g")` prints, correctly rounded; 17 digits tell every double from its neighbours.
///   cost   some 20 ns
void append_17_digits(std::string& text, double value);

}  // namespace hts::spectral

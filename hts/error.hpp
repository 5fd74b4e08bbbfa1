/// The one kind of error that bad input raises: it names quantity, value, unit and legal range.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace hts {

/// A value, a file or a line that cannot be used. `what()` is one line, ready to be shown to a user.
class Error : public std::invalid_argument {
  public:
    using std::invalid_argument::invalid_argument;
};

/// "wavelength -0.1 um: must be > 0".
///   unit       "" for a dimensionless quantity
///   legal      the legal range in words, with its unit where it has one
[[nodiscard]] Error out_of_range(std::string_view quantity, double value, std::string_view unit,
                                 std::string_view legal);

/// The shortest decimal text that reads back as the same double.
[[nodiscard]] std::string shortest(double value);

}  // namespace hts

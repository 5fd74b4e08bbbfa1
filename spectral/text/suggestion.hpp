/// What someone may have meant who wrote a name that is none. Not installed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hts::spectral {

/// The name that is written most like the word: of the same letters but for case and for _ in place of -, the
/// only one that begins with it, or the nearest by letters put in, left out, replaced or swapped, up to a
/// third of the word, or two of a short one. "" if none is near.
[[nodiscard]] std::string nearest(std::string_view word, const std::vector<std::string>& names);

/// The one of `known` that `name` may be a slip of: the same letters and digits, or at most two of them
/// changed, left out, added or swapped, at most a quarter of the name; "" if there is none.
[[nodiscard]] std::string similar_name(std::string_view name, const std::vector<std::string>& known);

/// `; did you mean "NAME"?`, or nothing.
[[nodiscard]] std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

/// "must be one of a, b, c", and what was meant where that can be told.
[[nodiscard]] std::string must_be_one_of(std::string_view word, const std::vector<std::string>& names);

}  // namespace hts::spectral

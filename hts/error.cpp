#include "hts/error.hpp"

#include <array>
#include <charconv>

namespace hts {

std::string shortest(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return {text.data(), end};
}

Error out_of_range(std::string_view quantity, double value, std::string_view unit, std::string_view legal) {
    std::string message{quantity};
    message.append(" ").append(shortest(value));
    if (!unit.empty()) message.append(" ").append(unit);
    message.append(": must be ").append(legal);
    return Error{message};
}

}  // namespace hts

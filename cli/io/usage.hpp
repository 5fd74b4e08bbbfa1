/// Wrong usage, as opposed to bad data: the program ends with exit code 2 instead of 1.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "hts/error.hpp"

namespace hts::cli {

class UsageError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The work is done and its outputs stand, but a check of theirs failed: exit code 1.
class CheckFailed : public Error {
  public:
    using Error::Error;
};

/// What `make` returns; the hts::Error that it throws becomes a UsageError that names the option.
template <class Make>
auto from_option(const std::string& option, Make&& make) {
    try {
        return std::forward<Make>(make)();
    } catch (const Error& error) {
        throw UsageError{option + ": " + error.what()};
    }
}

}  // namespace hts::cli

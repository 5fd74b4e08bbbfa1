/// Other programs run to their end: gnuplot, Python. Not installed.
#pragma once

#include <string>
#include <vector>

namespace hts::output {

/// How a program ended and what it wrote.
struct Ended {
    int status;          ///< 0: well; -1: it could not be run
    std::string output;  ///< standard output and, where they are asked for, messages
};

struct RunSettings {
    std::string folder = ".";   ///< it works in
    bool with_messages = true;  ///< standard error with the output, or nowhere
};

/// Runs a program of PATH without a shell. A signal that stops this process stops it too.
///   words   its name and arguments
/// hts::Error if no pipe can be opened.
[[nodiscard]] Ended run_program(std::vector<std::string> words, const RunSettings& how = {});

}  // namespace hts::output

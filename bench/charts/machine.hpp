/// What a speed depends on besides the code: printed on every chart and in every table of times.
#pragma once

#include <string>

namespace hts::bench {

struct Machine {
    std::string processor;  ///< as the system names it, with family and model where it says so
    std::string compiler;
    std::string flags;   ///< of the compiler
    std::string commit;  ///< of this source, "-dirty" with changes; "unknown" without git

    /// "AMD EPYC (family 25, model 17), g++ 12.2.0 -O3 -DNDEBUG, commit 7ef9621"
    [[nodiscard]] std::string text() const;
};

[[nodiscard]] Machine machine();

}  // namespace hts::bench

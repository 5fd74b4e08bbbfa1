#include "cli/summary.hpp"

#include <omp.h>

#include <array>
#include <cstdio>

namespace hts::cli {

std::string Summary::text() const {
    const double evaluations = static_cast<double>(pairs) * static_cast<double>(wavelengths);
    const double rate = seconds > 0 ? evaluations / seconds : 0;
    std::array<char, 160> line{};
    std::snprintf(line.data(), line.size(),
                  "%zu pairs x %zu wavelengths: %.3g s, %.3g evaluations/s, %d threads", pairs, wavelengths,
                  seconds, rate, omp_get_max_threads());
    return line.data();
}

}  // namespace hts::cli

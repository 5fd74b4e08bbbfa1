#include "cli/io/summary.hpp"

#include <omp.h>

#include "cli/io/table_writer.hpp"

namespace hts::cli {

std::string Summary::text() const {
    const double evaluations = static_cast<double>(pairs) * static_cast<double>(wavelengths);
    const double rate = seconds > 0 ? evaluations / seconds : 0;
    return std::to_string(pairs) + " pairs x " + std::to_string(wavelengths) +
           " wavelengths: " + brief(seconds, 3) + " s, " + brief(rate, 3) + " evaluations/s, " +
           std::to_string(omp_get_max_threads()) + " threads";
}

}  // namespace hts::cli

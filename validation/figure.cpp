#include "validation/figure.hpp"

#include "hts/error.hpp"
#include "spectral/text.hpp"

namespace hts::validation {

std::string page_label(const std::string& text, double x, double y, int size) {
    return "set label " + spectral::gnuplot_string(text) + " at screen " + shortest(x) + ',' + shortest(y) +
           " left noenhanced font '," + std::to_string(size) + "' tc rgb '#111111'\n";
}

}  // namespace hts::validation

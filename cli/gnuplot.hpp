/// Draws with gnuplot, which must be installed at run time.
#pragma once

#include <string>
#include <string_view>

#include "spectral/text.hpp"

namespace hts::cli {

using spectral::gnuplot_string;

/// Writes the script beside the picture (figure.svg: figure.gnuplot), with the terminal and the output put
/// in front, and runs it in that folder. hts::Error if gnuplot is missing, naming the package, or fails; the
/// script then stays and the picture is not there.
void draw(const std::string& svg_path, std::string_view script);

}  // namespace hts::cli

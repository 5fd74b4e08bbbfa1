/// Draws with gnuplot, which must be installed at run time.
#pragma once

#include <string>
#include <string_view>

#include "spectral/text/text.hpp"

namespace hts::cli {

using spectral::gnuplot_string;

/// Writes the script beside the picture (figure.svg: figure.gnuplot), with the terminal and the output put
/// in front, and runs it in that folder. hts::Error if gnuplot fails; the script then stays and the picture
/// is not there.
void draw(const std::string& svg_path, std::string_view script);

/// hts::Error that names the picture and the package if there is no gnuplot: to be called before anything
/// else is written.
void require_gnuplot(const std::string& svg_path);

}  // namespace hts::cli

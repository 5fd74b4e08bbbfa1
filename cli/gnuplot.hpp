/// Draws with gnuplot, which must be installed at run time.
#pragma once

#include <string>
#include <string_view>

namespace hts::cli {

/// A text as a gnuplot string literal, taken as it is.
[[nodiscard]] std::string gnuplot_string(std::string_view text);

/// Writes the script beside the picture (figure.svg: figure.gnuplot), with the terminal and the output put
/// in front, and runs it in that folder. hts::Error if gnuplot is missing, naming the package, or fails; the
/// script then stays and the picture is not there.
void draw(const std::string& svg_path, std::string_view script);

}  // namespace hts::cli

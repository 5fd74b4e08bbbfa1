/// What gnuplot drew, made fit for a page.
#pragma once

#include <string>
#include <string_view>

namespace hts::output {

/// The picture with a title of its own, that of its largest text; without the names that gnuplot gives to
/// lines without a title, which a pointer over them would show; and with a dark form for readers whose system
/// is dark: lightness turned about, hues kept. It takes about half the bytes: coordinates in tenths of a
/// pixel, dots as points of a path.
[[nodiscard]] std::string finished_svg(std::string_view drawn);

}  // namespace hts::output

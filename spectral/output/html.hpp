/// What the pages that the project writes have in common.
#pragma once

#include <string>
#include <string_view>

namespace hts::output {

/// Text as it stands in HTML, in attributes too.
[[nodiscard]] std::string html_escaped(std::string_view text);

/// From the doctype to the heading: one self-contained page, light or dark as the reader's system is.
/// Classes: good, bad, model and soft.
///   title   of the window      heading   of the page
///   style   STYLE.css of spectral/output/pages/, beside page.css
[[nodiscard]] std::string html_head(std::string_view title, std::string_view heading, std::string_view style);

/// What closes it.
inline constexpr std::string_view html_foot = "</body></html>\n";

}  // namespace hts::output

/// Gnuplot scripts: files of spectral/output/scripts/, embedded, with what they draw as variables in front.
#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "hts/error.hpp"

namespace hts::output {

/// A text as a gnuplot string literal, taken as it is, on one line.
[[nodiscard]] std::string gnuplot_string(std::string_view text);

/// The name of a file as gnuplot may be given it: with ./ in front of what it would take for an option, a
/// pipe or its own input.
[[nodiscard]] std::string gnuplot_file(std::string_view name);

/// The embedded file NAME.gnuplot; hts::Error if there is none.
[[nodiscard]] std::string_view script_file(std::string_view name);

/// Rows of numbers; an empty one stands for a gap between lines.
using Rows = std::vector<std::vector<double>>;

/// A script in the making. Each call adds variables that the file names at its head.
class Script {
  public:
    Script& set(std::string_view variable, std::string_view text);
    template <class Number>
    requires std::is_arithmetic_v<Number> Script& set(std::string_view variable, Number value) {
        return line(std::string{variable}, literal(value));
    }
    /// An array, of texts or numbers; gnuplot has none that is empty, so neither may this be.
    template <class Value>
    Script& set(std::string_view variable, const std::vector<Value>& values) {
        std::string list;
        for (const auto& value : values) list.append(list.empty() ? "[" : ",").append(literal(value));
        return line("array " + std::string{variable} + "[" + std::to_string(values.size()) + "]", list + "]");
    }
    /// Numbers to be plotted as $BLOCK, NaN for none; of several lists each is an index of the block.
    Script& data(std::string_view block, const std::vector<Rows>& lists);
    Script& data(std::string_view block, const Rows& rows) { return data(block, std::vector<Rows>{rows}); }

    /// All variables and the file NAME.gnuplot.
    [[nodiscard]] std::string with(std::string_view name) const;

  private:
    [[nodiscard]] static std::string literal(const std::string& text) { return gnuplot_string(text); }
    [[nodiscard]] static std::string literal(double value) { return shortest(value); }
    [[nodiscard]] static std::string literal(std::integral auto value) { return std::to_string(value); }
    Script& line(const std::string& variable, const std::string& value);

    std::string text_;
};

}  // namespace hts::output

#include "spectral/output/script.hpp"

#include <cctype>

#include "spectral/output/embedded.hpp"

namespace hts::output {
std::string gnuplot_string(std::string_view text) {
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? "''" : c == '\n' ? " " : std::string(1, c);
    return quoted + "'";
}

std::string gnuplot_file(std::string_view name) {
    const bool plain =
        !name.empty() && (std::isalnum(static_cast<unsigned char>(name.front())) != 0 || name.front() == '_');
    return (plain ? "" : "./") + std::string{name};
}

std::string_view script_file(std::string_view name) {
    return spectral::embedded_text(script_files(), name);
}

Script& Script::set(std::string_view variable, std::string_view text) {
    return line(std::string{variable}, gnuplot_string(text));
}

Script& Script::data(std::string_view block, const std::vector<Rows>& lists) {
    text_.append("$").append(block).append(" << EOD\n");
    for (const Rows& rows : lists) {
        if (&rows != &lists.front()) text_ += "\n\n";
        for (const auto& row : rows) {
            for (std::size_t i = 0; i < row.size(); ++i)
                text_.append(i == 0 ? "" : ",").append(shortest(row[i]));
            text_ += '\n';
        }
    }
    text_ += "EOD\n";
    return *this;
}

std::string Script::with(std::string_view name) const {
    return text_ + std::string{script_file(name)};
}

Script& Script::line(const std::string& variable, const std::string& value) {
    text_.append(variable).append(" = ").append(value).append("\n");
    return *this;
}

}  // namespace hts::output

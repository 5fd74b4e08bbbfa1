#include "validation/report/figure.hpp"

#include "hts/error.hpp"
#include "spectral/text/text.hpp"

namespace hts::validation {

std::string page_label(const std::string& text, double x, double y, int size) {
    return "set label " + spectral::gnuplot_string(text) + " at screen " + shortest(x) + ',' + shortest(y) +
           " left noenhanced font '," + std::to_string(size) + "' tc rgb '#111111'\n";
}

std::string data_block(const std::string& name, const std::vector<std::vector<double>>& rows) {
    std::string text{"$"};
    text.append(name).append(" << EOD\n");
    for (const auto& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i) text.append(i == 0 ? "" : ",").append(shortest(row[i]));
        text += '\n';
    }
    return text.append("EOD\n");
}

}  // namespace hts::validation

#include "bench/charts/chart_script.hpp"
#include "spectral/text/text.hpp"

#include <algorithm>
#include <cmath>

namespace hts::bench::script {

std::string colour_number(const std::string& colour) {
    return "0x" + colour.substr(1);
}

double marker_size(const ChartMethod& method) {
    return 0.8 * std::sqrt(1 + static_cast<double>(method.bytes) / 200e3);
}

std::string time_tics() {
    return "('1 ns' 1, '10 ns' 10, '100 ns' 100, '1 µs' 1e3, '10 µs' 1e4, '100 µs' 1e5, '1 ms' 1e6, "
           "'10 ms' 1e7, '100 ms' 1e8, '1 s' 1e9)";
}

void begin_page(std::ostream& out, int width, int height) {
    out << "set terminal svg size " << width << "," << height
        << " enhanced font 'Helvetica,13' background '#ffffff'\n"
           "set output picture\n"
           "set multiplot\n"
           "set tics nomirror textcolor rgb '#333333'\n"
           "set border 3 lc rgb '#666666'\n"
           "unset key\n";
}

void write(std::ostream& out, double x, double y, int size, std::string_view text, std::string_view colour) {
    out << "set label " << spectral::gnuplot_string(text) << " at screen " << x << "," << y
        << " left front noenhanced font '," << size << "' textcolor rgb " << spectral::gnuplot_string(colour)
        << '\n';
}

void write_frame(std::ostream& out, const ChartData& data, std::string_view title, std::string_view subtitle,
                 double top) {
    write(out, 0.012, top, 20, title, "#000000");
    write(out, 0.012, top - 0.03, 13, subtitle, "#333333");
    write(out, 0.012, 0.016, 11, data.machine.text() + ", seed " + std::to_string(data.settings.seed),
          "#555555");
}

LegendPlace write_family(std::ostream& out, const std::string& family, LegendPlace at, double line) {
    write(out, at.x, at.y, 13, family, "#000000");
    for (const ChartMethod& method : chart_methods()) {
        if (method.style.family != family) continue;
        at.y -= line;
        write(out, at.x + 0.018, at.y, 12, method.style.label, "#222222");
        out << "set label '' at screen " << at.x + 0.007 << "," << at.y << " point pt " << method.style.marker
            << " ps " << marker_size(method) << " lw 1.6 lc rgb "
            << spectral::gnuplot_string(method.style.colour) << '\n';
    }
    return {at.x, at.y - 1.5 * line};
}

std::vector<std::string> families() {
    std::vector<std::string> result;
    for (const ChartMethod& method : chart_methods()) {
        if (std::find(result.begin(), result.end(), method.style.family) == result.end()) {
            result.push_back(method.style.family);
        }
    }
    return result;
}

}  // namespace hts::bench::script

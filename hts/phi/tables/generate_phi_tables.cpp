// Writes the coefficients of phi, the same bytes each time: generate_phi_tables FOLDER, a minute or two.
// Each octave is cut into as few cells as meet the Spec's share of its error; the coefficients are fitted in
// 50 digits, the cuts are chosen in long double.
#include <cstdint>
#include <fstream>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "hts/phi/tables/cells.hpp"

namespace hts::phi_detail {
namespace {

using Digits50 =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;
using boost::multiprecision::exp;
using boost::multiprecision::log;

/// What the cells of Q may take of the error: the rest is rounding, F, W and 2^f.
template <class Spec>
constexpr double cell_share = Spec::error == 1e-12 ? 1e-13 : 0.4 * Spec::error;

template <class Spec>
struct Coefficients {
    std::vector<double> cells, lines;
    std::vector<std::int64_t> directory;
    int line_pieces = 0;
    double worst_cell = 0, worst_line = 0;
};

template <class Spec>
double worst_of(const std::vector<Cell>& cells) {
    double worst = 0;
    for (const Cell& cell : cells) {
        worst =
            std::max(worst, worst_error<Spec>(cell, fitted<Spec, long double>(cell, correction<long double>),
                                              correction<long double>, cell_share<Spec>));
        if (worst > cell_share<Spec>) break;
    }
    return worst;
}

/// The fewest cells that meet the error, the saddle point before the first terms; none if 64 do not.
template <class Spec>
std::optional<Entry> best_cut(const Row& row, int octave, double& worst) {
    const bool bottom = row.exponent < Spec::emin;
    for (int log2_cells = 0; log2_cells <= 6; ++log2_cells) {
        for (int log2_z = 0; log2_z <= std::min(log2_cells, 3); ++log2_z) {
            if (log2_cells - log2_z > 4) continue;
            for (const bool saddle : {true, false}) {
                if (saddle ? bottom : row.top) continue;
                const Entry entry{0, saddle, log2_cells - log2_z, log2_z};
                const double error = worst_of<Spec>(cut(row, octave, entry));
                if (error > cell_share<Spec>) continue;
                worst = std::max(worst, error);
                return entry;
            }
        }
    }
    return std::nullopt;
}

template <class Spec>
void add_octave(Coefficients<Spec>& c, const Row& row, int octave) {
    auto entry = best_cut<Spec>(row, octave, c.worst_cell);
    std::int64_t& slot =
        c.directory[static_cast<std::size_t>((row.exponent - Spec::emin + 1) * octaves_per_row + octave)];
    if (!entry) {
        std::cerr << "no cells for the octave of 2^" << octave << " in the row of 2^" << row.exponent << '\n';
        return;
    }
    entry->first = static_cast<int>(c.cells.size()) / (Spec::rows * Spec::lanes);
    slot = packed(*entry);
    for (const Cell& cell : cut(row, octave, *entry)) {
        const auto coefficients = fitted<Spec, Digits50>(cell, correction<Digits50>);
        c.cells.insert(c.cells.end(), coefficients.begin(), coefficients.end());
    }
}

template <class Spec>
void add_cells(Coefficients<Spec>& c) {
    c.directory.assign((Spec::emax - Spec::emin + 2) * octaves_per_row, no_entry);
    for (int exponent = Spec::emin - 1; exponent <= Spec::emax; ++exponent) {
        const Row row = row_of<Spec>(exponent);
        for (int octave = 0; octave < row.octaves; ++octave) add_octave(c, row, octave);
    }
}

/// Octaves of v that saddle cells reach.
template <class Spec>
int octaves_of_v(const Coefficients<Spec>& c) {
    int octaves = row_of<Spec>(Spec::emax).octaves;
    for (int exponent = Spec::emin; exponent < Spec::emax; ++exponent) {
        const double g = std::ldexp(1.0, exponent);
        for (int octave = 0; octave < octaves_per_row; ++octave) {
            const auto slot =
                static_cast<std::size_t>((exponent - Spec::emin + 1) * octaves_per_row + octave);
            if (c.directory[slot] == no_entry || (c.directory[slot] & saddle_bit) == 0) continue;
            const double t = std::ldexp(2.0, octave) - 1;
            octaves = std::max(octaves, 1 + static_cast<int>(std::log2(1 + v_scale * t / (g * g))));
        }
    }
    return octaves;
}

template <class Spec>
void add_line(Coefficients<Spec>& c, double v0, double v1) {
    const auto v_at = [=](auto x) { return v0 + (v1 - v0) * (x + 1) / 2; };
    std::vector<Digits50> slopes, widths;
    for (const Digits50& x : chebyshev_nodes<Digits50>(Spec::line_rows)) {
        const auto lines = lines_at(Digits50(v_at(x)));
        slopes.push_back(lines.slope);
        widths.push_back(lines.width);
    }
    const auto slope = interpolant(slopes), width = interpolant(widths);
    std::vector<double> interleaved;
    for (int i = 0; i < Spec::line_rows; ++i) {
        interleaved.push_back(static_cast<typename Spec::Line>(slope[static_cast<std::size_t>(i)]));
        interleaved.push_back(static_cast<typename Spec::Line>(width[static_cast<std::size_t>(i)]));
    }
    for (int k = 0; k <= 8; ++k) {
        const long double x = -1 + k * 0.25L;
        long double slope_here = 0, width_here = 0;
        for (std::size_t i = interleaved.size(); i > 0; i -= 2) {
            slope_here = slope_here * x / 2 + interleaved[i - 2];
            width_here = width_here * x / 2 + interleaved[i - 1];
        }
        const auto expected = lines_at<long double>(v_at(x));
        // the slope's multiplier makes least_log_phi of it at most
        const long double error =
            std::max(std::abs(slope_here / expected.slope - 1) * -least_log_phi / std::log(2.0L),
                     std::abs(width_here - expected.width));
        c.worst_line = std::max(c.worst_line, static_cast<double>(error * std::log(2.0L)));
    }
    c.lines.insert(c.lines.end(), interleaved.begin(), interleaved.end());
}

template <class Spec>
void add_lines(Coefficients<Spec>& c) {
    constexpr int pieces = 1 << Spec::line_sub;
    c.line_pieces = octaves_of_v(c) * pieces;
    for (int i = 0; i < c.line_pieces; ++i) {
        const int octave = i / pieces, piece = i % pieces;
        add_line(c, std::ldexp(1 + double(piece) / pieces, octave),
                 std::ldexp(1 + double(piece + 1) / pieces, octave));
    }
    c.lines.resize(c.lines.size() + 2 * Spec::line_rows, 0.0);
    c.lines[c.lines.size() - 2 * Spec::line_rows] = static_cast<typename Spec::Line>(1 / std::log(2.0));
}

template <class T>
void print(std::ostream& out, const std::string& type, const std::string& name, const std::vector<T>& values,
           std::size_t per_line) {
    out << "alignas(64) constexpr " << type << ' ' << name << "[] = {\n" << std::hexfloat;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i] == T(0)) {
            out << "0,";
        } else {
            out << values[i] << ',';
        }
        if ((i + 1) % per_line == 0) out << '\n';
    }
    out << "};\n" << std::defaultfloat;
}

template <class Spec>
void write_table(const std::string& folder, const std::string& name, const std::string& spec) {
    Coefficients<Spec> c;
    add_cells(c);
    add_lines(c);
    std::ofstream out{folder + "/" + name + ".cpp"};
    out << "// Written by generate_phi_tables; do not edit. " << c.cells.size() / (Spec::rows * Spec::lanes)
        << " cells.\n// Worst error of ln Phi on the generator's own grid: " << c.worst_cell
        << " by the cells, " << c.worst_line << " by the lines\n// at ln Phi = " << least_log_phi << ".\n"
        << "// clang-format off\n#include \"hts/phi/tables/phi_table.hpp\"\n\nnamespace hts::phi_detail "
           "{\nnamespace "
           "{\n\n";
    print(out, spec + "::Coefficient", "cells", c.cells, Spec::lanes);
    print(out, std::is_same_v<typename Spec::Line, float> ? "float" : "double", "lines", c.lines, 2);
    print(out, "std::int64_t", "directory", c.directory, octaves_per_row);
    constexpr bool narrow = Spec::error == Low::error;
    if (narrow) print(out, "std::int32_t", "narrow_directory", c.directory, octaves_per_row);
    out << "\n}  // namespace\n\nconst Table<" << spec << "> table_" << name
        << " = {cells, lines, directory, " << c.line_pieces
        << ", sizeof cells + sizeof lines + sizeof directory"
        << (narrow ? " + sizeof narrow_directory, narrow_directory" : "")
        << "};\n\n}  // namespace hts::phi_detail\n";
}

void write_terms(const std::string& folder) {
    std::vector<double> logs, reciprocals;
    for (int m = 1; m <= most_terms; ++m) {
        logs.push_back(static_cast<double>((boost::math::lgamma(Digits50(m + 1)) + log(Digits50(m))) /
                                           boost::math::constants::ln_two<Digits50>()));
        reciprocals.push_back(1.0 / m);
    }
    std::ofstream out{folder + "/terms.hpp"};
    out << "// log2(m! m) and 1/m, by m - 1. Written by generate_phi_tables; do not edit.\n// clang-format "
           "off\n#pragma once\n\nnamespace hts::phi_detail {\n\n";
    print(out, "double", "term_logs", logs, 4);
    print(out, "double", "term_reciprocals", reciprocals, 4);
    out << "\n}  // namespace hts::phi_detail\n";
}

void print_exp2(std::ostream& out, int degree) {
    std::vector<Digits50> values;
    for (const Digits50& x : chebyshev_nodes<Digits50>(degree + 1))
        values.push_back(exp(x / 2 * log(Digits50(2))));
    const auto polynomial = interpolant(values);
    out << "template <>\ninline constexpr std::array<double, " << degree + 1 << "> exp2_coefficients<"
        << degree << ">{\n    1" << std::hexfloat;
    for (std::size_t i = 1; i < polynomial.size(); ++i)
        out << ",\n    " << static_cast<double>(polynomial[i]);
    out << "};\n" << std::defaultfloat;
}

void write_exp2(const std::string& folder) {
    std::ofstream out{folder + "/exp2.hpp"};
    out << "// Polynomials of 2^f on [-1/2, 1/2], by power. Written by generate_phi_tables; do not "
           "edit.\n// clang-format off\n#pragma once\n\n"
           "#include <array>\n\nnamespace hts::lanes {\n\n"
           "template <int degree>\ninline constexpr std::array<double, degree + 1> exp2_coefficients{};\n";
    for (const int degree : {Low::exp_degree, Medium::exp_degree, High::exp_degree}) print_exp2(out, degree);
    out << "\n}  // namespace hts::lanes\n";
}

}  // namespace
}  // namespace hts::phi_detail

int main(int argc, char** argv) {
    using namespace hts::phi_detail;
    if (argc != 2) {
        std::cerr << "usage: generate_phi_tables FOLDER\n";
        return 2;
    }
    const std::string folder = argv[1];
    write_exp2(folder);
    write_terms(folder);
    write_table<Low>(folder, "low", "Low");
    write_table<Medium>(folder, "medium", "Medium");
    write_table<High>(folder, "high", "High");
}

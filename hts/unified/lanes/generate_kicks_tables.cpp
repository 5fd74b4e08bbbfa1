// Writes the coefficients of kicks_table.hpp, the same bytes each time:
// generate_kicks_tables FOLDER, a minute.
#include <fstream>
#include <iostream>
#include <optional>
#include <string>

#include "hts/phi/tables/cells.hpp"
#include "hts/unified/lanes/kicks_table.hpp"

namespace hts::unified_detail {
namespace {

using namespace phi_detail;
using Real = long double;

/// log2(H/g)
Real exponent(bool /*saddle*/, const Point<Real>& p) {
    const SeriesSums<Real> sums = series_sums(p.g, p.t);
    return std::log2((sums.phi - sums.chi) / sums.chi / p.g);
}

template <class Spec>
std::optional<Entry> best_cut(const Row& row, int octave, double& worst) {
    for (int log2_cells = 0; log2_cells <= 7; ++log2_cells) {
        for (int log2_z = 0; log2_z <= std::min(log2_cells, 3); ++log2_z) {
            if (log2_cells - log2_z > 5) continue;
            const Entry entry{0, true, log2_cells - log2_z, log2_z};
            double error = 0;
            for (const Cell& cell : cut(row, octave, entry)) {
                error = std::max(error, worst_error<Spec>(cell, fitted<Spec, Real>(cell, exponent), exponent,
                                                          Spec::error));
                if (error > Spec::error) break;
            }
            if (error > Spec::error) continue;
            worst = std::max(worst, error);
            return entry;
        }
    }
    return std::nullopt;
}

template <class T>
void print(std::ostream& out, const std::string& type, const std::string& name, const std::vector<T>& values,
           std::size_t per_line) {
    out << "alignas(64) constexpr " << type << ' ' << name << "[] = {\n" << std::hexfloat;
    for (std::size_t i = 0; i < values.size(); ++i) {
        out << values[i] << ((i + 1) % per_line == 0 ? ",\n" : ",");
    }
    out << "};\n" << std::defaultfloat;
}

template <class Spec>
void write_table(const std::string& folder, const std::string& name, const std::string& spec) {
    std::vector<double> cells;
    std::vector<std::int64_t> directory((Spec::emax - Spec::emin + 2) * octaves_per_row, no_entry);
    double worst = 0;
    for (int exponent_of_g = Spec::emin - 1; exponent_of_g <= Spec::emax; ++exponent_of_g) {
        const Row row = row_of<Spec>(exponent_of_g);
        for (int octave = 0; octave < row.octaves; ++octave) {
            auto entry = best_cut<Spec>(row, octave, worst);
            if (!entry) {
                std::cerr << "no cells for the octave of 2^" << octave << " in the row of 2^" << exponent_of_g
                          << '\n';
                continue;
            }
            entry->first = static_cast<int>(cells.size()) / (Spec::rows * Spec::lanes);
            directory[static_cast<std::size_t>((exponent_of_g - Spec::emin + 1) * octaves_per_row + octave)] =
                packed(*entry);
            for (const Cell& cell : cut(row, octave, *entry)) {
                const auto coefficients = fitted<Spec, Real>(cell, exponent);
                cells.insert(cells.end(), coefficients.begin(), coefficients.end());
            }
        }
    }
    std::ofstream out{folder + "/kicks_" + name + ".cpp"};
    out << "// Written by generate_kicks_tables; do not edit. " << cells.size() / (Spec::rows * Spec::lanes)
        << " cells, worst relative error on the generator's own grid " << worst << ".\n"
        << "// clang-format off\n#include \"hts/unified/lanes/kicks_table.hpp\"\n\nnamespace "
           "hts::unified_detail {\nnamespace {\n\n";
    print(out, spec + "::Coefficient", "cells", cells, Spec::lanes);
    print(out, "std::int64_t", "directory", directory, octaves_per_row);
    out << "\n}  // namespace\n\nconst KicksTable<" << spec << "> kicks_" << name
        << " = {cells, directory, sizeof cells + sizeof directory};\n\n}  // namespace hts::unified_detail\n";
}

}  // namespace
}  // namespace hts::unified_detail

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: generate_kicks_tables FOLDER\n";
        return 2;
    }
    hts::unified_detail::write_table<hts::unified_detail::KicksLow>(argv[1], "low", "KicksLow");
    hts::unified_detail::write_table<hts::unified_detail::KicksMedium>(argv[1], "medium", "KicksMedium");
}

// hts figures: figures of the papers computed anew.

#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <memory>

#include "cli/io/figure_files.hpp"
#include "cli/io/options.hpp"
#include "cli/verbs/verbs.hpp"
#include "hts/error.hpp"
#include "validation/papers/he_figures.hpp"
#include "validation/papers/microfacet_figures.hpp"

namespace hts::cli {
namespace {

constexpr auto figures_help = R"(
he1991: Figs 7 to 11 of He, Torrance, Sillion and Greenberg 1991 in the paper's axes. Theory
alone: its measured curves are not available.

kurt: Figs 2 and 3 of Kurt, Szirmay-Kalos and Krivanek 2010, the albedo of their model
against the angle of incidence, and the largest exponent alpha with which it conserves
energy, against the width m (F = 1). About a minute on one core.

walter: Figs 2, 8, 10, 11, 13 and 14 of Walter, Marschner, Li and Torrance 2007, normals,
shadowing and light through four rough glasses. Theory alone: the measured points are not
at hand. Angles of transmission are positive on the side that light is refracted to; a
lobe ends where the facet that would refract there is vertical.

Into the folder go, for each, the picture (.svg), its script (.gnuplot) and its numbers
(.csv, or .json beside them with --json).

Example:
  hts figures he1991 --output out/he1991
  hts figures kurt --output out/kurt
  hts figures walter --output out/walter)";

/// Whose figures, and how to make them.
struct PaperFigures {
    const char* paper;
    std::vector<validation::Figure> (*make)();
};

constexpr std::array papers{PaperFigures{"he1991", validation::he_figures},
                            PaperFigures{"kurt", validation::kurt_figures},
                            PaperFigures{"walter", validation::walter_figures}};

struct FiguresOptions {
    std::string paper, folder;
    bool json = false;
};

void run(const FiguresOptions& options) {
    const std::filesystem::path folder{options.folder};
    const auto* const of_paper = std::find_if(
        papers.begin(), papers.end(), [&](const PaperFigures& each) { return options.paper == each.paper; });
    for (const validation::Figure& figure : of_paper->make()) {
        std::cout << write_figure(folder, figure, options.json).string() << '\n';
    }
}

}  // namespace

void add_figures(CLI::App& program) {
    CLI::App* verb = program.add_subcommand("figures", "figures of the papers computed anew, SVG by gnuplot");
    auto options = std::make_shared<FiguresOptions>();
    std::vector<std::string> names;
    names.reserve(papers.size());
    for (const PaperFigures& each : papers) names.emplace_back(each.paper);
    one_of(verb->add_option("paper", options->paper, "whose figures"), names)->required();
    fills(verb->add_option("-o,--output", options->folder, "folder for pictures and numbers"))->required();
    verb->add_flag("--json", options->json, "the numbers as JSON too");
    verb->footer(figures_help);
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli

// hts furnace: the energy that the model gains and loses where every facet is a perfect mirror.

#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <vector>

#include "cli/answers/furnace_script.hpp"
#include "cli/io/options.hpp"
#include "cli/io/table_writer.hpp"
#include "cli/verbs/verbs.hpp"
#include "hts/error.hpp"
#include "spectral/energy/compensation.hpp"
#include "spectral/output/gnuplot.hpp"
#include "spectral/parallel.hpp"
#include "tables/formats/measured_model.hpp"

namespace hts::cli {
namespace {

namespace fs = std::filesystem;

constexpr auto furnace_help = R"(
The furnace test: a surface whose facets reflect everything (|F|^2 = 1) ought to return all
the light. The model does not, since its shadowing is of first order; what matters is
sigma_0/tau, sigma_0/lambda and the angle of incidence alone. Into the folder go
  furnace.csv, furnace.json      sigma0_over_tau, sigma0_over_lambda, theta_i_deg, specular,
                                 directional_diffuse, total [, compensated_total]
  furnace.svg, furnace.gnuplot   the total as a map, a panel per sigma_0/tau
With --compensate-energy also the total with the library's optional compensation, and its
map as furnace-compensated.svg. Of the correlation of a --material tau is the length.
Seconds with --quick, a minute or two without; some times longer with other correlations.

Examples:
  hts furnace --output out/furnace --quick
  hts furnace --output out/furnace --compensate-energy)";

struct FurnaceOptions {
    std::string folder, material;
    bool quick = false, compensate = false;
};

struct FurnacePoint {
    spectral::HemisphericalReflectance model;
    double compensated;
};

FurnaceGrid furnace_grid(bool quick) {
    FurnaceGrid grid{{0.02, 0.05, 0.1, 0.25, 0.5, 1}, {}, {}};
    const int roughnesses = quick ? 8 : 28, angles = quick ? 18 : 45;
    constexpr double least = 0.01, most = 5;  // sigma_0/lambda: from nearly a mirror to geometric optics
    for (int i = 0; i < roughnesses; ++i) {
        grid.roughnesses.push_back(least * std::pow(most / least, i / (roughnesses - 1.0)));
    }
    const double step = quick ? 5 : 2;
    for (int i = 0; i < angles; ++i) grid.degrees.push_back(step * i);
    return grid;
}

/// All angles of one surface, at a wavelength of 1 um.
///   like   whose theory and correlation it has
std::vector<FurnacePoint> furnace_curve(const FurnaceGrid& grid, const spectral::RoughSurface& like,
                                        double slope, double roughness, bool compensate) {
    const Surface gaussian{roughness, roughness / slope};
    const spectral::RoughSurface surface =
        like.with(like.correlation() ? gaussian.correlated(*like.correlation()) : gaussian);
    const auto wavelength = Wavelength::from_micrometres(1);
    std::optional<spectral::EnergyCompensation> compensation;
    if (compensate) compensation.emplace(surface, wavelength);
    std::vector<FurnacePoint> points;
    for (const double degrees : grid.degrees) {
        const auto in = Direction::from_degrees(degrees, 0);
        const spectral::PerfectMirror facets;
        FurnacePoint point{spectral::directional_hemispherical_reflectance(surface, facets, wavelength, in),
                           0};
        if (compensation) {
            point.compensated = spectral::directional_hemispherical_reflectance(*compensation, surface,
                                                                                facets, wavelength, in)
                                    .total();
        }
        points.push_back(point);
    }
    return points;
}

std::vector<FurnacePoint> furnace_map(const FurnaceGrid& grid, const spectral::RoughSurface& like,
                                      bool compensate) {
    const std::size_t across = grid.roughnesses.size();
    std::vector<std::vector<FurnacePoint>> curves(grid.slopes.size() * across);
    spectral::parallel_for(
        curves.size(),
        [&](std::size_t i) {
            curves[i] =
                furnace_curve(grid, like, grid.slopes[i / across], grid.roughnesses[i % across], compensate);
        },
        1);
    std::vector<FurnacePoint> points;
    for (const auto& curve : curves) points.insert(points.end(), curve.begin(), curve.end());
    return points;
}

void write_table(const fs::path& path, const FurnaceGrid& grid, const std::vector<FurnacePoint>& points,
                 bool compensate) {
    std::vector<std::string> columns{"sigma0_over_tau", "sigma0_over_lambda",  "theta_i_deg",
                                     "specular",        "directional_diffuse", "total"};
    if (compensate) columns.emplace_back("compensated_total");
    Output output{path.string()};
    TableWriter table{output, format_of(path.string(), false), columns};
    std::string text;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::size_t curve = i / grid.degrees.size();
        TableWriter::Row row{table, text};
        row.field(shortest(grid.slopes[curve / grid.roughnesses.size()]));
        row.field(shortest(grid.roughnesses[curve % grid.roughnesses.size()]));
        row.field(shortest(grid.degrees[i % grid.degrees.size()]));
        row.number(points[i].model.specular).number(points[i].model.directional_diffuse);
        row.number(points[i].model.total());
        if (compensate) row.number(points[i].compensated);
        row.end();
    }
    table.add(text);
    table.finish();
    output.commit();
}

template <class Total>
void draw_map(const fs::path& path, const FurnaceGrid& grid, const std::vector<FurnacePoint>& points,
              const std::string& title, Total&& total) {
    std::vector<double> totals;
    totals.reserve(points.size());
    for (const FurnacePoint& point : points) totals.push_back(total(point));
    output::draw(
        path.string(),
        furnace_script(grid, totals, title,
                       "Total reflectance of a rough surface whose facets reflect everything, |F|² = 1; "
                       "energy is conserved where it is 1."));
    std::cout << path.string() << '\n';
}

/// Whose energy is mapped, and under which title.
struct FurnaceSubject {
    spectral::RoughSurface like;
    std::string title;
};

/// The published model's of a Gaussian correlation, or what a material file says.
FurnaceSubject subject(const std::string& material) {
    if (material.empty()) return {{1, 1}, "Where the model gains and loses energy"};
    const auto read = spectral::read_material(material, tables::models_with_files());
    if (const auto& surface = read.properties().surface) {
        const auto& shape = surface->correlation();
        return {*surface, "Where " + read.model_name() + " gains and loses energy, correlation " +
                              (shape ? shape->name() : "gaussian")};
    }
    throw Error{material + ": model " + read.model_name() + ": must be he or he_unified"};
}

void run(const FurnaceOptions& options) {
    const fs::path folder{options.folder};
    output::require_gnuplot((folder / "furnace.svg").string());
    const FurnaceGrid grid = furnace_grid(options.quick);
    const FurnaceSubject of = subject(options.material);
    const auto points = furnace_map(grid, of.like, options.compensate);
    for (const char* name : {"furnace.csv", "furnace.json"}) {
        write_table(folder / name, grid, points, options.compensate);
    }
    draw_map(folder / "furnace.svg", grid, points, of.title,
             [](const FurnacePoint& point) { return point.model.total(); });
    if (!options.compensate) return;
    draw_map(folder / "furnace-compensated.svg", grid, points, "The same with energy compensation",
             [](const FurnacePoint& point) { return point.compensated; });
}

}  // namespace

void add_furnace(CLI::App& program) {
    CLI::App* verb =
        program.add_subcommand("furnace", "map of the energy the model gains and loses, SVG by gnuplot");
    auto options = std::make_shared<FurnaceOptions>();
    fills(verb->add_option("-o,--output", options->folder, "folder for the map and its table"),
          {"furnace.csv", "furnace.json", "furnace.svg", "furnace.gnuplot"})
        ->required();
    verb->add_option("-m,--material", options->material,
                     "material file whose theory and correlation take the place of he and a Gaussian");
    verb->add_flag("--quick", options->quick, "a coarser map");
    verb->add_flag("--compensate-energy", options->compensate, "map the optional energy compensation, too");
    verb->footer(furnace_help);
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli

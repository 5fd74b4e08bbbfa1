// hts spectrum: the BRDF spectrum of a material at one pair of directions, and its colour.

#include <iomanip>
#include <iostream>
#include <memory>
#include <numbers>
#include <sstream>
#include <utility>

#include "cli/answers/spectrum_colour.hpp"
#include "cli/answers/validity_warning.hpp"
#include "cli/io/options.hpp"
#include "cli/io/table_writer.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/verbs.hpp"
#include "spectral/models/reflected_terms.hpp"
#include "spectral/output/gnuplot.hpp"
#include "spectral/output/script.hpp"
#include "spectral/text/text.hpp"

namespace hts::cli {
namespace {

constexpr auto spectrum_help = R"(
Columns wavelength_um, directional_diffuse, uniform_diffuse, brdf [1/sr] and
specular_reflectance [1]. The colour (CIE 1931, 2 degrees) is that of the radiance factor
pi f of both diffuse terms, and that of the specular reflectance; it goes to standard
error, in JSON beside the spectrum.
With --tolerance 1e-6 the spectrum itself takes some tens of microseconds less, which the
start of the command hides.

Examples:
  hts spectrum --material cli/data/rough-aluminium.json --theta-i 30 --theta-r 30 --phi 180
  hts spectrum --material cli/data/rough-aluminium.json --theta-i 30 --theta-r 45 --phi 180 \
      --wavelengths 0.4:0.7:31 --illuminant E --output spectrum.csv --plot spectrum.svg)";

struct SpectrumOptions {
    MaterialOptions material;
    DirectionOptions directions;
    OutputOptions output;
    std::string wavelengths = "0.38:0.78:41", illuminant, plot;
    bool compensate = false;
    ToleranceOption tolerance;
};

/// The three terms, one value per wavelength.
struct Spectrum {
    std::vector<double> directional_diffuse, uniform_diffuse, brdf, specular_reflectance;
};

Spectrum spectrum_of(const spectral::Reflectance& model, const spectral::DirectionPair& pair) {
    auto terms = spectral::reflected_terms(model, pair);
    return {std::move(terms.directional_diffuse), std::move(terms.uniform_diffuse), model.brdf(pair),
            std::move(terms.specular_reflectance)};
}

spectral::Reflectance reflectance_of(const SpectrumOptions& options, const spectral::Material& material,
                                     const spectral::WavelengthGrid& grid) {
    if (options.compensate) require_rough_surface(material, "--compensate-energy");
    options.tolerance.require_met_by(material);
    return reflectance_from_option("--wavelengths", material, grid,
                                   {.tolerance = options.tolerance.tolerance(),
                                    .outside = options.material.policy(),
                                    .compensate_energy = options.compensate});
}

void write_table(Output& output, Format format, const spectral::WavelengthGrid& grid,
                 const Spectrum& spectrum) {
    TableWriter table{
        output,
        format,
        {"wavelength_um", "directional_diffuse", "uniform_diffuse", "brdf", "specular_reflectance"}};
    for (std::size_t i = 0; i < grid.size(); ++i) {
        std::string text;
        TableWriter::Row row{table, text};
        row.field(shortest(grid.micrometres()[i]));
        row.number(spectrum.directional_diffuse[i]).number(spectrum.uniform_diffuse[i]);
        row.number(spectrum.brdf[i]).number(spectrum.specular_reflectance[i]).end();
        table.add(text);
    }
    table.finish();
}

std::string title(const spectral::Material& material, const DirectionOptions& directions) {
    return material.name() + ", theta_i " + shortest(*directions.theta_i) + ", theta_r " +
           shortest(*directions.theta_r) + ", phi " +
           shortest(directions.reflected_azimuth() - directions.incident_azimuth()) + " deg";
}

std::string plot_script(const std::string& title, const spectral::WavelengthGrid& grid,
                        const Spectrum& spectrum) {
    output::Rows rows;
    for (std::size_t i = 0; i < grid.size(); ++i) {
        rows.push_back({grid.micrometres()[i], spectrum.brdf[i], spectrum.specular_reflectance[i]});
    }
    return output::Script{}.set("title", title).data("spectrum", rows).with("spectrum");
}

/// The colour, none for a grid that does not span the visible unless an illuminant was asked for.
std::optional<SpectrumColour> colour(const SpectrumOptions& options, const spectral::WavelengthGrid& grid,
                                     const Spectrum& spectrum) {
    const bool asked = !options.illuminant.empty();
    const auto illuminant = from_option(
        "--illuminant", [&] { return spectral::illuminant_named(asked ? options.illuminant : "D65"); });
    try {
        const auto weights = spectral::tristimulus_weights(grid.micrometres(), illuminant);
        return SpectrumColour{weights.of_brdf(spectrum.brdf), weights(spectrum.specular_reflectance),
                              illuminant};
    } catch (const Error& error) {
        if (asked) throw UsageError{std::string{"--wavelengths and --illuminant: "} + error.what()};
        std::cerr << "hts: no colour: " << error.what() << '\n';
        return std::nullopt;
    }
}

void run(const SpectrumOptions& options) {
    const auto pair = options.directions.pair();
    const auto grid = wavelengths_from_option(options.wavelengths);
    const auto material = options.material.read();
    require_spectrum(material);
    if (!options.plot.empty()) output::require_gnuplot(options.plot);
    const auto reflectance = reflectance_of(options, material, grid);
    const auto spectrum = spectrum_of(reflectance, pair);
    const auto seen = colour(options, grid, spectrum);

    Output output{options.output.path};
    const Format format = format_of(options.output.path, options.output.json);
    if (format == Format::json) {
        output.write("{\"material\": " + json_string(material.name()) +
                     ",\n \"colour\": " + (seen ? seen->json() : "null") + ",\n \"spectrum\": ");
    }
    write_table(output, format, grid, spectrum);
    if (format == Format::json) output.write("}\n");
    output.commit();
    ValidityWarning warning;
    warning.note(reflectance, pair);
    warning.print(options.material.path);
    if (seen) std::cerr << title(material, options.directions) << '\n' << seen->text();
    if (!options.plot.empty())
        output::draw(options.plot, plot_script(title(material, options.directions), grid, spectrum));
}

}  // namespace

void add_spectrum(CLI::App& program) {
    CLI::App* verb = program.add_subcommand("spectrum", "BRDF spectrum and colour at one pair of directions");
    auto options = std::make_shared<SpectrumOptions>();
    options->material.add_to(*verb)->required();
    options->directions.add_to(*verb);
    verb->add_option(wavelengths_names, options->wavelengths, "first:last:count or a,b,c [um]")
        ->capture_default_str();
    verb->add_option("--illuminant", options->illuminant, "D65 (default) or E");
    verb->add_flag(
        "--compensate-energy", options->compensate,
        "with the optional energy compensation, which is not part of the published model he;\nsome "
        "50 ms for each wavelength");
    options->tolerance.add_to(*verb);
    options->output.add_to(*verb);
    draws(verb->add_option("--plot", options->plot, "draw the spectrum as SVG (needs gnuplot)"));
    verb->footer(spectrum_help);
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli

// hts spectrum: the BRDF spectrum of a material at one pair of directions, and its colour.

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <memory>
#include <numbers>
#include <sstream>

#include "cli/answers/spectrum_colour.hpp"
#include "cli/answers/validity_warning.hpp"
#include "cli/io/gnuplot.hpp"
#include "cli/io/options.hpp"
#include "cli/io/table_writer.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/verbs.hpp"
#include "spectral/models/spectral_brdf.hpp"
#include "spectral/text/text.hpp"

namespace hts::cli {
namespace {

constexpr auto spectrum_help = R"(
Columns wavelength_um, directional_diffuse, uniform_diffuse, brdf [1/sr] and
specular_reflectance [1]. The colour (CIE 1931, 2 degrees) is that of the radiance factor
pi f of both diffuse terms, and that of the specular reflectance; it goes to standard
error, in JSON beside the spectrum.

Examples:
  hts spectrum --material aluminium.json --theta-i 30 --theta-r 30 --phi 180
  hts spectrum --material aluminium.json --theta-i 30 --theta-r 45 --phi 180 \
      --wavelengths 0.4:0.7:31 --illuminant E --output spectrum.csv --plot spectrum.svg)";

struct SpectrumOptions {
    MaterialOptions material;
    DirectionOptions directions;
    OutputOptions output;
    std::string wavelengths = "0.38:0.78:41", illuminant, plot;
    bool compensate = false;
};

/// The three terms, one value per wavelength.
struct Spectrum {
    std::vector<double> directional_diffuse, uniform_diffuse, brdf, specular_reflectance;
};

Spectrum spectrum_of(const spectral::SpectralBrdf& model, const spectral::DirectionPair& pair) {
    const std::vector<double> none(model.wavelengths().size());
    Spectrum result{none, none, none, none};
    model.directional_diffuse(pair, result.directional_diffuse);
    model.brdf(pair, result.brdf);
    model.specular_reflectance(pair.in, result.specular_reflectance);
    model.uniform_diffuse(result.uniform_diffuse);
    for (std::size_t i = 0; i < none.size(); ++i)  // on the horizon most models have none of either
        result.uniform_diffuse[i] = std::min(result.uniform_diffuse[i], result.brdf[i]);
    return result;
}

Spectrum spectrum_of(const SpectrumOptions& options, const spectral::AnyReflector& reflector,
                     const spectral::WavelengthGrid& grid, const spectral::DirectionPair& pair) {
    const auto policy = options.material.policy();
    if (!options.compensate) {
        const auto model =
            spectral::located("--wavelengths", [&] { return model_brdf(reflector, grid, policy); });
        return spectrum_of(*model, pair);
    }
    const spectral::Reflector& he = MaterialOptions::he_torrance(reflector, "--compensate-energy");
    const auto model = spectral::located("--wavelengths", [&] { return compensated_brdf(he, grid, policy); });
    return spectrum_of(*model, pair);
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

std::string title(const spectral::AnyReflector& reflector, const DirectionOptions& directions) {
    return reflector.name() + ", theta_i " + shortest(*directions.theta_i) + ", theta_r " +
           shortest(*directions.theta_r) + ", phi " +
           shortest(directions.reflected_azimuth() - directions.incident_azimuth()) + " deg";
}

std::string plot_script(const std::string& title, const spectral::WavelengthGrid& grid,
                        const Spectrum& spectrum) {
    std::ostringstream script;
    script << "set title " << gnuplot_string(title) << " noenhanced\n"
           << "set xlabel 'wavelength [µm]'\nset ylabel 'BRDF [1/sr]'\n"
           << "set y2label 'specular reflectance'\nset ytics nomirror\nset y2tics\n"
           << "set yrange [0:*]\nset y2range [0:*]\nset grid lc rgb '#dddddd'\n"
           << "set bmargin at screen 0.18\nset key at screen 0.5,0.02 bottom center horizontal\n"
           << "$spectrum << EOD\n";
    for (std::size_t i = 0; i < grid.size(); ++i) {
        script << grid.micrometres()[i] << ' ' << spectrum.brdf[i] << ' ' << spectrum.specular_reflectance[i]
               << '\n';
    }
    script
        << "EOD\n"
        << "plot $spectrum using 1:2 with lines lw 2.5 lc rgb '#0072b2' title 'diffuse terms (left)', \\\n"
        << "     '' using 1:3 axes x1y2 with lines lw 2.5 dt 2 lc rgb '#d55e00' title 'specular (right)'\n";
    return script.str();
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
    const auto reflector = options.material.read();
    if (!options.plot.empty()) require_gnuplot(options.plot);
    const auto spectrum = spectrum_of(options, reflector, grid, pair);
    const auto seen = colour(options, grid, spectrum);

    Output output{options.output.path};
    const Format format = format_of(options.output.path, options.output.json);
    if (format == Format::json) {
        output.write("{\"material\": " + json_string(reflector.name()) +
                     ",\n \"colour\": " + (seen ? seen->json() : "null") + ",\n \"spectrum\": ");
    }
    write_table(output, format, grid, spectrum);
    if (format == Format::json) output.write("}\n");
    output.commit();
    ValidityWarning warning;
    warning.note(reflector, pair, grid, options.material.policy());
    warning.print();
    if (seen) std::cerr << title(reflector, options.directions) << '\n' << seen->text();
    if (!options.plot.empty())
        draw(options.plot, plot_script(title(reflector, options.directions), grid, spectrum));
}

}  // namespace

void add_spectrum(CLI::App& program) {
    CLI::App* verb = program.add_subcommand("spectrum", "BRDF spectrum and colour at one pair of directions");
    auto options = std::make_shared<SpectrumOptions>();
    options->material.add_to(*verb)->required();
    options->directions.add_to(*verb);
    verb->add_option("--wavelengths", options->wavelengths, "first:last:count or a,b,c [um]")
        ->capture_default_str();
    verb->add_option("--illuminant", options->illuminant, "D65 (default) or E");
    verb->add_flag(
        "--compensate-energy", options->compensate,
        "with the optional energy compensation, which is not part of the published model he;\nsome "
        "50 ms for each wavelength");
    options->output.add_to(*verb);
    verb->add_option("--plot", options->plot, "draw the spectrum as SVG (needs gnuplot)")->check(svg_file());
    verb->footer(spectrum_help);
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli

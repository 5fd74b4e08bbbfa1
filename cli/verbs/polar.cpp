// hts polar: in-plane polar plots as in He et al. 1991, Figures 7 to 10.

#include <filesystem>
#include <iostream>
#include <memory>
#include <numbers>
#include <span>

#include "cli/answers/validity_warning.hpp"
#include "cli/io/options.hpp"
#include "cli/io/table_writer.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/verbs.hpp"
#include "spectral/output/gnuplot.hpp"
#include "spectral/output/script.hpp"
#include "validation/papers/polar_script.hpp"

namespace hts::cli {
namespace {

using validation::EqualCones;
using validation::PolarCurve;
using validation::PolarPoint;
using validation::PolarRadius;
using validation::PolarStyle;
using validation::sine_curve;
using validation::SineCurve;
using validation::SinePoint;

constexpr auto polar_help = R"(
The polar angle is the view angle in the plane of incidence, -90 ... 90 deg, positive on
the mirror's side; a curve per angle of incidence. The radius is the BRDF divided by the
BRDF in the specular direction theta_r = theta_i (He et al. 1991, eq. 11), or the BRDF
itself with --absolute.
--output figure.svg also writes figure.csv (the numbers) and figure.gnuplot (the script);
an output .csv or .json, or -, gives the numbers only.
--log-beta draws optical designers' plot in place of it: the BRDF over |beta - beta_0|, both
logarithmic, beta = sin theta_r in the plane of incidence and beta_0 = sin theta_i, so that a
spectrum of heights that falls as a power is a straight line; one line beyond the mirror
direction (beta > beta_0), one within. The numbers are then theta_i_deg, side (beyond or
within), beta, beta_difference, directional_diffuse, uniform_diffuse, brdf.
The specular term is a delta and is left out unless --solid-angle is given: then source
and receiver are cones of that solid angle w, and the specular term is
rho_s / (cos theta_i w) times the common part of two discs of the cones' half angle
acos(1 - w / 2 pi), one about the mirror direction, one about the view. The diffuse terms
are not averaged over the cones. The paper has w = pi/1024 sr = 0.0030679616.

Examples:
  hts polar --material cli/data/rough-aluminium.json --wavelength 0.5 --theta-i 10,30,45,60,75 \
      --solid-angle 0.0030679616 --output figure.svg
  hts polar --material cli/data/rough-aluminium.json --wavelength 2 --theta-i 45 --absolute --log \
      --output log.svg
  hts polar --material cli/data/rough-aluminium.json --wavelength 0.5 --theta-i 0,30,60 --log-beta \
      --output scatter.svg)";

struct PolarOptions {
    MaterialOptions material;
    OutputOptions output;
    double wavelength = 0, phi_i = 0;
    std::vector<double> theta_i;
    std::optional<double> solid_angle;
    bool absolute = false, logarithmic = false, sines = false;

    [[nodiscard]] PolarRadius radius() const {
        return absolute ? PolarRadius::absolute : PolarRadius::normalised;
    }
};

std::optional<EqualCones> cones(const PolarOptions& options) {
    if (!options.solid_angle) return std::nullopt;
    return from_option("--solid-angle", [&] { return EqualCones{*options.solid_angle}; });
}

std::vector<PolarCurve> curves(const PolarOptions& options, const spectral::Reflectance& reflectance) {
    std::vector<PolarCurve> result;
    for (const double theta_i : options.theta_i) {
        result.push_back(polar_curve(reflectance, theta_i, options.phi_i, cones(options), options.radius()));
    }
    return result;
}

void write_table(const std::string& path, Format format, const std::vector<PolarCurve>& curves) {
    Output output{path};
    TableWriter table{output,
                      format,
                      {"theta_i_deg", "view_angle_deg", "directional_diffuse", "uniform_diffuse",
                       "specular_average_per_sr", "radius"}};
    std::string text;
    for (const PolarCurve& curve : curves) {
        for (const PolarPoint& point : curve.points) {
            TableWriter::Row row{table, text};
            row.field(shortest(curve.theta_i)).field(shortest(point.view_angle));
            row.number(point.directional_diffuse).number(point.uniform_diffuse).number(point.specular);
            row.number(point.radius).end();
        }
    }
    table.add(text);
    table.finish();
    output.commit();
}

void write_sines(const std::string& path, Format format, const std::vector<SineCurve>& curves) {
    Output output{path};
    TableWriter table{
        output,
        format,
        {"theta_i_deg", "side", "beta", "beta_difference", "directional_diffuse", "uniform_diffuse", "brdf"}};
    std::string text;
    const auto add = [&](double theta_i, const char* side, std::span<const SinePoint> points) {
        for (const SinePoint& point : points) {
            TableWriter::Row row{table, text};
            row.field(shortest(theta_i)).word(side).number(point.beta).number(point.difference);
            row.number(point.directional_diffuse).number(point.uniform_diffuse).number(point.brdf()).end();
        }
    };
    for (const SineCurve& curve : curves) {
        add(curve.theta_i, "beyond", curve.beyond);
        add(curve.theta_i, "within", curve.within);
    }
    table.add(text);
    table.finish();
    output.commit();
}

std::string title(const PolarOptions& options, const std::string& name) {
    std::string text = name + ", λ = " + shortest(options.wavelength) + " µm";
    if (options.phi_i != 0) text += ", light from azimuth " + shortest(options.phi_i) + "°";
    return text;
}

PolarStyle style(const PolarOptions& options, const std::string& name, const std::string& data_file) {
    PolarStyle style;
    style.title = title(options, name);
    style.captions.emplace_back(
        options.absolute
            ? "radius: BRDF [1/sr]"
            : "radius: BRDF / BRDF in the specular direction θ_r = θ_i, eq. 11 of He et al. 1991");
    if (options.logarithmic) style.captions.front() += ", logarithmic";
    const auto averaged = cones(options);
    style.captions.push_back(averaged ? "specular term averaged over source and receiver cones of " +
                                            brief(averaged->solid_angle()) + " sr (half angle " +
                                            brief(averaged->half_angle() * 180 / std::numbers::pi) + "°)"
                                      : "specular term left out (--solid-angle averages it)");
    style.data_file = data_file;
    style.logarithmic = options.logarithmic;
    return style;
}

/// About the specular direction of each curve, where the lobe is.
void warn(const PolarOptions& options, const spectral::Reflectance& reflectance) {
    ValidityWarning warning;
    for (const double degrees : options.theta_i) {
        const Direction in = Direction::from_degrees(degrees, 0);
        warning.note(reflectance, {in, in.mirror()});
    }
    warning.print(options.material.path);
}

/// The numbers by `table`; of a picture beside it, with the script that `script` makes for their file.
template <class WriteTable, class Script>
void write_drawn(const PolarOptions& options, const WriteTable& table, const Script& script) {
    const std::filesystem::path path{options.output.path};
    if (path.extension() != ".svg")
        return table(options.output.path, format_of(options.output.path, options.output.json));
    output::require_gnuplot(options.output.path);
    const auto data = std::filesystem::path{path}.replace_extension(".csv");
    const std::string drawing = script(output::gnuplot_file(data.filename().string()));
    table(data.string(), Format::csv);
    output::draw(options.output.path, drawing);
}

void write(const PolarOptions& options, const spectral::Reflectance& reflectance) {
    if (options.sines) {
        constexpr double least = 1e-4;
        std::vector<SineCurve> drawn;
        for (const double theta_i : options.theta_i)
            drawn.push_back(sine_curve(reflectance, theta_i, options.phi_i, least));
        return write_drawn(
            options, [&](const std::string& path, Format format) { write_sines(path, format, drawn); },
            [&](const std::string& data) {
                return sine_script(drawn, title(options, reflectance.name()), data);
            });
    }
    const auto drawn = curves(options, reflectance);
    write_drawn(
        options, [&](const std::string& path, Format format) { write_table(path, format, drawn); },
        [&](const std::string& data) {
            return polar_script(drawn, style(options, reflectance.name(), data));
        });
}

void run(const PolarOptions& options) {
    wavelength_from_option(options.wavelength);
    require_angles("--theta-i", options.theta_i);
    static_cast<void>(cones(options));
    if (options.output.json && std::filesystem::path{options.output.path}.extension() == ".svg") {
        throw UsageError{"--json: must not come with an output .svg"};
    }
    from_option("--phi-i", [&] { return Direction::from_degrees(0, options.phi_i); });
    if (options.sines && (options.absolute || options.logarithmic || options.solid_angle))
        throw UsageError{"--log-beta: must not come with --absolute, --log, --solid-angle"};
    const auto grid = spectral::WavelengthGrid::from_micrometres({options.wavelength});
    const auto reflectance =
        reflectance_from_option("--wavelength", options.material.read(), grid, options.material.evaluation());
    write(options, reflectance);
    warn(options, reflectance);
}

}  // namespace

void add_polar(CLI::App& program) {
    CLI::App* verb = program.add_subcommand("polar", "polar plot in the plane of incidence, SVG by gnuplot");
    auto options = std::make_shared<PolarOptions>();
    options->material.add_to(*verb)->required();
    verb->add_option(wavelength_names, options->wavelength, "wavelength [um]")->required();
    comma_list(*verb, theta_i_names, options->theta_i,
               "angles of incidence [deg], 0 ... 90, separated by commas")
        ->required();
    verb->add_option("--phi-i", options->phi_i, "azimuth of the light [deg], for anisotropic materials")
        ->capture_default_str();
    verb->add_option("--solid-angle", options->solid_angle, "of source and receiver [sr], > 0 ... 1");
    verb->add_flag("--absolute", options->absolute, "radius: the BRDF itself");
    verb->add_flag("--log", options->logarithmic, "logarithmic radius, four decades");
    verb->add_flag("--log-beta", options->sines, "BRDF over |beta - beta_0|, both logarithmic");
    options->output.add_to(*verb, [](const std::string& path) -> std::vector<std::string> {
        const std::filesystem::path picture{path};
        if (picture.extension() != ".svg") return {};
        return {std::filesystem::path{path}.replace_extension(".csv"),
                std::filesystem::path{path}.replace_extension(".gnuplot")};
    });
    verb->footer(polar_help);
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli

// hts scatter: the parameters by which optical designers exchange scatter, of any material.

#include <iostream>
#include <memory>

#include "cli/answers/validity_warning.hpp"
#include "cli/io/options.hpp"
#include "cli/io/output.hpp"
#include "cli/io/table_writer.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/verbs.hpp"
#include "validation/fit/scatter_parameters.hpp"

namespace hts::cli {
namespace {

constexpr auto scatter_help = R"(
Fits three forms to the BRDF of the diffuse terms in the plane of incidence, by logarithms,
on both sides of the mirror direction; x = |sin(theta_r) - sin(theta_i)|, signed in the plane:
  abg            A/(B + x^g)
  harvey_shack   b0 (1 + (x/l)^2)^(s/2)
  k_correlation  16 pi^2 cos(theta_i) cos(theta_r) Q S2(x/lambda)/lambda^4, the law of smooth
                 surfaces, S2(f) = A/(1 + (B f)^2)^(s/2): Zemax' and FRED's numbers, the rms
                 roughness that of frequencies 0 ... 1/lambda; of views with
                 cos(theta_r) >= cos(theta_i)/2
Each parameter is a row, with the median and the root mean square of ln(form/BRDF) that its
form leaves. Q is what the material reflects in all unless --reflectance says it. Of rough
surfaces, or where the residual is large, the numbers of k_correlation are effective ones.

Examples:
  hts scatter --material cli/data/polished-optic.json --wavelength 0.6328
  hts scatter --material cli/data/rough-aluminium.json --wavelength 0.5 --theta-i 10,45 --json)";

struct ScatterOptions {
    MaterialOptions material;
    OutputOptions output;
    std::string wavelengths;
    std::vector<double> theta_i{5};
    double reflectance = 0;
};

void run(const ScatterOptions& options) {
    const auto material = options.material.read();
    require_spectrum(material);
    if (options.wavelengths.empty()) throw UsageError{"--wavelength missing: must be given in um"};
    const auto grid = wavelengths_from_option(options.wavelengths);
    const auto reflectance =
        reflectance_from_option("--wavelength", material, grid, options.material.evaluation());
    for (const double theta : options.theta_i) {
        if (!(theta >= 0 && theta <= 80))
            throw UsageError{"--theta-i: " + shortest(theta) + " deg: must be from 0 to 80"};
    }
    Output output{options.output.path};
    TableWriter table{output,
                      format_of(options.output.path, options.output.json),
                      {"wavelength_um", "theta_i_deg", "form", "parameter", "value", "unit", "points",
                       "median_abs_log", "rms_log", "worst_abs_log"}};
    for (std::size_t w = 0; w < grid.size(); ++w) {
        for (const double theta : options.theta_i) {
            const auto fits = validation::scatter_fits(reflectance, w, Direction::from_degrees(theta, 0),
                                                       options.reflectance);
            std::string text;
            for (const auto& fit : fits) {
                for (const auto& parameter : fit.parameters) {
                    TableWriter::Row row{table, text};
                    row.field(shortest(grid.micrometres()[w])).field(shortest(theta)).word(fit.model);
                    row.word(parameter.name).field(brief(parameter.value, 6)).word(parameter.unit);
                    row.field(std::to_string(fit.points)).field(brief(fit.median_abs_log, 3));
                    row.field(brief(fit.rms_log, 3)).field(brief(fit.worst_log, 3)).end();
                }
            }
            table.add(text);
        }
    }
    table.finish();
    output.commit();
    warn_of_gain_of(reflectance, options.material.path);
}

}  // namespace

void add_scatter(CLI::App& program) {
    CLI::App* verb =
        program.add_subcommand("scatter", "ABg, Harvey-Shack and K-correlation parameters of any material");
    auto options = std::make_shared<ScatterOptions>();
    options->material.add_to(*verb)->required();
    verb->add_option(wavelengths_names, options->wavelengths, "first:last:count or a,b,c [um]")->required();
    comma_list(*verb, theta_i_names, options->theta_i, "angles of incidence [deg]");
    verb->add_option("--reflectance", options->reflectance,
                     "Q of k_correlation, 0 ... 1; 0: what the material reflects in all")
        ->check(number_within(0, 1))
        ->capture_default_str();
    options->output.add_to(*verb);
    verb->footer(scatter_help);
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli

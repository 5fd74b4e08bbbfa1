// hts info: what a material is to the model, and where the model can be believed of it.

#include <memory>

#include "cli/answers/energy_info.hpp"
#include "cli/answers/info_report.hpp"
#include "cli/io/options.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/verbs.hpp"
#include "tables/formats/measured_model.hpp"

namespace hts::cli {
namespace {

constexpr auto info_help = R"(
Looks at the material in the mirror direction of every angle of incidence at every
wavelength: phase variance g and regime (how much of the sum for Phi it takes), the share
exp(-g) of the light that stays in the mirror direction, and how far the model's own
assumptions hold: tau/lambda, k R cos^3(theta), sigma0/tau, shadowing, the shadowed mirror
term, energy. Each is fine, a caution, or outside the model's validity, which is said and
is no failure. The expected error is that of the model against exact scattering, not of
the arithmetic: the map of hts truth moments, 1-D perfectly conducting surfaces up to 70
degrees, unpolarised. he_unified is judged by its expected distance from exact scattering in
place of these criteria.
Of models other than these two it says how much light they reflect in all, and what is known to
be wrong with the material.
Text by default; --json or an output .json give all of it, an output .csv a row per point.

Examples:
  hts info cli/data/rough-aluminium.json
  hts info cli/data/rough-aluminium.json --wavelengths 0.5,2 --theta-i 0,45,75 --output info.csv)";

struct InfoOptions {
    std::string material, wavelengths = "0.38:0.78:9";
    std::vector<double> theta{0, 15, 30, 45, 60, 75};
    OutsideOption outside;
    OutputOptions output;
};

/// As text, JSON or a table, as the options say.
template <class Info>
void report(const OutputOptions& options, const Info& info) {
    Output output{options.path};
    if (format_of(options.path, options.json) == Format::json) {
        output.write(info_json(info));
    } else if (options.path.ends_with(".csv")) {
        write_info_table(output, info);
    } else {
        output.write(info_text(info));
    }
    output.commit();
}

void run(const InfoOptions& options) {
    const auto grid = wavelengths_from_option(options.wavelengths);
    require_angles("--theta-i", options.theta);
    const auto policy = options.outside.policy;
    const auto material = spectral::read_material(options.material, tables::models_with_files());
    require_spectrum(material);
    static_cast<void>(reflectance_from_option("--wavelengths", material, grid, {.outside = policy}));
    if (material.properties().surface) {
        report(options.output, MaterialInfo{material, grid, options.theta, policy});
    } else {
        report(options.output, EnergyInfo{material, grid, options.theta, policy});
    }
}

}  // namespace

void add_info(CLI::App& program) {
    CLI::App* verb =
        program.add_subcommand("info", "a material's regime and where the model is valid for it");
    auto options = std::make_shared<InfoOptions>();
    reads_whole(verb->add_option(material_names, options->material, "material file (JSON)"))->required();
    verb->add_option(wavelengths_names, options->wavelengths, "first:last:count or a,b,c [um]")
        ->capture_default_str();
    comma_list(*verb, theta_i_names, options->theta,
               "angles of incidence [deg], 0 ... 90, separated by commas");
    options->outside.add_to(*verb);
    options->output.add_to(*verb);
    verb->get_option("--json")->description("write JSON instead of text");
    verb->footer(info_help);
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli

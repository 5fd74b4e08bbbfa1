// hts albedo: how much light a material reflects in all, and how much uniform-diffuse albedo it leaves room
// for.

#include <algorithm>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "cli/io/options.hpp"
#include "cli/io/table_writer.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/verbs.hpp"
#include "spectral/energy/energy.hpp"
#include "spectral/parallel.hpp"

namespace hts::cli {
namespace {

constexpr auto albedo_help = R"(
Directional-hemispherical reflectance of unpolarised light, a row per wavelength and angle:
  specular, directional_diffuse, uniform_diffuse, total   what each term and all reflect
and for materials of model he:
  largest_albedo     the diffuse albedo with which the total stays <= 1 up to --steepest:
                     1 less the most that the first two terms reflect there
  limited_at_deg     the angle of incidence where they reflect most
  measured_albedo    with --measured: the diffuse albedo with which the total is what was
                     measured, at one angle and one wavelength
  compensated_total  with --compensate-energy: the total with the optional, reciprocal
                     energy compensation, which is not part of the published model
With --emissivity, 1 less the total by Kirchhoff's law, for surfaces that let no light through:
  emissivity                     of unpolarised radiation
  emissivity_s, emissivity_p     behind a polariser, for models with polarisation
By reciprocity the columns are the hemispherical-directional reflectance too.

Examples:
  hts albedo --material cli/data/rough-aluminium.json --wavelengths 0.4:0.7:7 --theta-i 0,30,60,85
  hts albedo --material cli/data/smooth-plastic.json --wavelengths 0.46 --theta-i 0 --measured 0.195)";

struct AlbedoOptions {
    MaterialOptions material;
    OutputOptions output;
    std::string wavelengths = "0.4:0.7:7";
    std::vector<double> theta_i{0, 15, 30, 45, 60, 75, 85};
    double phi_i = 0, steepest = 85;
    std::optional<double> measured;
    bool compensate = false, emissivity = false;
};

/// 1 less the albedo of light in a state of polarisation.
struct Emissivity {
    double s, p;
};

/// What is asked of the library, checked.
struct AlbedoQuery {
    spectral::Reflectance reflectance;
    std::optional<spectral::Reflectance> compensated;
    std::vector<Direction> in;
    double steepest;  ///< [rad]
    bool polarised;   ///< emissivities behind a polariser
};

/// All rows of one wavelength.
struct AlbedoSpectralRow {
    std::vector<spectral::HemisphericalReflectance> terms;
    std::optional<spectral::DiffuseAlbedoLimit> limit{};  // of rough surfaces
    std::vector<double> compensated;
    std::vector<Emissivity> polarised;  // where asked for and known
};

AlbedoQuery query(const AlbedoOptions& options) {
    const auto grid = wavelengths_from_option(options.wavelengths);
    std::vector<Direction> in;
    for (const double theta : options.theta_i) {
        in.push_back(
            from_option("--theta-i, --phi-i", [&] { return Direction::from_degrees(theta, options.phi_i); }));
    }
    static_cast<void>(
        from_option("--steepest", [&] { return Direction::from_degrees(options.steepest, 0); }));
    if (options.measured && (grid.size() != 1 || in.size() != 1)) {
        throw UsageError{"--measured: must come with one wavelength and one --theta-i"};
    }
    const auto material = options.material.read();
    if (options.measured) require_rough_surface(material, "--measured");
    if (options.compensate) require_rough_surface(material, "--compensate-energy");
    auto how = options.material.evaluation();
    AlbedoQuery result{reflectance_from_option("--wavelengths", material, grid, how), std::nullopt,
                       std::move(in), options.steepest * std::numbers::pi / 180,
                       options.emissivity && material.properties().polarised};
    how.compensate_energy = true;
    if (options.compensate) result.compensated = material.at(grid, how);
    return result;
}

AlbedoSpectralRow evaluated(const AlbedoQuery& query, std::size_t wavelength) {
    AlbedoSpectralRow row;
    for (const Direction& in : query.in) {
        row.terms.push_back(query.reflectance.albedo(in, wavelength));
        if (query.polarised) {
            const auto of = [&](const Stokes& light) {
                return 1 - query.reflectance.albedo(in, wavelength, light).total();
            };
            row.polarised.push_back({of(Stokes::s_polarised()), of(Stokes::p_polarised())});
        }
        if (query.compensated) row.compensated.push_back(query.compensated->albedo(in, wavelength).total());
    }
    const auto& surface = query.reflectance.properties().surface;
    if (!surface) return row;
    const SpectralSample& at = query.reflectance.samples()[wavelength];
    row.limit = spectral::largest_diffuse_albedo(*surface, at.index, at.wavelength, query.steepest);
    return row;
}

std::vector<std::string> columns(const AlbedoOptions& options, bool rough, bool polarised) {
    std::vector<std::string> names{"wavelength_um",       "theta_i_deg",     "specular",
                                   "directional_diffuse", "uniform_diffuse", "total"};
    if (rough) names.insert(names.end(), {"largest_albedo", "limited_at_deg"});
    if (options.measured) names.emplace_back("measured_albedo");
    if (options.compensate) names.emplace_back("compensated_total");
    if (options.emissivity) names.emplace_back("emissivity");
    if (polarised) names.insert(names.end(), {"emissivity_s", "emissivity_p"});
    return names;
}

void append(TableWriter::Row& row, const AlbedoSpectralRow& values, std::size_t angle) {
    const auto& terms = values.terms[angle];
    row.number(terms.specular).number(terms.directional_diffuse).number(terms.uniform_diffuse);
    row.number(terms.total());
    if (!values.limit) return;
    row.number(values.limit->albedo).number(values.limit->theta * 180 / std::numbers::pi);
}

void run(const AlbedoOptions& options) {
    const AlbedoQuery asked = query(options);
    const auto& surface = asked.reflectance.properties().surface;
    std::optional<double> albedo;
    if (options.measured) {
        const SpectralSample& at = asked.reflectance.samples().front();
        albedo = spectral::diffuse_albedo_from(*options.measured, *surface, at.index, at.wavelength,
                                               asked.in.front());
    }
    std::vector<AlbedoSpectralRow> rows(asked.reflectance.size());
    spectral::parallel_for(
        rows.size(), [&](std::size_t i) { rows[i] = evaluated(asked, i); }, 1);

    Output output{options.output.path};
    TableWriter table{output, format_of(options.output.path, options.output.json),
                      columns(options, surface.has_value(), asked.polarised)};
    std::string text;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        for (std::size_t j = 0; j < asked.in.size(); ++j) {
            TableWriter::Row row{table, text};
            row.field(shortest(asked.reflectance.wavelengths().micrometres()[i]))
                .field(shortest(options.theta_i[j]));
            append(row, rows[i], j);
            if (albedo) row.number(*albedo);
            if (options.compensate) row.number(rows[i].compensated[j]);
            if (options.emissivity) row.number(1 - rows[i].terms[j].total());
            if (asked.polarised) row.number(rows[i].polarised[j].s).number(rows[i].polarised[j].p);
            row.end();
        }
    }
    table.add(text);
    table.finish();
    output.commit();
    double largest = 0;
    for (const AlbedoSpectralRow& row : rows)
        for (const auto& terms : row.terms) largest = std::max(largest, terms.total());
    warn_of_gain(options.material.path, largest);
}

}  // namespace

void add_albedo(CLI::App& program) {
    CLI::App* verb = program.add_subcommand("albedo", "directional-hemispherical reflectance, split by term");
    auto options = std::make_shared<AlbedoOptions>();
    options->material.add_to(*verb)->required();
    verb->add_option(wavelengths_names, options->wavelengths, "first:last:count or a,b,c [um]")
        ->capture_default_str();
    comma_list(*verb, theta_i_names, options->theta_i,
               "angles of incidence [deg], 0 ... 90, separated by commas");
    verb->add_option("--phi-i", options->phi_i, "azimuth of the light [deg], for anisotropic materials")
        ->capture_default_str();
    verb->add_option("--steepest", options->steepest, "up to where the total must stay <= 1 [deg], 0 ... 90")
        ->capture_default_str();
    verb->add_option(
            "--measured", options->measured,
            "a measured directional-hemispherical reflectance, 0 ... 1, to find the diffuse albedo from")
        ->check(number_within(0, 1));
    verb->add_flag("--compensate-energy", options->compensate, "add the total with energy compensation");
    verb->add_flag("--emissivity", options->emissivity, "add the emissivities by Kirchhoff's law");
    options->output.add_to(*verb);
    verb->footer(albedo_help);
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli

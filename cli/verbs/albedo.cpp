// hts albedo: how much light a material reflects in all, and how much uniform-diffuse albedo it leaves room
// for.

#include <algorithm>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cli/io/options.hpp"
#include "cli/io/table_writer.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/verbs.hpp"
#include "hts/error.hpp"
#include "spectral/energy/band.hpp"
#include "spectral/energy/energy.hpp"
#include "spectral/models/hemisphere.hpp"
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
By reciprocity the columns are the hemispherical-directional reflectance too. With --columns:
  tis                       total integrated scatter, what is scattered of all that is reflected:
                            1 - specular/total (Bennett and Porteus 1961)
  hemispherical             the total for light from the whole hemisphere alike, whatever theta_i
  hemispherical_emissivity  1 less it
With --temperature, --response or both: a row per angle, means over the wavelengths by a black
body's radiation, by the response of an instrument (CSV: wavelength_um,response), or by their
product, each value a straight line between its wavelengths; without largest_albedo. The column
covered says how much of the whole band the wavelengths hold.

Examples:
  hts albedo --material cli/data/rough-aluminium.json --wavelengths 0.4:0.7:7 --theta-i 0,30,60,85
  hts albedo --material cli/data/smooth-plastic.json --wavelengths 0.46 --theta-i 0 --measured 0.195
  hts albedo --material cli/data/fine-aluminium.json --wavelengths 2,3,4,6,10,20 --theta-i 0,60 \
      --emissivity --temperature 700 --columns tis)";

struct AlbedoOptions {
    MaterialOptions material;
    OutputOptions output;
    std::string wavelengths = "0.4:0.7:7", response;
    std::vector<double> theta_i{0, 15, 30, 45, 60, 75, 85};
    std::vector<std::string> columns;
    double phi_i = 0, steepest = 85;
    std::optional<double> measured, temperature;
    bool compensate = false, emissivity = false;

    [[nodiscard]] bool asks_for(const std::string& column) const {
        return std::ranges::find(columns, column) != columns.end();
    }
    [[nodiscard]] bool of_hemisphere() const {
        return asks_for("hemispherical") || asks_for("hemispherical_emissivity");
    }
};

/// Emissivities behind a polariser: 1 less the albedo of light in that state.
struct Emissivity {
    double s = 0, p = 0;
};

/// What is asked of the library, checked.
struct AlbedoQuery {
    spectral::Reflectance reflectance;
    std::optional<spectral::Reflectance> compensated;
    std::vector<Direction> in;
    double steepest;  ///< [rad]
    bool polarised;   ///< emissivities behind a polariser
    bool hemisphere;  ///< light from everywhere
    std::optional<spectral::Band> band;
};

/// At one angle.
struct AlbedoRow {
    spectral::HemisphericalReflectance terms{};
    Emissivity polarised{};  // where asked for and known
    double compensated = 0;
    double hemispherical = 0;

    void add(double share, const AlbedoRow& other) {
        terms.specular += share * other.terms.specular;
        terms.directional_diffuse += share * other.terms.directional_diffuse;
        terms.uniform_diffuse += share * other.terms.uniform_diffuse;
        polarised.s += share * other.polarised.s;
        polarised.p += share * other.polarised.p;
        compensated += share * other.compensated;
        hemispherical += share * other.hemispherical;
    }
};

/// All rows of one wavelength.
struct AlbedoSpectralRow {
    std::vector<AlbedoRow> angles;
    std::optional<spectral::DiffuseAlbedoLimit> limit{};  // of rough surfaces
};

std::optional<spectral::Band> band(const AlbedoOptions& options) {
    if (options.response.empty() && !options.temperature) return std::nullopt;
    std::optional<spectral::PiecewiseLinear> response;
    if (!options.response.empty()) response = spectral::read_response(options.response);
    return spectral::Band{std::move(response), options.temperature};
}

void require_opaque(const AlbedoOptions& options, const spectral::Reflectance& reflectance) {
    if (!options.emissivity && !options.asks_for("hemispherical_emissivity")) return;
    for (std::size_t i = 0; i < reflectance.size(); ++i) {
        if (!reflectance.transmits(i)) continue;
        throw Error{options.material.path +
                    ": emissivity: must be of a surface that lets no light through, as this does at " +
                    shortest(reflectance.wavelengths().micrometres()[i]) + " um"};
    }
}

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
    const auto over = band(options);
    if (over && grid.size() < 2)
        throw UsageError{"--temperature, --response: must come with at least two wavelengths"};
    const auto material = options.material.read();
    if (options.measured) require_rough_surface(material, "--measured");
    if (options.compensate) require_rough_surface(material, "--compensate-energy");
    auto how = options.material.evaluation();
    AlbedoQuery result{reflectance_from_option("--wavelengths", material, grid, how),
                       std::nullopt,
                       std::move(in),
                       options.steepest * std::numbers::pi / 180,
                       options.emissivity && material.properties().polarised,
                       options.of_hemisphere(),
                       over};
    require_opaque(options, result.reflectance);
    how.compensate_energy = true;
    if (options.compensate) result.compensated = material.at(grid, how);
    return result;
}

AlbedoSpectralRow evaluated(const AlbedoQuery& query, std::size_t wavelength) {
    AlbedoSpectralRow row;
    const double hemispherical =
        query.hemisphere ? bihemispherical_reflectance(query.reflectance, wavelength).total() : 0;
    for (const Direction& in : query.in) {
        AlbedoRow& at = row.angles.emplace_back();
        at.terms = query.reflectance.albedo(in, wavelength);
        at.hemispherical = hemispherical;
        if (query.polarised) {
            const auto of = [&](const Stokes& light) {
                return 1 - query.reflectance.albedo(in, wavelength, light).total();
            };
            at.polarised = {of(Stokes::s_polarised()), of(Stokes::p_polarised())};
        }
        if (query.compensated) at.compensated = query.compensated->albedo(in, wavelength).total();
    }
    const auto& surface = query.reflectance.properties().surface;
    if (!surface || query.band) return row;
    const SpectralSample& at = query.reflectance.samples()[wavelength];
    row.limit = spectral::largest_diffuse_albedo(*surface, at.index, at.wavelength, query.steepest);
    return row;
}

std::vector<std::string> columns(const AlbedoOptions& options, const AlbedoQuery& asked) {
    std::vector<std::string> names{"theta_i_deg", "specular", "directional_diffuse", "uniform_diffuse",
                                   "total"};
    if (!asked.band) names.insert(names.begin(), "wavelength_um");
    if (asked.reflectance.properties().surface && !asked.band)
        names.insert(names.end(), {"largest_albedo", "limited_at_deg"});
    if (options.measured) names.emplace_back("measured_albedo");
    if (options.compensate) names.emplace_back("compensated_total");
    if (options.emissivity) names.emplace_back("emissivity");
    if (asked.polarised) names.insert(names.end(), {"emissivity_s", "emissivity_p"});
    names.insert(names.end(), options.columns.begin(), options.columns.end());
    if (asked.band) names.emplace_back("covered");
    return names;
}

/// What --columns asks for.
double quantity(const std::string& name, const AlbedoRow& at) {
    if (name == "hemispherical") return at.hemispherical;
    if (name == "hemispherical_emissivity") return 1 - at.hemispherical;
    const double scattered = at.terms.directional_diffuse + at.terms.uniform_diffuse;
    return scattered > 0 ? scattered / at.terms.total() : 0;
}

/// A row but for its wavelength or its share of the band.
void append(TableWriter::Row& row, const AlbedoOptions& options, const AlbedoQuery& asked, std::size_t angle,
            const AlbedoRow& at, const std::optional<spectral::DiffuseAlbedoLimit>& limit,
            const std::optional<double>& measured) {
    row.field(shortest(options.theta_i[angle])).number(at.terms.specular);
    row.number(at.terms.directional_diffuse).number(at.terms.uniform_diffuse).number(at.terms.total());
    if (limit) row.number(limit->albedo).number(limit->theta * 180 / std::numbers::pi);
    if (measured) row.number(*measured);
    if (options.compensate) row.number(at.compensated);
    if (options.emissivity) row.number(1 - at.terms.total());
    if (asked.polarised) row.number(at.polarised.s).number(at.polarised.p);
    for (const std::string& name : options.columns) row.number(quantity(name, at));
}

/// Means of all angles over the band.
std::vector<AlbedoRow> means(const AlbedoQuery& asked, std::span<const AlbedoSpectralRow> rows) {
    const auto weights = asked.band->weights(asked.reflectance.wavelengths());
    std::vector<AlbedoRow> result(asked.in.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t j = 0; j < result.size(); ++j) result[j].add(weights[i], rows[i].angles[j]);
    return result;
}

std::optional<double> measured_albedo(const AlbedoOptions& options, const AlbedoQuery& asked) {
    if (!options.measured) return std::nullopt;
    const SpectralSample& at = asked.reflectance.samples().front();
    return spectral::diffuse_albedo_from(*options.measured, *asked.reflectance.properties().surface, at.index,
                                         at.wavelength, asked.in.front());
}

void run(const AlbedoOptions& options) {
    const AlbedoQuery asked = query(options);
    const auto measured = measured_albedo(options, asked);
    if (asked.band) static_cast<void>(asked.band->weights(asked.reflectance.wavelengths()));  // refuses early
    std::vector<AlbedoSpectralRow> rows(asked.reflectance.size());
    spectral::parallel_for(
        rows.size(), [&](std::size_t i) { rows[i] = evaluated(asked, i); }, 1);

    Output output{options.output.path};
    TableWriter table{output, format_of(options.output.path, options.output.json), columns(options, asked)};
    std::string text;
    if (asked.band) {
        const double covered = asked.band->covered(asked.reflectance.wavelengths());
        const auto all = means(asked, rows);
        for (std::size_t j = 0; j < all.size(); ++j) {
            TableWriter::Row row{table, text};
            append(row, options, asked, j, all[j], std::nullopt, std::nullopt);
            row.number(covered).end();
        }
    } else {
        for (std::size_t i = 0; i < rows.size(); ++i) {
            for (std::size_t j = 0; j < asked.in.size(); ++j) {
                TableWriter::Row row{table, text};
                row.field(shortest(asked.reflectance.wavelengths().micrometres()[i]));
                append(row, options, asked, j, rows[i].angles[j], rows[i].limit, measured);
                row.end();
            }
        }
    }
    table.add(text);
    table.finish();
    output.commit();
    double largest = 0;
    for (const AlbedoSpectralRow& row : rows)
        for (const auto& at : row.angles) largest = std::max(largest, at.terms.total());
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
    more_columns(*verb, options->columns, {"tis", "hemispherical", "hemispherical_emissivity"},
                 "more columns: tis, hemispherical, hemispherical_emissivity");
    verb->add_option("--temperature", options->temperature, "mean by a black body of this temperature [K]")
        ->check(number_within(spectral::Band::coldest, spectral::Band::hottest));
    reads(verb->add_option(
        "--response", options->response,
        "mean by the response of an instrument: CSV with wavelength_um (or\nwavelength_nm),response"));
    options->output.add_to(*verb);
    verb->footer(albedo_help);
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli

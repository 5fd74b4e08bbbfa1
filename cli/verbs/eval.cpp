// hts eval: BRDF, specular reflectance and Mueller matrix at given directions and wavelengths.

#include <algorithm>
#include <iostream>
#include <memory>

#include "cli/answers/eval_answer.hpp"
#include "cli/answers/eval_plan.hpp"
#include "cli/answers/random_pairs.hpp"
#include "cli/io/options.hpp"
#include "cli/io/transform.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/verbs.hpp"
#include "spectral/models/material.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/measured_model.hpp"

namespace hts::cli {
namespace {

constexpr auto eval_help = R"(
Points are CSV (semicolons, tabs or blanks between fields and decimal commas are read too)
with the columns wavelength_um (or wavelength_nm), theta_i_deg, phi_i_deg, theta_r_deg,
phi_r_deg in any order, and optionally n, k, rms_roughness_um, correlation_length_um (or
correlation_length_x_um and correlation_length_y_um, with azimuth_deg of the first from x)
and albedo, which go before the material's (models he and he_unified). Without
wavelength_um every row is evaluated at --wavelength or --wavelengths. Other columns are
repeated and not used.
A file whose name ends in .npy is a structured array of NumPy, whose fields are the
columns; so is the answer, which then can hold numbers alone.
The answer repeats the columns and adds directional_diffuse, uniform_diffuse, brdf [1/sr]
and specular_reflectance [1]. All directions point away from the surface; the mirror
direction is theta_r = theta_i, phi_r = phi_i + 180. The columns of --detail and of
polarisation are those of model he; others have neither.
With --transmission the view is behind the surface, theta_r counts from the inward normal,
and the answer is btdf [1/sr], radiance out per irradiance in; straight on is theta_r =
theta_i, phi_r = phi_i + 180.
With --plan, --material is the name of one of its materials, and the wavelengths are the
plan's. A spectral plan adds wavelength_um, brdf, specular_reflectance, an rgb one linear
sRGB: red, green, blue of the radiance factor pi f and specular_red, specular_green,
specular_blue of the specular reflectance.
With --tolerance 1e-6, --random-pairs takes a seventh of its time at 31 wavelengths and
--points four fifths, since most of that goes into reading and writing numbers (one core
of an AMD EPYC, material rough-aluminium.json).

Examples:
  hts eval --material cli/data/rough-aluminium.json --wavelength 0.5 --theta-i 30 --theta-r 30 --phi 180
  hts eval --material cli/data/rough-aluminium.json --points cli/data/points.csv --output values.csv --detail
  hts eval --material cli/data/rough-aluminium.json --points - --wavelengths 0.4:0.7:31 < cli/data/pairs.csv
  hts eval --material cli/data/rough-aluminium.json --wavelengths 0.4:0.7:31 --random-pairs 1000000
  hts eval --material cli/data/rough-aluminium.json --points cli/data/points.csv --columns brf,sigma0,ars
  hts eval --material cli/data/rough-aluminium.json --points cli/data/points.csv \
      --uncertainty rms_roughness_um=0.01,correlation_length_um=0.05,n=0.02
  hts plan cli/data/figure-14.json --output plan.json
  hts eval --plan plan.json --material "copper sphere" --points cli/data/pairs.csv)";

struct EvalOptions {
    MaterialOptions material;
    DirectionOptions directions;
    OutputOptions output;
    std::optional<double> wavelength;
    std::string wavelengths, points, polarisation, plan;
    std::optional<std::uint64_t> random_pairs;
    std::uint64_t seed = 1;
    std::vector<std::string> columns;
    std::string deviations;
    bool uncertainty = false;
    bool mueller = false, detail = false, transmission = false, compensate = false;
    ToleranceOption tolerance;

    /// How the material is to be evaluated, without energy compensation.
    [[nodiscard]] spectral::EvaluationOptions plain() const {
        return {.tolerance = tolerance.tolerance(), .outside = material.policy()};
    }
    [[nodiscard]] spectral::EvaluationOptions evaluation() const {
        auto how = plain();
        how.compensate_energy = compensate;
        return how;
    }
};

std::optional<spectral::WavelengthGrid> wavelengths(const EvalOptions& options) {
    if (!options.wavelengths.empty()) return wavelengths_from_option(options.wavelengths);
    if (!options.wavelength) return std::nullopt;
    return spectral::WavelengthGrid::from_micrometres(
        {wavelength_from_option(*options.wavelength).micrometres()});
}

/// The one point that the options describe, as a file of one row.
CsvReader single_point(const EvalOptions& options) {
    const DirectionOptions& to = options.directions;
    const bool needs_wavelength = options.plan.empty();
    if (!to.any() && !wavelengths(options)) {
        throw UsageError{
            "points missing: must be given by --points, or by --wavelength, --theta-i, --theta-r and --phi"};
    }
    if (needs_wavelength && !wavelengths(options))
        throw UsageError{"--wavelength missing: must be given in um"};
    static_cast<void>(to.pair());  // complains about options, where the row would complain about a file
    const std::string header = "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg\n";
    const std::string row = shortest(*to.theta_i) + "," + shortest(to.incident_azimuth()) + "," +
                            shortest(*to.theta_r) + "," + shortest(to.reflected_azimuth()) + "\n";
    if (!options.wavelength) return CsvReader::from_text(header + row);
    return CsvReader::from_text("wavelength_um," + header + shortest(*options.wavelength) + "," + row);
}

void warn_of_unused(const CsvReader& points) {
    constexpr std::size_t most = 10;
    auto unused = PointEvaluator::unused_columns(points);
    if (unused.empty()) return;
    const std::size_t more = unused.size() - std::min(unused.size(), most);
    unused.resize(unused.size() - more);
    std::cerr << "hts: " << points.where_header()
              << "columns repeated but not used: " << spectral::joined(unused)
              << (more == 0 ? "" : " and " + std::to_string(more) + " more") << '\n';
}

std::optional<spectral::Material> material(const EvalOptions& options) {
    if (options.material.path.empty()) return std::nullopt;
    auto described = options.material.read();
    if (options.compensate) require_rough_surface(described, "--compensate-energy");
    options.tolerance.require_met_by(described);
    if (options.mueller) require_polarised(described, "--mueller");
    if (!options.polarisation.empty()) require_polarised(described, "--polarisation");
    return described;
}

/// hts::Error that names the option if the material is not known at the wavelengths that it gives.
void require_known(const EvalOptions& options, const spectral::Material& material) {
    const auto grid = wavelengths(options);
    if (!grid) return;
    const char* option = options.wavelength ? "--wavelength" : "--wavelengths";
    static_cast<void>(reflectance_from_option(option, material, *grid, options.plain()));
}

bool has_own_constants(const CsvReader& points) {
    return points.find_column("n") || points.find_column("k") || points.find_column("albedo");
}

/// What the material file says of its errors, and what --uncertainty says instead.
spectral::UncertainMaterial uncertain_material(const EvalOptions& options) {
    const std::string& path = options.material.path;
    if (path.empty()) throw UsageError{"--uncertainty: must come with --material"};
    std::vector<spectral::UncertainNumber> given;
    for (const std::string_view piece : spectral::split(options.deviations, ',')) {
        if (options.deviations.empty()) break;
        const auto [name, value] = assignment("--uncertainty", std::string{piece});
        given.push_back({name, value});
    }
    const auto make = [&] {
        return spectral::UncertainMaterial{options.material.text(), path, given, tables::models_with_files()};
    };
    return given.empty() ? make() : from_option("--uncertainty", make);
}

CsvReader points_of(const EvalOptions& options) {
    return options.points.empty() ? single_point(options) : CsvReader{options.points};
}

void evaluate_as_planned(const EvalOptions& options) {
    if (wavelengths(options) || options.random_pairs || options.detail || !options.columns.empty() ||
        options.material.policy() != spectral::OutsideRange::error || options.compensate ||
        !options.polarisation.empty() || options.tolerance.value) {
        throw UsageError{
            "--plan: must not come with --wavelength, --wavelengths, --random-pairs, --detail, --columns, "
            "--outside, --compensate-energy, --polarisation, --tolerance"};
    }
    CsvReader points = points_of(options);
    evaluate_planned({options.plan, options.material.path, options.mueller}, points, options.output);
}

void evaluate_points(const EvalOptions& options) {
    CsvReader points = points_of(options);
    const bool own_wavelength = options.points.empty() && options.wavelength;
    const auto grid = own_wavelength ? std::nullopt : wavelengths(options);
    const auto described = material(options);
    if (described && !has_own_constants(points)) require_known(options, *described);
    PointEvaluator evaluator{points, described, grid, options.evaluation()};
    if (options.uncertainty) evaluator.with(uncertain_material(options));
    warn_of_unused(points);
    EvalAnswer answer{
        grid.has_value(),    options.mueller,      options.detail && evaluator.of_rough_surfaces(),
        options.uncertainty, options.transmission, options.columns};
    if (!options.polarisation.empty()) answer.incident = stokes_from_option(options.polarisation);

    Output output{options.output.path};
    std::vector<std::string> columns = points.columns();
    for (std::string& added : answer.columns()) columns.push_back(std::move(added));
    TableWriter table{output, format_of(options.output.path, options.output.json), columns};
    ValidityWarning warning;
    const Summary summary = Transform<Evaluation>{points, table, evaluator.wavelengths()}.run(
        [&](const CsvRow& row, std::span<Evaluation> result) {
            if (answer.transmission) return evaluator.evaluate_transmission(row, result);
            evaluator.evaluate(row, answer.wish(), result, warning);
        },
        [&](TableWriter::Row& row, const Evaluation& value) { answer.append(row, value); });
    output.commit();
    warning.print(options.material.path);
    if (options.detail) std::cerr << "hts: " << summary.text() << '\n';
}

void evaluate_random(const EvalOptions& options) {
    const auto grid = wavelengths(options);
    const auto described = material(options);
    if (!grid || !described) throw UsageError{"--random-pairs: must come with --material and --wavelengths"};
    require_known(options, *described);
    const auto reflectance = described->at(*grid, options.evaluation());
    const Direction normal = Direction::from_degrees(0, 0);
    ValidityWarning warning;
    warning.note(reflectance, {normal, normal});
    const auto [summary, mean_brdf] = evaluate_random_pairs(reflectance, *options.random_pairs, options.seed);
    Output output{options.output.path};
    TableWriter table{output,
                      format_of(options.output.path, options.output.json),
                      {"pairs", "wavelengths", "seed", "mean_brdf_per_sr"}};
    std::string text;
    TableWriter::Row row{table, text};
    row.field(std::to_string(summary.pairs)).field(std::to_string(summary.wavelengths));
    row.field(std::to_string(options.seed)).number(mean_brdf).end();
    table.add(text);
    table.finish();
    output.commit();
    warning.print(options.material.path);
    std::cerr << "hts: " << summary.text() << '\n';
}

void require_one_of(bool first, bool second, const char* names) {
    if (first && second) throw UsageError{std::string{names} + " both given: must be one of them"};
}

void run(const EvalOptions& options) {
    require_one_of(options.wavelength.has_value(), !options.wavelengths.empty(),
                   "--wavelength and --wavelengths");
    require_one_of(!options.points.empty(), options.directions.any(), "--points and a direction");
    require_one_of(!options.points.empty(), options.random_pairs.has_value(), "--points and --random-pairs");
    require_one_of(options.directions.any(), options.random_pairs.has_value(),
                   "--random-pairs and a direction");
    require_one_of(options.detail, options.tolerance.value.has_value(), "--detail and --tolerance");
    require_one_of(options.mueller || !options.polarisation.empty(), options.random_pairs.has_value(),
                   "--random-pairs and --mueller or --polarisation");
    require_one_of(!options.columns.empty(), options.random_pairs.has_value(),
                   "--random-pairs and --columns");
    if (options.transmission &&
        (options.mueller || options.detail || !options.columns.empty() || options.compensate ||
         !options.polarisation.empty() || !options.plan.empty() || options.random_pairs)) {
        throw UsageError{
            "--transmission: must not come with --mueller, --detail, --columns, --compensate-energy, "
            "--polarisation, --plan, --random-pairs"};
    }
    if (options.uncertainty &&
        (options.transmission || options.compensate || !options.plan.empty() || options.random_pairs)) {
        throw UsageError{
            "--uncertainty: must not come with --transmission, --compensate-energy, --plan, --random-pairs"};
    }
    if (!options.plan.empty()) return evaluate_as_planned(options);
    options.random_pairs ? evaluate_random(options) : evaluate_points(options);
}

}  // namespace

void add_eval(CLI::App& program) {
    CLI::App* verb =
        program.add_subcommand("eval", "BRDF, specular reflectance, Mueller matrix at given points");
    auto options = std::make_shared<EvalOptions>();
    options->material.add_to(*verb);
    reads_whole(verb->add_option("--plan", options->plan, "plan file of hts plan"));
    verb->add_option("--wavelength", options->wavelength, "wavelength [um]");
    verb->add_option("--wavelengths", options->wavelengths, "first:last:count or a,b,c [um]");
    reads(verb->add_option("--points", options->points, "CSV file of points, - for standard input"));
    options->directions.add_to(*verb);
    options->output.add_to(*verb);
    verb->add_flag("--mueller", options->mueller,
                   "add the Mueller matrices m00 ... m33 of the directional-diffuse term and\n"
                   "specular_m00 ... specular_m33 of the specular one");
    verb->add_flag("--detail", options->detail,
                   "add g, t, effective_roughness_um, shadowing, fresnel, method;\na summary of the speed "
                   "goes to standard error");
    more_columns(*verb, options->columns, eval_quantities(),
                 "the BRDF f in other terms: brf (bidirectional reflectance factor, pi f),\n"
                 "sigma0 (radar's scattering coefficient, 4 pi f cos theta_i cos theta_r),\n"
                 "ars (angle-resolved scatter, f cos theta_r [1/sr])");
    verb->add_flag(
        "--compensate-energy", options->compensate,
        "with the optional energy compensation, which is not part of the published model he;\nsome "
        "50 ms for each surface and wavelength");
    verb->add_flag("--transmission", options->transmission,
                   "the view is behind the surface: btdf of transparent materials of model walter");
    verb->add_option(
        "--polarisation", options->polarisation,
        "incident light: s, p, unpolarised or s0,s1,s2,s3; adds what the diffuse terms reflect:\n"
        "s0 ... s3, degree_of_polarisation, angle_of_polarisation_deg (from s towards p),\n"
        "and the same of the specular term, specular_s0 ...; the terms themselves, which need\n"
        "no polarisation, stay those of unpolarised light");
    verb->add_option("--uncertainty", options->deviations,
                     "add brdf_uncertainty and specular_reflectance_uncertainty, one standard deviation,\n"
                     "from those of the material's numbers: NAME=VALUE,... here, and its key \"uncertainty\"")
        ->expected(0, 1)
        ->type_name("[TEXT]");
    options->tolerance.add_to(*verb);
    verb->add_option("--random-pairs,--pairs,--samples,--count", options->random_pairs,
                     "instead of points: this many random pairs of directions,\n"
                     "the BRDF at all wavelengths in one call; prints mean and speed")
        ->check(whole_number(1, 1'000'000'000));
    verb->add_option("--seed", options->seed, "of the random pairs")
        ->check(seed_number())
        ->capture_default_str();
    verb->footer(eval_help);
    verb->callback([options, verb] {
        options->uncertainty = verb->count("--uncertainty") > 0;
        run(*options);
    });
}

}  // namespace hts::cli

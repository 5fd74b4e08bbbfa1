// hts fit: the parameters with which a model comes closest to measured curves, and what those leave open.

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

#include "cli/answers/fit_report.hpp"
#include "cli/io/curve_argument.hpp"
#include "cli/io/options.hpp"
#include "cli/io/references.hpp"
#include "cli/io/table_writer.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/verbs.hpp"
#include "hts/error.hpp"
#include "spectral/jobs/progress.hpp"
#include "spectral/text/suggestion.hpp"
#include "spectral/text/text.hpp"
#include "validation/fit/fit_findings.hpp"
#include "validation/fit/fit_table.hpp"

namespace hts::cli {
namespace {

namespace fs = std::filesystem;
using validation::CurveSet;
using validation::Fit;
using validation::FitRequest;

constexpr auto fit_help = R"(
Prints the parameters with standard errors, how close the model comes, and what the data
cannot tell. Parameters are those of the material file, or their symbols (sigma0, tau, a);
a factor "scale" on all values is 1 unless freed. Where --index is not given, n is fitted
and k is 0 unless freed. Anisotropic widths are equal unless one is freed (--free my).
--output writes the material, ready for --material of other verbs; "scale", which no
material has, stands beside it for hts compare. --report writes everything.
More sets after the first are hemispherical reflectances (1 - emissivity) of the same
surface, to which "scale" does not apply.
Without a solid angle of source or detector the specular term has no finite value and is
not compared. --fix sigma0=measured holds the roughness that the curve set states.
--cross-validate leaves out one angle of incidence at a time, fits the others, and says how
well what was left out is predicted: a model with more parameters fits better and may predict
worse. The angle is that of the direction which stands still, light or viewer.

Examples:
  hts fit mwir-aluminium-sandblasted --model he --index Al --output fitted.json
  hts fit curet-sandpaper --model kurt --lobes 2 --residual cosine --largest-theta 80
  hts fit mwir-brass --model he --free scale,k --fix a=0 --start sigma0=0.3 --json
  hts fit anodised-ec1 --most-points 40 --cross-validate
  hts fit --all-models mwir-brass curet-sandpaper --residual cosine)";

struct FitOptions {
    std::vector<std::string> curves, fixed, freed, starts;
    std::string model = "he", index, films, residual = "log", loss = "squares", output, report;
    int lobes = 1, nodes = 1;
    double loss_scale = 1, largest_theta = 87;
    std::size_t followed_starts = 8, most_points = 0;
    bool all_models = false, json = false, conserve_energy = false, cross_validate = false;
    OutsideOption outside{};
    InstrumentOptions instrument;
};

template <class Choice>
Choice choice(const std::string& option, const std::string& text, std::initializer_list<Choice> choices) {
    std::vector<std::string> names;
    for (const Choice c : choices) {
        if (text == name(c)) return c;
        names.emplace_back(name(c));
    }
    throw UsageError{option + ": " + spectral::in_quotes(text) + ": " +
                     spectral::must_be_one_of(text, names)};
}

validation::FitSelection selection(const FitOptions& options) {
    return {options.largest_theta, options.most_points, {4, options.nodes}, options.outside.policy};
}

validation::Residual residual(const FitOptions& options) {
    using enum validation::Residual;
    return choice("--residual", options.residual, {logarithmic, relative, weighted, cosine});
}

void insert_once(std::map<std::string, double>& values, const std::pair<std::string, double>& value,
                 const char* option) {
    if (!values.insert(value).second)
        throw UsageError{std::string{option} + ": " + value.first + ": must be given once"};
}

/// sigma0 as it was measured by other means.
double measured_roughness(const CurveSet& set) {
    if (set.roughness) return set.roughness->rms_um;
    throw UsageError{"--fix sigma0=measured: " + set.stem + " states no measured_roughness"};
}

FitRequest request(const FitOptions& options, const CurveSet& set) {
    using enum validation::Loss;
    FitRequest result{.model = options.model,
                      .lobes = options.lobes,
                      .index = json_of(options.index),
                      .films = options.films,
                      .freed = options.freed,
                      .residual = residual(options),
                      .loss = choice("--loss", options.loss, {squares, huber, cauchy}),
                      .loss_scale = options.loss_scale,
                      .conserve_energy = options.conserve_energy,
                      .followed_starts = options.followed_starts};
    for (const std::string& text : options.fixed) {
        if (text.starts_with("index=")) {
            if (!options.index.empty()) throw UsageError{"--fix index: must not come with --index"};
            result.index = json_of(text.substr(6));
        } else if (text == "sigma0=measured") {
            insert_once(result.fixed, {"sigma0", measured_roughness(set)}, "--fix");
        } else {
            insert_once(result.fixed, assignment("--fix", text), "--fix");
        }
    }
    for (const std::string& text : options.starts)
        insert_once(result.starts, assignment("--start", text), "--start");
    return result;
}

/// What `make` returns; a request that cannot be is wrong usage.
template <class Make>
auto from_request(const Make& make) {
    try {
        return make();
    } catch (const validation::RequestError& error) {
        throw UsageError{error.what()};
    }
}

void fit_one(const FitOptions& options) {
    std::vector<CurveSet> sets;
    for (const std::string& name : options.curves) sets.push_back(curves_from_argument(name));
    for (std::size_t i = 1; i < sets.size(); ++i) {
        if (sets[i].quantity != validation::Quantity::hemispherical_reflectance)
            throw UsageError{
                "curves: " + options.curves[i] +
                ": must be one set, and hemispherical reflectances of its surface, unless --all-models "
                "is given"};
    }
    sets.front() = options.instrument.of(std::move(sets.front()));
    const CurveSet& set = sets.front();
    FitRequest asked = request(options, set);
    if (set.scale == validation::Scale::unknown && !asked.fixed.contains("scale"))
        asked.freed.emplace_back("scale");
    const Fit fit = from_request(
        [&] { return validation::fitted(asked, sets, selection(options), {.other_ways = true}); });
    if (!options.output.empty()) {
        write_file(options.output, material_for(options.output, material_file(fit)));
        if (const double scale = fit.parameter("scale").value; scale != 1) {
            std::cerr << "hts: " << options.output << " holds the factor scale = " << shortest(scale)
                      << " for hts compare alone: a material cannot hold it\n";
        }
    }
    std::optional<validation::CrossValidation> unseen;
    if (options.cross_validate) unseen = validation::cross_validated(fit, sets, selection(options));
    if (!options.report.empty()) write_file(options.report, fit_json(fit, unseen));
    std::cout << (options.json ? fit_json(fit, unseen)
                               : fit_text(fit) + (unseen ? cross_validation_text(*unseen) : ""));
}

/// The files of folders, and files and names as they are.
std::vector<std::string> expanded(const std::vector<std::string>& curves) {
    std::vector<std::string> result;
    for (const std::string& curve : curves) {
        if (std::error_code ignored; !fs::is_directory(curve, ignored)) {
            result.push_back(curve);
            continue;
        }
        std::vector<std::string> inside;
        for (const auto& entry : fs::directory_iterator{curve}) {
            if (entry.path().extension() == ".json") inside.push_back(entry.path().string());
        }
        if (inside.empty()) throw Error{curve + ": no curve sets (*.json)"};
        std::ranges::sort(inside);
        result.insert(result.end(), inside.begin(), inside.end());
    }
    return result;
}

/// Which model fits and which predicts, by what the residuals make small.
void say_who_predicts(const FitOptions& options, const std::vector<Fit>& fits,
                      const std::vector<validation::CrossValidation>& unseen) {
    const bool cosine = residual(options) == validation::Residual::cosine;
    const auto fitted = [&](std::size_t i) {
        return cosine ? fits[i].statistics.l2 : fits[i].statistics.rms_log;
    };
    const auto predicted = [&](std::size_t i) { return cosine ? unseen[i].all.l2 : unseen[i].all.rms_log; };
    std::size_t fits_best = 0, predicts_best = 0;
    for (std::size_t i = 1; i < fits.size(); ++i) {
        if (fitted(i) < fitted(fits_best)) fits_best = i;
        if (predicted(i) < predicted(predicts_best)) predicts_best = i;
    }
    const auto named = [&](std::size_t i, double value) {
        return choice_of(fits[i]).label() + " (" + (cosine ? "L2 " : "rms ln ") + brief(value) + ")";
    };
    std::cerr << fits.front().data << ": " << named(fits_best, fitted(fits_best)) << " fits best, "
              << named(predicts_best, predicted(predicts_best)) << " predicts best\n";
}

void fit_all_models(const FitOptions& options) {
    const auto names = expanded(options.curves);
    Output output{options.output.empty() ? "-" : options.output};
    std::vector<std::string> columns{
        "data", "model", "values", "free_parameters", "median_abs_log", "rms_log", "rms", "l2_cosine_per_sr",
        "aic",  "bic"};
    if (options.cross_validate)
        columns.insert(columns.end(), {"predicted_median_abs_log", "predicted_rms_log", "predicted_rms",
                                       "predicted_l2_cosine_per_sr"});
    TableWriter table{output, format_of(options.output, options.json), columns};
    const spectral::Job job{"", names.size()};
    for (const std::string& name : names) {
        const CurveSet set = options.instrument.of(curves_from_argument(name));
        const auto fits = from_request([&] {
            return validation::fits_of(
                validation::compared_models(), set,
                {residual(options), selection(options), json_of(options.index), options.followed_starts});
        });
        std::vector<validation::CrossValidation> unseen;
        if (options.cross_validate) {
            unseen = validation::cross_validations(fits, set, selection(options));
            say_who_predicts(options, fits, unseen);
        }
        std::string text;
        for (std::size_t i = 0; i < fits.size(); ++i) {
            const Fit& fit = fits[i];
            const auto& s = fit.statistics;
            TableWriter::Row row{table, text};
            row.field(fit.data).field(choice_of(fit).label()).field(std::to_string(s.data));
            row.field(std::to_string(s.free_parameters));
            for (const double x : {s.median_abs_log, s.rms_log, s.rms, s.l2, s.aic, s.bic})
                row.field(brief(x, 6));
            if (options.cross_validate) {
                const auto& error = unseen[i].all;
                for (const double x : {error.median_abs_log, error.rms_log, error.rms, error.l2})
                    row.field(brief(x, 6));
            }
            row.end();
        }
        table.add(text);
        job.done();
    }
    table.finish();
    output.commit();
}

void run(const FitOptions& options) {
    if (options.all_models) return fit_all_models(options);
    fit_one(options);
}

}  // namespace

void add_fit(CLI::App& program) {
    CLI::App* verb =
        program.add_subcommand("fit", "the parameters with which a model comes closest to measured curves");
    auto options = std::make_shared<FitOptions>();
    offers(reads_whole(verb->add_option(
               "curves", options->curves,
               "curve set: a file or a name of hts curves list; more of the same surface, as its "
               "hemispherical reflectance; with --all-models of any, or folders")),
           validation::built_in_curve_names())
        ->required();
    std::vector<CLI::Option*> of_one{
        verb->add_option("--model", options->model,
                         "he, beckmann, ggx, kurt, ward, … (a wrong one lists all)")
            ->capture_default_str(),
        verb->add_option("--lobes", options->lobes, "1 ... 3, of models with lobes")
            ->check(whole_number(1, 3))
            ->capture_default_str(),
        verb->add_option("--fix", options->fixed, "hold a parameter: name=value, index=Al, sigma0=measured"),
        comma_list(*verb, "--free", options->freed,
                   "parameters to fit that are held otherwise: scale, k, my"),
        verb->add_option("--start", options->starts, "the only start of a parameter: name=value"),
        verb->add_flag("--conserve-energy", options->conserve_energy,
                       "hold what the material reflects at all of the light at most"),
        verb->add_option("--loss", options->loss, "squares, huber or cauchy")->capture_default_str(),
        verb->add_option("--loss-scale", options->loss_scale, "residual from where large ones count less")
            ->check(number_within(1e-9, 1e9))
            ->capture_default_str(),
        writes(verb->add_option("--report", options->report, "everything about the fit (JSON)"))};
    verb->add_option("--index", options->index,
                     "optical constants: a built-in name, or JSON as in a material file");
    of_one.push_back(verb->add_option("--films", options->films,
                                      "films that cover it, held: JSON as in a material file, "
                                      R"([{"index": "Al2O3", "thickness_um": 0.004}])"));
    verb->add_option("--residual", options->residual, "log, relative, weighted or cosine")
        ->capture_default_str();
    options->outside.add_to(*verb);
    options->instrument.add_to(*verb);
    verb->add_option("--largest-theta", options->largest_theta, "of both polar angles [deg], 0 ... 90")
        ->check(number_within(0, 90))
        ->capture_default_str();
    verb->add_option("--most-points", options->most_points, "thin the data out to so many; 0: all")
        ->check(whole_number(0, 1'000'000'000))
        ->capture_default_str();
    verb->add_option("--rings", options->nodes, "rings of nodes over each cone, 0 ... 8")
        ->check(whole_number(0, 8))
        ->capture_default_str();
    verb->add_option("--starts", options->followed_starts,
                     "how many of the most promising starts are followed, 1 ... 512")
        ->check(whole_number(1, 512))
        ->capture_default_str();
    verb->add_flag("--cross-validate", options->cross_validate,
                   "leave out one angle of incidence at a time and predict it by a fit of the others");
    auto* all = verb->add_flag("--all-models", options->all_models, "a table of all models");
    for (CLI::Option* option : of_one) all->excludes(option);
    writes(verb->add_option("-o,--output", options->output, "the fitted material (JSON), or the table"));
    verb->add_flag("--json", options->json, "print JSON");
    verb->footer(fit_help);
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli

// hts phi: the roughness function Phi(g, t), on which every directional-diffuse lobe depends.

#include "hts/phi.hpp"

#include <cmath>
#include <iostream>
#include <memory>

#include "cli/io/options.hpp"
#include "cli/io/transform.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/verbs.hpp"

namespace hts::cli {
namespace {

constexpr auto phi_help = R"(
Phi(g, t) = exp(-g) sum over m >= 1 of g^m / (m! m) exp(-t / m). The points file has the
columns g and t in any order; the answer repeats its columns and adds phi, log_phi
(finite where phi underflows) and method (the branch that computed it).

Examples:
  hts phi --g 100 --t 30
  hts phi --points cli/data/g-and-t.csv --output phi.csv)";

struct PhiOptions {
    std::optional<double> g, t;
    std::string points;
    OutputOptions output;
};

void require_in_domain(double g, double t) {
    if (!(g >= 0 && g <= 1e300)) throw out_of_range("g", g, "", "from 0 to 1e+300");
    if (!(t >= 0 && std::isfinite(t))) throw out_of_range("t", t, "", ">= 0 and finite");
}

CsvReader single_point(const PhiOptions& options) {
    if (!options.g || !options.t)
        throw UsageError{"points missing: must be given by --points, or by --g and --t"};
    from_option("--g, --t", [&] {
        require_in_domain(*options.g, *options.t);
        return 0;
    });
    return CsvReader::from_text("g,t\n" + shortest(*options.g) + "," + shortest(*options.t) + "\n");
}

void run(const PhiOptions& options) {
    if (!options.points.empty() && (options.g || options.t)) {
        throw UsageError{"--points: must not come with --g or --t"};
    }
    CsvReader points = options.points.empty() ? single_point(options) : CsvReader{options.points};
    const std::size_t g = points.column("g");
    const std::size_t t = points.column("t");
    const auto evaluate = [g, t](const CsvRow& row, std::span<Phi> result) {
        const double g_value = row.number(g, "g");
        const double t_value = row.number(t, "t");
        require_in_domain(g_value, t_value);
        result[0] = phi(g_value, t_value);
    };
    const auto append = [](TableWriter::Row& row, const Phi& value) {
        row.number(value.value).number(value.log).word(name(value.method));
    };
    Output output{options.output.path};
    std::vector<std::string> columns = points.columns();
    columns.insert(columns.end(), {"phi", "log_phi", "method"});
    TableWriter table{output, format_of(options.output.path, options.output.json), columns};
    Transform<Phi>{points, table, 1}.run(evaluate, append);
    output.commit();
}

}  // namespace

void add_phi(CLI::App& program) {
    CLI::App* verb = program.add_subcommand("phi", "the roughness function Phi(g, t)");
    auto options = std::make_shared<PhiOptions>();
    reads(verb->add_option("--points", options->points, "CSV file with columns g,t; - for standard input"));
    verb->add_option("--g", options->g, "phase variance, 0 ... 1e300");
    verb->add_option("--t", options->t, "lobe argument v_xy^2 tau^2 / 4, >= 0");
    options->output.add_to(*verb);
    verb->footer(phi_help);
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli

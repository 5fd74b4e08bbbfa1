// hts sample: outgoing directions drawn in proportion to what a material reflects.

#include <array>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <memory>
#include <numbers>
#include <sstream>

#include "cli/io/options.hpp"
#include "cli/io/table_writer.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/verbs.hpp"
#include "hts/sampling/random.hpp"
#include "spectral/jobs/progress.hpp"
#include "spectral/output/gnuplot.hpp"
#include "spectral/output/script.hpp"

namespace hts::cli {
namespace {

constexpr auto sample_help = R"(
Columns theta_r_deg, phi_r_deg, lobe (specular, directional_diffuse, uniform_diffuse or
none), pdf and weight. pdf is the density of all diffuse lobes together [1/sr], of a
specular draw the probability of that lobe [1], and 0 of none: a draw below the horizon,
which counts and has weight 0. weight is brdf cos(theta_r) / pdf, of a specular draw
reflectance / pdf; the mean weight, printed to standard error, is the reflectance into
the hemisphere. The same seed gives the same draws. Models other than he draw one lobe,
called uniform_diffuse where that part is all there is.

Examples:
  hts sample --material cli/data/rough-aluminium.json --wavelength 0.5 --theta-i 45 --count 100000 \
      --output directions.csv
  hts sample --material cli/data/rough-aluminium.json --wavelength 2 --theta-i 75 --count 20000 \
      --plot directions.svg --output directions.csv)";

struct SampleOptions {
    MaterialOptions material;
    OutputOptions output;
    double wavelength = 0, theta_i = 0, phi_i = 0;
    std::uint64_t count = 1000, seed = 1;
    std::string plot;
};

/// Sums over the draws.
struct Statistics {
    double sum = 0, squares = 0;
    std::array<std::size_t, 4> lobes{};  // by Lobe
    std::size_t count = 0;

    void add(const Draw& drawn) {
        sum += drawn.weight;
        squares += drawn.weight * drawn.weight;
        ++lobes[static_cast<std::size_t>(drawn.lobe)];
        ++count;
    }
    [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
    /// Of the mean, one standard deviation.
    [[nodiscard]] double error() const {
        const auto n = static_cast<double>(count);
        return std::sqrt(std::max(0.0, squares / n - mean() * mean()) / n);
    }
    [[nodiscard]] std::string text() const {
        std::ostringstream text;
        text << std::setprecision(6) << "mean weight " << mean() << " +- " << error() << ';';
        for (const Lobe lobe : {Lobe::specular, Lobe::directional_diffuse, Lobe::uniform_diffuse, Lobe::none})
            text << ' ' << name(lobe) << ' ' << lobes[static_cast<std::size_t>(lobe)];
        return text.str();
    }
};

/// Degrees, the azimuth from 0 to 360.
struct Degrees {
    double theta, phi;
};

Degrees degrees(const Direction& direction) {
    constexpr double per_radian = 180 * std::numbers::inv_pi;
    const double phi = std::atan2(direction.sin_phi(), direction.cos_phi()) * per_radian;
    return {std::atan2(direction.sin_theta(), direction.cos_theta()) * per_radian, phi < 0 ? phi + 360 : phi};
}

spectral::Sampler sampler(const SampleOptions& options) {
    const auto grid = spectral::WavelengthGrid::from_micrometres(
        {wavelength_from_option(options.wavelength).micrometres()});
    return reflectance_from_option("--wavelength", options.material.read(), grid,
                                   options.material.evaluation())
        .sampler(0);
}

void run(const SampleOptions& options) {
    const Direction in = from_option("--theta-i, --phi-i",
                                     [&] { return Direction::from_degrees(options.theta_i, options.phi_i); });
    const spectral::Sampler prepared = sampler(options);
    if (!options.plot.empty()) output::require_gnuplot(options.plot);
    Random random{options.seed};
    Output output{options.output.path};
    TableWriter table{output,
                      format_of(options.output.path, options.output.json),
                      {"theta_r_deg", "phi_r_deg", "lobe", "pdf", "weight"}};
    Statistics statistics;
    output::Rows points;
    const Vector3 light = in.vector();
    points.push_back({light.x, light.y, 4});
    const spectral::Job job{"", options.count};
    for (std::uint64_t i = 0; i < options.count; ++i) {
        job.done();
        const Draw drawn = prepared.sample(in, random.uniforms());
        const Degrees out = degrees(drawn.out);
        std::string text;
        TableWriter::Row row{table, text};
        row.number(out.theta)
            .number(out.phi)
            .word(name(drawn.lobe))
            .number(drawn.pdf)
            .number(drawn.weight)
            .end();
        table.add(text);
        statistics.add(drawn);
        if (options.plot.empty() || drawn.lobe == Lobe::none) continue;
        const Vector3 v = drawn.out.vector();
        points.push_back({v.x, v.y, static_cast<double>(drawn.lobe)});
    }
    table.finish();
    output.commit();
    std::cerr << "hts: " << statistics.text() << '\n';
    warn_of_gain(options.material.path, statistics.mean() - 3 * statistics.error());
    if (options.plot.empty()) return;
    output::Script script;
    script.set("title", std::to_string(options.count) + " draws, theta_i " + shortest(options.theta_i) +
                            " deg, " + shortest(options.wavelength) + " um");
    output::draw(options.plot, script.data("draws", points).with("sample"));
}

}  // namespace

void add_sample(CLI::App& program) {
    CLI::App* verb =
        program.add_subcommand("sample", "directions drawn as a material reflects, with density and weight");
    auto options = std::make_shared<SampleOptions>();
    options->material.add_to(*verb)->required();
    verb->add_option(wavelength_names, options->wavelength, "wavelength [um]")->required();
    verb->add_option(theta_i_names, options->theta_i, "polar angle of the light [deg], 0 ... 90")->required();
    verb->add_option("--phi-i", options->phi_i, "azimuth of the light [deg]")->capture_default_str();
    verb->add_option(count_names, options->count, "number of draws, 1 ... 1000000000")
        ->check(whole_number(1, 1'000'000'000))
        ->capture_default_str();
    verb->add_option("--seed", options->seed, "of the random numbers")
        ->check(seed_number())
        ->capture_default_str();
    options->output.add_to(*verb);
    draws(verb->add_option("--plot", options->plot, "draw the directions as SVG (needs gnuplot)"));
    verb->footer(sample_help);
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli

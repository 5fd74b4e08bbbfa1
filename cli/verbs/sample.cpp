// hts sample: outgoing directions drawn in proportion to what a material reflects.

#include "hts/sampling.hpp"

#include <array>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <memory>
#include <numbers>
#include <random>
#include <sstream>

#include "cli/io/gnuplot.hpp"
#include "cli/io/options.hpp"
#include "cli/io/table_writer.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/verbs.hpp"

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
  hts sample --material aluminium.json --wavelength 0.5 --theta-i 45 --count 100000 --output dirs.csv
  hts sample --material aluminium.json --wavelength 2 --theta-i 75 --count 20000 --plot dirs.svg --output dirs.csv)";

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

    void add(const WeightedDirection& drawn) {
        sum += drawn.weight;
        squares += drawn.weight * drawn.weight;
        ++lobes[static_cast<std::size_t>(drawn.lobe)];
        ++count;
    }
    [[nodiscard]] std::string text() const {
        const auto n = static_cast<double>(count);
        const double mean = sum / n;
        const double deviation = std::sqrt(std::max(0.0, squares / n - mean * mean));
        std::ostringstream text;
        text << std::setprecision(6) << "mean weight " << mean << " +- " << deviation / std::sqrt(n) << ';';
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

spectral::AnyModel model(const SampleOptions& options) {
    const auto grid = spectral::WavelengthGrid::from_micrometres(
        {wavelength_from_option(options.wavelength).micrometres()});
    return spectrum_from_option("--wavelength", options.material.read(), grid, options.material.policy())
        .models()
        .front();
}

Uniforms uniforms(std::mt19937_64& random) {
    Uniforms u{};
    for (double& x : u) x = static_cast<double>(random() >> 11) * 0x1p-53;
    return u;
}

/// Directions as seen from above the surface, each lobe in a colour.
std::string plot_script(const std::string& title, const std::string& points) {
    return "set title " + gnuplot_string(title) + R"( noenhanced
$draws << EOD
)" + points +
           R"(EOD
set size ratio -1
set xrange [-1.15:1.15]
set yrange [-1.15:1.15]
unset border
unset tics
set key outside right top samplen 1
set for [s=1:3] object s circle at 0,0 size sin(30*s*pi/180) fc rgb '#999999' fs empty border rgb '#bbbbbb'
set for [s=1:3] label s sprintf('%d°', 30*s) at 0,-sin(30*s*pi/180)-0.03 center tc rgb '#777777' font ',11'
plot $draws using 1:($3==2 ? $2 : 1/0) with dots lc rgb '#0072b2' notitle, \
     '' using 1:($3==3 ? $2 : 1/0) with dots lc rgb '#009e73' notitle, \
     '' using 1:($3==1 ? $2 : 1/0) with points pt 7 ps 1 lc rgb '#d55e00' title 'specular', \
     NaN with points pt 7 lc rgb '#0072b2' title 'directional diffuse', \
     NaN with points pt 7 lc rgb '#009e73' title 'uniform diffuse', \
     '' using 1:($3==4 ? $2 : 1/0) with points pt 2 ps 1.5 lc rgb '#000000' title 'light'
)";
}

void run(const SampleOptions& options) {
    const Direction in = from_option("--theta-i, --phi-i",
                                     [&] { return Direction::from_degrees(options.theta_i, options.phi_i); });
    const spectral::AnyModel prepared = model(options);
    if (!options.plot.empty()) require_gnuplot(options.plot);
    std::mt19937_64 random{options.seed};
    Output output{options.output.path};
    TableWriter table{output,
                      format_of(options.output.path, options.output.json),
                      {"theta_r_deg", "phi_r_deg", "lobe", "pdf", "weight"}};
    Statistics statistics;
    std::ostringstream points;
    const Vector3 light = in.vector();
    points << light.x << ' ' << light.y << " 4\n";
    for (std::uint64_t i = 0; i < options.count; ++i) {
        const WeightedDirection drawn = prepared.sample(in, uniforms(random));
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
        points << v.x << ' ' << v.y << ' ' << static_cast<int>(drawn.lobe) << '\n';
    }
    table.finish();
    output.commit();
    std::cerr << "hts: " << statistics.text() << '\n';
    if (options.plot.empty()) return;
    draw(options.plot,
         plot_script(std::to_string(options.count) + " draws, theta_i " + shortest(options.theta_i) +
                         " deg, " + shortest(options.wavelength) + " um",
                     points.str()));
}

}  // namespace

void add_sample(CLI::App& program) {
    CLI::App* verb =
        program.add_subcommand("sample", "directions drawn as a material reflects, with density and weight");
    auto options = std::make_shared<SampleOptions>();
    options->material.add_to(*verb)->required();
    verb->add_option("--wavelength", options->wavelength, "wavelength [um]")->required();
    verb->add_option("--theta-i", options->theta_i, "polar angle of the light [deg], 0 ... 90")->required();
    verb->add_option("--phi-i", options->phi_i, "azimuth of the light [deg]")->capture_default_str();
    verb->add_option("--count", options->count, "number of draws, 1 ... 1000000000")
        ->check(whole_number(1, 1'000'000'000))
        ->capture_default_str();
    verb->add_option("--seed", options->seed, "of the random numbers")
        ->check(seed_number())
        ->capture_default_str();
    options->output.add_to(*verb);
    verb->add_option("--plot", options->plot, "draw the directions as SVG (needs gnuplot)")
        ->check(svg_file());
    verb->footer(sample_help);
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli

#include "cli/answers/energy_info.hpp"

#include <algorithm>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "hts/error.hpp"
#include "hts/sampling/random.hpp"
#include "hts/tolerance.hpp"
#include "spectral/parallel.hpp"

namespace hts::cli {
namespace {

using EnergyPoint = EnergyInfo::Point;
using Json = nlohmann::ordered_json;

/// Above 1 by more than the error of the integral.
bool gains(const EnergyPoint& point) {
    return point.reflectance.total() > 1 + 1e-5;
}

std::string energy_text(const std::vector<EnergyPoint>& points) {
    const auto count = std::count_if(points.begin(), points.end(), gains);
    if (count == 0) return "Reflects no more light than falls in, at any of these points.\n";
    return "Reflects MORE light than falls in at " + std::to_string(count) + " of " +
           std::to_string(points.size()) + " points.\n";
}

/// Whether the material is the same at all wavelengths: at pairs all over the hemisphere, to the last bit.
bool is_grey(const spectral::Reflectance& reflectance) {
    constexpr int pairs = 64;
    Random random{1};
    std::vector<double> spectrum(reflectance.size());
    const auto is_flat = [&] {
        return std::ranges::all_of(spectrum, [&](double value) { return value == spectrum.front(); });
    };
    reflectance.uniform_diffuse(spectrum);
    bool grey = is_flat();
    for (int i = 0; grey && i < pairs; ++i) {
        const Direction in = random.direction(0), out = random.direction(0);
        reflectance.evaluator().brdf({in, out}, spectrum);
        grey = is_flat();
        reflectance.specular_reflectance(in, spectrum);
        grey = grey && is_flat();
    }
    return grey;
}

}  // namespace

EnergyInfo::EnergyInfo(spectral::Material of, const spectral::WavelengthGrid& wavelengths,
                       const std::vector<double>& theta_deg, spectral::OutsideRange policy)
    : material{std::move(of)}, points(wavelengths.size() * theta_deg.size()) {
    constexpr Tolerance shown{1e-5};  // four digits
    const auto reflectance = material.at(wavelengths, {.tolerance = shown, .outside = policy});
    const std::size_t angles = theta_deg.size(), computed = is_grey(reflectance) ? angles : points.size();
    spectral::parallel_for(
        computed,
        [&](std::size_t i) {
            points[i].reflectance =
                reflectance.albedo(Direction::from_degrees(theta_deg[i % angles], 0), i / angles);
        },
        1);
    for (std::size_t i = 0; i < points.size(); ++i)
        points[i] = {wavelengths.micrometres()[i / angles], theta_deg[i % angles],
                     points[i % computed].reflectance};
}

std::string info_text(const EnergyInfo& info) {
    std::ostringstream text;
    text << info.material.name() << "\n  model        " << info.material.model_name() << " ("
         << info.material.model_source() << ")\n\n"
         << std::left << "  wavelength    theta_i    reflectance in all    of it uniform diffuse\n";
    for (const EnergyPoint& point : info.points) {
        text << "  " << std::setw(14) << shortest(point.wavelength) + " um" << std::setw(11)
             << shortest(point.theta) + " deg" << std::setw(22) << brief(point.reflectance.total())
             << brief(point.reflectance.uniform_diffuse) << '\n';
    }
    text << '\n' << energy_text(info.points);
    for (const std::string& warning : info.material.warnings()) text << "Warning: " << warning << '\n';
    return text.str();
}

std::string info_json(const EnergyInfo& info) {
    Json points = Json::array();
    for (const EnergyPoint& point : info.points) {
        points.push_back({{"wavelength_um", point.wavelength},
                          {"theta_deg", point.theta},
                          {"directional_diffuse", point.reflectance.directional_diffuse},
                          {"uniform_diffuse", point.reflectance.uniform_diffuse},
                          {"total", point.reflectance.total()}});
    }
    const Json result{{"name", info.material.name()},
                      {"model", info.material.model_name()},
                      {"source", info.material.model_source()},
                      {"points", points},
                      {"points_above_1", std::count_if(info.points.begin(), info.points.end(), gains)},
                      {"warnings", info.material.warnings()}};
    return result.dump(1) + "\n";
}

void write_info_table(Output& output, const EnergyInfo& info) {
    TableWriter table{output,
                      Format::csv,
                      {"wavelength_um", "theta_deg", "directional_diffuse", "uniform_diffuse", "total"}};
    std::string text;
    for (const EnergyPoint& point : info.points) {
        TableWriter::Row row{table, text};
        row.field(shortest(point.wavelength)).field(shortest(point.theta));
        row.number(point.reflectance.directional_diffuse).number(point.reflectance.uniform_diffuse);
        row.number(point.reflectance.total()).end();
    }
    table.add(text);
    table.finish();
}

}  // namespace hts::cli

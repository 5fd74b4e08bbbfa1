#include "cli/answers/validation_parts.hpp"

#include <iostream>

#include "cli/io/usage.hpp"
#include "validation/curves/comparison_section.hpp"
#include "validation/fit/sections/fit_section.hpp"
#include "validation/papers/he_figures.hpp"
#include "validation/pictures/renders_section.hpp"
#include "validation/scattering/dielectric_scattering.hpp"
#include "validation/scattering/exact_scattering.hpp"
#include "validation/scattering/fourier/fourier_integral.hpp"
#include "validation/scattering/rays/ray_report.hpp"
#include "validation/scattering/vector/vector_report.hpp"

namespace hts::cli {
namespace {

using validation::Effort;
using validation::Section;

/// A part that is one section.
template <Section (*make)(Effort)>
std::vector<Section> alone(Effort effort, const std::filesystem::path& /*curves*/) {
    return {make(effort)};
}

std::vector<Section> measurements(Effort effort, const std::filesystem::path& /*curves*/) {
    return validation::fits_sections(effort);
}

std::vector<Section> paper_figures(Effort effort, const std::filesystem::path& curves) {
    return {validation::paper_figures_section(effort), validation::slots_section(curves)};
}

}  // namespace

const std::vector<ValidationPart>& validation_parts() {
    static const std::vector<ValidationPart> parts{
        {"measurements", measurements},
        {"models", alone<validation::models_section>},
        {"moments", alone<validation::exact_scattering_section>},
        {"vector", alone<validation::vector_section>},
        {"dielectric", alone<validation::dielectric_scattering_section>},
        {"fourier", alone<validation::fourier_section>},
        {"rays", alone<validation::rays_section>},
        {"figures", paper_figures},
        {"pictures", alone<validation::renders_section>}};
    return parts;
}

void require_as_recorded(const std::vector<std::string>& contradictions, const std::string& verb) {
    if (contradictions.empty()) return;
    for (const std::string& line : contradictions) std::cerr << "not as recorded: " << line << '\n';
    const auto count = contradictions.size();
    throw CheckFailed{verb + ": " + std::to_string(count) +
                      (count == 1 ? " result contradicts" : " results contradict") +
                      " what is recorded (above)"};
}

}  // namespace hts::cli

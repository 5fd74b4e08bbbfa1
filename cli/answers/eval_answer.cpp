#include "cli/answers/eval_answer.hpp"

#include <initializer_list>
#include <numbers>
#include <utility>

#include "hts/error.hpp"

namespace hts::cli {
namespace {

void add(std::vector<std::string>& names, std::initializer_list<const char*> more) {
    names.insert(names.end(), more.begin(), more.end());
}

void append_detail(TableWriter::Row& row, const Evaluation& value) {
    const spectral::LobeDetail& term = value.detail.value();
    row.number(term.phase_variance).number(term.lobe_argument).number(term.effective_roughness);
    row.number(term.shadowing).number(term.fresnel).word(name(term.method));
}

double quantity(const std::string& name, const Evaluation& value) {
    const double f = value.directional_diffuse + value.uniform_diffuse;
    if (name == "brf") return std::numbers::pi * f;
    if (name == "sigma0") return 4 * std::numbers::pi * f * value.cos_theta_i * value.cos_theta_r;
    return f * value.cos_theta_r;
}

}  // namespace

const std::vector<std::string>& eval_quantities() {
    static const std::vector<std::string> names{"brf", "sigma0", "ars"};
    return names;
}

std::vector<std::string> mueller_columns() {
    std::vector<std::string> names;
    for (const std::string term : {"m", "specular_m"})
        for (const char row : {'0', '1', '2', '3'})
            for (const char column : {'0', '1', '2', '3'}) names.push_back(term + row + column);
    return names;
}

void append_mueller(TableWriter::Row& row, const Mueller& diffuse, const Mueller& specular) {
    for (const Mueller* matrix : {&diffuse, &specular})
        for (const double element : matrix->elements()) row.number(element);
}

std::vector<std::string> EvalAnswer::columns() const {
    std::vector<std::string> names;
    if (wavelength) names.emplace_back("wavelength_um");
    if (transmission) {
        add(names, {"btdf"});
        return names;
    }
    add(names, {"directional_diffuse", "uniform_diffuse", "brdf", "specular_reflectance"});
    if (uncertainty) add(names, {"brdf_uncertainty", "specular_reflectance_uncertainty"});
    names.insert(names.end(), quantities.begin(), quantities.end());
    if (mueller) {
        for (std::string& name : mueller_columns()) names.push_back(std::move(name));
    }
    if (detail) add(names, {"g", "t", "effective_roughness_um", "shadowing", "fresnel", "method"});
    if (incident) {
        for (const std::string term : {"", "specular_"})
            for (const char* name :
                 {"s0", "s1", "s2", "s3", "degree_of_polarisation", "angle_of_polarisation_deg"})
                names.push_back(term + name);
    }
    return names;
}

void EvalAnswer::append(TableWriter::Row& row, const Evaluation& value) const {
    if (wavelength) row.field(shortest(value.wavelength));
    if (transmission) {
        row.number(value.btdf);
        return;
    }
    row.number(value.directional_diffuse).number(value.uniform_diffuse);
    row.number(value.directional_diffuse + value.uniform_diffuse).number(value.specular_reflectance);
    if (uncertainty) row.number(value.brdf_uncertainty).number(value.specular_uncertainty);
    for (const std::string& name : quantities) row.number(quantity(name, value));
    if (mueller) append_mueller(row, value.mueller, value.specular_mueller);
    if (detail) append_detail(row, value);
    if (incident) append_polarisation(row, value);
}

void EvalAnswer::append_polarisation(TableWriter::Row& row, const Evaluation& value) const {
    const Mueller diffuse = value.mueller + Mueller::depolariser(value.uniform_diffuse);
    for (const Mueller* term : {&diffuse, &value.specular_mueller}) {
        const Stokes reflected = *term * *incident;
        for (std::size_t i = 0; i < 4; ++i) row.number(reflected[i]);
        row.number(reflected.degree_of_polarisation());
        row.number(reflected.angle_of_polarisation() * 180 / std::numbers::pi);
    }
}

}  // namespace hts::cli

/// What `hts eval` adds to the columns of the points.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/answers/point_evaluator.hpp"
#include "cli/io/table_writer.hpp"

namespace hts::cli {

/// "m00" … "m33" of the diffuse terms, then "specular_m00" … "specular_m33" of the mirror's, row by row.
[[nodiscard]] std::vector<std::string> mueller_columns();
/// The numbers of those columns.
void append_mueller(TableWriter::Row& row, const Mueller& diffuse, const Mueller& specular);

/// Other names and units of the BRDF f of both diffuse terms, for --columns:
///   brf      bidirectional reflectance factor, pi f [1] (Nicodemus et al. 1977)
///   sigma0   radar's scattering coefficient, 4 pi f cos(theta_i) cos(theta_r) [1] (Ulaby, Moore, Fung 1982)
///   ars      angle-resolved scatter, the cosine-corrected BRDF: f cos(theta_r) [1/sr]
///            (Stover 2012; ISO 19986)
[[nodiscard]] const std::vector<std::string>& eval_quantities();

/// Names and values of the added columns, in the order of the members.
struct EvalAnswer {
    bool wavelength = false;
    bool mueller = false;
    bool detail = false;
    bool uncertainty = false;               ///< one standard deviation of BRDF and specular reflectance
    bool transmission = false;              ///< btdf instead of the terms of reflection
    std::vector<std::string> quantities{};  ///< some of eval_quantities
    std::optional<Stokes>
        incident{};  ///< adds the Stokes vectors that the diffuse terms and the mirror reflect

    [[nodiscard]] PointEvaluator::Wish wish() const noexcept {
        return {.mueller = mueller || incident, .detail = detail};
    }
    [[nodiscard]] std::vector<std::string> columns() const;
    void append(TableWriter::Row& row, const Evaluation& value) const;

  private:
    void append_polarisation(TableWriter::Row& row, const Evaluation& value) const;
};

}  // namespace hts::cli

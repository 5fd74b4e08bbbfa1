/// `hts eval --plan`: points evaluated as a plan says.
#pragma once

#include <string>

#include "cli/io/options.hpp"
#include "spectral/text/csv.hpp"

namespace hts::cli {

using spectral::CsvReader;

struct PlannedEval {
    std::string plan;      ///< plan file
    std::string material;  ///< name of one of its materials; may be empty if there is only one
    bool mueller = false;
};

/// Repeats the points' columns and adds, for a spectral plan, wavelength_um, brdf, specular_reflectance and,
/// if asked for, m00 ... m33 of the diffuse terms; for an rgb one linear sRGB of the diffuse terms' radiance
/// factor and of the specular reflectance. UsageError or hts::Error if plan or points do not fit.
void evaluate_planned(const PlannedEval& options, CsvReader& points, const OutputOptions& answer);

}  // namespace hts::cli

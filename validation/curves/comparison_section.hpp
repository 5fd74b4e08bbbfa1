/// The part of the report that sets a model beside measured curves, and what nobody has measured.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "validation/curves/comparison_figures.hpp"
#include "validation/report/report.hpp"

namespace hts::validation {

/// A model on trial.
struct Trial {
    std::string model;        ///< what it is, with its parameters: stands on every plot
    int free_parameters = 0;  ///< fitted to the set
    spectral::OutsideRange policy = spectral::OutsideRange::error;
    AveragingNodes nodes{};
    double scale = 1;        ///< a factor on the model, where one was fitted
    std::string stem{};      ///< of all files; that of the set if empty
    bool in_report = false;  ///< where every surface has a verdict
};

/// Model, roughness and albedo as a material file gives them: "he: rms roughness 0.28 um, correlation length
/// 1.77 um, Al".
[[nodiscard]] std::string described(const spectral::Material& material);

/// Plots, a table of figures of merit (all points and each curve), the reciprocity of the data, and the
/// criteria of the set. hts::Error where the model is not known in a band of the set.
[[nodiscard]] Section comparison_section(const CurveSet& set, const spectral::Material& material,
                                         const Trial& trial);

/// A measured curve that was printed and is not to be had.
struct MeasurementSlot {
    std::string stem;  ///< of the file that would hold it: "he91-figure-7"
    std::string what;
    spectral::Material model;  ///< with the parameters of the paper
};

/// The dashed curves of He et al. 1991, Figures 7 to 11.
[[nodiscard]] std::vector<MeasurementSlot> measurement_slots();

/// Each slot's comparison if `folder` holds its file (STEM.json, a curve set), else a line "measurement not
/// available".
[[nodiscard]] Section slots_section(const std::filesystem::path& folder);

}  // namespace hts::validation

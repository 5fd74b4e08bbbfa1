/// A model of the list (fit_family.hpp) laid out for data: its parameters by lobe and channel, the model that
/// their values make, and the material file that says the same.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hts/error.hpp"
#include "spectral/materials/coated_constants.hpp"
#include "spectral/models/material.hpp"
#include "spectral/wavelength_grid.hpp"
#include "validation/fit/fit_family.hpp"

namespace hts::validation {

/// What was asked of a fit cannot be, whatever the data: a model or parameter that is not known, a value out
/// of bounds.
class RequestError : public Error {
  public:
    using Error::Error;
};

/// A parameter of a model, placed: for one lobe and, where it may depend on wavelength, for one channel.
struct FitParameter {
    ParameterRange range;
    std::string pointer;  ///< JSON pointer into the material file: "/lobes/0/mx"
    std::string name;     ///< unique: "sigma0", "mx2" of the second lobe, "kd@0.55um" of a channel
    std::optional<std::size_t> lobe{};     ///< none: a number of the model's own
    std::size_t number = 0;                ///< place among the numbers of the lobe or of the model
    std::optional<std::size_t> channel{};  ///< none: the same in all
};

/// How the model is laid out for data.
struct FitLayout {
    int lobes = 1;  ///< 1 to 3; of models with lobes
    /// Wavelengths of the data [um] and which channel each belongs to; parameters that are linear get a value
    /// per channel.
    std::vector<double> wavelengths;
    std::vector<std::size_t> channels;
    /// JSON of the key "index" where it is known, "\"Al\""; else n and k are parameters.
    std::string index{};
    spectral::OutsideRange outside = spectral::OutsideRange::error;  ///< of the index and of films
    /// JSON of the key "films"; none if empty.
    std::string films{};

    [[nodiscard]] std::size_t channel_count() const noexcept;
};

/// Values, one per parameter, and what of the model is meant: all of it, or a lobe alone.
struct FitTrial {
    std::vector<double> values;
    std::optional<std::size_t> lobe{};
};

/// A model with places for numbers. Immutable; calls may run on any thread.
class FitModel {
  public:
    /// RequestError that names the model, lobes or index that is not known or not possible.
    FitModel(const std::string& family, FitLayout layout);

    [[nodiscard]] const std::string& name() const noexcept { return family_.name; }
    [[nodiscard]] const FitFamily& family() const noexcept { return family_; }
    [[nodiscard]] const FitLayout& layout() const noexcept { return layout_; }
    [[nodiscard]] const std::vector<FitParameter>& parameters() const noexcept { return parameters_; }

    /// What the model answers to a job at some of the layout's wavelengths, for each of some trials, which
    /// share what they have in common; hts::Error where a value is not allowed.
    [[nodiscard]] std::vector<Prediction::Answer> answers(std::span<const FitTrial> trials,
                                                          const Prediction::Job& job) const;
    /// Whether a parameter matters at any wavelength of a job.
    [[nodiscard]] bool concerns(const FitParameter& parameter, const Prediction::Job& job) const;
    /// The material file with these values.
    [[nodiscard]] std::string material_text(std::span<const double> values, const std::string& name) const;

  private:
    void place(const ParameterRange& range, std::optional<std::size_t> lobe, std::size_t number);
    void read_substance();
    [[nodiscard]] std::size_t lobe_count() const noexcept;
    [[nodiscard]] std::size_t layout_place(double um) const;
    [[nodiscard]] std::vector<ModelNumbers> numbers(const FitTrial& trial,
                                                    const spectral::WavelengthGrid& wavelengths) const;

    FitFamily family_;
    FitLayout layout_;
    std::vector<FitParameter> parameters_;
    std::optional<spectral::CoatedConstants>
        substance_;                     // of models that have an index; its own may be a place holder
    std::vector<CoatedIndex> indices_;  // of each wavelength of the layout, where the index is known
};

}  // namespace hts::validation

/// Every model of the library as something with parameters to fit: which numbers of its material file may move, how far, and
/// from where a search starts.
///
/// A model joins with a line in fit_model.cpp that lists the keys of its material file. A fit moves the numbers of such a file
/// and asks the registry of models (spectral/models/material.hpp) what it means, so that a fitted material and one that is read
/// are the same thing.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hts/error.hpp"
#include "spectral/models/material.hpp"
#include "spectral/wavelength_grid.hpp"

namespace hts::validation {

/// What was asked of a fit cannot be, whatever the data: a model or parameter that is not known, a value out of bounds.
class RequestError : public Error {
  public:
    using Error::Error;
};

/// How a parameter moves.
enum class Motion {
    factors,  ///< by factors: its logarithm is what is fitted; positive lengths, widths, exponents
    steps,    ///< by differences
    linear,  ///< by differences, and the BRDF is an affine function of it and of all others of this kind together
};

/// What the starts of a parameter are multiples of.
enum class StartUnit { own, wavelength, previous };

/// A number of a material file, as a fit moves it.
struct ParameterRange {
    std::string
        key;  ///< of the material file: "rms_roughness_um", "normals/sigma_x"; of a lobe's object for lobes
    std::string symbol;  ///< "sigma0"
    std::string unit;    ///< "um", "1", "deg"
    Motion motion;
    double lowest, highest;
    std::vector<double> starts;  ///< a search tries all combinations of these
    StartUnit start_unit = StartUnit::own;
    std::string
        tied_to{};  ///< key of the parameter whose value it takes unless it is freed: my of mx, for isotropic fits
    bool fixed = false;  ///< stays at its first start unless it is freed: k of a dielectric
};

/// A line of the list of models.
struct FitFamily {
    std::string name;   ///< "he", "beckmann", "kurt"
    std::string model;  ///< of the material file: "walter" for "beckmann"
    /// Keys whose values are no numbers, with JSON: {"distribution", "\"beckmann\""}.
    std::vector<std::pair<std::string, std::string>> settings;
    std::vector<ParameterRange> parameters;
    std::vector<ParameterRange> lobe{};  ///< of each lobe, for models with a list of lobes
    bool has_index = false;  ///< parameters n and k stand for the key "index", unless that is given
    bool costly = false;     ///< each trial takes long: left out where all models are compared
};

/// All that can be fitted: he, beckmann, ggx, kurt, ward, …
[[nodiscard]] const std::vector<FitFamily>& fit_families();

/// A parameter of a model, placed: for one lobe and, where it may depend on wavelength, for one channel.
struct FitParameter {
    ParameterRange range;
    std::string pointer;  ///< JSON pointer into the material file: "/lobes/0/mx"
    std::string name;     ///< unique: "sigma0", "mx2" of the second lobe, "kd@0.55um" of a channel
};

/// How the model is laid out for data.
struct FitLayout {
    int lobes = 1;  ///< 1 to 3; of models with lobes
    /// Wavelengths of the data [um] and which channel each belongs to; parameters that are linear get a value per channel.
    std::vector<double> wavelengths;
    std::vector<std::size_t> channels;
    std::string
        index{};  ///< JSON of the key "index" where it is known: "\"Al\""; else n and k are parameters

    [[nodiscard]] std::size_t channel_count() const noexcept;
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

    /// The material file with these numbers, one per parameter.
    [[nodiscard]] std::string material_text(std::span<const double> values, const std::string& name) const;
    /// What that file means; hts::Error where a value is not allowed.
    [[nodiscard]] spectral::Material reflector(std::span<const double> values) const;

  private:
    /// The index read once, so that a wrong one is found before a search.
    void try_index() const;
    void place(const ParameterRange& range, const std::string& pointer, const std::string& suffix);

    FitFamily family_;
    FitLayout layout_;
    std::vector<FitParameter> parameters_;
};

/// What a material file means.
[[nodiscard]] spectral::Material reflector_from(const std::string& material_text);

}  // namespace hts::validation

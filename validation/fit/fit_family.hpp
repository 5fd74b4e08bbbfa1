/// Every model of the library as something with parameters to fit: which numbers may move, how far, from
/// where a search starts, and what the model of such numbers answers to an instrument.
///
/// A model joins with a line in fit_family.cpp that lists the keys of its material file and what its numbers
/// mean. A test holds that against the registry of models (spectral/models/material.hpp), so that what is
/// fitted and the material file that comes out of a fit are the same thing.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hts/films/coated_index.hpp"
#include "hts/wavelength.hpp"
#include "validation/curves/prediction.hpp"

namespace hts::validation {

/// How a parameter moves.
enum class Motion {
    factors,  ///< by factors: its logarithm is what is fitted; positive lengths, widths, exponents
    steps,    ///< by differences
    linear,   ///< the same, and the BRDF is an affine function of it and of all others of this kind together
};

/// What the starts of a parameter are multiples of.
enum class StartUnit { own, wavelength, previous };

/// A number of a material file, as a fit moves it.
struct ParameterRange {
    /// Of the material file: "rms_roughness_um", "normals/sigma_x"; of a lobe's object for lobes.
    std::string key;
    std::string symbol;  ///< "sigma0"
    std::string unit;    ///< "um", "1", "deg"
    Motion motion;
    double lowest, highest;
    std::vector<double> starts;  ///< a search tries all combinations of these
    StartUnit start_unit = StartUnit::own;
    /// Key of the parameter whose value it takes unless it is freed: my of mx, for isotropic fits.
    std::string tied_to{};
    bool fixed = false;  ///< stays at its first start unless it is freed: k of a dielectric
};

/// What a model is made of at one wavelength.
struct ModelNumbers {
    Wavelength wavelength;
    CoatedIndex index;                       ///< of models that have one, else 1
    std::vector<double> own;                 ///< in the order of FitFamily::parameters
    std::vector<std::vector<double>> lobes;  ///< of each lobe, in the order of FitFamily::lobe
};

/// A line of the list of models.
struct FitFamily {
    /// What the models of several numbers answer, all of a pair (an incidence) together: they share what the
    /// numbers have in common. hts::Error where a number is not allowed.
    using Answer = std::function<Prediction::Answer(std::span<const ModelNumbers>, const Prediction::Job&)>;

    std::string name;   ///< "he", "beckmann", "kurt"
    std::string model;  ///< of the material file: "walter" for "beckmann"
    /// Keys whose values are no numbers, with JSON: {"distribution", "\"beckmann\""}.
    std::vector<std::pair<std::string, std::string>> settings;
    std::vector<ParameterRange> parameters;
    std::vector<ParameterRange> lobe;  ///< of each lobe, for models with a list of lobes
    Answer answer;
    bool has_index = false;   ///< parameters n and k stand for the key "index", unless that is given
    bool costly = false;      ///< each trial takes long: left out where all models are compared
    bool one_by_one = false;  ///< `answer` is asked for one trial at a time: trials have nothing in common
};

/// All that can be fitted: he, beckmann, ggx, kurt, ward, …
[[nodiscard]] const std::vector<FitFamily>& fit_families();

/// One of them; null if the name is not known.
[[nodiscard]] const FitFamily* find_family(const std::string& name);

}  // namespace hts::validation

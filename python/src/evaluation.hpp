/// Evaluates a material over broadcast wavelengths and directions: what all calls of hts.Material have in common.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "spectral/models/material.hpp"

namespace hts::python {

/// How a material is to be evaluated, as Python says it.
struct How {
    double tolerance = accuracy::default_tolerance;
    spectral::OutsideRange outside = spectral::OutsideRange::error;
    bool compensate_energy = false;

    friend auto operator<=>(const How&, const How&) = default;
};

/// n, k, rms roughness, correlation length and albedo of one element, where they go before the material's.
struct Overrides {
    std::optional<double> n, k, rms_roughness, correlation_length, diffuse_albedo;

    friend auto operator<=>(const Overrides&, const Overrides&) = default;
};

/// A material as Python holds it: with what was prepared of it last.
class PyMaterial {
  public:
    explicit PyMaterial(spectral::Material material, std::string description = {}, nb::object index = {});

    [[nodiscard]] const spectral::Material& material() const noexcept { return material_; }
    /// JSON of its file; empty where it came from elsewhere.
    [[nodiscard]] const std::string& description() const noexcept { return description_; }
    [[nodiscard]] const nb::object& index() const noexcept { return index_; }

    /// The material at wavelengths. With optical constants that are a Python function, it is called here.
    [[nodiscard]] spectral::Reflectance at(const spectral::WavelengthGrid& grid, const How& how,
                                           const Overrides& overrides = {}) const;
    /// At one wavelength; those asked for last are kept.
    [[nodiscard]] spectral::Reflectance at(double wavelength, const How& how,
                                           const Overrides& overrides = {}) const;
    /// A sampler at one wavelength; kept as well.
    [[nodiscard]] spectral::Sampler sampler(double wavelength, const How& how) const;

  private:
    using Key = std::tuple<double, How, Overrides>;
    struct Kept {
        std::mutex mutex;
        std::map<Key, spectral::Reflectance> reflectances;
        std::map<Key, spectral::Sampler> samplers;
    };

    spectral::Material material_;
    std::string description_;
    nb::object index_;  ///< a callable, or none
    std::shared_ptr<Kept> kept_;
};

/// A material, whatever the file: a description in JSON, or what a reader of measured and tabulated BRDFs makes of it.
///   format        of the file; "" to recognise it
///   wavelengths   what its channels are called [um], where the file does not say
[[nodiscard]] PyMaterial material_of_any_file(const std::string& path, const std::string& format = {},
                                              std::optional<std::vector<double>> wavelengths = std::nullopt);

/// What a call computes of each pair of directions at each wavelength.
struct Quantity {
    const char* name;
    Shape trailing;  ///< axes of the values of one element: none, or (4, 4) of a Mueller matrix
    bool views;      ///< whether it takes an outgoing direction
    bool samplers;   ///< whether it asks samplers instead of reflectances
    /// All wavelengths of a pair together.
    std::function<void(const spectral::Reflectance&, std::span<const DirectionPair>, std::span<double>)>
        evaluate;
    std::function<void(const spectral::Sampler&, std::span<const DirectionPair>, std::span<double>)>
        of_sampler;
};

/// The arguments of a call that says where: wavelengths, directions, and what goes before the material's values.
struct Where {
    nb::handle wavelength, theta_i, theta_r, phi, phi_i, incident, reflected;
    nb::handle rms_roughness, correlation_length, n, k, diffuse_albedo;
    bool degrees = false;
    int threads = 0;  ///< 0: all cores
};

/// An array of the common shape, followed by the quantity's own axes; a float for numbers.
///   out   None or an array for the result
[[nodiscard]] nb::object evaluate(const PyMaterial& material, const Quantity& quantity, const Where& where,
                                  const How& how, nb::object out);

/// The unit and the legal range of an angle: radians or degrees.
[[nodiscard]] Direction direction(double theta, double phi, bool degrees);

}  // namespace hts::python

/// A material as Python holds it.
#pragma once

#include <nanobind/nanobind.h>

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "spectral/models/material.hpp"

namespace hts::python {

namespace nb = nanobind;

/// How a material is to be evaluated, as Python says it.
struct How {
    double tolerance = accuracy::default_tolerance;
    spectral::OutsideRange outside = spectral::OutsideRange::error;
    bool compensate_energy = false;

    friend auto operator<=>(const How&, const How&) = default;
};

/// hts::Error where a tolerance or what holds outside a range is none.
[[nodiscard]] How how_from(double tolerance, const std::string& outside, bool compensate_energy);

/// A material as Python holds it: with what was prepared of it last.
class PyMaterial {
  public:
    ///   description   JSON of its file, without the index where that is a Python function
    ///   folder        absolute, from which relative paths in the description lead
    explicit PyMaterial(spectral::Material material, std::string description = {}, nb::object index = {},
                        std::string folder = {});

    [[nodiscard]] const spectral::Material& material() const noexcept { return material_; }
    /// JSON of its file; empty where it came from elsewhere.
    [[nodiscard]] const std::string& description() const noexcept { return description_; }
    [[nodiscard]] const std::string& folder() const noexcept { return folder_; }
    /// A Python function of wavelength that gives the optical constants, or none.
    [[nodiscard]] const nb::object& index() const noexcept { return index_; }

    /// With what such a function says at these wavelengths in its place; itself where there is none.
    [[nodiscard]] PyMaterial sampled(const spectral::WavelengthGrid& grid) const;
    /// The material at wavelengths. With optical constants that are a Python function, it is called here.
    [[nodiscard]] spectral::Reflectance at(const spectral::WavelengthGrid& grid, const How& how,
                                           const spectral::RoughSurfaceValues& instead = {}) const;
    /// At one wavelength; those asked for last are kept.
    [[nodiscard]] spectral::Reflectance at(double wavelength, const How& how,
                                           const spectral::RoughSurfaceValues& instead = {}) const;
    /// A sampler at one wavelength; kept as well.
    [[nodiscard]] spectral::Sampler sampler(double wavelength, const How& how) const;

  private:
    using Value = std::optional<double>;
    using Key = std::tuple<double, How, Value, Value, Value, Value, Value>;
    [[nodiscard]] static Key key(double wavelength, const How& how,
                                 const spectral::RoughSurfaceValues& instead);
    struct Kept {
        std::mutex mutex;
        std::map<Key, spectral::Reflectance> reflectances;
        std::map<Key, spectral::Sampler> samplers;
    };
    /// The value of a key, made if it is not kept.
    template <class Made, class Make>
    Made kept(std::map<Key, Made> Kept::*of, const Key& which, const Make& make) const;

    spectral::Material material_;
    std::string description_;
    nb::object index_;
    std::string folder_;
    std::shared_ptr<Kept> kept_;
};

/// A material, whatever the file: a description in JSON, or what a reader of measured and
/// tabulated BRDFs makes of it.
///   format        of the file; "" to recognise it
///   wavelengths   what its channels are called [um], where the file does not say
[[nodiscard]] PyMaterial material_of_any_file(const std::string& path, const std::string& format = {},
                                              std::optional<std::vector<double>> wavelengths = std::nullopt);

/// Reflectance that a file, a table or a plan has at its own wavelengths, as something to evaluate anywhere
/// between them.
[[nodiscard]] PyMaterial material_of_reflectance(const spectral::Reflectance& reflectance,
                                                 std::vector<std::string> notes, const std::string& model,
                                                 const std::string& source,
                                                 std::vector<std::string> channels = {});

}  // namespace hts::python

/// Evaluates a material over broadcast wavelengths and directions: what all calls of
/// hts.Material have in common.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "py_material.hpp"

namespace hts::python {

/// What a call computes of each pair of directions at each wavelength.
struct Quantity {
    const char* name;
    Shape trailing;  ///< axes of the values of one element: none, or (4, 4) of a Mueller matrix
    bool views;      ///< whether it takes an outgoing direction
    bool samplers;   ///< whether it asks samplers instead of reflectances
    bool slow;       ///< whether an element takes a millisecond or so
    /// All wavelengths of a pair together.
    std::function<void(const spectral::Reflectance&, std::span<const DirectionPair>, std::span<double>)>
        evaluate;
    std::function<void(const spectral::Sampler&, std::span<const DirectionPair>, std::span<double>)>
        of_sampler;
};

/// From now on a child process that was forked computes too, on one thread.
void survive_forks();

/// The arguments of a call that says where: wavelengths, directions, and what goes
/// before the material's values.
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

}  // namespace hts::python

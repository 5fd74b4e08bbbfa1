/// How material files become models: what a line of the registry is made of.
///
/// A model that is made from numbers needs no reader of its own: a line names its keys in the order of its
/// constructor's arguments, model_of_numbers<OrenNayar>("oren_nayar", "Oren, Nayar 1994",
/// {{"diffuse_albedo", 0}, …}).
#pragma once

#include <array>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "hts/microfacet/diffuse.hpp"
#include "hts/microfacet/lobes.hpp"
#include "spectral/models/model_evaluator.hpp"
#include "spectral/models/spectral_number.hpp"

namespace hts::spectral {

/// NumberKey::unit of angles in degrees [rad].
inline constexpr double degree = std::numbers::pi / 180;

/// A key whose value is a number or {"table": [[um, value], …]}.
struct NumberKey {
    const char* name;
    /// any value that is allowed: the other keys are checked beside it, so that a message names one key
    double legal;
    double unit = 1;  ///< of the file's number in the library's unit: pi/180 for degrees
    std::optional<double>
        otherwise{};  ///< the file's number where the key is left out; else it must be there
};

/// A value made from numbers of a file, whatever the wavelength: Make{}(double …) returns
/// it or throws hts::Error.
template <class Make, std::size_t N>
class ValueOfNumbers {
  public:
    ValueOfNumbers(const JsonValue& object, const std::array<NumberKey, N>& keys) {
        std::array<double, N> legal;
        for (std::size_t i = 0; i < N; ++i) legal[i] = keys[i].legal * keys[i].unit;
        for (std::size_t i = 0; i < N; ++i) {
            const auto checked = [&](double value) {
                auto tried = legal;
                tried[i] = value * keys[i].unit;
                static_cast<void>(made(tried));
                return tried[i];
            };
            if (keys[i].otherwise) {
                numbers_.emplace_back(object, keys[i].name, *keys[i].otherwise * keys[i].unit, checked);
            } else {
                numbers_.emplace_back(object[keys[i].name], checked);
            }
        }
    }

    [[nodiscard]] auto at(const Wavelength& wavelength, OutsideRange policy) const {
        std::array<double, N> values;
        for (std::size_t i = 0; i < N; ++i) values[i] = numbers_[i](wavelength, policy);
        return made(values);
    }

  private:
    [[nodiscard]] static auto made(const std::array<double, N>& values) {
        return std::apply([](auto... value) { return Make{}(value...); }, values);
    }

    std::vector<SpectralNumber> numbers_;
};

/// "name", "model", and the names of keys.
template <std::size_t N>
[[nodiscard]] std::vector<std::string> known_keys(const std::array<NumberKey, N>& keys,
                                                  std::vector<std::string> known = {"name", "model"}) {
    for (const NumberKey& key : keys) known.emplace_back(key.name);
    return known;
}

/// The part of a model's BRDF that is the same for all directions [1/sr].
template <class Model>
[[nodiscard]] double uniform_part(const Model& model) noexcept {
    if constexpr (requires { model.kd(); }) return model.kd() * std::numbers::inv_pi;
    return 0;
}
[[nodiscard]] inline double uniform_part(const LambertianModel& model) noexcept {
    return model.albedo() * std::numbers::inv_pi;
}

/// A model that Make{}(double …) makes from numbers, one per key.
template <class Make, std::size_t N>
[[nodiscard]] ModelEntry model_made_by(std::string name, std::string source,
                                       const std::array<NumberKey, N>& keys) {
    return {std::move(name), std::move(source), [keys](const MaterialFile& file) {
                file.json.require_keys_among(known_keys(keys));
                return material_of([value = ValueOfNumbers<Make, N>{file.json, keys}](
                                       const Wavelength& wavelength, OutsideRange policy) {
                    const auto model = value.at(wavelength, policy);
                    return ModelAtWavelength{model, uniform_part(model)};
                });
            }};
}

template <class Model>
struct Construct {
    template <class... Number>
    [[nodiscard]] Model operator()(Number... number) const {
        return Model{number...};
    }
};

/// A model whose constructor takes numbers, one per key.
template <ReflectanceModel Model, std::size_t N>
[[nodiscard]] ModelEntry model_of_numbers(std::string name, std::string source,
                                          const NumberKey (&keys)[N]) {  // NOLINT(modernize-avoid-c-arrays)
    return model_made_by<Construct<Model>>(std::move(name), std::move(source), std::to_array(keys));
}

/// "kd", 0 if left out, and "lobes", a list of objects with the key "ks" and those of `keys`, in the order of
/// the arguments of Lobe's constructor.
template <LobeShape Lobe, std::size_t N>
class LobesOfNumbers {
  public:
    LobesOfNumbers(const JsonValue& file, const std::array<NumberKey, N>& keys)
        : kd_{file, "kd", 0, [](double kd) { return checked_reflectance("diffuse albedo kd", kd); }} {
        std::array<NumberKey, N + 1> all{NumberKey{"ks", 1}};
        std::copy(keys.begin(), keys.end(), all.begin() + 1);
        const JsonValue list = file["lobes"];
        if (list.items().empty()) throw list.error("must have at least one lobe");
        for (const JsonValue& lobe : list.items()) {
            lobe.require_keys_among(known_keys(all, {}));
            lobes_.emplace_back(lobe, all);
        }
    }

    [[nodiscard]] double kd(const Wavelength& wavelength, OutsideRange policy) const {
        return kd_(wavelength, policy);
    }
    [[nodiscard]] std::vector<WeightedLobe<Lobe>> lobes(const Wavelength& wavelength,
                                                        OutsideRange policy) const {
        std::vector<WeightedLobe<Lobe>> result;
        for (const auto& lobe : lobes_) result.push_back(lobe.at(wavelength, policy));
        return result;
    }

  private:
    struct Make {
        template <class... Number>
        [[nodiscard]] WeightedLobe<Lobe> operator()(double ks, Number... number) const {
            return {checked_reflectivity("specular reflectivity ks", ks), Lobe{number...}};
        }
    };

    SpectralNumber kd_;
    std::vector<ValueOfNumbers<Make, N + 1>> lobes_;
};

/// DiffuseAndLobes<Lobe>.
template <LobeShape Lobe, std::size_t N>
[[nodiscard]] ModelEntry model_of_lobes(std::string name, std::string source,
                                        const NumberKey (&list)[N]) {  // NOLINT(modernize-avoid-c-arrays)
    return {std::move(name), std::move(source), [keys = std::to_array(list)](const MaterialFile& file) {
                file.json.require_keys_among({"name", "model", "kd", "lobes"});
                return material_of([parts = LobesOfNumbers<Lobe, N>{file.json, keys}](
                                       const Wavelength& wavelength, OutsideRange policy) {
                    const double kd = parts.kd(wavelength, policy);
                    return ModelAtWavelength{DiffuseAndLobes<Lobe>{kd, parts.lobes(wavelength, policy)},
                                             kd * std::numbers::inv_pi};
                });
            }};
}

// Models with more than numbers, a file each.
[[nodiscard]] Material read_ashikhmin(const MaterialFile& file);
[[nodiscard]] Material read_kurt(const MaterialFile& file);
[[nodiscard]] Material read_walter(const MaterialFile& file);

}  // namespace hts::spectral

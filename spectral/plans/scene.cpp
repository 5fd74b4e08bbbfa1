#include "spectral/plans/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <set>
#include <string_view>
#include <utility>

#include "hts/error.hpp"
#include "hts/tolerance.hpp"
#include "spectral/models/model_readers.hpp"
#include "spectral/models/reflectance.hpp"
#include "spectral/plans/true_tolerance.hpp"
#include "spectral/text/json_value.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {
namespace {

namespace fs = std::filesystem;

constexpr double finest_delta_e = 1e-3;
constexpr double coarsest_delta_e = 100;
constexpr double largest_budget = 0x1p53;  // whole numbers up to here are exact in JSON

// ---- reading

Material reflector_from(const JsonValue& item, const fs::path& folder, std::size_t number,
                        const std::vector<ModelEntry>& models) {
    if (item.is_object())
        return material_from_json({item, folder, "material " + std::to_string(number)}, models);
    if (!item.is_text()) throw item.error("must be the path of a material file or a material");
    return located(item.place(), [&] { return read_material(folder / item.text(), models); });
}

std::vector<Material> materials_from(const JsonValue& list, const fs::path& folder,
                                     const std::vector<ModelEntry>& models) {
    std::vector<Material> materials;
    std::set<std::string> names;
    for (const JsonValue& item : list.items()) {
        materials.push_back(reflector_from(item, folder, materials.size() + 1, models));
        const std::string& name = materials.back().name();
        if (!names.insert(name).second)
            throw item.error("name " + in_quotes(name) + " stands twice: must differ");
    }
    if (materials.empty()) throw list.error("must have at least one material");
    return materials;
}

WavelengthGrid wavelengths_from(const JsonValue& value) {
    return located(value.place(), [&] {
        if (value.is_text()) return WavelengthGrid::parse(value.text());
        std::vector<double> micrometres;
        for (const JsonValue& item : value.items()) micrometres.push_back(item.number());
        return WavelengthGrid::from_micrometres(std::move(micrometres));
    });
}

double angle_from(const JsonValue& value) {
    const double degrees = value.number();
    if (degrees > 0 && degrees <= 90) return degrees * std::numbers::pi / 180;
    throw value.error(shortest(degrees) + " deg: must be > 0 and <= 90 deg");
}

bool flag_from(const JsonValue& file, const char* key) {
    const auto flag = file.find(key);
    return flag && flag->boolean();
}

std::optional<Illuminant> illuminant_from(const JsonValue& file) {
    const JsonValue output = file["output"];
    const auto illuminant = file.find("illuminant");
    if (output.text() == "rgb") {
        if (!illuminant) return Illuminant::D65;
        return located(illuminant->place(), [&] { return illuminant_named(illuminant->text()); });
    }
    if (output.text() != "spectral")
        throw output.error(in_quotes(output.text()) + ": must be spectral or rgb");
    if (illuminant) throw illuminant->error(R"(contradicts "output": "spectral": must come with "rgb" only)");
    return std::nullopt;
}

constexpr const char* true_key = "true_db";

JsonValue tolerance_key(const JsonValue& tolerance) {
    const std::vector<std::string> keys{name(ErrorMeasure::relative_brdf_error),
                                        name(ErrorMeasure::delta_e_2000), true_key};
    tolerance.require_keys_among({keys[0], keys[1], keys[2]});
    std::optional<JsonValue> found;
    std::string first;
    for (const std::string& key : keys) {
        const auto value = tolerance.find(key);
        if (!value) continue;
        if (found)
            throw tolerance.error(
                first.append(" and " + key + " contradict each other: must be one of them"));
        found = value;
        first = key;
    }
    if (!found) throw tolerance.error("must have relative_brdf_error, delta_e_2000 or true_db");
    return *found;
}

void require_colour(const JsonValue& tolerance, bool rgb, bool polarised) {
    if (!rgb) throw tolerance.error(R"(contradicts "output": "spectral": must come with "output": "rgb")");
    if (polarised) {
        throw tolerance.error(R"(contradicts "polarised": true, of which a colour says nothing: must be )"
                              "relative_brdf_error");
    }
}

std::optional<std::size_t> budget_from(const JsonValue& file) {
    const auto budget = file.find("memory_budget_bytes");
    if (!budget) return std::nullopt;
    const double bytes = budget->number();
    if (bytes >= 1 && bytes <= largest_budget && bytes == std::floor(bytes))
        return static_cast<std::size_t>(bytes);
    throw budget->error(shortest(bytes) + ": must be a whole number of bytes, > 0");
}

/// What not every model has.
template <class Has>
void require_of_all(const JsonValue& file, const char* key, const Scene& scene, const Has& has) {
    if (!flag_from(file, key)) return;
    for (const Material& material : scene.materials) {
        if (has(material.properties())) continue;
        throw file[key].error("true: materials must be of model he; " + in_quotes(material.name()) +
                              " has model " + material.model_name());
    }
}

void require_wavelengths(const JsonValue& key, const Scene& scene) {
    located(key.place(), [&] {
        if (scene.illuminant)
            static_cast<void>(tristimulus_weights(scene.wavelengths.micrometres(), *scene.illuminant));
        for (const Material& material : scene.materials) {
            located(in_quotes(material.name()),
                    [&] { return material.at(scene.wavelengths, {.outside = scene.outside_range}); });
        }
    });
}

// ---- fingerprint

/// FNV-1a of 64 bits over text.
class Checksum {
  public:
    void add(std::string_view text) {
        for (const char c : text) step(static_cast<unsigned char>(c));
        step(0);
    }
    void add(double value, int significant_digits = 12) {
        std::array<char, 32> digits{};
        static_cast<void>(std::snprintf(digits.data(), digits.size(), "%.*g", significant_digits, value));
        add(std::string_view{digits.data()});
    }
    [[nodiscard]] std::string text() const {
        std::array<char, 17> digits{};
        static_cast<void>(
            std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(state_)));
        return digits.data();
    }

  private:
    void step(std::uint64_t byte) {
        state_ ^= byte;
        state_ *= 0x100000001b3;
    }
    std::uint64_t state_ = 0xcbf29ce484222325;
};

void add_samples(Checksum& checksum, const Reflectance& reflectance) {
    for (const SpectralSample& sample : reflectance.samples()) {
        checksum.add(sample.index.substrate().n());
        checksum.add(sample.index.substrate().k());
        for (const auto& film : sample.index.film_numbers())
            for (const double number : film) checksum.add(number);
        checksum.add(sample.uniform_diffuse);
    }
}

/// The BRDF seen from the mirror direction, nearby and far from it, in planes that no symmetry of a surface
/// singles out, one wavelength after the other.
void add_probes(Checksum& checksum, const Reflectance& reflectance) {
    constexpr int digits = 9;
    std::vector<std::vector<double>> probes;
    for (const double theta_i : {5., 50.}) {
        const Direction in = Direction::from_degrees(theta_i, 17 + theta_i);
        probes.push_back(reflectance.brdf({in, in.mirror()}));
        for (const double away : {1., 7., 25.}) {
            probes.push_back(
                reflectance.brdf({in, Direction::from_degrees(theta_i + away, 197 + theta_i + 3 * away)}));
        }
    }
    for (std::size_t i = 0; i < reflectance.size(); ++i)
        for (const auto& probe : probes) checksum.add(probe[i], digits);
}

/// Equally spaced over the range of a grid, for what a material does between its wavelengths.
WavelengthGrid between(const WavelengthGrid& wavelengths) {
    if (wavelengths.size() == 1) return wavelengths;
    return WavelengthGrid::linear(wavelengths.micrometres().front(), wavelengths.micrometres().back(), 257);
}

void add_material(Checksum& checksum, const Material& material, const Scene& scene) {
    checksum.add(material.name());
    checksum.add(material.model_name());
    if (const auto& surface = material.properties().surface) {
        checksum.add(surface->rms_roughness());
        checksum.add(surface->correlation_length());
        if (!surface->isotropic()) {
            checksum.add(surface->correlation_lengths().along);
            checksum.add(surface->azimuth());
        }
        if (const auto& shape = surface->correlation()) {
            for (const double q : {0.0, 0.1, 1.0, 10.0, 100.0}) checksum.add(shape->log_spectrum(q));
        }
        if (const auto& choices = surface->unified()) {
            checksum.add(static_cast<double>(choices->mirror));
            checksum.add(choices->polarisation_mixing ? 1.0 : 0.0);
            if (choices->conductor_shortcut) checksum.add(1.0);
        }
    }
    for (const WavelengthGrid& grid : {scene.wavelengths, between(scene.wavelengths)}) {
        const Reflectance reflectance = material.at(grid, {.outside = scene.outside_range});
        if (material.properties().surface)
            add_samples(checksum, reflectance);
        else
            add_probes(checksum, reflectance);
    }
}

}  // namespace

const char* name(ErrorMeasure measure) noexcept {
    return measure == ErrorMeasure::delta_e_2000 ? "delta_e_2000" : "relative_brdf_error";
}

void require_tolerance(ErrorMeasure measure, double tolerance) {
    const bool colour = measure == ErrorMeasure::delta_e_2000;
    const double finest = colour ? finest_delta_e : hts::accuracy::finest_tolerance;
    const double coarsest = colour ? coarsest_delta_e : hts::accuracy::coarsest_tolerance;
    if (tolerance >= finest && tolerance <= coarsest) return;
    throw out_of_range("tolerance", tolerance, "", "from " + shortest(finest) + " to " + shortest(coarsest));
}

/// "outside", or "clamp", which is "outside": "hold".
static OutsideRange outside_from(const JsonValue& file) {
    const auto outside = file.find("outside");
    if (outside && file.find("clamp"))
        throw outside->error("must not come with clamp, which is outside hold");
    if (!outside) return flag_from(file, "clamp") ? OutsideRange::hold : OutsideRange::error;
    return located(outside->place(), [&] { return outside_range_named(outside->text()); });
}

static Scene scene_from(const JsonValue& file, const fs::path& path, std::vector<Material> materials) {
    file.require_keys_among({"name", "materials", "wavelengths_um", "output", "illuminant", "polarised",
                             "compensate_energy", "outside", "clamp", "largest_theta_i_deg",
                             "largest_theta_r_deg", "tolerance", "memory_budget_bytes"});
    if (const auto name = file.find("name")) static_cast<void>(name->text());
    const JsonValue tolerance = tolerance_key(file["tolerance"]);
    const JsonValue wavelengths = file["wavelengths_um"];
    const bool colour = file["tolerance"].find(name(ErrorMeasure::delta_e_2000)).has_value();
    Scene scene{path,
                std::move(materials),
                wavelengths_from(wavelengths),
                outside_from(file),
                angle_from(file["largest_theta_i_deg"]),
                angle_from(file["largest_theta_r_deg"]),
                flag_from(file, "polarised"),
                illuminant_from(file),
                colour ? ErrorMeasure::delta_e_2000 : ErrorMeasure::relative_brdf_error,
                tolerance.number(),
                budget_from(file),
                flag_from(file, "compensate_energy")};
    require_of_all(file, "polarised", scene, [](const Properties& has) { return has.polarised; });
    require_of_all(file, "compensate_energy", scene,
                   [](const Properties& has) { return has.surface.has_value(); });
    if (colour) require_colour(tolerance, scene.illuminant.has_value(), scene.polarised);
    require_wavelengths(wavelengths, scene);
    located(tolerance.place(), [&] {
        if (file["tolerance"].find(true_key)) {
            scene.true_db = scene.tolerance;
            scene.tolerance = tolerance_beside_model(scene, *scene.true_db);
        }
        require_tolerance(scene.measure, scene.tolerance);
    });
    return scene;
}

Scene read_scene(const fs::path& path, const std::vector<ModelEntry>& models) {
    const JsonValue file = JsonValue::read(path);
    return scene_from(file, path, materials_from(file["materials"], path.parent_path(), models));
}

Scene scene_from_text(const std::string& text, const std::string& source, Material material) {
    return scene_from(JsonValue::parse(text, source), source, {std::move(material)});
}

std::string fingerprint(const Scene& scene) {
    Checksum checksum;
    for (const double um : scene.wavelengths.micrometres()) checksum.add(um);
    // the older word stays, so that plans of scenes that did not change stay
    checksum.add(
        std::string_view{scene.outside_range == OutsideRange::hold ? "clamp" : name(scene.outside_range)});
    checksum.add(scene.largest_theta_i);
    checksum.add(scene.largest_theta_r);
    checksum.add(std::string_view{scene.polarised ? "polarised" : "unpolarised"});
    checksum.add(std::string_view{scene.illuminant ? name(*scene.illuminant) : "spectral"});
    checksum.add(std::string_view{name(scene.measure)});
    checksum.add(scene.tolerance);
    if (scene.true_db) checksum.add(*scene.true_db);
    checksum.add(static_cast<double>(scene.memory_budget.value_or(0)));
    checksum.add(std::string_view{scene.compensate_energy ? "compensated" : "as published"});
    for (const Material& material : scene.materials) add_material(checksum, material, scene);
    return checksum.text();
}

}  // namespace hts::spectral

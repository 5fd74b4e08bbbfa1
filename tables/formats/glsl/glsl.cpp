#include "tables/formats/glsl/glsl.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <numbers>
#include <sstream>
#include <utility>
#include <vector>

#include "hts/error.hpp"
#include "hts/version.hpp"
#include "spectral/colour/colour.hpp"
#include "spectral/colour/display_colour.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/glsl/shader_text.hpp"
#include "tables/formats/glsl/wgsl.hpp"

namespace hts::tables {
namespace {

// What the shader takes for granted.
struct vec3 {
    float x, y, z;
    vec3() = default;
    vec3(float x_, float y_, float z_) : x{x_}, y{y_}, z{z_} {}
};
using std::abs, std::cos, std::exp, std::log, std::max, std::min, std::sin, std::sqrt;

// NOLINTBEGIN
#include "tables/formats/glsl/he_torrance.glsl"
// NOLINTEND

vec3 single(const Direction& direction) {
    const Vector3 v = direction.vector();
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// The constants of a material, as the text holds them.
struct ShaderMaterial {
    float rms_roughness, correlation_length;
    std::vector<float> wavelength, n, k, albedo;
};

class ShaderSampler final : public spectral::DirectionSampler {
  public:
    ShaderSampler(std::shared_ptr<const ShaderMaterial> material, std::size_t w)
        : material_{std::move(material)}, w_{w} {}

    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept override {
        const auto& m = *material_;
        return static_cast<double>(hts_he_pdf(single(in), single(out), m.wavelength[w_], m.rms_roughness,
                                              m.correlation_length, m.n[w_], m.k[w_], m.albedo[w_]));
    }
    [[nodiscard]] Draw sample(const Direction& in, const Uniforms& u) const noexcept override {
        const auto& m = *material_;
        const vec3 uniforms{static_cast<float>(u[0]), static_cast<float>(u[1]), static_cast<float>(u[2])};
        const HtsDraw drawn = hts_he_sample(single(in), uniforms, m.wavelength[w_], m.rms_roughness,
                                            m.correlation_length, m.n[w_], m.k[w_], m.albedo[w_]);
        if (!(drawn.pdf > 0)) return {in.mirror(), 0, 0, Lobe::none};
        const Vector3 out{static_cast<double>(drawn.direction.x), static_cast<double>(drawn.direction.y),
                          static_cast<double>(drawn.direction.z)};
        return {drawn.specular ? in.mirror() : Direction::from_unit_vector(out),
                static_cast<double>(drawn.weight), static_cast<double>(drawn.pdf),
                drawn.specular ? Lobe::specular : Lobe::directional_diffuse};
    }

  private:
    std::shared_ptr<const ShaderMaterial> material_;
    std::size_t w_;
};

class ShaderEvaluator final : public spectral::Evaluator {
  public:
    ShaderEvaluator(const std::string& name, ShaderMaterial material)
        : Evaluator{name, grid(material)},
          material_{std::make_shared<const ShaderMaterial>(std::move(material))} {}

    [[nodiscard]] spectral::Properties properties() const override {
        spectral::Properties result;
        result.isotropic = result.specular_term = true;
        return result;
    }
    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        const auto& m = *material_;
        const vec3 in = single(pair.in), out = single(pair.out);
        for (std::size_t w = 0; w < values.size(); ++w)
            values[w] = static_cast<double>(hts_he_brdf(in, out, m.wavelength[w], m.rms_roughness,
                                                        m.correlation_length, m.n[w], m.k[w], m.albedo[w]));
    }
    void specular_reflectance(const Direction& in, std::span<double> values) const noexcept override {
        const auto& m = *material_;
        for (std::size_t w = 0; w < values.size(); ++w)
            values[w] = static_cast<double>(hts_he_specular(single(in), m.wavelength[w], m.rms_roughness,
                                                            m.correlation_length, m.n[w], m.k[w]));
    }
    [[nodiscard]] std::shared_ptr<const spectral::DirectionSampler> sampler(
        std::size_t wavelength) const override {
        return std::make_shared<const ShaderSampler>(material_, wavelength);
    }

  private:
    static spectral::WavelengthGrid grid(const ShaderMaterial& material) {
        return spectral::WavelengthGrid::from_micrometres(
            {material.wavelength.begin(), material.wavelength.end()});
    }

    std::shared_ptr<const ShaderMaterial> material_;
};

// ---- the text

// As both languages write a float: with a point or an exponent.
std::string literal(double value) {
    std::array<char, 32> digits{};
    const auto end =
        std::to_chars(digits.data(), digits.data() + digits.size(), static_cast<float>(value)).ptr;
    std::string text{digits.data(), end};
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    return text;
}

template <class Values, class Of>
std::string list(const std::string& type, const std::string& name, const Values& values, const Of& of) {
    const std::string size = "[" + std::to_string(values.size()) + "]";
    std::string text = "const " + type + " " + name + size + " = " + type + size + "(";
    std::string line;
    for (const auto& value : values) {
        const std::string next = of(value);
        if (line.size() + next.size() > 96) {
            text += "\n    " + line;
            line.clear();
        }
        line += next + (&value == &values.back() ? "" : ", ");
    }
    return text + (text.find('\n') == std::string::npos && line.size() < 70 ? "" : "\n    ") + line + ");\n";
}

// What each wavelength adds to linear sRGB: three are blue, green and red.
std::vector<spectral::LinearRgb> rgb_weights(const spectral::WavelengthGrid& wavelengths) {
    constexpr auto white = spectral::Illuminant::D65;
    const auto um = wavelengths.micrometres();
    if (um.size() == 3) return {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
    if (um.size() < 2 || um.front() > spectral::shortest_coverage + 1e-9 ||
        um.back() < spectral::longest_coverage - 1e-9)
        return {};
    std::vector<spectral::LinearRgb> result;
    const auto weights = spectral::tristimulus_weights(um, white);
    for (const auto& xyz : weights.weights()) result.push_back(spectral::linear_srgb(xyz, white));
    return result;
}

const spectral::RoughSurface& surface_of(const spectral::Reflectance& brdf, const std::string& format) {
    const auto& surface = brdf.properties().surface;
    const std::string must = ": format " + format + ": must be a material of model \"he\"";
    if (!surface) throw Error{brdf.name() + must};
    if (surface->unified()) throw Error{brdf.name() + must + ", not \"he_unified\""};
    if (std::ranges::any_of(brdf.samples(),
                            [](const SpectralSample& sample) { return sample.index.coated(); }))
        throw Error{brdf.name() + must + ", without films"};
    if (surface->correlation()) throw Error{brdf.name() + must + ", with a gaussian correlation"};
    if (!surface->isotropic()) throw Error{brdf.name() + must + ", of one correlation length"};
    if (brdf.samples().size() > most_shader_wavelengths)
        throw out_of_range("number of wavelengths of a shader", static_cast<double>(brdf.samples().size()),
                           "", "at most " + std::to_string(most_shader_wavelengths));
    return *surface;
}

std::string one_line(std::string text) {
    std::ranges::replace_if(
        text, [](char c) { return c == '\n' || c == '\r' || c == '\\'; }, ' ');
    return text;
}

///   language   and what has to stand before the text
std::string head(const spectral::Reflectance& brdf, const char* language, const char* format) {
    std::ostringstream out;
    out << "// " << one_line(brdf.name()) << ": the reflectance of He, Torrance, Sillion and Greenberg 1991\n"
        << "// in " << language << " Written by hts " << HTS_VERSION << ", hts table export --format "
        << format << R"(.
//
// Directions are unit vectors about the normal (0, 0, 1), both away from the surface, wi towards the light
// and wo towards the viewer; lengths are in micrometres. Error of the BRDF: at most )"
        << accuracy::shader << " of the model's value, where that exceeds " << accuracy::shader_floor
        << R"( of its peak for that
// light, 0.003 <= sigma0/tau <= 1, and both polar angles are at most 89 degrees. Data: 35 coefficients
// of Phi, 140 bytes. For values that change, as uniforms, call hts_he_brdf, hts_he_specular,
// hts_he_sample, hts_he_pdf.

)";
    return out.str();
}

constexpr const char* calls = R"(
float hts_brdf(vec3 wi, vec3 wo, int w) {
    return hts_he_brdf(wi, wo, HTS_WAVELENGTH[w], HTS_SIGMA0, HTS_TAU, HTS_N[w], HTS_K[w], HTS_ALBEDO[w]);
}

float hts_specular(vec3 wi, int w) {
    return hts_he_specular(wi, HTS_WAVELENGTH[w], HTS_SIGMA0, HTS_TAU, HTS_N[w], HTS_K[w]);
}

float hts_pdf(vec3 wi, vec3 wo, int w) {
    return hts_he_pdf(wi, wo, HTS_WAVELENGTH[w], HTS_SIGMA0, HTS_TAU, HTS_N[w], HTS_K[w], HTS_ALBEDO[w]);
}

HtsDraw hts_sample(vec3 wi, vec3 u, int w) {
    return hts_he_sample(wi, u, HTS_WAVELENGTH[w], HTS_SIGMA0, HTS_TAU, HTS_N[w], HTS_K[w], HTS_ALBEDO[w]);
}
)";

constexpr const char* colour_calls = R"(
// Linear sRGB of the BRDF [1/sr] under D65; components out of gamut are 0.
vec3 hts_brdf_rgb(vec3 wi, vec3 wo) {
    vec3 rgb = vec3(0.0f);
    if (wi.z <= 0.0f || wo.z <= 0.0f) return rgb;
    HtsPair pair = hts_pair(HTS_SIGMA0, HTS_TAU, wi, wo);
    for (int w = 0; w < HTS_WAVELENGTHS; ++w) {
        float lobe = hts_pair_brdf(pair, HTS_WAVELENGTH[w], HTS_N[w], HTS_K[w]);
        rgb += HTS_RGB[w] * (lobe + HTS_ALBEDO[w] / HTS_PI);
    }
    return max(rgb, vec3(0.0f));
}

vec3 hts_specular_rgb(vec3 wi) {
    vec3 rgb = vec3(0.0f);
    for (int w = 0; w < HTS_WAVELENGTHS; ++w) {
        rgb += HTS_RGB[w] * hts_specular(wi, w);
    }
    return max(rgb, vec3(0.0f));
}
)";

std::string code(const spectral::Reflectance& brdf, const std::string& format) {
    const auto& surface = surface_of(brdf, format);
    const auto samples = brdf.samples();
    const auto rgb = rgb_weights(brdf.wavelengths());
    const auto constant = [](const char* name, double value) {
        return std::string{"const float "} + name + " = " + literal(value) + ";\n";
    };
    const auto each = [&](const char* name, const auto& of) {
        return list("float", name, samples, [&](const SpectralSample& s) { return literal(of(s)); });
    };
    std::string text{spectral::embedded_text(shader_files(), "he_torrance")};
    text +=
        "\n// ---- this material "
        "----------------------------------------------------------------------------\n\n";
    text += "const int HTS_WAVELENGTHS = " + std::to_string(samples.size()) + ";\n";
    text += constant("HTS_SIGMA0", surface.rms_roughness());
    text += constant("HTS_TAU", surface.correlation_length());
    text += each("HTS_WAVELENGTH", [](const auto& s) { return s.wavelength.micrometres(); });
    text += each("HTS_N", [](const auto& s) { return s.index.substrate().n(); });
    text += each("HTS_K", [](const auto& s) { return s.index.substrate().k(); });
    text += each("HTS_ALBEDO", [](const auto& s) { return s.uniform_diffuse * std::numbers::pi; });
    if (!rgb.empty())
        text += list("vec3", "HTS_RGB", rgb, [](const auto& weight) {
            return "vec3(" + literal(weight.red) + ", " + literal(weight.green) + ", " +
                   literal(weight.blue) + ")";
        });
    text += calls;
    if (!rgb.empty()) text += colour_calls;
    return text;
}

// ---- reading it

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
    throw Error{name + ": " + what + ": must be a shader that hts table export has written"};
}

float number_at(std::string_view text, std::size_t at, const std::string& name) {
    const auto digits = text.substr(at, text.find_first_of(",);", at) - at);
    return spectral::located(
        name, [&] { return static_cast<float>(spectral::number_in(spectral::trimmed(digits))); });
}

///   key   as GLSL has it or as WGSL has it
std::size_t behind(const std::string& text, const std::string& key, char glsl, const char* wgsl,
                   const std::string& sign, const std::string& name) {
    auto found = text.find("const float " + key + glsl);
    if (found == std::string::npos) found = text.find("const " + key + wgsl);
    const auto at = found == std::string::npos ? found : text.find(sign, found);
    if (at == std::string::npos) refuse(name, "constant " + key + ": missing");
    return at + sign.size();
}

std::vector<float> numbers_of(const std::string& text, const std::string& key, const std::string& name) {
    std::vector<float> values;
    const auto begin = behind(text, key, '[', " = array", "(", name);
    for (auto at = begin; at != std::string::npos && text[at - 1] != ')';) {
        values.push_back(number_at(text, at, name));
        at = text.find_first_of(",)", at);
        if (at != std::string::npos) ++at;
    }
    if (values.size() > most_shader_wavelengths) refuse(name, "constant " + key + ": too long");
    return values;
}

}  // namespace

std::string glsl_text(const spectral::Reflectance& brdf) {
    return head(brdf, "GLSL ES 3.00, to stand below \"#version 300 es\" and \"precision highp float;\".",
                "glsl") +
           code(brdf, "glsl");
}
std::string wgsl_text(const spectral::Reflectance& brdf) {
    return head(brdf, "WGSL.", "wgsl") + wgsl_of(code(brdf, "wgsl"));
}

namespace {

Exported exported(const char* language, std::string text, const std::string& path) {
    Sidecar sidecar;
    sidecar.format = language;
    sidecar.value = "f, the BRDF without the cosine";
    sidecar.normalisation = "none";
    sidecar.specular = "in the file, hts_specular";
    sidecar.notes = {"Phi: 35 coefficients, 140 bytes, in the code; no texture"};
    return {{{path, std::move(text)}}, std::move(sidecar)};
}

}  // namespace

Exported exported_glsl(const spectral::Reflectance& brdf, const std::string& path) {
    return exported("GLSL ES 3.00", glsl_text(brdf), path);
}
Exported exported_wgsl(const spectral::Reflectance& brdf, const std::string& path) {
    return exported("WGSL", wgsl_text(brdf), path);
}

spectral::Reflectance shader_brdf(const std::string& text, const std::string& name) {
    const auto constant = [&](const char* key) {
        return number_at(text, behind(text, key, ' ', " :", "= ", name), name);
    };
    ShaderMaterial material{constant("HTS_SIGMA0"),
                            constant("HTS_TAU"),
                            numbers_of(text, "HTS_WAVELENGTH", name),
                            numbers_of(text, "HTS_N", name),
                            numbers_of(text, "HTS_K", name),
                            numbers_of(text, "HTS_ALBEDO", name)};
    for (const auto* each : {&material.n, &material.k, &material.albedo})
        if (each->size() != material.wavelength.size()) refuse(name, "constants of different lengths");
    return spectral::Reflectance{std::make_shared<const ShaderEvaluator>(name, std::move(material))};
}

}  // namespace hts::tables

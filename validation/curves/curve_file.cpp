// The file of a curve set: JSON with one point a line, so that changes of a data file can be read.

#include <array>
#include <nlohmann/json.hpp>

#include "hts/error.hpp"
#include "spectral/text/json_value.hpp"
#include "spectral/text/text.hpp"
#include "validation/curves/curve.hpp"
#include "validation/curves/curve_json.hpp"

namespace hts::validation {
namespace {

using nlohmann::ordered_json;
using spectral::JsonValue;

constexpr const char* curve_format = "hts curves";
constexpr int format_version = 1;
constexpr std::array kinds{CurveKind::measured, CurveKind::digitised, CurveKind::theory};
constexpr std::array quantities{Quantity::brdf, Quantity::brdf_cosine, Quantity::reflectance_factor,
                                Quantity::hemispherical_reflectance};
constexpr std::array scales{Scale::absolute, Scale::specular, Scale::unknown};

// ---- reading

void require_format(const JsonValue& file) {
    const JsonValue kind = file["format"], version = file["format_version"];
    if (kind.text() != curve_format)
        throw kind.error(spectral::in_quotes(kind.text()) + ": must be " + spectral::in_quotes(curve_format));
    if (version.number() != format_version)
        throw version.error(shortest(version.number()) + ": must be " + std::to_string(format_version));
}

std::optional<MeasuredRoughness> roughness_from(const JsonValue& file) {
    const auto found = file.find("measured_roughness");
    if (!found) return std::nullopt;
    found->require_keys_among({"rms_um", "method"});
    return MeasuredRoughness{(*found)["rms_um"].number(), (*found)["method"].text()};
}

std::vector<std::string> notes_from(const JsonValue& file) {
    std::vector<std::string> result;
    if (const auto notes = file.find("notes"))
        for (const JsonValue& note : notes->items()) result.push_back(note.text());
    return result;
}

/// In-plane curves name the angle that stands still; scattered pairs name none.
Sweep sweep_from(const JsonValue& curve) {
    if (!curve.find("theta_i_deg")) return curve.find("theta_r_deg") ? Sweep::incident : Sweep::scattered;
    if (curve.find("theta_r_deg")) throw curve["theta_r_deg"].error("must not stand beside \"theta_i_deg\"");
    return Sweep::outgoing;
}

const char* fixed_key(Sweep sweep) {
    return sweep == Sweep::incident ? "theta_r_deg" : "theta_i_deg";
}

Curve scattered_curve(const JsonValue& points, Band band, bool uncertain) {
    std::vector<std::string> columns{"theta_i_deg", "phi_i_deg", "theta_r_deg", "phi_r_deg", "value"};
    if (uncertain) columns.emplace_back("uncertainty");
    Curve result{band, Sweep::scattered, {}};
    for (const auto& row : points.rows(columns)) {
        const auto& v = row.values;
        result.points.push_back({v[0], v[1], v[2], v[3], v[4], uncertain ? v[5] : 0});
    }
    return result;
}

Curve in_plane_curve(const JsonValue& points, Band band, Sweep sweep, double fixed, bool uncertain) {
    std::vector<std::string> columns{sweep == Sweep::incident ? "theta_i_deg" : "theta_r_deg", "value"};
    if (uncertain) columns.emplace_back("uncertainty");
    Curve result{band, sweep, {}};
    for (const auto& row : points.rows(columns)) {
        const auto& v = row.values;
        result.points.push_back(in_plane_point(sweep, fixed, v[0], v[1], uncertain ? v[2] : 0));
    }
    return result;
}

Curve curve_from(const JsonValue& curve, bool uncertain) {
    curve.require_keys_among({"wavelength_um", "band_um", "theta_i_deg", "theta_r_deg", "points"});
    const Band band = band_from(curve);
    const Sweep sweep = sweep_from(curve);
    const JsonValue points = curve["points"];
    if (sweep == Sweep::scattered) return scattered_curve(points, band, uncertain);
    return in_plane_curve(points, band, sweep, curve[fixed_key(sweep)].number(), uncertain);
}

// ---- writing

/// Arrays of numbers on one line each; all else indented.
class Writer {
  public:
    void add(const char* key, const ordered_json& value) {
        text_ += (text_.empty() ? "{\n  " : ",\n  ") + quoted(key) + ": " + value.dump();
    }
    void add_curves(const CurveSet& set) {
        text_ += ",\n  \"curves\": [";
        for (std::size_t i = 0; i < set.curves.size(); ++i) {
            text_ += i == 0 ? "\n    {" : ",\n    {";
            add_curve(set.curves[i], !set.uncertainty.empty());
        }
        text_ += "\n  ]\n}\n";
    }
    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    static std::string quoted(const char* key) { return std::string{"\""} + key + '"'; }
    void add_curve(const Curve& curve, bool uncertain) {
        const auto& [first, last] = curve.band;
        text_ += curve.band.single() ? "\"wavelength_um\": " + shortest(first)
                                     : "\"band_um\": [" + shortest(first) + ", " + shortest(last) + "]";
        if (curve.sweep != Sweep::scattered)
            text_ += ", " + quoted(fixed_key(curve.sweep)) + ": " + shortest(curve.fixed_angle());
        text_ += ", \"points\": [";
        for (std::size_t i = 0; i < curve.points.size(); ++i) {
            text_ += i == 0 ? "\n      [" : ",\n      [";
            add_point(curve, curve.points[i], uncertain);
        }
        text_ += "\n    ]}";
    }
    void add_point(const Curve& curve, const CurvePoint& p, bool uncertain) {
        if (curve.sweep == Sweep::scattered) {
            for (const double angle : {p.theta_i, p.phi_i, p.theta_r, p.phi_r})
                text_ += shortest(angle) + ", ";
        } else {
            text_ += shortest(curve.swept_angle(p)) + ", ";
        }
        text_ += shortest(p.value);
        if (uncertain) text_ += ", " + shortest(p.uncertainty);
        text_ += "]";
    }

    std::string text_;
};

}  // namespace

std::vector<std::string> head_keys() {
    return {"surface",
            "kind",
            "by",
            "source",
            "licence",
            "notes",
            "quantity",
            "scale",
            "source_solid_angle_sr",
            "detector_solid_angle_sr",
            "measured_roughness",
            "noise_floor"};
}

CurveSet head_from(const JsonValue& file, const std::string& surface, bool emissivity) {
    return {
        .stem = "",
        .surface = surface.empty() ? file["surface"].text() : surface,
        .kind = named(file["kind"], kinds),
        .by = file["by"].text(),
        .source = file["source"].text(),
        .licence = file["licence"].text(),
        .how = "",
        .notes = notes_from(file),
        .quantity = emissivity ? Quantity::hemispherical_reflectance : named(file["quantity"], quantities),
        .scale = named(file["scale"], scales),
        .source_solid_angle = optional_number(file, "source_solid_angle_sr"),
        .detector_solid_angle = optional_number(file, "detector_solid_angle_sr"),
        .roughness = roughness_from(file),
        .noise_floor = optional_number(file, "noise_floor"),
        .uncertainty = "",
        .curves = {}};
}

Band band_from(const JsonValue& object) {
    if (const auto single = optional_number(object, "wavelength_um")) {
        if (object.find("band_um")) throw object["band_um"].error("must not stand beside \"wavelength_um\"");
        return {*single, *single};
    }
    const JsonValue band = object["band_um"];
    const auto ends = band.items();
    if (ends.size() != 2) throw band.error("must be [first, last]");
    return {ends[0].number(), ends[1].number()};
}

CurveSet curves_from_json(const JsonValue& file, const std::string& stem, const std::string& place) {
    require_format(file);
    auto keys = head_keys();
    keys.insert(keys.end(), {"format", "format_version", "how", "uncertainty", "curves"});
    file.require_keys_among(keys);
    CurveSet set = head_from(file);
    set.stem = stem;
    set.how = file["how"].text();
    if (const auto uncertainty = file.find("uncertainty")) set.uncertainty = uncertainty->text();
    for (const JsonValue& curve : file["curves"].items())
        set.curves.push_back(curve_from(curve, !set.uncertainty.empty()));
    return checked(std::move(set), place);
}

CurveSet read_curves(const std::filesystem::path& path) {
    return curves_from_json(JsonValue::read(path), path.stem().string(), path.string());
}

std::string curves_text(const CurveSet& set) {
    Writer writer;
    writer.add("format", curve_format);
    writer.add("format_version", format_version);
    writer.add("surface", set.surface);
    writer.add("kind", name(set.kind));
    writer.add("by", set.by);
    writer.add("source", set.source);
    writer.add("licence", set.licence);
    writer.add("how", set.how);
    if (!set.notes.empty()) writer.add("notes", set.notes);
    writer.add("quantity", name(set.quantity));
    writer.add("scale", name(set.scale));
    if (set.source_solid_angle) writer.add("source_solid_angle_sr", *set.source_solid_angle);
    if (set.detector_solid_angle) writer.add("detector_solid_angle_sr", *set.detector_solid_angle);
    if (set.roughness) {
        const ordered_json roughness{{"rms_um", set.roughness->rms_um}, {"method", set.roughness->method}};
        writer.add("measured_roughness", roughness);
    }
    if (set.noise_floor) writer.add("noise_floor", *set.noise_floor);
    if (!set.uncertainty.empty()) writer.add("uncertainty", set.uncertainty);
    writer.add_curves(set);
    return writer.text();
}

}  // namespace hts::validation

// hts.Material: files and descriptions, and every call that evaluates.
#include "module.hpp"

#include <filesystem>
#include <numbers>
#include <span>
#include <tuple>

#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "hts/error.hpp"
#include "hts/version.hpp"
#include "quantities.hpp"
#include "sampling.hpp"
#include "spectral/models/hemisphere.hpp"
#include "spectral/text/json_value.hpp"
#include "tables/formats/measured_model.hpp"

namespace hts::python {
namespace {

// ------------------------------------------------------------------------------------------------ arguments

template <const Quantity& what>
nb::object of_pair(const PyMaterial& self, nb::handle wavelength, nb::handle theta_i, nb::handle theta_r,
                   nb::handle phi, nb::handle phi_i, double tolerance, bool degrees, nb::object out,
                   nb::handle incident, nb::handle reflected, nb::handle rms_roughness,
                   nb::handle correlation_length, nb::handle n, nb::handle k, nb::handle diffuse_albedo,
                   const std::string& outside, bool compensate_energy, int threads) {
    return evaluate(self, what,
                    {wavelength, theta_i, theta_r, phi, phi_i, incident, reflected, rms_roughness,
                     correlation_length, n, k, diffuse_albedo, degrees, threads},
                    how_from(tolerance, outside, compensate_energy), std::move(out));
}

template <const Quantity& what>
nb::object of_light(const PyMaterial& self, nb::handle wavelength, nb::handle theta_i, nb::handle phi_i,
                    double tolerance, bool degrees, nb::object out, nb::handle incident,
                    nb::handle rms_roughness, nb::handle correlation_length, nb::handle n, nb::handle k,
                    nb::handle diffuse_albedo, const std::string& outside, bool compensate_energy,
                    int threads) {
    return evaluate(self, what,
                    {wavelength,
                     theta_i,
                     {},
                     {},
                     phi_i,
                     incident,
                     {},
                     rms_roughness,
                     correlation_length,
                     n,
                     k,
                     diffuse_albedo,
                     degrees,
                     threads},
                    how_from(tolerance, outside, compensate_energy), std::move(out));
}

nb::object mueller_of_pair(const PyMaterial& self, nb::handle wavelength, nb::handle theta_i,
                           nb::handle theta_r, nb::handle phi, nb::handle phi_i, double tolerance,
                           bool degrees, nb::object out, nb::handle incident, nb::handle reflected,
                           nb::handle rms_roughness, nb::handle correlation_length, nb::handle n,
                           nb::handle k, nb::handle diffuse_albedo, const std::string& outside,
                           bool compensate_energy, int threads, const std::string& terms) {
    if (terms != "directional_diffuse" && terms != "diffuse")
        throw Error{"terms \"" + terms + "\": must be \"directional_diffuse\" or \"diffuse\""};
    const auto call = terms == "diffuse" ? of_pair<quantity::diffuse_mueller> : of_pair<quantity::mueller>;
    return call(self, wavelength, theta_i, theta_r, phi, phi_i, tolerance, degrees, std::move(out), incident,
                reflected, rms_roughness, correlation_length, n, k, diffuse_albedo, outside,
                compensate_energy, threads);
}

// ------------------------------------------------------------------------------------------------
// derivatives

/// In the order of quantity::derivatives.
constexpr const char* parameters[]{"rms_roughness_um",
                                   "correlation_length_um",
                                   "n",
                                   "k",
                                   "diffuse_albedo",
                                   "theta_i",
                                   "theta_r",
                                   "phi",
                                   "correlation_length_x_um",
                                   "correlation_length_y_um",
                                   "azimuth"};
/// Those that a surface of one or of two correlation lengths has, and which of them are angles.
constexpr std::size_t of_isotropic[]{0, 1, 2, 3, 4, 5, 6, 7}, of_anisotropic[]{0, 8, 9, 10, 2, 3, 4, 5, 6, 7};
constexpr std::size_t first_angle = 5, theta_r_place = 6, phi_place = 7, azimuth_place = 10;

/// Directional-hemispherical reflectance of light polarised along s or p.
nb::object polarised_albedo(const PyMaterial& self, nb::handle wavelength, nb::handle theta, nb::handle phi,
                            bool s, bool degrees, const std::string& outside) {
    return evaluate(self, s ? quantity::s_albedo : quantity::p_albedo,
                    {wavelength, theta, {}, {}, phi, {}, {}, {}, {}, {}, {}, {}, degrees},
                    how_from(accuracy::default_tolerance, outside, false), nb::none());
}

/// Of what the material's file says.
std::size_t film_count(const PyMaterial& self) {
    if (self.description().empty()) return 0;
    const auto films = spectral::JsonValue::parse(self.description(), "material").find("films");
    return films ? films->items().size() : 0;
}

nb::dict gradient(const PyMaterial& self, nb::handle wavelength, nb::handle theta_i, nb::handle theta_r,
                  nb::handle phi, nb::handle phi_i, const std::string& of, bool degrees,
                  nb::handle rms_roughness, nb::handle correlation_length, nb::handle n, nb::handle k,
                  nb::handle diffuse_albedo, const std::string& outside, int threads) {
    if (self.material().model_name() != "he")
        throw Error{"gradient: derivatives are known of model he: this is " + self.material().model_name()};
    const std::size_t films = film_count(self);
    const Quantity derivatives = quantity::derivatives(of, films);
    const bool views = derivatives.views;
    const nb::object all = evaluate(self, derivatives,
                                    {wavelength,
                                     theta_i,
                                     views ? theta_r : nb::handle{},
                                     views ? phi : nb::handle{},
                                     phi_i,
                                     {},
                                     {},
                                     rms_roughness,
                                     correlation_length,
                                     n,
                                     k,
                                     diffuse_albedo,
                                     degrees,
                                     threads},
                                    how_from(accuracy::default_tolerance, outside, false), nb::none());
    const nb::object moved = numpy().attr("moveaxis")(all, of == "mueller" ? -3 : -1, 0);
    nb::dict result;
    const bool isotropic = !correlation_length.is_none() || self.material().properties().isotropic;
    const auto known = isotropic ? std::span<const std::size_t>{of_isotropic} : std::span{of_anisotropic};
    for (const std::size_t p : known) {
        // the mirror direction turns along with the light
        if (!views && (p == theta_r_place || p == phi_place)) continue;
        nb::object values = moved[p];
        const bool angle = (p >= first_angle && p <= phi_place) || p == azimuth_place;
        if (degrees && angle) values = values * nb::float_(std::numbers::pi / 180);
        result[parameters[p]] = values;
    }
    for (std::size_t film = 0; film < films; ++film) {
        const std::string name = "films/" + std::to_string(film) + "/";
        std::size_t place = std::size(parameters) + 3 * film;
        for (const char* const key : {"n", "k", "thickness_um"})
            result[nb::str((name + key).c_str())] = moved[place++];
    }
    return result;
}

// ------------------------------------------------------------------------------------------------ validity

/// Severity, least and most error along a last axis of 3: quantity::validity.
nb::object validity(const PyMaterial& self, nb::handle wavelength, nb::handle theta_i, nb::handle theta_r,
                    nb::handle phi, nb::handle phi_i, bool degrees) {
    if (!self.material().properties().surface)
        throw Error{"validity: known of models of rough surfaces: this is " + self.material().model_name()};
    return evaluate(self, quantity::validity,
                    {wavelength, theta_i, theta_r, phi, phi_i, {}, {}, {}, {}, {}, {}, {}, degrees},
                    how_from(1e-6, "error", false), nb::none());
}

// ------------------------------------------------------------------------------------------------
// construction

/// From a file of any kind, a copy, or a description of Python made into JSON by hts/_description.py.
void construct(PyMaterial* self, nb::object source, nb::kwargs keywords) {
    if (nb::isinstance<PyMaterial>(source) && keywords.size() == 0) {
        new (self) PyMaterial{nb::cast<const PyMaterial&>(source)};
        return;
    }
    const nb::object arguments = nb::borrow(keywords);
    const nb::module_ helper = nb::module_::import_("hts._description");
    const auto [text, path, index] = nb::cast<std::tuple<std::string, std::string, nb::object>>(
        helper.attr("described")(source, arguments));
    if (text.empty()) {
        new (self) PyMaterial{material_of_any_file(path)};
        return;
    }
    const bool of_function = !index.is_none();
    const auto readable = of_function ? nb::cast<std::string>(helper.attr("with_any_index")(text)) : text;
    new (self) PyMaterial{spectral::material_from_text(readable, path, tables::models_with_files()), text,
                          of_function ? index : nb::object{}, std::filesystem::current_path().string()};
}

std::string repr(const PyMaterial& self) {
    return "<hts.Material \"" + self.material().name() + "\", model " + self.material().model_name() + ">";
}

}  // namespace

// What Python's help and type checkers see.
#define HTS_ARRAY "numpy.typing.ArrayLike"
#define HTS_MAYBE HTS_ARRAY " | None = None"
#define HTS_OF_SURFACE                                                                                       \
    "rms_roughness_um: " HTS_MAYBE ", correlation_length_um: " HTS_MAYBE ", n: " HTS_MAYBE ", k: " HTS_MAYBE \
    ", diffuse_albedo: " HTS_MAYBE
#define HTS_HOW ", outside: str = 'error', compensate_energy: bool = False, threads: int = 0"
#define HTS_PAIR(name, last)                                                                    \
    "def " name "(self, wavelength: " HTS_ARRAY ", theta_i: " HTS_MAYBE ", theta_r: " HTS_MAYBE \
    ", phi: " HTS_MAYBE ", phi_i: " HTS_ARRAY                                                   \
    " = 0.0, tolerance: float = 1e-6, degrees: bool = False, out: "                             \
    "numpy.ndarray | None = None, *, incident: " HTS_MAYBE ", reflected: " HTS_MAYBE            \
    ", " HTS_OF_SURFACE HTS_HOW last ") -> typing.Any"
#define HTS_LIGHT(name)                                                                             \
    "def " name "(self, wavelength: " HTS_ARRAY ", theta_i: " HTS_MAYBE ", phi_i: " HTS_ARRAY       \
    " = 0.0, tolerance: float = 1e-6, degrees: bool = False, out: numpy.ndarray | None = None, *, " \
    "incident: " HTS_MAYBE ", " HTS_OF_SURFACE HTS_HOW ") -> typing.Any"

constexpr const char* arguments_doc = R"(

wavelength         in vacuum [um]
theta_i, theta_r   polar angles of light and view from the normal [rad], 0 ... pi/2; in degrees with
                   degrees=True
phi, phi_i         azimuth of the view less that of the light, and of the light [rad]
incident,reflected unit vectors (..., 3) away from the surface, instead of angles
tolerance          relative error of rough surfaces, 1e-12 ... 1
out                array of float64 for the result
rms_roughness_um, correlation_length_um, n, k, diffuse_albedo   go before the material's, element by element
outside            "error", "hold" or "zero", where the material is not known at a wavelength or, of
                   measured data, at a pair of directions
threads            0 ... 1024; 0: all cores; one in a process that was forked
All arguments broadcast; the result has their common shape, a float where all are numbers.)";

#define HTS_SURFACE                                                                          \
    nb::arg("rms_roughness_um") = nb::none(), nb::arg("correlation_length_um") = nb::none(), \
    nb::arg("n") = nb::none(), nb::arg("k") = nb::none(), nb::arg("diffuse_albedo") = nb::none()

void bind_material(nb::module_& module) {
    module.attr("_version") = HTS_VERSION;

    nb::class_<PyMaterial> material{module, "Material"};
    material.def("__init__", &construct, nb::arg("source") = nb::none(), nb::arg("keywords"),
                 nb::sig("def __init__(self, source: typing.Any = None, **keywords: typing.Any) -> None"));
    material.def("__repr__", &repr);
    material.def(
        "_transmits",
        [](const PyMaterial& self, double wavelength, const std::string& outside) {
            return self.at(wavelength, how_from(accuracy::default_tolerance, outside, false)).transmits(0);
        },
        nb::arg("wavelength"), nb::arg("outside"));
    material.def_prop_ro("name", [](const PyMaterial& self) { return self.material().name(); });
    material.def_prop_ro(
        "model", [](const PyMaterial& self) { return self.material().model_name(); },
        "Name of the model as material files have it.");
    material.def_prop_ro(
        "source", [](const PyMaterial& self) { return self.material().model_source(); },
        "The paper of the model, or the format of a measured file.");
    material.def_prop_ro(
        "warnings", [](const PyMaterial& self) { return self.material().warnings(); },
        "What the description says that the model cannot be.");
    material.def_prop_ro(
        "description", [](const PyMaterial& self) { return self.description(); },
        "JSON of the material file; empty where there is none. An index that is a function is named as "
        "such.");
    material.def_prop_ro("_index", [](const PyMaterial& self) {
        return self.index().is_valid() ? self.index() : nb::object{nb::none()};
    });
    material.def_prop_ro("_folder", [](const PyMaterial& self) { return self.folder(); });

    const auto pair_call = [&](const char* name, auto function, auto signature, const char* what,
                               const auto&... more) {
        material.def(name, function, signature, (std::string{what} + arguments_doc).c_str(),
                     nb::arg("wavelength").none(), nb::arg("theta_i") = nb::none(),
                     nb::arg("theta_r") = nb::none(), nb::arg("phi") = nb::none(),
                     nb::arg("phi_i").none() = 0.0, nb::arg("tolerance") = accuracy::default_tolerance,
                     nb::arg("degrees") = false, nb::arg("out") = nb::none(), nb::kw_only(),
                     nb::arg("incident") = nb::none(), nb::arg("reflected") = nb::none(), HTS_SURFACE,
                     nb::arg("outside") = "error", nb::arg("compensate_energy") = false,
                     nb::arg("threads") = 0, more...);
    };
    pair_call("brdf", &of_pair<quantity::brdf>, nb::sig(HTS_PAIR("brdf", "")),
              "BRDF of all diffuse terms, unpolarised [1/sr] [He91 (5)].");
    pair_call("directional_diffuse", &of_pair<quantity::directional_diffuse>,
              nb::sig(HTS_PAIR("directional_diffuse", "")),
              "Its part that depends on direction, the lobe [1/sr].");
    pair_call("pdf", &of_pair<quantity::pdf>, nb::sig(HTS_PAIR("pdf", "")),
              "Density with which `sample` draws the view [1/sr]; error 5e-12, relative.");
    pair_call(
        "mueller", &mueller_of_pair, nb::sig(HTS_PAIR("mueller", ", terms: str = 'directional_diffuse'")),
        "Mueller matrix (..., 4, 4) of the directional-diffuse term [1/sr], as `hts eval --mueller` prints "
        "it; of all diffuse terms with terms=\"diffuse\". Frames and Stokes vectors: hts/polarisation.hpp.",
        nb::arg("terms") = "directional_diffuse");
    const auto light_call = [&](const char* name, auto function, auto signature, const char* what) {
        material.def(name, function, signature, (std::string{what} + arguments_doc).c_str(),
                     nb::arg("wavelength").none(), nb::arg("theta_i") = nb::none(),
                     nb::arg("phi_i").none() = 0.0, nb::arg("tolerance") = accuracy::default_tolerance,
                     nb::arg("degrees") = false, nb::arg("out") = nb::none(), nb::kw_only(),
                     nb::arg("incident") = nb::none(), HTS_SURFACE, nb::arg("outside") = "error",
                     nb::arg("compensate_energy") = false, nb::arg("threads") = 0);
    };
    light_call("specular_reflectance", &of_light<quantity::specular_reflectance>,
               nb::sig(HTS_LIGHT("specular_reflectance")),
               "Reflectance into the mirror direction [1] [He91 (6)].");
    light_call("specular_mueller", &of_light<quantity::specular_mueller>,
               nb::sig(HTS_LIGHT("specular_mueller")),
               "Mueller matrix (..., 4, 4) of the specular term [1].");
    light_call("albedo", &of_light<quantity::albedo>, nb::sig(HTS_LIGHT("albedo")),
               "Directional-hemispherical reflectance of all terms [1]; error 4e-8 of model he, else 1e-7, "
               "relative.");

    material.def("_polarised_albedo", &polarised_albedo,
                 HTS_ANY("_polarised_albedo(self, wavelength: typing.Any, theta: typing.Any, phi: "
                         "typing.Any, s: bool, degrees: bool, outside: str)"),
                 nb::arg("wavelength"), nb::arg("theta"), nb::arg("phi"), nb::arg("s"), nb::arg("degrees"),
                 nb::arg("outside"));
    bind_sampling(module, material);
    material.def(
        "gradient", &gradient,
        nb::sig("def gradient(self, wavelength: " HTS_ARRAY ", theta_i: " HTS_ARRAY ", theta_r: " HTS_MAYBE
                ", phi: " HTS_MAYBE ", phi_i: " HTS_ARRAY " = 0.0, of: str = 'brdf', degrees: bool = False, "
                "*, " HTS_OF_SURFACE ", outside: str = 'error', threads: int = 0) -> dict[str, typing.Any]"),
        R"(Derivatives by every parameter of model he, a dict of arrays by name.

of      "brdf", "mueller" (of the lobe) or "specular" (by theta_i alone, the mirror direction turns along)
by      rms_roughness_um, correlation_length_um [1/um], n, k, diffuse_albedo [1], theta_i, theta_r, phi
        [1/rad, or 1/deg]; of two correlation lengths correlation_length_x_um, correlation_length_y_um [1/um]
        and azimuth [1/rad, or 1/deg]; n and k of the substrate, and of each film films/0/n, films/0/k [1],
        films/0/thickness_um [1/um], outermost first
error   2e-10 of brdf and mueller, 4e-12 of specular, on the scales of hts/he_torrance_gradient.hpp; 1e-4 of
        other correlations than the Gaussian, whose length is varied with the shape kept)",
        nb::arg("wavelength"), nb::arg("theta_i"), nb::arg("theta_r") = nb::none(),
        nb::arg("phi") = nb::none(), nb::arg("phi_i") = 0.0, nb::arg("of") = "brdf",
        nb::arg("degrees") = false, nb::kw_only(), HTS_SURFACE, nb::arg("outside") = "error",
        nb::arg("threads") = 0);
    material.def("_validity", &validity,
                 HTS_ANY("_validity(self, wavelength: typing.Any, theta_i: typing.Any, theta_r: typing.Any, "
                         "phi: typing.Any, phi_i: typing.Any, degrees: bool)"),
                 nb::arg("wavelength"), nb::arg("theta_i"), nb::arg("theta_r"), nb::arg("phi"),
                 nb::arg("phi_i"), nb::arg("degrees"));
    material.def(
        "_hemispherical_reflectance",
        [](const PyMaterial& self, double wavelength, const std::string& outside) {
            const auto of = self.at(wavelength, how_from(accuracy::default_tolerance, outside, false));
            const nb::gil_scoped_release others_may_run;
            return spectral::bihemispherical_reflectance(of, 0).total();
        },
        nb::arg("wavelength"), nb::arg("outside"));
}

}  // namespace hts::python

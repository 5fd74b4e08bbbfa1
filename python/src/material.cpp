// hts.Material: files and descriptions, and every call that evaluates.
#include "module.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <tuple>

#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "evaluation.hpp"
#include "hts/error.hpp"
#include "hts/he_torrance_gradient.hpp"
#include "hts/version.hpp"
#include "spectral/energy/validity.hpp"
#include "spectral/models/he_torrance_material.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/measured_model.hpp"

namespace hts::python {
namespace {

using spectral::OutsideRange;
using spectral::Reflectance;
using Pairs = std::span<const DirectionPair>;
using Values = std::span<double>;

// ------------------------------------------------------------------------------------------------ what can be asked

/// f of each pair into values.size()/pairs.size() places.
template <class Function>
auto pair_by_pair(Function f) {
    return [f](const Reflectance& of, Pairs pairs, Values values) {
        const std::size_t each = values.size() / pairs.size();
        for (std::size_t i = 0; i < pairs.size(); ++i) f(of, pairs[i], values.subspan(i * each, each));
    };
}

/// The same for Mueller matrices.
template <class Function>
auto matrix_by_matrix(Function f) {
    return pair_by_pair([f](const Reflectance& of, const DirectionPair& pair, Values values) {
        thread_local std::vector<Mueller> matrices;
        matrices.resize(of.size());
        f(of, pair, std::span{matrices});
        for (std::size_t i = 0; i < matrices.size(); ++i)
            std::ranges::copy(matrices[i].elements(), values.begin() + static_cast<std::ptrdiff_t>(16 * i));
    });
}

const Quantity brdf{
    "brdf",
    {},
    true,
    false,
    [](const Reflectance& of, Pairs pairs, Values values) { of.evaluator().brdf_batch(pairs, values); },
    {}};
const Quantity directional_diffuse{"directional_diffuse",
                                   {},
                                   true,
                                   false,
                                   pair_by_pair([](const Reflectance& of, const DirectionPair& pair,
                                                   Values values) { of.directional_diffuse(pair, values); }),
                                   {}};
const Quantity specular_reflectance{
    "specular_reflectance",
    {},
    false,
    false,
    pair_by_pair([](const Reflectance& of, const DirectionPair& pair, Values values) {
        of.specular_reflectance(pair.in, values);
    }),
    {}};
const Quantity mueller{
    "mueller",
    {4, 4},
    true,
    false,
    matrix_by_matrix([](const Reflectance& of, const DirectionPair& pair, std::span<Mueller> all) {
        of.directional_diffuse_mueller(pair, all);
    }),
    {}};
const Quantity diffuse_mueller{"mueller",
                               {4, 4},
                               true,
                               false,
                               matrix_by_matrix([](const Reflectance& of, const DirectionPair& pair,
                                                   std::span<Mueller> all) { of.mueller(pair, all); }),
                               {}};
const Quantity specular_mueller{
    "specular_mueller",
    {4, 4},
    false,
    false,
    matrix_by_matrix([](const Reflectance& of, const DirectionPair& pair, std::span<Mueller> all) {
        of.specular_mueller(pair.in, all);
    }),
    {}};
const Quantity albedo{"albedo",
                      {},
                      false,
                      false,
                      pair_by_pair([](const Reflectance& of, const DirectionPair& pair, Values values) {
                          for (std::size_t i = 0; i < values.size(); ++i)
                              values[i] = of.albedo(pair.in, i).total();
                      }),
                      {}};
const Quantity pdf{"pdf", {}, true, true, {}, [](const spectral::Sampler& of, Pairs pairs, Values values) {
                       for (std::size_t i = 0; i < pairs.size(); ++i)
                           values[i] = of.pdf(pairs[i].in, pairs[i].out);
                   }};

// ------------------------------------------------------------------------------------------------ arguments

OutsideRange outside_from(const std::string& text) {
    return spectral::located("outside", [&] { return spectral::outside_range_named(text); });
}

How how_from(double tolerance, const std::string& outside, bool compensate_energy) {
    return {Tolerance{tolerance}.relative_error(), outside_from(outside), compensate_energy};
}

template <const Quantity& quantity>
nb::object of_pair(const PyMaterial& self, nb::handle wavelength, nb::handle theta_i, nb::handle theta_r,
                   nb::handle phi, nb::handle phi_i, double tolerance, bool degrees, nb::object out,
                   nb::handle incident, nb::handle reflected, nb::handle rms_roughness,
                   nb::handle correlation_length, nb::handle n, nb::handle k, nb::handle diffuse_albedo,
                   const std::string& outside, bool compensate_energy, int threads) {
    return evaluate(self, quantity,
                    {wavelength, theta_i, theta_r, phi, phi_i, incident, reflected, rms_roughness,
                     correlation_length, n, k, diffuse_albedo, degrees, threads},
                    how_from(tolerance, outside, compensate_energy), std::move(out));
}

template <const Quantity& quantity>
nb::object of_light(const PyMaterial& self, nb::handle wavelength, nb::handle theta_i, nb::handle phi_i,
                    double tolerance, bool degrees, nb::object out, nb::handle incident,
                    nb::handle rms_roughness, nb::handle correlation_length, nb::handle n, nb::handle k,
                    nb::handle diffuse_albedo, const std::string& outside, bool compensate_energy,
                    int threads) {
    return evaluate(self, quantity,
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
    return evaluate(self, terms == "diffuse" ? diffuse_mueller : mueller,
                    {wavelength, theta_i, theta_r, phi, phi_i, incident, reflected, rms_roughness,
                     correlation_length, n, k, diffuse_albedo, degrees, threads},
                    how_from(tolerance, outside, compensate_energy), std::move(out));
}

// ------------------------------------------------------------------------------------------------ sampling

/// (theta_r, phi_r, pdf, weight, lobe code) of `uniforms`, an array (…, 3), light broadcast with its leading axes.
nb::tuple sample(const PyMaterial& self, double wavelength, nb::handle theta_i, nb::handle phi_i,
                 nb::handle uniforms, bool degrees, double tolerance, const std::string& outside) {
    const Operand polar{"theta_i", theta_i}, azimuth{"phi_i", phi_i}, drawn{"uniforms", uniforms, 3};
    const Operand* const all[]{&polar, &azimuth, &drawn};
    const Broadcast broadcast{all};
    const auto sampler = self.sampler(wavelength, how_from(tolerance, outside, false));
    Result theta{broadcast.shape(), nb::none(), {}}, phi{broadcast.shape(), nb::none(), {}},
        density{broadcast.shape(), nb::none(), {}}, weight{broadcast.shape(), nb::none(), {}},
        lobe{broadcast.shape(), nb::none(), {}};
    const Walk walk{broadcast.shape(), std::vector<bool>(broadcast.shape().size(), true)};
    const Shape polar_steps = broadcast.steps(polar), azimuth_steps = broadcast.steps(azimuth),
                drawn_steps = broadcast.steps(drawn);
    const double unit = degrees ? 180 / std::numbers::pi : 1;
    {
        const nb::gil_scoped_release others_may_run;
        for (std::size_t i = 0; i < walk.size(); ++i) {
            const Direction in = direction(polar.data()[walk.offset(i, polar_steps)],
                                           azimuth.data()[walk.offset(i, azimuth_steps)], degrees);
            const double* u = drawn.data() + walk.offset(i, drawn_steps);
            const std::ptrdiff_t step = drawn.component_stride();
            const Draw draw = sampler.sample(in, {u[0], u[step], u[2 * step]});
            theta.data()[i] = std::atan2(draw.out.sin_theta(), draw.out.cos_theta()) * unit;
            phi.data()[i] = std::atan2(draw.out.sin_phi(), draw.out.cos_phi()) * unit;
            density.data()[i] = draw.pdf;
            weight.data()[i] = draw.weight;
            lobe.data()[i] = static_cast<double>(static_cast<int>(draw.lobe));
        }
    }
    return nb::make_tuple(theta.finish(), phi.finish(), density.finish(), weight.finish(), lobe.finish());
}

std::vector<std::string> lobe_names() {
    return {name(Lobe::none), name(Lobe::specular), name(Lobe::directional_diffuse),
            name(Lobe::uniform_diffuse)};
}

// ------------------------------------------------------------------------------------------------ derivatives

constexpr const char* parameters[]{
    "rms_roughness_um", "correlation_length_um", "n", "k", "diffuse_albedo", "theta_i", "theta_r", "phi"};

template <class Value>
std::array<Value, 8> in_order(const Gradient<Value>& by) {
    return {by.rms_roughness,
            by.correlation_length,
            by.n,
            by.k,
            by.diffuse_albedo,
            by.theta_i,
            by.theta_r,
            by.phi};
}

/// Directional-hemispherical reflectance of light polarised along s or p.
nb::object polarised_albedo(const PyMaterial& self, nb::handle wavelength, nb::handle theta, nb::handle phi,
                            bool s, bool degrees, const std::string& outside) {
    const Quantity quantity{
        "emissivity",
        {},
        false,
        false,
        pair_by_pair([s](const Reflectance& of, const DirectionPair& pair, Values values) {
            const Stokes light = s ? Stokes::s_polarised() : Stokes::p_polarised();
            for (std::size_t i = 0; i < values.size(); ++i) values[i] = of.albedo(pair.in, i, light).total();
        }),
        {}};
    return evaluate(self, quantity, {wavelength, theta, {}, {}, phi, {}, {}, {}, {}, {}, {}, {}, degrees},
                    how_from(accuracy::default_tolerance, outside, false), nb::none());
}

/// A quantity whose values are all derivatives, one after the other.
template <class OfPair>
Quantity derivatives(Shape trailing, bool views, OfPair of_pair) {
    return {"gradient",
            std::move(trailing),
            views,
            false,
            [of_pair](const Reflectance& of, Pairs pairs, Values out) {
                const auto& surface = of.properties().surface;
                double* to = out.data();
                for (const DirectionPair& pair : pairs) {
                    for (const SpectralSample& at : of.samples()) {
                        for (const auto& derivative : in_order(of_pair(*surface, pair, at))) {
                            if constexpr (std::is_same_v<decltype(derivative), const double&>) {
                                *to++ = derivative;
                            } else {
                                to = std::ranges::copy(derivative.elements(), to).out;
                            }
                        }
                    }
                }
            },
            {}};
}

Quantity derivatives_of(const std::string& of) {
    using Pair = DirectionPair;
    using At = SpectralSample;
    if (of == "brdf") {
        return derivatives({8}, true, [](const Surface& s, const Pair& d, const At& at) {
            return brdf_gradient({s, d.in, d.out}, at.wavelength, at.index, at.uniform_diffuse).by;
        });
    }
    if (of == "mueller") {
        return derivatives({8, 4, 4}, true, [](const Surface& s, const Pair& d, const At& at) {
            return directional_diffuse_mueller_gradient({s, d.in, d.out}, at.wavelength, at.index).by;
        });
    }
    if (of == "specular") {
        return derivatives({8}, false, [](const Surface& s, const Pair& d, const At& at) {
            return specular_reflectance_gradient(s, view_gradient(s, d.in), at.wavelength, at.index).by;
        });
    }
    throw Error{"of \"" + of + "\": must be \"brdf\", \"mueller\" or \"specular\""};
}

nb::dict gradient(const PyMaterial& self, nb::handle wavelength, nb::handle theta_i, nb::handle theta_r,
                  nb::handle phi, nb::handle phi_i, const std::string& of, bool degrees,
                  nb::handle rms_roughness, nb::handle correlation_length, nb::handle n, nb::handle k,
                  nb::handle diffuse_albedo, const std::string& outside, int threads) {
    if (self.material().model_name() != "he")
        throw Error{"gradient: derivatives are known of model he: this is " + self.material().model_name()};
    const Quantity quantity = derivatives_of(of);
    const bool views = quantity.views;
    const nb::object all = evaluate(self, quantity,
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
    // the mirror direction turns along with the light
    for (std::size_t p = 0; p < (views ? 8U : 6U); ++p) {
        nb::object values = moved[p];
        if (degrees && p >= 5) values = values * nb::float_(std::numbers::pi / 180);
        result[parameters[p]] = values;
    }
    return result;
}

// ------------------------------------------------------------------------------------------------ validity

/// Severity 0 … 2, least and most dB (NaN where unknown), for each element.
nb::object validity(const PyMaterial& self, nb::handle wavelength, nb::handle theta_i, nb::handle theta_r,
                    nb::handle phi, bool degrees, int what) {
    if (!self.material().properties().surface)
        throw Error{"validity: known of models of rough surfaces: this is " + self.material().model_name()};
    const Quantity quantity{
        "validity",
        {},
        true,
        false,
        pair_by_pair([what](const Reflectance& of, const DirectionPair& pair, Values values) {
            for (std::size_t i = 0; i < values.size(); ++i) {
                const auto verdict = spectral::validity(*of.properties().surface, pair, of.samples()[i]);
                const auto error = spectral::decibels(verdict.error);
                const double unknown = std::nan("");
                values[i] = what == 0   ? static_cast<double>(verdict.severity())
                            : what == 1 ? (error ? error->least : unknown)
                                        : (error ? error->most : unknown);
            }
        }),
        {}};
    return evaluate(self, quantity,
                    {wavelength, theta_i, theta_r, phi, nb::float_(0.0), {}, {}, {}, {}, {}, {}, {}, degrees},
                    how_from(1e-6, "error", false), nb::none());
}

// ------------------------------------------------------------------------------------------------ construction

/// From a file of any kind, a copy, or a description of Python made into JSON by hts/_description.py.
void construct(PyMaterial* self, nb::object source, nb::kwargs keywords) {
    if (nb::isinstance<PyMaterial>(source) && keywords.size() == 0) {
        new (self) PyMaterial{nb::cast<const PyMaterial&>(source)};
        return;
    }
    const nb::object arguments = nb::borrow(keywords);
    const auto [text, path, index] = nb::cast<std::tuple<std::string, std::string, nb::object>>(
        nb::module_::import_("hts._description").attr("described")(source, arguments));
    if (text.empty()) {
        new (self) PyMaterial{material_of_any_file(path)};
    } else {
        new (self) PyMaterial{spectral::material_from_text(text, path, tables::models_with_files()), text,
                              index.is_none() ? nb::object{} : index};
    }
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
theta_i, theta_r   polar angles of light and view from the normal [rad], 0 ... pi/2; in degrees with degrees=True
phi, phi_i         azimuth of the view less that of the light, and of the light [rad]
incident,reflected unit vectors (..., 3) away from the surface, instead of angles
tolerance          relative error of rough surfaces, 1e-12 ... 1
out                array of float64 for the result
rms_roughness_um, correlation_length_um, n, k, diffuse_albedo   go before the material's, element by element
outside            "error", "hold" or "zero", where the material is not known at a wavelength or, of
                   measured data, at a pair of directions
threads            0: all cores
All arguments broadcast; the result has their common shape, a float where all are numbers.)";

#define HTS_SURFACE                                                                          \
    nb::arg("rms_roughness_um") = nb::none(), nb::arg("correlation_length_um") = nb::none(), \
    nb::arg("n") = nb::none(), nb::arg("k") = nb::none(), nb::arg("diffuse_albedo") = nb::none()

void bind_material(nb::module_& module) {
    module.attr("_version") = HTS_VERSION;
    module.def("_lobe_names", &lobe_names);

    nb::class_<PyMaterial> material{module, "Material"};
    material.def("__init__", &construct, nb::arg("source") = nb::none(), nb::arg("keywords"),
                 nb::sig("def __init__(self, source: typing.Any = None, **keywords: typing.Any) -> None"));
    material.def("__repr__", &repr);
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
        "JSON of the material file; empty where there is none.");

    const auto pair_call = [&](const char* name, auto function, auto signature, const char* what) {
        material.def(name, function, signature, (std::string{what} + arguments_doc).c_str(),
                     nb::arg("wavelength").none(), nb::arg("theta_i") = nb::none(),
                     nb::arg("theta_r") = nb::none(), nb::arg("phi") = nb::none(),
                     nb::arg("phi_i").none() = 0.0, nb::arg("tolerance") = accuracy::default_tolerance,
                     nb::arg("degrees") = false, nb::arg("out") = nb::none(), nb::kw_only(),
                     nb::arg("incident") = nb::none(), nb::arg("reflected") = nb::none(), HTS_SURFACE,
                     nb::arg("outside") = "error", nb::arg("compensate_energy") = false,
                     nb::arg("threads") = 0);
    };
    pair_call("brdf", &of_pair<brdf>, nb::sig(HTS_PAIR("brdf", "")),
              "BRDF of all diffuse terms, unpolarised [1/sr] [He91 (5)].");
    pair_call("directional_diffuse", &of_pair<directional_diffuse>,
              nb::sig(HTS_PAIR("directional_diffuse", "")),
              "Its part that depends on direction, the lobe [1/sr].");
    pair_call("pdf", &of_pair<pdf>, nb::sig(HTS_PAIR("pdf", "")),
              "Density with which `sample` draws the view [1/sr]; error 5e-12, relative.");
    material.def(
        "mueller", &mueller_of_pair, nb::sig(HTS_PAIR("mueller", ", terms: str = 'directional_diffuse'")),
        (std::string{"Mueller matrix (..., 4, 4) of the directional-diffuse term [1/sr], as `hts eval "
                     "--mueller` prints it; of all diffuse terms with terms=\"diffuse\". Frames and Stokes "
                     "vectors: hts/polarisation.hpp."} +
         arguments_doc)
            .c_str(),
        nb::arg("wavelength").none(), nb::arg("theta_i") = nb::none(), nb::arg("theta_r") = nb::none(),
        nb::arg("phi") = nb::none(), nb::arg("phi_i").none() = 0.0,
        nb::arg("tolerance") = accuracy::default_tolerance, nb::arg("degrees") = false,
        nb::arg("out") = nb::none(), nb::kw_only(), nb::arg("incident") = nb::none(),
        nb::arg("reflected") = nb::none(), HTS_SURFACE, nb::arg("outside") = "error",
        nb::arg("compensate_energy") = false, nb::arg("threads") = 0,
        nb::arg("terms") = "directional_diffuse");
    const auto light_call = [&](const char* name, auto function, auto signature, const char* what) {
        material.def(name, function, signature, (std::string{what} + arguments_doc).c_str(),
                     nb::arg("wavelength").none(), nb::arg("theta_i") = nb::none(),
                     nb::arg("phi_i").none() = 0.0, nb::arg("tolerance") = accuracy::default_tolerance,
                     nb::arg("degrees") = false, nb::arg("out") = nb::none(), nb::kw_only(),
                     nb::arg("incident") = nb::none(), HTS_SURFACE, nb::arg("outside") = "error",
                     nb::arg("compensate_energy") = false, nb::arg("threads") = 0);
    };
    light_call("specular_reflectance", &of_light<specular_reflectance>,
               nb::sig(HTS_LIGHT("specular_reflectance")),
               "Reflectance into the mirror direction [1] [He91 (6)].");
    light_call("specular_mueller", &of_light<specular_mueller>, nb::sig(HTS_LIGHT("specular_mueller")),
               "Mueller matrix (..., 4, 4) of the specular term [1].");
    light_call("albedo", &of_light<albedo>, nb::sig(HTS_LIGHT("albedo")),
               "Directional-hemispherical reflectance of all terms [1]; error 4e-8 of model he, else 1e-7, "
               "relative.");

    material.def("_polarised_albedo", &polarised_albedo,
                 HTS_ANY("_polarised_albedo(self, wavelength: typing.Any, theta: typing.Any, phi: "
                         "typing.Any, s: bool, degrees: bool, outside: str)"),
                 nb::arg("wavelength"), nb::arg("theta"), nb::arg("phi"), nb::arg("s"), nb::arg("degrees"),
                 nb::arg("outside"));
    material.def("_sample", &sample,
                 HTS_ANY("_sample(self, wavelength: float, theta_i: typing.Any, phi_i: typing.Any, uniforms: "
                         "typing.Any, degrees: bool, tolerance: float, outside: str)"),
                 nb::arg("wavelength"), nb::arg("theta_i"), nb::arg("phi_i"), nb::arg("uniforms"),
                 nb::arg("degrees"), nb::arg("tolerance"), nb::arg("outside"));
    material.def(
        "gradient", &gradient,
        nb::sig("def gradient(self, wavelength: " HTS_ARRAY ", theta_i: " HTS_ARRAY ", theta_r: " HTS_MAYBE
                ", phi: " HTS_MAYBE ", phi_i: " HTS_ARRAY " = 0.0, of: str = 'brdf', degrees: bool = False, "
                "*, " HTS_OF_SURFACE ", outside: str = 'error', threads: int = 0) -> dict[str, typing.Any]"),
        R"(Derivatives by every parameter of model he, a dict of arrays by name.

of      "brdf", "mueller" (of the lobe) or "specular" (by theta_i alone, the mirror direction turns along)
by      rms_roughness_um, correlation_length_um [1/um], n, k, diffuse_albedo [1], theta_i, theta_r, phi [1/rad, or 1/deg]
error   2e-10 of brdf and mueller, 4e-12 of specular, on the scales of hts/he_torrance_gradient.hpp)",
        nb::arg("wavelength"), nb::arg("theta_i"), nb::arg("theta_r") = nb::none(),
        nb::arg("phi") = nb::none(), nb::arg("phi_i") = 0.0, nb::arg("of") = "brdf",
        nb::arg("degrees") = false, nb::kw_only(), HTS_SURFACE, nb::arg("outside") = "error",
        nb::arg("threads") = 0);
    material.def("_validity", &validity,
                 HTS_ANY("_validity(self, wavelength: typing.Any, theta_i: typing.Any, theta_r: typing.Any, "
                         "phi: typing.Any, degrees: bool, what: int)"),
                 nb::arg("wavelength"), nb::arg("theta_i"), nb::arg("theta_r"), nb::arg("phi"),
                 nb::arg("degrees"), nb::arg("what"));
}

}  // namespace hts::python

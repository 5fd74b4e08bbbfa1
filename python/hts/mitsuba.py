"""A BSDF of Mitsuba 3: the model of He, Torrance, Sillion and Greenberg in Dr.Jit arrays.

    import mitsuba as mi, hts
    mi.set_variant("llvm_ad_spectral")
    hts.mitsuba.register()
    mi.load_dict({"type": "hts", "rms_roughness_um": 0.28, "correlation_length_um": 1.77, "index": "Al"})

All variants that run on arrays of single precision: llvm_* and cuda_*, rgb, mono and spectral, polarised or not. Parameters, named
as in material files, and as `mi.traverse` shows them, all differentiable:

    rms_roughness_um, correlation_length_um   sigma_0 and tau [um], numbers
    n, k               refractive index: numbers, spectra or textures; or `index`, a name of hts.substances()
    diffuse_albedo     a: number, spectrum or texture, 0
    wavelength_um      rgb and mono variants: of each channel, where the roughness is seen and `index` is read;
                       (0.611, 0.549, 0.464), the dominant wavelengths of sRGB's primaries, or 0.55 [um]

Wavelengths of spectral variants are the renderer's. rgb variants evaluate the model at three wavelengths, not over bands.
eval returns f cos(theta) of both diffuse terms; the specular term is a lobe of type DeltaReflection. Light from below is not
reflected: `twosided` does that. Mueller matrices are in Mitsuba's frames. Components: 0 specular, 1 directional diffuse, 2 uniform
diffuse.
"""

from __future__ import annotations

import math
from typing import Any

from . import Error, Material, refractive_index

try:
    import drjit as dr
    import mitsuba as mi
except ImportError as error:
    raise Error(f"hts.mitsuba: Mitsuba 3 is not installed ({error}): pip install mitsuba") from None

from . import _phi_table

#: |plugin - exact|/(exact + 1e-3 peak) of f cos(theta), the peak that of all views of one incidence, up to 85 degrees and for
#: sigma_0/tau of 0.01 and more: worst and median. Rays of single precision do not resolve the lobe of a smoother surface so well.
ERROR_WORST = 1e-4
ERROR_MEDIAN = 4e-6

#: Of draws, for surfaces with sigma_0/tau up to 0.6 and incidence up to 85 degrees, where the largest seen was 8.2.
LARGEST_WEIGHT = 12.0

suspend_grad: Any = dr.suspend_grad  # which has no types

SRGB_WAVELENGTHS = (0.611, 0.549, 0.464)

_registered: set[str] = set()


def register() -> None:
    """Makes {"type": "hts"} known to the active variant of Mitsuba, and to those that are activated later."""
    mi.detail.add_variant_callback(_on_variant)
    variant = mi.variant()
    if variant is None:
        return
    if variant.startswith("scalar"):
        raise Error(f"hts.mitsuba: variant {variant}: must be one of llvm_* or cuda_*")
    _on_variant("", variant)


def _on_variant(_: str, variant: str | None) -> None:
    if variant is None or variant.startswith("scalar") or variant in _registered:
        return
    _registered.add(variant)
    bsdf = _bsdf_class()
    mi.register_bsdf("hts", lambda properties: bsdf(properties))


def _wavelengths(properties: Any) -> tuple[float, ...]:
    """Of the channels [um], none in spectral variants."""
    if mi.is_spectral:
        if "wavelength_um" in properties:
            raise Error("wavelength_um: spectral variants take the wavelengths of the renderer")
        return ()
    channels = 3 if mi.is_rgb else 1
    given = properties.get("wavelength_um", None)
    if given is None:
        return SRGB_WAVELENGTHS if mi.is_rgb else (0.55,)
    wavelengths = (given,) * channels if isinstance(given, (int, float)) else tuple(float(um) for um in given)
    if len(wavelengths) != channels or not all(0 < um < math.inf for um in wavelengths):
        raise Error(f"wavelength_um {given} um: must be {channels} positive number(s) or one")
    return wavelengths


def _index_textures(name: str, wavelengths: tuple[float, ...]) -> tuple[Any, Any]:
    """n and k of a substance as Mitsuba's own spectra."""
    first, last = 360, 830  # nm, all that Mitsuba samples
    grid = [nm / 1000 for nm in range(first, last + 1, 2)] if mi.is_spectral else list(wavelengths)
    values = refractive_index(name, grid)

    def texture(numbers: list[float]) -> Any:
        if mi.is_spectral:
            listed = ", ".join(repr(each) for each in numbers)
            return mi.load_dict({"type": "regular", "wavelength_min": first, "wavelength_max": last, "values": listed})
        if mi.is_rgb:
            return mi.load_dict({"type": "srgb", "color": mi.ScalarColor3d(numbers), "unbounded": True})
        return mi.load_dict({"type": "uniform", "value": numbers[0]})

    return texture([float(each.real) for each in values]), texture([float(each.imag) for each in values])


def _number(properties: Any, name: str) -> float:
    if name not in properties:
        raise Error(f"hts BSDF: {name} missing")
    value = properties[name]
    if not isinstance(value, (int, float)):
        raise Error(f"hts BSDF: {name}: must be a number, is {value!r}")
    return float(value)


def _is_number(properties: Any, name: str) -> bool:
    return name in properties and isinstance(properties[name], (int, float))


def _check(properties: Any) -> None:
    """As material files are checked, with their messages."""
    index: Any = properties.get("index", None)
    if index is None:
        index = {name: float(properties[name]) if _is_number(properties, name) else 1.0 for name in ("n", "k")}
        if "n" not in properties:
            raise Error("hts BSDF: n, or index, missing")
        if "k" not in properties:
            index["k"] = 0.0
    elif "n" in properties or "k" in properties:
        raise Error(f'hts BSDF: index "{index}": must not be given along with n and k')
    Material(
        model="he",
        name="hts BSDF",
        rms_roughness_um=_number(properties, "rms_roughness_um"),
        correlation_length_um=_number(properties, "correlation_length_um"),
        index=index,
        diffuse_albedo=float(properties["diffuse_albedo"]) if _is_number(properties, "diffuse_albedo") else 0.0,
    )


def _bsdf_class() -> Any:
    """The class for the active variant, whose types it is made of."""
    from ._drjit_polarisation import facet_mueller, mirror_mueller, uniform_mueller
    from ._drjit_sampler import Mixture
    from ._drjit_terms import Surface, fresnel

    specular_flags = mi.BSDFFlags.DeltaReflection | mi.BSDFFlags.FrontSide
    lobe_flags = mi.BSDFFlags.GlossyReflection | mi.BSDFFlags.FrontSide
    diffuse_flags = mi.BSDFFlags.DiffuseReflection | mi.BSDFFlags.FrontSide
    table = mi.Float(_phi_table.coefficients().ravel())
    dr.eval(table)

    class HeTorrance(mi.BSDF):  # type: ignore[misc]
        def __init__(self, properties: Any) -> None:
            mi.BSDF.__init__(self, properties)
            _check(properties)
            self.wavelengths = _wavelengths(properties)
            self.rms_roughness = mi.Float(_number(properties, "rms_roughness_um"))
            self.correlation_length = mi.Float(_number(properties, "correlation_length_um"))
            dr.make_opaque(self.rms_roughness, self.correlation_length)  # so that surfaces share their kernels
            name = properties.get("index", None)
            if name is None:
                self.n, self.k = (properties.get_unbounded_texture(each, 0.0) for each in ("n", "k"))
            else:
                self.n, self.k = _index_textures(str(name), self.wavelengths)
            self.diffuse_albedo = properties.get_texture("diffuse_albedo", 0.0)
            self.m_components = [specular_flags, lobe_flags, diffuse_flags]
            self.m_flags = specular_flags | lobe_flags | diffuse_flags

        def traverse(self, callback: Any) -> None:
            differentiable = mi.ParamFlags.Differentiable
            callback.put("rms_roughness_um", self.rms_roughness, differentiable)
            callback.put("correlation_length_um", self.correlation_length, differentiable)
            callback.put("n", self.n, differentiable)
            callback.put("k", self.k, differentiable)
            callback.put("diffuse_albedo", self.diffuse_albedo, differentiable)

        def surface(self) -> Surface:
            return Surface(self.rms_roughness, self.correlation_length, table)

        def channels(self, si: Any) -> list[Any]:
            """Wavelength of each channel [um]."""
            if mi.is_spectral:
                return [si.wavelengths[i] * 1e-3 for i in range(len(si.wavelengths))]
            return [mi.Float(um) for um in self.wavelengths]

        def shares(self, ctx: Any, si: Any, active: Any) -> tuple[Any, Any, Any, Any]:
            """Probabilities of the specular, directional-diffuse and uniform-diffuse lobes; what the specular one reflects."""
            c = dr.maximum(mi.Frame3f.cos_theta(si.wi), 1e-4)
            coherent = mi.UnpolarizedSpectrum(self.surface().coherent_fraction(c, self.channels(si)))
            amplitudes = fresnel(c, self.n.eval(si, active), self.k.eval(si, active))
            reflected = amplitudes.unpolarised
            enabled = [
                ctx.is_enabled(kind, i)
                for i, kind in enumerate(
                    (mi.BSDFFlags.DeltaReflection, mi.BSDFFlags.GlossyReflection, mi.BSDFFlags.DiffuseReflection)
                )
            ]
            with suspend_grad():
                specular = dr.mean(reflected * coherent) if enabled[0] else mi.Float(0)
                lobe = dr.mean(reflected * (1 - coherent)) + 1e-6 if enabled[1] else mi.Float(0)
                diffuse = dr.mean(self.diffuse_albedo.eval(si, active)) if enabled[2] else mi.Float(0)
                scale = dr.rcp(dr.maximum(specular + lobe + diffuse, 1e-20))
            return specular * scale, lobe * scale, diffuse * scale, (coherent, amplitudes)

        def value(self, ctx: Any, si: Any, wo: Any, active: Any) -> Any:
            """f cos(theta_r) of both diffuse terms."""
            cosine = mi.Frame3f.cos_theta(wo)
            active = active & (mi.Frame3f.cos_theta(si.wi) > 0) & (cosine > 0)
            result = mi.Spectrum(0.0)
            if ctx.is_enabled(mi.BSDFFlags.GlossyReflection, 1):
                lobe, cos_theta_d = self.surface().lobe_times_cosine(si.wi, wo, self.channels(si))
                amplitudes = fresnel(cos_theta_d, self.n.eval(si, active), self.k.eval(si, active))
                result = facet_mueller(ctx, si.wi, wo, mi.UnpolarizedSpectrum(lobe), amplitudes)
            if ctx.is_enabled(mi.BSDFFlags.DiffuseReflection, 2):
                albedo = self.diffuse_albedo.eval(si, active)
                result = result + uniform_mueller(albedo * (dr.maximum(cosine, 0.0) / math.pi))
            return result & active

        def density(self, si: Any, wo: Any, shares: Any, mixture: Mixture) -> Any:
            cosine = mi.Frame3f.cos_theta(wo)
            above = (mi.Frame3f.cos_theta(si.wi) > 0) & (cosine > 0)
            return dr.select(above, shares[1] * mixture.pdf(wo) + shares[2] * cosine / math.pi, 0.0)

        def eval(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
            return self.value(ctx, si, wo, active)

        def pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
            with suspend_grad():
                mixture = Mixture.around(self.surface(), si.wi, self.channels(si))
                return self.density(si, wo, self.shares(ctx, si, active), mixture) & active

        def eval_pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
            return self.value(ctx, si, wo, active), self.pdf(ctx, si, wo, active)

        def sample(self, ctx: Any, si: Any, sample1: Any, sample2: Any, active: Any = True) -> Any:
            active = active & (mi.Frame3f.cos_theta(si.wi) > 0)
            shares = self.shares(ctx, si, active)
            to_specular, to_lobe, to_diffuse, mirror = shares
            specular = sample1 < to_specular
            diffuse = ~specular & (sample1 >= to_specular + to_lobe) & (to_diffuse > 0)
            with suspend_grad():
                mixture = Mixture.around(self.surface(), si.wi, self.channels(si))
                rest = (sample1 - to_specular) / dr.maximum(to_lobe, 1e-20)
                drawn = mixture.draw(dr.clip(rest, 0.0, 1 - 1e-7), sample2)
                drawn = dr.select(diffuse, mi.warp.square_to_cosine_hemisphere(sample2), drawn)
                bs: Any = dr.zeros(mi.BSDFSample3f)
                bs.wo = dr.select(specular, mi.Vector3f(-si.wi.x, -si.wi.y, si.wi.z), drawn)
                bs.pdf = dr.select(specular, to_specular, self.density(si, bs.wo, shares, mixture))
                bs.eta = 1.0
                kinds = (mi.BSDFFlags.DeltaReflection, mi.BSDFFlags.GlossyReflection, mi.BSDFFlags.DiffuseReflection)
                bs.sampled_type = dr.select(
                    specular, mi.UInt32(kinds[0]), dr.select(diffuse, mi.UInt32(kinds[2]), mi.UInt32(kinds[1]))
                )
                bs.sampled_component = dr.select(
                    specular, mi.UInt32(0), dr.select(diffuse, mi.UInt32(2), mi.UInt32(1))
                )
                active = active & (bs.pdf > 0) & (mi.Frame3f.cos_theta(bs.wo) > 0)
            reflected = dr.select(specular, mirror_mueller(ctx, si.wi, *mirror), self.value(ctx, si, bs.wo, active))
            return bs, (reflected * dr.rcp(dr.maximum(bs.pdf, 1e-30))) & active

        def to_string(self) -> str:
            return (
                f"HeTorrance[rms_roughness_um = {self.rms_roughness}, correlation_length_um = {self.correlation_length},"
                f" n = {self.n}, k = {self.k}, diffuse_albedo = {self.diffuse_albedo}]"
            )

    return HeTorrance

"""The terms of the model, hts/terms.hpp, as functions of Dr.Jit arrays of the active variant of Mitsuba: single precision,
differentiable, without a branch. Spectra are lists of a Float for each channel."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import drjit as dr
import mitsuba as mi

from . import _phi_table

_LEAST = 1e-30  # in front of logarithms and below fractions


@dataclass(frozen=True)
class Visibility:
    """What a surface lets a direction see [hts/shadowing.hpp]."""

    obstruction: Any  # K
    shadowing: Any  # S_1
    shadowing_over_cosine: Any


def visibility(slope_width: Any, cos_theta: Any) -> Visibility:
    """slope_width is 2 sigma_0/tau; obstruction [He91 (82)], shadowing [He91 (24), (25)]."""
    sine = dr.sqrt(dr.maximum(dr.fma(-cos_theta, cos_theta, 1.0), 1e-14))
    width_sine = slope_width * sine
    c = dr.minimum(cos_theta / dr.maximum(width_sine, 1e-12), 27.0)
    complement = 1 - dr.erf(c)
    ierfc = dr.maximum(dr.exp(-c * c) / math.sqrt(math.pi) - c * complement, 0.0)
    quotient = (1 - complement / 2) / dr.fma(width_sine / 2, ierfc, dr.maximum(cos_theta, 1e-7))
    return Visibility(sine / dr.maximum(cos_theta, 1e-7) * complement, cos_theta * quotient, quotient)


def effective_roughness_ratio_squared(obstruction: Any) -> Any:
    """(sigma/sigma_0)^2 = 1/(1 + W0(K^2/8 pi)), closed form of [He91 (80), (81)]. W0 by [Winitzki03]'s approximation and
    Newton's method in ln W; the last step alone is differentiated, and gives W's derivative as it is."""
    x = dr.clip(obstruction * obstruction / (8 * math.pi), 1e-6, 1e12)
    fixed = dr.detach(x)
    l = dr.log(1 + fixed)
    w = l * (1 - dr.log(1 + l) / (2 + l))
    w = w * (1 + dr.log(fixed / w)) / (1 + w)
    w = w * (1 + dr.log(x / w)) / (1 + w)
    return dr.rcp(1 + w)


def _place(x: Any, first: float, last: float, cells: int) -> tuple[Any, Any]:
    scaled = dr.clip((x - first) * (cells / (last - first)), 0.0, float(cells))
    cell = dr.minimum(mi.UInt32(dr.detach(scaled)), cells - 1)
    return cell, scaled - mi.Float(cell)


def phi(table: Any, log_g: Any, g: Any, t: Any) -> Any:
    """Phi(g, t) from the coefficients of _phi_table, four gathers of four."""
    i, y = _place(log_g, _phi_table.LOG_G_FIRST, _phi_table.LOG_G_LAST, _phi_table.LOG_G_CELLS)
    scale = dr.rcp(1 + g)
    j, q = _place(dr.log(dr.fma(t, scale, 1.0)), 0.0, _phi_table.Q_LAST, _phi_table.Q_CELLS)
    cell = (i * _phi_table.Q_CELLS + j) * 4
    r = mi.Float(0)
    for power in reversed(range(4)):
        c = dr.gather(mi.Vector4f, table, cell + power)
        r = dr.fma(r, y, dr.fma(dr.fma(dr.fma(c[3], q, c[2]), q, c[1]), q, c[0]))
    return g * scale * scale * dr.exp(r)


@dataclass(frozen=True)
class Fresnel:
    """|F_s|^2, |F_p|^2 and F_s F_p* [hts/fresnel.hpp]."""

    s: Any
    p: Any
    real: Any
    imaginary: Any

    @property
    def unpolarised(self) -> Any:
        return (self.s + self.p) / 2


def fresnel(c: Any, n: Any, k: Any) -> Fresnel:
    """Reflection by an index n + ik at incidence of cosine c; r = sqrt(N^2 - sin^2) = a + ib in a form that does not cancel."""
    er, ei = (n - k) * (n + k), 2 * n * k
    d = er - (1 - c) * (1 + c)
    large = dr.sqrt((dr.sqrt(dr.maximum(d * d + ei * ei, _LEAST)) + dr.abs(d)) / 2)
    small = ei / (2 * large)
    a, b = dr.select(d > 0, large, small), dr.select(d > 0, small, large)
    # F_s = (c - r)/(c + r), F_p = (N^2 c - r)/(N^2 c + r)
    s_re, s_im = c - a, -b
    s_below_re, s_below_im = c + a, b
    p_re, p_im = er * c - a, ei * c - b
    p_below_re, p_below_im = er * c + a, ei * c + b
    s_scale = dr.rcp(dr.maximum(s_below_re * s_below_re + s_below_im * s_below_im, _LEAST))
    p_scale = dr.rcp(dr.maximum(p_below_re * p_below_re + p_below_im * p_below_im, _LEAST))
    fs_re, fs_im = _quotient(s_re, s_im, s_below_re, s_below_im, s_scale)
    fp_re, fp_im = _quotient(p_re, p_im, p_below_re, p_below_im, p_scale)
    return Fresnel(
        fs_re * fs_re + fs_im * fs_im,
        fp_re * fp_re + fp_im * fp_im,
        fs_re * fp_re + fs_im * fp_im,
        fs_im * fp_re - fs_re * fp_im,
    )


def _quotient(re: Any, im: Any, below_re: Any, below_im: Any, scale: Any) -> tuple[Any, Any]:
    return (re * below_re + im * below_im) * scale, (im * below_re - re * below_im) * scale


@dataclass(frozen=True)
class Surface:
    """sigma_0 and tau [um] with the table of Phi."""

    rms_roughness: Any
    correlation_length: Any
    table: Any

    @property
    def slope_width(self) -> Any:
        return 2 * self.rms_roughness / self.correlation_length

    def phase_variance(self, obstruction: Any, vertical: Any) -> Any:
        """g lambda^2 [um^2], of the cosines' sum [He91 (79)]."""
        roughness = 2 * math.pi * self.rms_roughness * vertical
        return roughness * roughness * effective_roughness_ratio_squared(obstruction)

    def lobe_times_cosine(self, incident: Any, reflected: Any, wavelengths: Any) -> tuple[list[Any], Any]:
        """The directional-diffuse lobe for |F|^2 = 1 times cos theta_r [1/sr], a channel after the other, and
        cos theta_d [He91 (71), (76), (78)]."""
        ci, cr = mi.Frame3f.cos_theta(incident), mi.Frame3f.cos_theta(reflected)
        light, eye = visibility(self.slope_width, ci), visibility(self.slope_width, cr)
        v = incident + reflected
        squared, vertical = dr.maximum(dr.squared_norm(v), 1e-12), dr.maximum(v.z, 1e-7)
        g1 = self.phase_variance(light.obstruction + eye.obstruction, vertical)
        across = math.pi * self.correlation_length
        t1 = across * across * (v.x * v.x + v.y * v.y)
        log_g1 = dr.log(dr.maximum(g1, _LEAST))
        root = squared / vertical * self.correlation_length
        common = math.pi / 4 * root * root * light.shadowing_over_cosine * eye.shadowing
        lobe = []
        for wavelength in wavelengths:
            scale = dr.rcp(wavelength * wavelength)
            value = phi(self.table, log_g1 + dr.log(scale), g1 * scale, t1 * scale)
            lobe.append(common * scale * value)
        return lobe, dr.minimum(dr.sqrt(squared) / 2, 1.0)

    def coherent_fraction(self, cos_theta: Any, wavelengths: Any) -> list[Any]:
        """exp(-g) S in the mirror direction [He91 (73)]."""
        seen = visibility(self.slope_width, cos_theta)
        g1 = self.phase_variance(2 * seen.obstruction, 2 * cos_theta)
        return [dr.exp(-g1 / (wavelength * wavelength)) * seen.shadowing * seen.shadowing for wavelength in wavelengths]

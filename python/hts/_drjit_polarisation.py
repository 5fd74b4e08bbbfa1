"""Reflectances as Mitsuba's spectra: numbers, or in polarised variants Mueller matrices in Mitsuba's frames.

A facet is diag(F_s, F_p) in the plane of both rays, and its Mueller matrix is turned from that plane's frame to the frames of the
rays, as Mitsuba's own conductors do; light arrives along -wo where radiance is traced, along -wi where importance is.
"""

from __future__ import annotations

from typing import Any

import drjit as dr
import mitsuba as mi

from ._drjit_terms import Fresnel


def facet_mueller(ctx: Any, wi: Any, wo: Any, scale: Any, f: Fresnel) -> Any:
    """Of the facet that mirrors one into the other."""
    if not mi.is_polarized:
        return scale * f.unpolarised
    to_light, to_eye = (wo, wi) if ctx.mode == mi.TransportMode.Radiance else (wi, wo)
    facet = dr.normalize(to_light + to_eye)
    normal = dr.cross(facet, to_eye)
    backscatter = dr.squared_norm(normal) < 1e-10
    axis = dr.normalize(dr.select(backscatter, mi.coordinate_system(facet)[0], normal))
    zero = mi.UnpolarizedSpectrum(0.0)
    mean, half = scale * f.unpolarised, scale * (f.s - f.p) / 2
    real, imaginary = scale * f.real, scale * f.imaginary
    matrix = mi.Spectrum(
        mean, half, zero, zero, half, mean, zero, zero, zero, zero, real, -imaginary, zero, zero, imaginary, real
    )  # fmt: skip
    basis = mi.mueller.stokes_basis
    return mi.mueller.rotate_mueller_basis(
        matrix, -to_light, axis, basis(-to_light), to_eye, axis, basis(to_eye)
    )


def mirror_mueller(ctx: Any, wi: Any, scale: Any, f: Fresnel) -> Any:
    """Of the surface itself."""
    return facet_mueller(ctx, wi, mi.Vector3f(-wi.x, -wi.y, wi.z), scale, f)


def uniform_mueller(value: Any) -> Any:
    """Of what leaves unpolarised."""
    return mi.mueller.depolarizer(value) if mi.is_polarized else value

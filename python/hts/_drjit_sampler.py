"""How the Mitsuba plugin draws directions: from a mixture of densities that are normalised in closed form, so that the density
returned is that of the draw, as in hts/he_torrance.hpp but with parameters by formulas instead of a fit.

In the frame where the known direction is (s, 0, c), with q = v_xy/v_z the slopes of the facet that mirrors it into the drawn one:

    facets    exp(-q^2/alpha^2)/(pi alpha^2) B(q),  B = 1 + q_x s/c within 0 ... 2, 2 where -q mirrors to below the horizon
    grazing   2 q_x exp(-q^2/alpha^2)/(sqrt(pi) alpha^3), q_x > 0
    cosine    cos theta/pi, for the uniform-diffuse lobe too

alpha^2 = 4 m/(tau v_z)^2 follows the mean m of Phi's Poisson sum in the mirror direction. Facets come in two widths: that of the
channel with the least, and twice the alpha^2 of the channel with the largest, of the roughness that a view along the normal sees.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import drjit as dr
import mitsuba as mi

from ._drjit_terms import Surface, visibility

_LARGEST_WIDTH = 4.0  # of alpha^2; wider facets mirror to below the horizon
_WIDE_SHARE = 0.35


def _slope_variance(surface: Surface, cos_theta: Any, obstruction: Any, wavelength: Any) -> Any:
    """alpha^2 of the lobe."""
    g = surface.phase_variance(obstruction, 2 * cos_theta) / (wavelength * wavelength)
    mean = dr.select(g < 1e-3, 1 + g / 2, g / (1 - dr.exp(-dr.maximum(g, 1e-3))))  # of m, from 1
    beam = wavelength / (2 * math.pi * surface.correlation_length * dr.maximum(cos_theta, 1e-3))
    return dr.clip(mean * beam * beam, 1e-10, _LARGEST_WIDTH)


@dataclass(frozen=True)
class Mixture:
    """Densities around one known direction, and the shares of the directional-diffuse lobe."""

    direction: Any
    sine: Any
    cosine: Any
    azimuth: Any  # (cos, sin) of the known direction
    widths: Any  # alpha^2, narrow and wide
    grazing: Any  # share of grazing facets among facets, of each width
    cosine_share: Any

    @staticmethod
    def around(surface: Surface, direction: Any, wavelengths: Any) -> Mixture:
        c = dr.clip(mi.Frame3f.cos_theta(direction), 1e-4, 1.0)
        s = dr.sqrt(dr.maximum(1 - c * c, 0.0))
        flat = s < 1e-6
        scale = dr.select(flat, 1.0, dr.rcp(dr.maximum(s, 1e-6)))
        azimuth = (dr.select(flat, 1.0, direction.x * scale), dr.select(flat, 0.0, direction.y * scale))
        obstruction = visibility(surface.slope_width, c).obstruction
        narrow, wide = mi.Float(_LARGEST_WIDTH), mi.Float(0)
        for wavelength in wavelengths:
            narrow = dr.minimum(narrow, _slope_variance(surface, c, 2 * obstruction, wavelength))
            wide = dr.maximum(wide, _slope_variance(surface, c, obstruction, wavelength))
        widths = (narrow, dr.minimum(2 * wide, _LARGEST_WIDTH))
        grazing = []
        for width in widths:
            raised = dr.sqrt(width) * s / c / (2 * math.sqrt(math.pi))
            part = raised * raised / (0.5 + raised)
            grazing.append(part / (1 + part))
        return Mixture(direction, s, c, azimuth, widths, tuple(grazing), 0.05 + 0.6 * narrow / (1 + narrow))

    def _height(self, qx: Any, squared: Any) -> Any:
        """cos theta of the direction into which the facet of slopes q mirrors."""
        return 2 * (self.sine * qx + self.cosine) / (1 + squared) - self.cosine

    def _bracket(self, qx: Any, squared: Any) -> Any:
        """B; B(q) + B(-q) = 2."""
        up, other = self._height(qx, squared) > 0, self._height(-qx, squared) > 0
        tilted = dr.clip(1 + qx * self.sine / self.cosine, 0.0, 2.0)
        return dr.select(up == other, tilted, dr.select(up, 2.0, 0.0))

    def pdf(self, drawn: Any) -> Any:
        """Of the directional-diffuse lobe [1/sr]; `drawn` above the horizon."""
        v = self.direction + drawn
        vertical = dr.maximum(v.z, 1e-7)
        x, y = v.x / vertical, v.y / vertical
        qx, squared = x * self.azimuth[0] + y * self.azimuth[1], x * x + y * y
        bracket = self._bracket(qx, squared)
        density = mi.Float(0)
        for width, grazing, share in zip(self.widths, self.grazing, (1 - _WIDE_SHARE, _WIDE_SHARE)):
            raised = 2 * math.sqrt(math.pi) * dr.maximum(qx, 0.0) * dr.rsqrt(width)
            gaussian = dr.exp(-squared / width) / (math.pi * width)
            density += share * gaussian * dr.lerp(bracket, raised, grazing)
        # d q/d omega = 1/(4 (h . direction) h_z^3), h the bisector
        length_squared = dr.maximum(dr.squared_norm(v), 1e-12)
        jacobian = length_squared / (2 * vertical * vertical * vertical)
        return dr.lerp(density * jacobian, drawn.z / math.pi, self.cosine_share)

    def draw(self, u: Any, plane: Any) -> Any:
        """A direction in proportion to `pdf`, which may be below the horizon; u chooses, plane is a pair."""
        cosine = u < self.cosine_share
        u = (u - self.cosine_share) / (1 - self.cosine_share)
        wide = u < _WIDE_SHARE
        u = dr.select(wide, u / _WIDE_SHARE, (u - _WIDE_SHARE) / (1 - _WIDE_SHARE))
        grazing_share = dr.select(wide, self.grazing[1], self.grazing[0])
        grazing = u < grazing_share
        u = (u - grazing_share) / (1 - grazing_share)
        alpha = dr.sqrt(dr.select(wide, self.widths[1], self.widths[0]))
        radius = alpha * dr.sqrt(-dr.log(1 - plane.x))
        sin_phi, cos_phi = dr.sincos(2 * math.pi * plane.y)
        across = alpha * dr.erfinv(dr.clip(2 * plane.y - 1, -1 + 1e-7, 1 - 1e-7))
        qx, qy = dr.select(grazing, radius, radius * cos_phi), dr.select(grazing, across, radius * sin_phi)
        turn = ~grazing & (2 * u >= self._bracket(qx, qx * qx + qy * qy))
        qx, qy = dr.select(turn, -qx, qx), dr.select(turn, -qy, qy)
        hx = qx * self.azimuth[0] - qy * self.azimuth[1]
        hy = qx * self.azimuth[1] + qy * self.azimuth[0]
        facet = dr.normalize(mi.Vector3f(hx, hy, 1.0))
        mirrored = 2 * dr.dot(self.direction, facet) * facet - self.direction
        return dr.select(cosine, mi.warp.square_to_cosine_hemisphere(plane), mirrored)

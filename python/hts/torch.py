"""The model as functions of PyTorch, with derivatives; the numbers and derivatives are those of `Material`.

    import hts, torch
    sigma = torch.tensor(0.28, dtype=torch.float64, requires_grad=True)
    hts.torch.brdf(material, 0.5, 0.3, 0.4, 3.0, sigma).backward()        # sigma.grad, 1/(sr um)

Arguments broadcast and may be numbers; results have the type of the tensors among them, on their device. The calls run on the
CPU, in as many threads as there are cores. Derivatives of first order, by all arguments but the wavelength, of model he.
"""

from __future__ import annotations

from functools import reduce
from typing import Any

import numpy as np

from . import Error, Material
from ._differentiable import functions, method, names_of, numbers

try:
    import torch
except ImportError as error:
    raise Error(f"hts.torch: PyTorch is not installed ({error}): pip install torch") from None

def _call(of: str, material: Material, arguments: tuple[Any, ...], parameters: dict[str, Any]) -> Any:
    given = (*arguments, *parameters.values())
    tensors = [each for each in given if isinstance(each, torch.Tensor)]
    dtype, device = torch.get_default_dtype(), "cpu"
    if tensors:
        device = tensors[0].device
        floats = [each.dtype for each in tensors if each.dtype.is_floating_point]
        dtype = reduce(torch.promote_types, floats, floats[0]) if floats else dtype
    values = [torch.as_tensor(each, dtype=dtype, device=device) for each in given]
    return _Evaluated.apply(of, material, names_of(arguments, parameters), *torch.broadcast_tensors(*values))


class _Evaluated(torch.autograd.Function):  # type: ignore[misc, unused-ignore]
    @staticmethod
    def forward(ctx: Any, of: str, material: Material, names: tuple[str, ...], *values: Any) -> Any:
        ctx.of, ctx.material, ctx.names = of, material, names
        ctx.save_for_backward(*values)
        arrays, parameters = _arrays(names, values)
        found = np.asarray(method(material, of)(*arrays, **parameters))
        return torch.as_tensor(found, dtype=values[0].dtype, device=values[0].device)

    @staticmethod
    @torch.autograd.function.once_differentiable  # type: ignore[misc, unused-ignore]
    def backward(ctx: Any, above: Any) -> Any:
        if ctx.needs_input_grad[3]:
            raise Error("hts.torch: no derivative by wavelength")
        values = ctx.saved_tensors
        arrays, parameters = _arrays(ctx.names, values)
        gradient = ctx.material.gradient(*arrays, **{"of": ctx.of, **parameters})
        result: list[Any] = []
        for name, needed in zip(ctx.names, ctx.needs_input_grad[4:]):
            if not needed:
                result.append(None)
                continue
            slope = torch.as_tensor(np.asarray(gradient[name]), dtype=above.dtype, device=above.device)
            each = slope * above
            result.append(each.sum(dim=(-2, -1)) if ctx.of == "mueller" else each)
        return (None, None, None, None, *result)


def _arrays(names: tuple[str, ...], values: tuple[Any, ...]) -> tuple[list[Any], dict[str, Any]]:
    return numbers(names, [each.detach().cpu().numpy().astype(float) for each in values])


brdf, mueller, specular_reflectance = functions(_call)

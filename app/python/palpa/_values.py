"""Conversion of arguments: numbers and vectors that the user gives, and JSON texts."""

from __future__ import annotations

import json
from typing import Any, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._core import InputError

Floats = NDArray[np.float64]


def vectors(value: ArrayLike, name: str) -> Floats:
    """An array of shape (n, 3); one point of shape (3,) becomes (1, 3)."""
    try:
        array = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InputError(f"{name}: expected numbers ({error})") from None
    if array.ndim == 1:
        array = array[np.newaxis]
    if array.ndim != 2 or array.shape[1] != 3:
        raise InputError(
            f"{name}: expected coordinates x, y, z of one point or an array of shape (n, 3), "
            f"found the shape {np.shape(value)}"
        )
    return array


def vector(value: ArrayLike, name: str) -> Floats:
    """An array of shape (3,)."""
    array = vectors(value, name)
    if len(array) != 1:
        raise InputError(f"{name}: expected one vector x, y, z, found {len(array)}")
    return array.reshape(3)


def triple(value: ArrayLike, name: str) -> Tuple[float, float, float]:
    """Three floats, for the frozen classes of the parts of a project."""
    x, y, z = vector(value, name).tolist()
    return (x, y, z)


def _plain(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    raise TypeError(f"{type(value).__name__} has no JSON form")


def to_json(value: Any) -> str:
    """JSON text; floats keep their bits."""
    try:
        return json.dumps(value, default=_plain, allow_nan=False)
    except (TypeError, ValueError) as error:
        raise InputError(f"commands: {error}") from None

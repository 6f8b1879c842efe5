"""Files of batches: npz, HDF5 and CSV, with units in the names of the arrays and columns."""

from __future__ import annotations

import csv
from typing import Any, Dict, Iterator, Mapping, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._core import InputError

Arrays = Dict[str, NDArray[Any]]

# Units at the ends of names, before which the name of the component goes: force_x_N.
_UNITS = ("_N_per_mm", "_N", "_mm", "_MPa", "_mJ")


def save(path: str, arrays: Arrays, more: Mapping[str, ArrayLike], rows: int) -> None:
    """Writes arrays with one row per touch; the ending of the path chooses the format."""
    every = dict(arrays)
    for name, values in more.items():
        every[name] = np.asarray(values)
        if every[name].shape[:1] != (rows,):
            raise InputError(
                f"{name}: expected one row for each of the {rows} touches, found the shape "
                f"{every[name].shape}"
            )
    ending = path[path.rfind(".") :].lower()
    writers = {".npz": _save_npz, ".h5": _save_hdf5, ".hdf5": _save_hdf5, ".csv": _save_csv}
    if ending not in writers:
        raise InputError(f"{path}: expected a name that ends in .npz, .h5 or .csv")
    try:
        writers[ending](path, every)
    except OSError as error:
        raise InputError(f"{path}: cannot be written ({error.strerror}); check its folder") from error


def _save_npz(path: str, arrays: Arrays) -> None:
    np.savez_compressed(path, **arrays)


def _save_hdf5(path: str, arrays: Arrays) -> None:
    try:
        import h5py  # type: ignore[import]
    except ImportError:
        raise InputError(f"{path}: HDF5 needs h5py; install python3-h5py, or save as .npz") from None
    with h5py.File(path, "w") as file:
        for name, values in arrays.items():
            file[name] = values.astype("S") if values.dtype.kind == "U" else values


def _save_csv(path: str, arrays: Arrays) -> None:
    columns = [column for name, values in arrays.items() for column in _columns(name, values)]
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow([name for name, _ in columns])
        writer.writerows(zip(*[values.tolist() for _, values in columns]))


def _columns(name: str, values: NDArray[Any]) -> Iterator[Tuple[str, NDArray[Any]]]:
    """One column per number of a row."""
    if values.ndim == 1:
        yield name, values
        return
    unit = next((unit for unit in _UNITS if name.endswith(unit)), "")
    stem = name[: len(name) - len(unit)]
    for number, index in enumerate(np.ndindex(values.shape[1:])):
        parts = [str(each) for each in index]
        if values.shape[-1] == 3:
            parts[-1] = "xyz"[index[-1]]
        yield f"{stem}_{'_'.join(parts)}{unit}", values.reshape(len(values), -1)[:, number]

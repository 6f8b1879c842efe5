"""Many touches: force-depth curves, batches, sensors that read them."""

from __future__ import annotations

import os
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Callable, Dict, List, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, _tables
from ._state import State
from ._values import Floats

Path = Union[str, "os.PathLike[str]"]
Progress = Optional[Callable[[str, float], Any]]


@dataclass(frozen=True)
class Sweep:
    """Force-depth curves.

    shares: (n + 1,), 0 … 1, of the displacements and forces of the touches. forces: N,
    (n + 1, touches, 3). displacements: mm, the same shape. stiffness: N/mm, (n + 1, touches).
    energies: mJ, (n + 1,).
    """

    shares: Floats
    forces: Floats
    displacements: Floats
    stiffness: Floats
    energies: Floats


class Batch:
    """Results of touches one at a time: Model.touch_many(). n is the number of touches."""

    def __init__(self, core: _core.Batch, kind: str, given: Floats, radius: float) -> None:
        self._core = core
        self._kind = kind
        self._given = given
        self._radius = radius

    def __len__(self) -> int:
        return len(self._given)

    @property
    def kind(self) -> str:
        """Kind of the touches: "grab", "force", "push", "ball" or "pin"."""
        return self._kind

    @property
    def given(self) -> Floats:
        """The prescribed displacements (mm), or forces (N) for the kind "force", (n, 3)."""
        return self._given

    @property
    def radius(self) -> float:
        """Requested radius of the mask or ball, mm."""
        return self._radius

    @cached_property
    def at(self) -> Floats:
        """Places on the unloaded surface, mm, (n, 3); of pushes and balls where they have slid to."""
        return self._core.places()

    @cached_property
    def normals(self) -> Floats:
        """Outward unit normals at the places, (n, 3)."""
        return self._core.normals()

    @cached_property
    def forces(self) -> Floats:
        """Forces on the body, N, (n, 3)."""
        return self._core.forces()

    @cached_property
    def displacements(self) -> Floats:
        """Displacements of the places, mm, (n, 3), from all causes."""
        return self._core.displacements()

    @cached_property
    def deflections(self) -> Floats:
        """Parts of the displacements that the touch causes, mm, (n, 3)."""
        return self._core.deflections()

    @cached_property
    def stiffness(self) -> Floats:
        """|force| / |deflection|, N/mm, (n,); 0 without force."""
        return self._core.stiffness()

    @cached_property
    def statuses(self) -> List[str]:
        """Of each contact: "holding", "sticking", "slipping", "open"."""
        return self._core.statuses()

    def columns(self) -> Dict[str, NDArray[Any]]:
        """All results by their names with units, as save() writes them."""
        given = "given_N" if self.kind == "force" else "given_mm"
        return {
            "at_mm": self.at,
            "normal": self.normals,
            given: self.given,
            "force_N": self.forces,
            "displacement_mm": self.displacements,
            "deflection_mm": self.deflections,
            "stiffness_N_per_mm": self.stiffness,
            "status": np.array(self.statuses),
        }

    def save(self, path: Path, **more: ArrayLike) -> None:
        """Writes the batch as .npz (numpy), .h5 (HDF5; needs h5py) or .csv (units in the headings).

        more: further arrays with one row per touch, such as ``markers_mm=sensor.markers(batch)``; put
        the unit into the name. Tables have one column per number: force_x_N, force_y_N, …. Raises
        InputError.
        """
        _tables.save(os.fspath(path), self.columns(), more, len(self))

    def __repr__(self) -> str:
        return f"<palpa.Batch: {len(self)} touches of the kind {self.kind!r}>"


class Sensor:
    """A tactile skin: places of the surface at which every touch is read. Made by Model.sensor()."""

    def __init__(self, core: _core.Sensor) -> None:
        self._core = core

    @cached_property
    def at(self) -> Floats:
        """The places on the unloaded surface, mm, (taxels, 3)."""
        return self._core.places()

    @cached_property
    def normals(self) -> Floats:
        """Outward unit normals at the places, (taxels, 3)."""
        return self._core.normals()

    def markers(
        self, touched: Union[State, Batch], *, threads: int = 0, progress: Progress = None
    ) -> Floats:
        """Displacements of the places, mm: (taxels, 3) of a state, (n, taxels, 3) of a batch."""
        if isinstance(touched, State):
            return self._core.displacements(touched._core)
        return self._core.displacements_of_batch(touched._core, progress, threads)

    def pressures(
        self, touched: Union[State, Batch], *, threads: int = 0, progress: Progress = None
    ) -> Floats:
        """Pressures on the surface at the places, MPa, positive into the body: (taxels,) of a state,
        (n, taxels) of a batch. Below the body they are those that the support exerts."""
        if isinstance(touched, State):
            return self._core.pressures(touched._core)
        return self._core.pressures_of_batch(touched._core, progress, threads)

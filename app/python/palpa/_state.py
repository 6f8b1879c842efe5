"""The states of a touched body: forces, displacements, tractions."""

from __future__ import annotations

import os
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._values import Floats, vectors

if TYPE_CHECKING:
    from ._model import Model

Path = Union[str, "os.PathLike[str]"]


@dataclass(frozen=True)
class Contact:
    """What a touch does to the body.

    name, kind, radius (mm), friction: of the touch; the mesh may widen the radius. at: mm, on the
    unloaded surface. normal: outward, unit. status: "holding", "sticking", "slipping", "open", ….
    force: N, on the body. normal_force: N, positive into the body; tangential_force: N.
    displacement: mm, of the place, from all causes. deflection: mm, the part that this touch causes.
    stiffness: N/mm, |force| / |deflection|. patch_radius: mm, of the contact of a push or ball.
    """

    name: str
    kind: str
    status: str
    at: Floats
    normal: Floats
    radius: float
    friction: float
    force: Floats
    normal_force: float
    tangential_force: float
    displacement: Floats
    deflection: Floats
    stiffness: float
    patch_radius: float


@dataclass(frozen=True)
class Resultant:
    """Force (N) and moment (N·mm, about the origin) of a support or load on the body."""

    name: str
    force: Floats
    moment: Floats


class State:
    """A solution: displacements and tractions on the whole surface, forces, energy.

    Made by Model.touch(), Model.play() and Model.solve().
    """

    def __init__(self, core: _core.State, model: Model) -> None:
        self._core = core
        self._model = model

    @property
    def model(self) -> Model:
        """The model that was touched."""
        return self._model

    @cached_property
    def contacts(self) -> Tuple[Contact, ...]:
        """One per touch, in their order."""
        return tuple(Contact(**each) for each in self._core.contacts())

    @cached_property
    def supports(self) -> Tuple[Resultant, ...]:
        """Reactions: what each support exerts on the body."""
        return tuple(Resultant(**each) for each in self._core.supports())

    @cached_property
    def loads(self) -> Tuple[Resultant, ...]:
        """Resultants of the loads of the project."""
        return tuple(Resultant(**each) for each in self._core.loads())

    def _only(self) -> Contact:
        if len(self.contacts) != 1:
            raise _core.InputError(
                f"the state has {len(self.contacts)} touches; take the one you mean from contacts"
            )
        return self.contacts[0]

    @property
    def force(self) -> Floats:
        """Force of the only touch on the body, N, (3,)."""
        return self._only().force

    @property
    def displacement(self) -> Floats:
        """Displacement of the place of the only touch, mm, (3,)."""
        return self._only().displacement

    @property
    def stiffness(self) -> float:
        """Stiffness of the only touch, N/mm."""
        return self._only().stiffness

    @property
    def error(self) -> float:
        """Estimated relative error of the forces, the largest one: 0.01 is 1 %. Costs about as much as
        building the model, once."""
        return self._core.errors()[1]

    @property
    def field_error(self) -> float:
        """Estimated relative error of displacements and forces, the largest one. Cost as of error."""
        return self._core.errors()[0]

    @property
    def contact_errors(self) -> Floats:
        """Estimated relative errors of the forces of the contacts, (contacts,). Cost as of error."""
        return np.array(self._core.errors()[2], dtype=np.float64)

    @property
    def energy(self) -> float:
        """Strain energy, mJ."""
        return self._core.numbers()["energy"]

    @property
    def balance(self) -> float:
        """Norm of the sum of all forces on the body, N: zero for an exact solution."""
        return self._core.numbers()["balance"]

    @property
    def relative_balance(self) -> float:
        """balance over the largest force."""
        return self._core.numbers()["relative_balance"]

    @cached_property
    def displacements(self) -> Floats:
        """Displacements of Model.nodes, mm, (nodes, 3)."""
        return self._core.displacements()

    @cached_property
    def tractions(self) -> Floats:
        """Tractions on the surface at the corners of Model.triangles, MPa, (triangles, 3, 3). They jump
        across sharp edges and borders of supports, so nodes have no single value."""
        return self._core.tractions()

    @cached_property
    def stresses(self) -> Floats:
        """Cauchy's stress at the corners of Model.triangles, MPa, global axes, (triangles, 3, 3, 3)."""
        return self._core.stresses()

    def sample(self, points: ArrayLike) -> Tuple[Floats, Floats]:
        """Displacements (mm) and tractions (MPa) at the surface points nearest to points (n, 3), each
        (n, 3), as palpa-cli --sample. Raises InputError for points far from the surface."""
        _, displacements, tractions = self._core.sample(vectors(points, "points"))
        return displacements, tractions

    def inside(self, points: ArrayLike) -> Tuple[Floats, Floats]:
        """Displacements (mm), (n, 3), and Cauchy's stresses (MPa), (n, 3, 3), at points (n, 3) inside the
        body, such as markers in a gel. Raises InputError for points outside of it."""
        return self._core.inside(vectors(points, "points"))

    def save(self, path: Path) -> None:
        """Writes the mesh with displacement_mm and traction_MPa (.vtp, for ParaView), or the deformed
        surface (.stl, .obj, .ply)."""
        self._core.save(os.fspath(path))

    def __repr__(self) -> str:
        touches = ", ".join(
            f"{each.name!r} {np.linalg.norm(each.force):.4g} N" for each in self.contacts
        )
        return f"<palpa.State: {touches or 'no touches'}, energy {self.energy:.4g} mJ>"

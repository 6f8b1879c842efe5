"""Built models, the states of touches, batches, sensors."""

from __future__ import annotations

import os
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, _tables
from ._parts import Touch
from ._values import Floats, triple, vector, vectors

Path = Union[str, "os.PathLike[str]"]
Progress = Optional[Callable[[str, float], Any]]


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


class Model:
    """A built project, ready to be touched. It does not change when the project does.

    Made by Project.build(). Several threads may use one model. threads: 0 for all cores. progress and
    Ctrl-C: as of Project.build().
    """

    def __init__(self, core: _core.Model, touches: Sequence[Touch]) -> None:
        self._core = core
        self._touches = tuple(touches)

    @cached_property
    def report(self) -> Dict[str, Any]:
        """Figures of the build: engine, nodes, triangles, elements, coefficients, memory_bytes, notice,
        and seconds per phase."""
        return self._core.report()

    @cached_property
    def nodes(self) -> Floats:
        """Nodes of the mesh, mm, (nodes, 3)."""
        return self._core.nodes()

    @cached_property
    def triangles(self) -> NDArray[np.int32]:
        """Nodes of each triangle, counter-clockwise seen from outside, (triangles, 3)."""
        return self._core.triangles()

    @property
    def touches(self) -> Tuple[Touch, ...]:
        """The touches of the project when it was built."""
        return self._touches

    @property
    def default_radius(self) -> float:
        """Radius of a touch that does not name one, mm: of a fingertip."""
        return self._core.default_radius()

    def solve(self) -> State:
        """The state under the supports and loads of the project, without touches."""
        return State(self._core.solve(), self)

    def touch(
        self,
        at: ArrayLike,
        displace: Optional[ArrayLike] = None,
        *,
        force: Optional[ArrayLike] = None,
        kind: Optional[str] = None,
        radius: Optional[float] = None,
        friction: float = 0.0,
        steps: int = 0,
        threads: int = 0,
        progress: Progress = None,
    ) -> State:
        """Touches the body at one place, together with the loads of the project.

        at: mm, (3,), on the unloaded shape. displace: mm, or force: N, (3,). kind, radius, friction: see
        Touch. steps: along the path of a push or ball, 0: chosen. Raises InputError (a place on a
        support or far from the surface), SolveError (a ball finds no equilibrium).
        """
        touch = Touch(
            "touch",
            triple(at, "at"),
            None if displace is None else triple(displace, "displace"),
            None if force is None else triple(force, "force"),
            kind,
            radius,
            friction,
        )
        return self.play([touch], steps=steps, threads=threads, progress=progress)

    def play(
        self,
        touches: Union[str, Touch, Sequence[Union[str, Touch]], None] = None,
        *,
        steps: int = 0,
        threads: int = 0,
        progress: Progress = None,
    ) -> State:
        """Plays touches, all at the same time: names of touches of the project, or Touch objects; None:
        all touches of the project, as palpa-cli touch. Other arguments and errors as of touch()."""
        given = self._tuples(touches)
        return State(self._core.play(given, steps, progress, threads), self)

    def sweep(
        self,
        count: int,
        touches: Union[str, Touch, Sequence[Union[str, Touch]], None] = None,
        *,
        steps: int = 0,
        threads: int = 0,
        progress: Progress = None,
    ) -> Sweep:
        """Plays touches at the shares 0, 1/count, …, 1 of their displacements and forces: force-depth
        curves, as palpa-cli touch --sweep. count: 1 … 1000. Other arguments as of play()."""
        if not 1 <= count <= 1000:
            raise _core.InputError(f"count: expected 1 to 1000 steps, found {count}")
        given = self._tuples(touches)
        return Sweep(*self._core.sweep(given, count, steps, progress, threads))

    def touch_many(
        self,
        at: ArrayLike,
        displace: Optional[ArrayLike] = None,
        *,
        force: Optional[ArrayLike] = None,
        kind: Optional[str] = None,
        radius: Optional[float] = None,
        friction: float = 0.0,
        steps: int = 0,
        threads: int = 0,
        progress: Progress = None,
    ) -> Batch:
        """Touches the body many times, each touch alone, at about 10,000 touches per second.

        at: mm, (n, 3). displace: mm, or force: N, (n, 3) or (3,) for all. One kind, radius and friction
        for all touches. Grabs, forces and pins use the Green's functions in single precision: forces
        agree with touch() to about 1e-5. The first batch computes the Green's functions that it needs
        and keeps them. Pushes and balls follow their paths, as in touch(), some milliseconds each.
        Raises InputError and SolveError with the number of the touch.
        """
        places = vectors(at, "at")
        name = kind or ("grab" if force is None else "force")
        given = force if name == "force" else displace
        # Touch knows which of displace and force a kind takes.
        Touch(
            "touch",
            (0.0, 0.0, 0.0),
            None if displace is None else (0.0, 0.0, 0.0),
            None if force is None else (0.0, 0.0, 0.0),
            name,
            friction=friction,
        )._vector()
        values = vectors((0.0, 0.0, 0.0) if given is None else given, "displace" if force is None else "force")
        if len(values) == 1:
            values = np.repeat(values, len(places), axis=0)
        core = self._core.touch_many(places, values, name, radius, friction, steps, progress, threads)
        return Batch(core, name, values, self.default_radius if radius is None else radius)

    def compliance(
        self,
        points: ArrayLike,
        *,
        radius: Optional[float] = None,
        threads: int = 0,
        progress: Progress = None,
    ) -> Floats:
        """Dense block of Green's functions, mm/N, (3 n, 3 n), symmetric: the entry [3 i + a, 3 j + b] is
        the displacement along axis a of the mask at points[i] by a unit force along axis b on the mask
        at points[j].

        points: mm, (n, 3), at most 5000, on free surface. radius: mm, of the masks; None: of a
        fingertip. Grabbing all points at once takes the forces ``solve(C, d - d0)``, where d0 are the
        displacements under loads alone. Raises InputError, SolveError.
        """
        return self._core.compliance(vectors(points, "points"), radius, progress, threads)

    def gradient(
        self,
        touched: Union[State, str, Touch],
        contact: int = 0,
        *,
        threads: int = 0,
        progress: Progress = None,
    ) -> Floats:
        """Derivative of the stiffness of a touch by the control points of the solid, N/mm per mm,
        (control points, 3), as palpa-cli gradient.

        touched: a state of this model and the number of its contact, or a touch. Costs some assemblies.
        Raises InputError for a mesh body, a touch without force, or supports whose motion is unknown
        (rollers, strokes, exceptions).
        """
        state = touched if isinstance(touched, State) else self.play(touched)
        return self._core.gradient(state._core, contact, progress, threads)[1]

    def sensor(self, taxels: ArrayLike) -> Sensor:
        """A tactile skin that reads displacements (markers) or pressures at taxels: mm, (taxels, 3), on
        the surface, also where a support holds it. Raises InputError for places far from the surface."""
        return Sensor(self._core.sensor(vectors(taxels, "taxels")))

    def __repr__(self) -> str:
        report = self.report
        return f"<palpa.Model: {report['engine']}, {report['coefficients']} coefficients>"

    def _tuples(self, touches: Union[str, Touch, Sequence[Union[str, Touch]], None]) -> List[_core.TouchTuple]:
        if touches is None:
            if not self._touches:
                raise _core.InputError(
                    "the project has no recorded touches; give one, or touch() a place"
                )
            wanted: Sequence[Union[str, Touch]] = self._touches
        elif isinstance(touches, (str, Touch)):
            wanted = [touches]
        else:
            wanted = touches
        return [self._tuple(each) for each in wanted]

    def _tuple(self, wanted: Union[str, Touch]) -> _core.TouchTuple:
        if isinstance(wanted, str):
            named = [each for each in self._touches if each.name == wanted]
            if not named:
                known = ", ".join(repr(each.name) for each in self._touches) or "none"
                raise _core.InputError(f"the project has no touch {wanted!r}; it has {known}")
            wanted = named[0]
        return (
            wanted.name,
            vector(wanted.at, "at"),
            wanted._kind(),
            vector(wanted._vector(), "displace"),
            wanted.radius,
            wanted.friction,
        )

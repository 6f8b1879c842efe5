"""Built models, ready to be touched."""

from __future__ import annotations

from functools import cached_property
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._batch import Batch, Sensor, Sweep
from ._parts import Touch
from ._state import State
from ._values import Floats, triple, vector, vectors

Progress = Optional[Callable[[str, float], Any]]


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
        """Figures of the build: engine, nodes, triangles, elements, coefficients, memory_bytes, storage,
        notice, and seconds per phase."""
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

"""Projects: bodies with material, supports, loads and touches, and their history of edits."""

from __future__ import annotations

import contextlib
import json
import os
from typing import Any, Callable, Dict, Iterable, Iterator, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._model import Model
from ._parts import Load, Material, Mesh, Support, Touch, load_of, materials
from ._values import Floats, to_json

Path = Union[str, "os.PathLike[str]"]
Progress = Optional[Callable[[str, float], Any]]


class ControlPoints(np.lib.mixins.NDArrayOperatorsMixin):
    """The control points of a solid, mm: behaves as an array of shape (n, 3).

    Reading gives copies. Assigning to points, as in ``points[12] += (0, 0, 1.5)`` or
    ``points[:, 2] *= 1.1``, moves them by one command that can be undone. Beside smooth edges other
    points may follow (docs/editing.md).
    """

    def __init__(self, project: Project) -> None:
        self._project = project

    def __array__(self, dtype: Any = None) -> Floats:
        points = self._project._core.points()
        return points if dtype is None else points.astype(dtype)

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **keywords: Any) -> Any:
        plain = [np.asarray(each) if isinstance(each, ControlPoints) else each for each in inputs]
        out = keywords.pop("out", None)
        result = getattr(ufunc, method)(*plain, **keywords)
        if out is None:
            return result
        out[0][...] = result
        return out[0]

    def __len__(self) -> int:
        return len(np.asarray(self))

    @property
    def shape(self) -> Tuple[int, int]:
        """(n, 3)."""
        return (len(self), 3)

    def __getitem__(self, index: Any) -> Any:
        return np.asarray(self)[index]

    def __setitem__(self, index: Any, value: ArrayLike) -> None:
        before = np.asarray(self)
        points = before.copy()
        points[index] = value
        moved = np.flatnonzero((points != before).any(axis=1))
        if len(moved):
            self._project._core.move_points(moved.tolist(), points[moved])

    def __repr__(self) -> str:
        return f"ControlPoints({np.asarray(self)!r})"


class Project:
    """A body with its material, supports, loads, touches and mesh settings.

    Made by open(), read_step(), read_mesh() and the shapes (sphere(), box(), …). Every change is a
    command that undo() takes back. Not to be used by several threads at the same time.
    """

    def __init__(self, core: _core.Project, file: Optional[str] = None, notes: Sequence[str] = ()) -> None:
        self._core = core
        self._file = file
        self._notes = tuple(notes)

    # What the project consists of.

    @property
    def file(self) -> Optional[str]:
        """The file that save() writes; None if the project was never saved."""
        return self._file

    @property
    def notes(self) -> Tuple[str, ...]:
        """Sentences on an imported body: approximations, repairs, what is held."""
        return self._notes

    @property
    def name(self) -> str:
        """Name of the project."""
        name: str = self._parts().get("name", "")
        return name

    @name.setter
    def name(self, name: str) -> None:
        self.perform({"command": "rename_project", "name": name})

    @property
    def is_solid(self) -> bool:
        """True for a solid of spline patches, False for a mesh body."""
        return self._core.is_solid()

    @property
    def patches(self) -> Tuple[str, ...]:
        """Names of the patches, or of the faces of a mesh body."""
        return tuple(self._core.patches())

    @property
    def volume(self) -> float:
        """Enclosed volume, mm³."""
        return self._core.volume()

    @property
    def area(self) -> float:
        """Area of the surface, mm²."""
        return self._core.area()

    @property
    def control_points(self) -> ControlPoints:
        """The control points, mm, (n, 3). Raises InputError for a mesh body."""
        if not self.is_solid:
            raise _core.InputError("control_points: the body is a mesh body, which has none")
        return ControlPoints(self)

    @control_points.setter
    def control_points(self, points: ArrayLike) -> None:
        if isinstance(points, ControlPoints) and points._project is self:
            return
        self.control_points[:] = points

    @property
    def vertices(self) -> Floats:
        """Vertices of a mesh body, mm, (n, 3). Raises InputError for a solid."""
        if self.is_solid:
            raise _core.InputError("vertices: the body is a solid, which has control points")
        return self._core.points()

    @property
    def material(self) -> Material:
        """The material."""
        return Material._of(self._parts()["material"])

    @material.setter
    def material(self, material: Union[Material, str]) -> None:
        if isinstance(material, str):
            library = materials()
            if material not in library:
                raise _core.InputError(
                    f"material: the library has no {material!r}; it has {', '.join(library)}"
                )
            material = library[material]
        self.perform({"command": "set_material", "material": material._json()})

    @property
    def mesh(self) -> Mesh:
        """Settings of meshing and discretisation."""
        return Mesh._of(self._parts()["mesh"])

    @mesh.setter
    def mesh(self, mesh: Mesh) -> None:
        self.perform({"command": "set_mesh", "mesh": mesh._json()})

    @property
    def supports(self) -> Tuple[Support, ...]:
        """The supports, in their order. Assign a list to replace all of them."""
        return tuple(Support._of(each) for each in self._parts().get("supports", ()))

    @supports.setter
    def supports(self, supports: Iterable[Support]) -> None:
        self._replace("support", self.supports, supports)

    @property
    def loads(self) -> Tuple[Load, ...]:
        """The loads, in their order. Assign a list to replace all of them."""
        return tuple(load_of(each) for each in self._parts().get("loads", ()))

    @loads.setter
    def loads(self, loads: Iterable[Load]) -> None:
        self._replace("load", self.loads, loads)

    @property
    def touches(self) -> Tuple[Touch, ...]:
        """The touches, in their order. Assign a list to replace all of them. Elements and meshes become
        finer at the touches of the project when it is built."""
        return tuple(Touch._of(each) for each in self._parts().get("touches", ()))

    @touches.setter
    def touches(self, touches: Iterable[Touch]) -> None:
        self._replace("touch", self.touches, touches)

    def json(self) -> str:
        """The text of the project file."""
        return self._core.json()

    # Edits.

    def perform(self, *commands: Mapping[str, Any], label: str = "Script") -> float:
        """Applies editing commands, given as in files of commands (docs/editing.md):
        ``project.perform({"command": "move_points", "points": [12], "by_mm": [0, 0, 1.5]})``.

        Several commands are one step of undo, named label; if one fails, none has an effect. Returns
        the largest deviation in mm of commands that change the surface approximately, mostly 0. Raises
        InputError.
        """
        return self._core.perform(to_json({"commands": list(commands)}), label)

    def add(self, *parts: Union[Support, Load, Touch]) -> None:
        """Appends supports, loads and touches to the lists: one step of undo."""
        self.perform(*[self._command("add", part) for part in parts], label="Add")

    def remove(self, *parts: Union[Support, Load, Touch]) -> None:
        """Removes supports, loads and touches, by their names: one step of undo."""
        self.perform(
            *[{"command": f"remove_{_kind_of(part)}", "name": part.name} for part in parts],
            label="Remove",
        )

    @contextlib.contextmanager
    def group(self, label: str) -> Iterator[Project]:
        """Edits in the block are one step of undo; an exception undoes them."""
        self._core.begin_group(label)
        try:
            yield self
        except BaseException:
            self._core.cancel_group()
            raise
        self._core.end_group()

    def undo(self) -> bool:
        """Takes the last edit back. False if there is none."""
        return self._core.undo()

    def redo(self) -> bool:
        """Repeats the edit that was taken back last. False if there is none."""
        return self._core.redo()

    @property
    def undo_label(self) -> str:
        """What undo() takes back; empty if there is nothing."""
        return self._core.undo_label()

    @property
    def redo_label(self) -> str:
        """What redo() repeats; empty if there is nothing."""
        return self._core.redo_label()

    @property
    def is_modified(self) -> bool:
        """True if there are edits that are not saved."""
        return self._core.is_modified()

    # Files.

    def save(self, path: Optional[Path] = None) -> None:
        """Writes the project file, by default the one it was read from; the old one stays as
        <name>.bak. Raises InputError."""
        target = self._file if path is None else os.fspath(path)
        if target is None:
            raise _core.InputError("save: the project has no file yet; give a path")
        self._core.save(target)
        self._file = target

    def export(self, path: Path, progress: Progress = None) -> None:
        """Writes the body to a CAD file (.step, .iges, .brep: solids only) or its mesh to .stl, .obj,
        .ply or .vtp. Raises InputError."""
        self._core.export(os.fspath(path), progress)

    # Solving.

    def build(
        self,
        accuracy: Optional[float] = None,
        *,
        edge_length: Optional[float] = None,
        element_length: Optional[float] = None,
        engine: Optional[str] = None,
        threads: int = 0,
        progress: Progress = None,
    ) -> Model:
        """Meshes, assembles, factorises and solves; the result can be touched.

        accuracy, edge_length, element_length and engine replace the settings of the project's mesh (see
        Mesh), as the options of palpa-cli do; the project does not change. threads: 0 for all cores.

        The work runs without the interpreter's lock, so that other threads go on. Ctrl-C stops it and
        raises KeyboardInterrupt. progress: called with the name of a phase ("assemble") and its done
        fraction 0 … 1, on the calling thread; if it returns False, the work stops and Cancelled is
        raised. If only loads have changed since the last build, its factors are used again.

        Raises InputError (a region without surface, …), SolveError (the body is free to move, the
        model is too large, …).
        """
        return Model(
            self._core.build(accuracy, edge_length, element_length, engine, threads, progress), self.touches
        )

    def __repr__(self) -> str:
        kind = "solid" if self.is_solid else "mesh body"
        return f"<palpa.Project {self.name!r}: {kind}, {len(self._core.points())} points>"

    def _parts(self) -> Dict[str, Any]:
        parts: Dict[str, Any] = json.loads(self._core.parts_json())
        return parts

    @staticmethod
    def _command(verb: str, part: Union[Support, Load, Touch]) -> Dict[str, Any]:
        kind = _kind_of(part)
        return {"command": f"{verb}_{kind}", kind: part._json()}

    def _replace(
        self,
        kind: str,
        present: Sequence[Union[Support, Load, Touch]],
        wanted: Iterable[Union[Support, Load, Touch]],
    ) -> None:
        commands: List[Dict[str, Any]] = [
            {"command": f"remove_{kind}", "name": part.name} for part in present
        ]
        for part in wanted:
            if _kind_of(part) != kind:
                raise _core.InputError(f"expected a {kind}, found a {type(part).__name__}")
            commands.append(self._command("add", part))
        if commands:
            self.perform(*commands, label=f"Replace the {kind}{'es' if kind == 'touch' else 's'}")


def _kind_of(part: Union[Support, Load, Touch]) -> str:
    if isinstance(part, Support):
        return "support"
    return "touch" if isinstance(part, Touch) else "load"


def open(path: Path) -> Project:
    """Opens a project file, or makes a project from a CAD or mesh file as read_step() and read_mesh() do
    with default options. Raises InputError with the place in the file, the problem and the remedy."""
    text = os.fspath(path)
    if text.lower().endswith((".json", ".palpa")):
        return Project(_core.Project.read(text), text)
    return _read(text)


def _read(
    path: Path,
    solid: Union[int, str, None] = None,
    unit: Optional[str] = None,
    up: str = "z",
    scale: float = 1.0,
    edge_length: Optional[float] = None,
    tolerance: Optional[float] = None,
    progress: Progress = None,
) -> Project:
    core, notes, deviation, held = _core.Project.import_file(
        os.fspath(path),
        "" if solid is None else str(solid),
        unit or "",
        up,
        scale,
        edge_length or 0.0,
        tolerance or 0.0,
        progress,
    )
    lines = [*notes, f"Held on {held}."]
    if deviation > 0:
        lines.append(f"The body deviates by up to {deviation:.2g} mm from the file.")
    return Project(core, None, lines)


def read_step(
    path: Path,
    *,
    solid: Union[int, str, None] = None,
    unit: Optional[str] = None,
    up: str = "z",
    scale: float = 1.0,
    edge_length: Optional[float] = None,
    tolerance: Optional[float] = None,
    progress: Progress = None,
) -> Project:
    """Makes a project from a CAD file (STEP, IGES, BREP), held on its largest flat face.

    solid: number from 1 or name, if the file has several. unit: "mm", "in", …, instead of the file's
    unit. up: axis of the file that becomes +z ("y", "-x", …). scale: factor for all lengths.
    edge_length: mm, of the mesh. tolerance: mm, largest deviation of patches from curved faces. The
    result is a solid if all faces are four-sided pieces, otherwise a mesh body; see Project.notes.
    Raises InputError.
    """
    return _read(path, solid, unit, up, scale, edge_length, tolerance, progress)


def read_mesh(
    path: Path,
    *,
    solid: Union[int, str, None] = None,
    unit: str = "mm",
    up: str = "z",
    scale: float = 1.0,
    edge_length: Optional[float] = None,
    progress: Progress = None,
) -> Project:
    """Makes a project from a closed triangle mesh (STL, OBJ, PLY), held on its largest flat face.
    Arguments as of read_step(). Raises InputError."""
    return _read(path, solid, unit, up, scale, edge_length, None, progress)

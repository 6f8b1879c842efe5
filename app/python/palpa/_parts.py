"""The parts of a project: material, regions, supports, loads, touches, mesh settings.

All are frozen: change a project by giving it a new part, as in
``project.material = project.material.replace(youngs_modulus=0.3)``. Each corresponds to a part of the
project file (docs/project-file.md).
"""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass, field
from typing import Any, Dict, List, Mapping, Optional, Tuple, TypeVar, Union

from numpy.typing import ArrayLike

from . import _core
from ._values import triple, vectors

Vector = Tuple[float, float, float]
_Part = TypeVar("_Part", bound="_Replaceable")


def _given(json: Mapping[str, Any], key: str) -> Optional[Vector]:
    """The vector of a key; None if the key is absent."""
    return triple(json[key], key) if key in json else None


class _Replaceable:
    def replace(self: _Part, **changes: Any) -> _Part:
        """The same with some attributes changed."""
        return dataclasses.replace(self, **changes)


@dataclass(frozen=True)
class Material(_Replaceable):
    """Isotropic linear elastic material.

    youngs_modulus: MPa, > 0. poisson_ratio: above -1, up to 0.5. density: kg/m³, > 0, needed for
    gravity alone. name: for the user.
    """

    youngs_modulus: float
    poisson_ratio: float
    density: Optional[float] = None
    name: str = ""

    def _json(self) -> Dict[str, Any]:
        json: Dict[str, Any] = {"name": self.name} if self.name else {}
        json["youngs_modulus_MPa"] = self.youngs_modulus
        json["poisson_ratio"] = self.poisson_ratio
        if self.density is not None:
            json["density_kg_per_m3"] = self.density
        return json

    @staticmethod
    def _of(json: Mapping[str, Any]) -> Material:
        return Material(
            json["youngs_modulus_MPa"],
            json["poisson_ratio"],
            json.get("density_kg_per_m3"),
            json.get("name", ""),
        )


def materials() -> Dict[str, Material]:
    """The materials of the library by name: silicones, rubbers, foams, tissues, …"""
    return {each["name"]: Material(**each) for each in _core.materials()}


@dataclass(frozen=True)
class Region(_Replaceable):
    """Part of a body's surface: the union of its parts, without the exceptions.

    Made by patches(), below() and stroke(). ``a | b`` is the union, ``a - b`` leaves b out. parts and
    exceptions: as in project files.
    """

    parts: Tuple[Mapping[str, Any], ...]
    exceptions: Tuple[Mapping[str, Any], ...] = ()

    def __or__(self, other: Region) -> Region:
        if self.exceptions or other.exceptions:
            raise _core.InputError("a region with exceptions has no union; unite first, then subtract")
        return Region(self.parts + other.parts)

    def __sub__(self, other: Region) -> Region:
        if other.exceptions:
            raise _core.InputError("a region with exceptions cannot be an exception")
        return Region(self.parts, self.exceptions + other.parts)

    def _json(self) -> Any:
        if len(self.parts) == 1 and not self.exceptions:
            return self.parts[0]
        parts: List[Any] = list(self.parts)
        return parts + ([{"except": list(self.exceptions)}] if self.exceptions else [])

    @staticmethod
    def _of(json: Any) -> Region:
        if isinstance(json, Mapping):
            return Region((json,))
        parts = tuple(part for part in json if "except" not in part)
        exceptions = tuple(each for part in json if "except" in part for each in part["except"])
        return Region(parts, exceptions)


def patches(*names: str) -> Region:
    """The surface of the named patches, or faces of a mesh body; see Project.patches."""
    return Region(({"patches": list(names)},))


def below(normal: ArrayLike, distance: float) -> Region:
    """The surface points x with normal · x < distance. With a normal of length 1 the distance is in
    mm from the origin."""
    return Region(
        ({"half_space": {"normal": list(triple(normal, "normal")), "below_mm": float(distance)}},)
    )


def stroke(points: ArrayLike, radius: float) -> Region:
    """The surface nearer than radius (mm) to the polyline through points, (n, 3) in mm; one point
    gives a ball."""
    return Region(
        ({"stroke": {"points_mm": vectors(points, "points").tolist(), "radius_mm": float(radius)}},)
    )


@dataclass(frozen=True)
class Support(_Replaceable):
    """Region with prescribed displacements.

    kind: "fixed" (all components) or "roller" (the normal one). displacement: mm, of the region.
    """

    name: str
    where: Region
    kind: str = "fixed"
    displacement: Vector = (0.0, 0.0, 0.0)

    def _json(self) -> Dict[str, Any]:
        json: Dict[str, Any] = {"name": self.name, "kind": self.kind, "where": self.where._json()}
        displacement = triple(self.displacement, "displacement")
        if any(displacement):
            json["displacement_mm"] = list(displacement)
        return json

    @staticmethod
    def _of(json: Mapping[str, Any]) -> Support:
        displacement = json.get("displacement_mm", (0, 0, 0))
        where = Region._of(json["where"])
        return Support(json["name"], where, json["kind"], triple(displacement, "displacement_mm"))


@dataclass(frozen=True)
class Pressure(_Replaceable):
    """Pressure on a region, MPa, positive into the body."""

    name: str
    where: Region
    pressure: float

    def _json(self) -> Dict[str, Any]:
        return {
            "name": self.name,
            "kind": "pressure",
            "where": self.where._json(),
            "MPa": self.pressure,
        }


@dataclass(frozen=True)
class Traction(_Replaceable):
    """Uniform traction on a region, MPa (x, y, z)."""

    name: str
    where: Region
    traction: Vector

    def _json(self) -> Dict[str, Any]:
        return {
            "name": self.name,
            "kind": "traction",
            "where": self.where._json(),
            "MPa": list(triple(self.traction, "traction")),
        }


@dataclass(frozen=True)
class Force(_Replaceable):
    """Total force on a region, N (x, y, z), spread as a uniform traction."""

    name: str
    where: Region
    force: Vector

    def _json(self) -> Dict[str, Any]:
        return {
            "name": self.name,
            "kind": "force",
            "where": self.where._json(),
            "force_N": list(triple(self.force, "force")),
        }


@dataclass(frozen=True)
class Moment(_Replaceable):
    """Moment on a region, N·mm (x, y, z), without a net force."""

    name: str
    where: Region
    moment: Vector

    def _json(self) -> Dict[str, Any]:
        return {
            "name": self.name,
            "kind": "moment",
            "where": self.where._json(),
            "moment_N_mm": list(triple(self.moment, "moment")),
        }


@dataclass(frozen=True)
class Gravity(_Replaceable):
    """Weight of the body; needs Material.density. acceleration: m/s² (x, y, z)."""

    name: str
    acceleration: Vector = (0.0, 0.0, -9.80665)

    def _json(self) -> Dict[str, Any]:
        return {
            "name": self.name,
            "kind": "gravity",
            "acceleration_m_per_s2": list(triple(self.acceleration, "acceleration")),
        }


@dataclass(frozen=True)
class Bump(_Replaceable):
    """The traction direction · peak · (1 - (r/radius)²)² for points nearer than radius to center.

    center, radius: mm. peak: MPa. direction: as given, not normalised.
    """

    name: str
    center: Vector
    radius: float
    peak: float
    direction: Vector = (0.0, 0.0, -1.0)

    def _json(self) -> Dict[str, Any]:
        return {
            "name": self.name,
            "kind": "bump",
            "center_mm": list(triple(self.center, "center")),
            "radius_mm": self.radius,
            "peak_MPa": self.peak,
            "direction": list(triple(self.direction, "direction")),
        }


Load = Union[Pressure, Traction, Force, Moment, Gravity, Bump]


def load_of(json: Mapping[str, Any]) -> Load:
    """The load of an entry in a project file."""
    name, kind = json["name"], json["kind"]
    if kind == "gravity":
        return Gravity(name, _given(json, "acceleration_m_per_s2") or Gravity.acceleration)
    if kind == "bump":
        return Bump(
            name,
            triple(json["center_mm"], "center_mm"),
            json["radius_mm"],
            json["peak_MPa"],
            triple(json["direction"], "direction"),
        )
    where = Region._of(json["where"])
    if kind == "pressure":
        return Pressure(name, where, json["MPa"])
    if kind == "traction":
        return Traction(name, where, triple(json["MPa"], "MPa"))
    if kind == "force":
        return Force(name, where, triple(json["force_N"], "force_N"))
    return Moment(name, where, triple(json["moment_N_mm"], "moment_N_mm"))


@dataclass(frozen=True)
class Touch(_Replaceable):
    """A touch of a project.

    at: mm, place on the unloaded shape. displace: mm, or force: N, depending on the kind:

    - "grab" prescribes the displacement of the place, all components;
    - "force" pulls or presses with a force;
    - "push" is a fingertip that presses but does not pull, with friction;
    - "ball" is a rigid ball that does the same; its contact grows with depth;
    - "pin" keeps the place at its position under supports and loads, or displaces it from there.

    Without a kind it is a grab, or a force if a force is given. radius: mm, of the pressure mask or
    the ball; None: of a fingertip. friction: Coulomb's coefficient of a push or ball, 0 … 10.
    """

    name: str
    at: Vector
    displace: Optional[Vector] = None
    force: Optional[Vector] = None
    kind: Optional[str] = None
    radius: Optional[float] = None
    friction: float = 0.0

    def _kind(self) -> str:
        return self.kind or ("grab" if self.force is None else "force")

    def _vector(self) -> Vector:
        """The displacement or force that the touch prescribes; checks what the kind takes."""
        kind = self._kind()
        if self.friction and kind not in ("push", "ball"):
            raise _core.InputError(
                f"touch {self.name!r}: a touch of the kind {kind!r} has no friction; take a push or a ball"
            )
        given, other = self.displace, self.force
        needed, refused = "displace", "force"
        if kind == "force":
            given, other, needed, refused = other, given, refused, needed
        if other is not None:
            raise _core.InputError(
                f"touch {self.name!r}: a touch of the kind {kind!r} has {needed}, but no {refused}"
            )
        if given is None:
            if kind == "pin":
                return (0.0, 0.0, 0.0)
            raise _core.InputError(f"touch {self.name!r}: a touch of the kind {kind!r} needs {needed}")
        return triple(given, needed)

    def _json(self) -> Dict[str, Any]:
        kind = self._kind()
        json: Dict[str, Any] = {"name": self.name, "kind": kind, "at_mm": list(triple(self.at, "at"))}
        json["force_N" if kind == "force" else "displace_mm"] = list(self._vector())
        if self.radius is not None:
            json["radius_mm"] = self.radius
        if self.friction:
            json["friction"] = self.friction
        return json

    @staticmethod
    def _of(json: Mapping[str, Any]) -> Touch:
        return Touch(
            json["name"],
            triple(json["at_mm"], "at_mm"),
            _given(json, "displace_mm"),
            _given(json, "force_N"),
            json["kind"],
            json.get("radius_mm"),
            json.get("friction", 0.0),
        )


@dataclass(frozen=True)
class Mesh(_Replaceable):
    """Settings of meshing and discretisation.

    edge_length: mm, distance of adjacent nodes. engine: "automatic", "splines", "quadratic" or
    "triangles". accuracy: requested relative error with splines, 1e-4 … 0.1. element_length: mm, size
    of spline elements, instead of the accuracy. refinement_levels: 0 … 6, towards refine_at, which may
    contain "sharp_edges" and "support_borders". patch_factors: factors on lengths by patch, 0.05 … 20.
    feature_fraction: features of mesh bodies smaller than this part of the edge length are meshed over.
    spline_density: 1 … 16, elements per length over the number that the accuracy leads to.
    """

    edge_length: float
    engine: str = "automatic"
    accuracy: float = 0.01
    element_length: Optional[float] = None
    refinement_levels: int = 0
    refine_at: Tuple[str, ...] = ()
    patch_factors: Mapping[str, float] = field(default_factory=dict)
    feature_fraction: float = 0.25
    spline_density: float = 1.0

    def _json(self) -> Dict[str, Any]:
        json: Dict[str, Any] = {"edge_length_mm": self.edge_length}
        if self.patch_factors:
            json["patch_factors"] = dict(self.patch_factors)
        if self.refinement_levels or self.refine_at:
            json["refinement"] = {"levels": self.refinement_levels, "at": list(self.refine_at)}
        json["engine"] = self.engine
        json["accuracy"] = self.accuracy
        json["spline_density"] = self.spline_density
        json["feature_fraction"] = self.feature_fraction
        if self.element_length is not None:
            json["element_length_mm"] = self.element_length
        return json

    @staticmethod
    def _of(json: Mapping[str, Any]) -> Mesh:
        refinement = json.get("refinement", {})
        return Mesh(
            json["edge_length_mm"],
            json.get("engine", "automatic"),
            json.get("accuracy", 0.01),
            json.get("element_length_mm"),
            refinement.get("levels", 0),
            tuple(refinement.get("at", ())),
            json.get("patch_factors", {}),
            json.get("feature_fraction", 0.25),
            json.get("spline_density", 1.0),
        )

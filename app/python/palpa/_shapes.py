"""Projects from shapes. Each is held at its base (flat bottom, or the lowest tenth of round bodies) and
consists of a silicone of 0.2 MPa, so that it can be touched at once."""

from __future__ import annotations

from typing import Any, Mapping, Sequence, Tuple

from numpy.typing import ArrayLike

from . import _core
from ._project import Project
from ._values import to_json, triple

Curve = Mapping[str, Any]


def _make(kind: str, name: str, degree: int, control_points: int, **parameters: Any) -> Project:
    primitive = {"kind": kind, **parameters, "degree": degree}
    if control_points:
        primitive["control_points"] = control_points
    command = to_json([{"command": "make_primitive", "primitive": primitive}])
    return Project(_core.Project.make(command, name or kind))


def sphere(radius: float = 25.0, *, degree: int = 3, control_points: int = 0, name: str = "") -> Project:
    """Sphere about the origin. radius: mm. degree: of all patches, 1 … 5. control_points: per direction
    and patch, degree + 1 … 64; 0: as many as the shape needs. name: of the project. Raises InputError."""
    return _make("sphere", name, degree, control_points, radius_mm=radius)


def ellipsoid(
    radii: ArrayLike = (30.0, 20.0, 15.0), *, degree: int = 3, control_points: int = 0, name: str = ""
) -> Project:
    """Ellipsoid about the origin. radii: mm along x, y, z. Other arguments as of sphere()."""
    return _make("ellipsoid", name, degree, control_points, radii_mm=list(triple(radii, "radii")))


def box(
    size: ArrayLike = (40.0, 30.0, 20.0), *, degree: int = 3, control_points: int = 0, name: str = ""
) -> Project:
    """Box that stands on z = 0, its axis on z. size: mm along x, y, z. Other arguments as of sphere()."""
    return _make("box", name, degree, control_points, size_mm=list(triple(size, "size")))


def cylinder(
    radius: float = 20.0,
    height: float = 60.0,
    *,
    degree: int = 3,
    control_points: int = 0,
    name: str = "",
) -> Project:
    """Cylinder that stands on z = 0. radius, height: mm. Other arguments as of sphere()."""
    return _make("cylinder", name, degree, control_points, radius_mm=radius, height_mm=height)


def cone(
    bottom_radius: float = 20.0,
    top_radius: float = 10.0,
    height: float = 30.0,
    *,
    degree: int = 3,
    control_points: int = 0,
    name: str = "",
) -> Project:
    """Frustum that stands on z = 0, or a cone with an apex if top_radius is 0. Lengths in mm. Other
    arguments as of sphere()."""
    return _make(
        "cone",
        name,
        degree,
        control_points,
        bottom_radius_mm=bottom_radius,
        top_radius_mm=top_radius,
        height_mm=height,
    )


def capsule(
    radius: float = 10.0,
    length: float = 30.0,
    *,
    degree: int = 3,
    control_points: int = 0,
    name: str = "",
) -> Project:
    """Cylinder of the given length between two half spheres, about the origin, its axis z. Lengths in
    mm. Other arguments as of sphere()."""
    return _make("capsule", name, degree, control_points, radius_mm=radius, length_mm=length)


def torus(
    major_radius: float = 25.0,
    minor_radius: float = 8.0,
    *,
    degree: int = 3,
    control_points: int = 0,
    name: str = "",
) -> Project:
    """Ring about the z axis. major_radius: mm, of its centre line; minor_radius: mm, of its section.
    Other arguments as of sphere()."""
    return _make(
        "torus",
        name,
        degree,
        control_points,
        major_radius_mm=major_radius,
        minor_radius_mm=minor_radius,
    )


def revolve(profile: Curve, *, degree: int = 3, control_points: int = 0, name: str = "") -> Project:
    """Open profile (r, z) revolved around the z axis. profile: a plane B-spline curve,
    {"degree": …, "knots": […], "points_mm": [[r, z], …]}, as in project files. Other arguments as of
    sphere()."""
    return _make("revolve", name, degree, control_points, profile=profile)


def extrude(
    profile: Curve, height: float = 20.0, *, degree: int = 3, control_points: int = 0, name: str = ""
) -> Project:
    """Closed profile (x, y) extruded along z. profile: as of revolve(), with equal first and last
    points. height: mm. Other arguments as of sphere()."""
    return _make("extrude", name, degree, control_points, profile=profile, height_mm=height)


def loft(
    sections: Sequence[Tuple[float, Curve]], *, degree: int = 3, control_points: int = 0, name: str = ""
) -> Project:
    """Surface through closed profiles (x, y). sections: pairs of a height z in mm, increasing, and a
    profile as of extrude(). Other arguments as of sphere()."""
    return _make(
        "loft",
        name,
        degree,
        control_points,
        sections=[{"z_mm": z, "profile": profile} for z, profile in sections],
    )

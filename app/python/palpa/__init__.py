"""Palpa from Python: model elastic solids with spline patches and touch them.

Lengths are in mm, forces in N, stresses in MPa, moments in N·mm, energies in mJ, times in s. Points and
vectors are numpy arrays with the coordinates last: one point has the shape (3,), n points have (n, 3).

    >>> import palpa
    >>> project = palpa.sphere(25)
    >>> model = project.build()
    >>> touch = model.touch(at=(0, 0, 25), displace=(0, 0, -2), radius=8)
    >>> touch.force, touch.error

Results agree with palpa-cli bit for bit, because both use the same libraries.
"""

from ._batch import Batch, Sensor, Sweep
from ._core import Cancelled, Error, InputError, SolveError
from ._core import version as __version__
from ._model import Model
from ._parts import (
    Bump,
    Force,
    Gravity,
    Load,
    Material,
    Mesh,
    Moment,
    Pressure,
    Region,
    Support,
    Touch,
    Traction,
    below,
    materials,
    patches,
    stroke,
)
from ._project import ControlPoints, Project, open, read_mesh, read_step
from ._shapes import (
    box,
    capsule,
    cone,
    cylinder,
    ellipsoid,
    extrude,
    loft,
    revolve,
    sphere,
    torus,
)
from ._state import Contact, Resultant, State

__all__ = [
    "Batch",
    "Bump",
    "Cancelled",
    "Contact",
    "ControlPoints",
    "Error",
    "Force",
    "Gravity",
    "InputError",
    "Load",
    "Material",
    "Mesh",
    "Model",
    "Moment",
    "Pressure",
    "Project",
    "Region",
    "Resultant",
    "Sensor",
    "SolveError",
    "State",
    "Support",
    "Sweep",
    "Touch",
    "Traction",
    "__version__",
    "below",
    "box",
    "capsule",
    "cone",
    "cylinder",
    "ellipsoid",
    "extrude",
    "loft",
    "materials",
    "open",
    "patches",
    "read_mesh",
    "read_step",
    "revolve",
    "sphere",
    "stroke",
    "torus",
]

#pragma once

#include <vector>

#include "modeling/mesh/mesh_focus.h"
#include "modeling/project/project.h"

namespace palpa::modeling {

/// The places of a project where a mesh of triangles must be finer than its settings say: under
/// touches, whose pressure masks would otherwise be wider than wished or whose contact area would
/// cover few nodes, and under bumps. On mesh bodies also wide ones, with the settings' edge length:
/// the thin part that one of them touches must not be left out. None for splines, whose elements
/// follow project_geometry.h (app/core).
std::vector<MeshFocus> meshFoci(const Project& project);

/// Longest distance of adjacent nodes of triangles over the radius of a touch that they carry; 0
/// for splines.
double edgeLengthPerTouchRadius(Engine engine);

}  // namespace palpa::modeling

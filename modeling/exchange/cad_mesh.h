#pragma once

#include <TopoDS_Solid.hxx>
#include <string>
#include <vector>

#include "base/job.h"
#include "modeling/body/mesh_body.h"

// Internal to modeling/exchange/: only .cpp files include this header.
namespace palpa::modeling {

/// A mesh body and its accuracy.
struct MeshResult {
  MeshBody body;
  double deviation = 0.0;  ///< mm, the largest over samples of all triangles
};

/// Triangulates a closed solid. Faces are joined by the numbers of the nodes on the shape's edges,
/// so the result is closed for any tolerances of the file. `faceNames` in the order of
/// TopExp::MapShapes. `chordTolerance` (mm) is the target, `deviation` the reached accuracy.
/// Throws ModelingError (without the file's name), Standard_Failure, Cancelled.
MeshResult makeMeshBody(const TopoDS_Solid& shape, const std::vector<std::string>& faceNames,
                        double chordTolerance, const Job& job);

}  // namespace palpa::modeling

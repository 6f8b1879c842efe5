#pragma once

#include <TopoDS_Solid.hxx>
#include <string>
#include <vector>

#include "base/job.h"
#include "modeling/body/mesh_body.h"

// Internal to modeling/exchange/: only .cpp files include this header.
namespace palpa::modeling {

struct MeshResult {
  MeshBody body;
  double deviation = 0.0;  ///< mm, the largest found over samples of all triangles
};

/// Triangulates a closed solid. Triangles are joined along the shape's edges by their nodes' places
/// on them, so the result is closed whatever the tolerances of the file. `faceNames` in the order
/// of TopExp::MapShapes. `chordTolerance` in mm is what is aimed at; `deviation` is what was
/// reached.
/// @throws ModelingError (without the file's name), Standard_Failure, Cancelled
MeshResult makeMeshBody(const TopoDS_Solid& shape, const std::vector<std::string>& faceNames,
                        double chordTolerance, const Job& job);

}  // namespace palpa::modeling

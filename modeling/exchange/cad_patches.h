#pragma once

#include <TopoDS_Solid.hxx>
#include <string>
#include <vector>

#include "base/job.h"
#include "modeling/exchange/quad_faces.h"
#include "modeling/solid/solid.h"

// Internal to modeling/exchange/: only .cpp files include this header.
namespace palpa::modeling {

/// A NUBS solid and its accuracy.
struct PatchResult {
  Solid solid;
  int approximatedFaces = 0;
  double deviation = 0.0;  ///< mm, the largest over samples of all faces
};

/// The NUBS solid of a shape whose faces are all four-sided. `faceNames` in the order of
/// TopExp::MapShapes; `tolerance` in mm.
/// Throws NoPatches if the shape cannot become a NUBS solid; Standard_Failure, Cancelled.
PatchResult makePatches(const TopoDS_Solid& shape, const std::vector<std::string>& faceNames,
                        double tolerance, const Job& job);

}  // namespace palpa::modeling

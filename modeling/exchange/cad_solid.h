#pragma once

#include <TopoDS_Solid.hxx>
#include <string>
#include <vector>

#include "base/job.h"
#include "modeling/exchange/cad_read.h"

// Internal to modeling/exchange/: only .cpp files include this header.
namespace palpa::modeling {

/// The one closed, outward oriented solid of a file.
struct CadSolid {
  TopoDS_Solid shape;
  FaceNames faceNames;
  std::vector<std::string> notes;  ///< repairs, as sentences
};

/// Finds the solid of a file; sews loose faces and repairs faults when needed. The order and the
/// surfaces of faces without fault stay as they are.
/// @throws ModelingError (messages without the file's name): several solids, none, open surface
/// with
///         the place, too many faces; Standard_Failure, Cancelled
CadSolid findSolid(const CadContent& content, const Job& job);

/// The names of the faces in the order of TopExp::MapShapes, unique and not empty: face_7 for the
/// seventh one when it has none.
std::vector<std::string> uniqueFaceNames(const TopoDS_Shape& shape, const FaceNames& names);

}  // namespace palpa::modeling

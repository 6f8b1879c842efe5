#pragma once

#include <TopoDS_Solid.hxx>
#include <string>
#include <vector>

#include "base/job.h"
#include "modeling/exchange/cad_read.h"

// Internal to modeling/exchange/: only .cpp files include this header.
namespace palpa::modeling {

/// The only solid of a file, closed and oriented outwards.
struct CadSolid {
  TopoDS_Solid shape;
  FaceNames faceNames;
  std::vector<std::string> notes;  ///< repairs, as sentences
};

/// Finds the solid of a file; sews loose faces and repairs faults if necessary. Order and surfaces
/// of faultless faces do not change.
/// Throws ModelingError (without the file's name) if there are several solids or none, the surface
/// is open (with the place), or there are too many faces; Standard_Failure, Cancelled.
CadSolid findSolid(const CadContent& content, const Job& job);

/// The names of the faces in the order of TopExp::MapShapes, unique and not empty: without a name
/// the seventh face becomes face_7.
std::vector<std::string> uniqueFaceNames(const TopoDS_Shape& shape, const FaceNames& names);

}  // namespace palpa::modeling

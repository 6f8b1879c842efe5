#pragma once

#include <TopoDS_Solid.hxx>
#include <string>
#include <vector>

#include "base/job.h"
#include "modeling/exchange/cad_read.h"

// Internal to modeling/exchange/: only .cpp files include this header.
namespace palpa::modeling {

/// The bodies of a file, each closed unless it is a solid of the file with faults.
struct CadSolids {
  std::vector<TopoDS_Shape> shapes;
  std::vector<std::string> names;  ///< of the file; empty without a name
  FaceNames faceNames;
  std::vector<std::string> notes;  ///< repairs, as sentences
};

/// A solid of a file, closed and oriented outwards.
struct CadSolid {
  TopoDS_Solid shape;
  FaceNames faceNames;
  std::vector<std::string> notes;  ///< repairs, as sentences
};

/// Finds the solids of a file, with the placements of its assemblies. A file without solids is
/// sewn together from its faces; closed shells inside others become cavities. Lengths in notes are
/// multiplied by `factor`.
/// Throws ModelingError (without the file's name) if there are no faces, or loose faces leave an
/// open surface (with the place); Standard_Failure, Cancelled.
CadSolids findSolids(const CadContent& content, double factor, const Job& job);

/// One of the solids; sews its faces and repairs faults if necessary. Order and surfaces of
/// faultless faces do not change.
/// Throws ModelingError (without the file's name) if its surface is open (with the place) or it has
/// too many faces; Standard_Failure, Cancelled.
CadSolid closedSolid(const CadSolids& solids, std::size_t index, double factor, const Job& job);

/// The names of the faces in the order of TopExp::MapShapes, unique and not empty: without a name
/// the seventh face becomes face_7.
std::vector<std::string> uniqueFaceNames(const TopoDS_Shape& shape, const FaceNames& names);

}  // namespace palpa::modeling

#pragma once

#include <TopoDS_Face.hxx>
#include <TopoDS_Solid.hxx>
#include <vector>

#include "modeling/solid/solid.h"

// Internal to modeling/exchange/: only .cpp files include this header.
namespace palpa::modeling {

/// Boundary representation of a NUBS solid: one face with natural bounds per patch, one edge per
/// solid edge and one vertex per corner, shared by adjacent faces. Faces have the orientation of
/// their surfaces (normals du × dv outwards).
struct ShapeOfSolid {
  TopoDS_Solid shape;
  std::vector<TopoDS_Face> faces;  ///< in the order of the patches
};

/// Boundary representation of a solid. Throws Standard_Failure.
ShapeOfSolid makeShape(const Solid& solid);

}  // namespace palpa::modeling

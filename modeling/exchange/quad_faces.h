#pragma once

#include <Geom_BSplineSurface.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Solid.hxx>
#include <array>
#include <gp_Dir.hxx>
#include <gp_Pnt.hxx>
#include <string>
#include <vector>

#include "modeling/solid/solid.h"

// The faces of a solid as four-sided pieces of surfaces. Internal to modeling/exchange/: only .cpp
// files include this header.
namespace palpa::modeling {

/// Exception that ends the conversion of a shape to a NUBS solid. `reason` completes the sentence
/// "… because".
struct NoPatches {
  std::string reason;
};

/// A face over its parameter rectangle, oriented so that du × dv points outwards.
struct QuadFace {
  enum class Kind {
    kSpline,  ///< a B-spline without weights, degrees up to 5: kept unchanged
    kSmooth,  ///< any other surface: approximated
    kFlat,    ///< a plane: interpolated between its edges
  };
  struct SideUse {
    int edge = -1;          ///< 1-based index into QuadFaces::edges
    bool reversed = false;  ///< the edge runs against the parameter of the side
  };

  std::string name;
  Kind kind = Kind::kFlat;
  Handle(Geom_BSplineSurface) spline;            ///< kSpline: over the rectangle of the face only
  Handle(Geom_Surface) surface;                  ///< kSmooth
  bool swapped = false;                          ///< kSmooth: u of `surface` is v of the face
  std::array<std::array<double, 2>, 2> range{};  ///< kSmooth: of u and v of the face
  gp_Pnt origin;                                 ///< kFlat: a point of the plane
  gp_Dir normal;                                 ///< kFlat: outwards
  std::array<SideUse, 4> sides;                  ///< by Side

  /// The point (mm) at fractions 0 … 1 of the parameters; not for kFlat.
  gp_Pnt value(double s, double t) const;
};

/// Four-sided faces of a solid, and its edges.
struct QuadFaces {
  std::vector<QuadFace> faces;  ///< in the order of TopExp::MapShapes
  TopTools_IndexedMapOfShape edges;
};

/// The faces of a solid; `faceNames` in the order of TopExp::MapShapes.
/// Throws NoPatches if a face is not four-sided; Standard_Failure.
QuadFaces findQuadFaces(const TopoDS_Solid& solid, const std::vector<std::string>& faceNames);

}  // namespace palpa::modeling

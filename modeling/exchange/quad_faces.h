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

/// Why a shape cannot become a NUBS solid; thrown to end the attempt. The reason completes "…
/// because".
struct NoPatches {
  std::string reason;
};

/// One face over its parameter rectangle. The parameters are turned so that du × dv points
/// outwards.
struct QuadFace {
  enum class Kind {
    kSpline,  ///< a B-spline without weights, degrees up to 5: taken over as it is
    kSmooth,  ///< any other surface: to be approximated
    kFlat,    ///< a plane: spanned between its edges
  };
  struct SideUse {
    int edge = -1;          ///< 1-based index into QuadFaces::edges
    bool reversed = false;  ///< the edge runs against the growing parameter of the side
  };

  std::string name;
  Kind kind = Kind::kFlat;
  Handle(Geom_BSplineSurface) spline;            ///< kind spline: over the face's rectangle only
  Handle(Geom_Surface) surface;                  ///< kind smooth
  bool swapped = false;                          ///< kind smooth: the surface's own u is our v
  std::array<std::array<double, 2>, 2> range{};  ///< kind smooth, our u and v
  gp_Pnt origin;                                 ///< kind flat: a point of the plane
  gp_Dir normal;                                 ///< kind flat, outwards
  std::array<SideUse, 4> sides;                  ///< by Side

  /// The point at fractions 0 … 1 of the parameters; not for kind flat.
  gp_Pnt value(double s, double t) const;
};

struct QuadFaces {
  std::vector<QuadFace> faces;
  TopTools_IndexedMapOfShape edges;
};

/// @throws NoPatches when a face is not four-sided; Standard_Failure
QuadFaces findQuadFaces(const TopoDS_Solid& solid, const std::vector<std::string>& faceNames);

}  // namespace palpa::modeling

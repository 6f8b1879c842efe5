#pragma once

#include <array>
#include <vector>

#include "modeling/solid/surface_evaluator.h"

// Edges of a solid as curves, and points of the surface named by patch and parameters.
namespace palpa::modeling {

/// A point of the surface, named by its patch and parameters in the patch's own knot range.
struct SurfaceParameter {
  int patch = -1;
  double u = 0.0;
  double v = 0.0;
};

/// The point of a side at the fraction t (0 … 1) of the side's own growing parameter.
SurfaceParameter onSide(const SurfaceEvaluator& surface, PatchEdge edge, double t);

/// The point of an edge at the fraction t of the parameter of edge.uses[0], named in the patch of
/// edge.uses[use].
SurfaceParameter onEdge(const SurfaceEvaluator& surface, const SolidEdge& edge, int use, double t);

/// A line of constant parameter of a patch with its arc length (relative accuracy about 1e-6).
/// `direction` is the parameter that varies, `fixed` the value of the other one.
class IsoCurve {
 public:
  IsoCurve(const SurfaceEvaluator& surface, int patch, int direction, double fixed);

  double length() const { return lengths_.back(); }

  /// Fractions 0 … 1 of the parameter range at which the curve is cut into `count` equal lengths;
  /// count + 1 values, the first 0 and the last 1.
  std::vector<double> equalLengths(int count) const;

 private:
  double parameterAt(double length) const;

  std::vector<double> fractions_;  // sample parameters, as fractions of the range
  std::vector<double> lengths_;    // arc length up to each sample
};

}  // namespace palpa::modeling

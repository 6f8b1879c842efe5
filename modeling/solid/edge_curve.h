#pragma once

#include <array>
#include <numbers>
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

/// A piece of a curve should turn by no more than this, so that a quarter of a circle has three.
inline constexpr double kPieceAngle = std::numbers::pi / 6.0;

/// A line of constant parameter of a patch with its arc length (relative accuracy about 1e-6) and
/// how much it turns. `direction` is the parameter that varies, `fixed` the value of the other one.
class IsoCurve {
 public:
  IsoCurve(const SurfaceEvaluator& surface, int patch, int direction, double fixed);

  double length() const { return lengths_.back(); }

  /// How many pieces of the given length it takes, counted finer where the curve bends so much that
  /// they would turn by more than kPieceAngle: ∫ max(1 / pieceLength, κ / kPieceAngle) ds, with
  /// pieces not below pieceLength / 64 and kinks at knots left out.
  double pieces(double pieceLength) const { return density(pieceLength).back(); }

  /// Fractions 0 … 1 of the parameter range at which the curve is cut into `count` parts with equal
  /// shares of that integral: equal lengths where it bends little. count + 1 values, the first 0
  /// and the last 1.
  std::vector<double> cut(int count, double pieceLength) const;

 private:
  /// The integral up to each sample.
  std::vector<double> density(double pieceLength) const;

  std::vector<double> fractions_;  // sample parameters, as fractions of the range
  std::vector<double> lengths_;    // arc length up to each sample
  std::vector<double> turns_;      // by how much the curve turns up to each sample, rad
};

}  // namespace palpa::modeling

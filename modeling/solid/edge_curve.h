#pragma once

#include <array>
#include <numbers>
#include <vector>

#include "modeling/solid/surface_evaluator.h"

// Edges of a solid as curves, and surface points named by patch and parameters.
namespace palpa::modeling {

/// Surface point, named by its patch and the parameters in the knot range of the patch.
struct SurfaceParameter {
  int patch = -1;
  double u = 0.0;
  double v = 0.0;
};

/// Point of a side at the fraction t (0 … 1) of the side's growing parameter.
SurfaceParameter onSide(const SurfaceEvaluator& surface, PatchEdge edge, double t);

/// Point of an edge at the fraction t (0 … 1) of the parameter of edge.uses[0], named in the patch
/// of edge.uses[use].
SurfaceParameter onEdge(const SurfaceEvaluator& surface, const SolidEdge& edge, int use, double t);

/// Largest turn of a piece of a curve, rad: a quarter of a circle gets three pieces.
inline constexpr double kPieceAngle = std::numbers::pi / 6.0;

/// Line of constant parameter of a patch, with its arc length (relative accuracy about 1e-6) and
/// its turning angle. `direction` is the varying parameter, `fixed` the value of the other
/// parameter.
class IsoCurve {
 public:
  IsoCurve(const SurfaceEvaluator& surface, int patch, int direction, double fixed);

  /// Arc length, mm.
  double length() const { return lengths_.back(); }

  /// Number of pieces of the given length (mm) along the curve, larger where they would turn by
  /// more than kPieceAngle: ∫ max(1 / pieceLength, κ / kPieceAngle) ds. Pieces are at least
  /// pieceLength / 64 long; kinks at knots are ignored.
  double pieces(double pieceLength) const { return density(pieceLength).back(); }

  /// Fractions 0 … 1 of the parameter range that divide the curve into `count` parts with equal
  /// shares of this integral (equal lengths where the curvature is small): count + 1 values, the
  /// first 0, the last 1.
  std::vector<double> cut(int count, double pieceLength) const;

 private:
  /// Integral of pieces() up to each sample.
  std::vector<double> density(double pieceLength) const;

  std::vector<double> fractions_;  // sample parameters, as fractions of the range
  std::vector<double> lengths_;    // arc length up to each sample
  std::vector<double> turns_;      // total turn of the curve up to each sample, rad
};

}  // namespace palpa::modeling

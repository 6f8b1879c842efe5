#pragma once

#include <array>
#include <optional>
#include <vector>

#include "modeling/measure/measured_surface.h"
#include "modeling/measure/patch_search.h"

// Edges of a solid as exact curves: tangents, curvatures, lengths. Internal to modeling/measure.
namespace palpa::modeling {

/// Geometry of the sides of patches as curves c(t), where t has the range of the patch's knots
/// along the side. Refers to the solid and the search, which must outlive it. Immutable; several
/// threads may use it.
class PatchEdges {
 public:
  PatchEdges(const Solid& solid, const PatchSearch& search) : solid_(solid), search_(search) {}

  /// Absolute error of curvatures, 1/mm: second derivatives are differences of control points.
  /// Smaller curvatures count as zero.
  double curvatureError() const { return 1e3 * kMeasuredRounding / search_.size(); }

  /// Parameters of the patch at t.
  Eigen::Vector2d uvOf(const PatchEdge& edge, double t) const;
  /// Position, tangent and curvature vector (c'' − (c''·t) t) / |c'|² of the curve c at t.
  EdgePoint pointAt(const PatchEdge& edge, double t) const;
  /// Nearest point of the curve, by Newton's method in one parameter from several points of each
  /// span. Exact to rounding.
  PatchPoint nearest(const PatchEdge& edge, const Eigen::Vector3d& x) const;
  /// Points of the curve, `pieces` + 1 per span; spans share their ends.
  std::vector<Eigen::Vector3d> line(const PatchEdge& edge, int pieces) const;

  /// Length and its error, mm: ∫ |c'| dt by Gauss points on quarters of the spans; the error is
  /// estimated by the difference to halves.
  struct Length {
    double value, error;
  };
  Length lengthOf(const PatchEdge& edge) const;
  /// Length of the chain of edges that continue an edge of the solid (its index) over its vertices
  /// without a corner, mm.
  double chainLength(int edge) const;

 private:
  /// Unit tangent of an edge at one of its vertices, pointing away from the vertex.
  Eigen::Vector3d away(int edge, int vertex) const;
  /// The edge that leaves a vertex in the direction in which another one arrives. Nothing for an
  /// edge inside a smooth surface: only sharp edges continue sharp ones.
  std::optional<int> continuation(int edge, int vertex) const;

  const Solid& solid_;
  const PatchSearch& search_;
};

}  // namespace palpa::modeling

#pragma once

#include "bem/model/boundary_mesh.h"
#include "bem/model/bulk.h"
#include "bem/model/triangle_tree.h"
#include "bem/problem/interior_evaluator.h"
#include "bem/triangle/interior_sources.h"

namespace palpa::bem {

/// Interior states of fields that are linear on triangles.
///
/// Integrals: rules of 3, 7 or 16 points by the distance over the size of a triangle, subdivision
/// of nearer ones: relative errors of about 1e-4 of the largest stress. Nearer to the surface than
/// kLayer times the size of a triangle, the stress of a piecewise linear field has kinks (it is
/// unbounded at edges), while its mean at the nodes converges: there the state is interpolated
/// between the surface and the end of the layer, along the line through the nearest surface point.
///
/// Mesh and slots must outlive it.
class TriangleInterior final : public InteriorEvaluator {
 public:
  /// Thickness of the layer over the size of a triangle, sqrt(2 area).
  static constexpr double kLayer = 0.25;

  /// `points`: inside the body, mm; others get the state of the nearest surface point. `layer`:
  /// other thicknesses are for measurements. Takes a few microseconds per point. Throws Cancelled.
  TriangleInterior(const BoundaryMesh& mesh, const TractionSlots& slots, const Bulk& bulk,
                   std::vector<Eigen::Vector3d> points, const Job& job, double layer = kLayer);

 private:
  std::vector<InteriorState> evaluateAll(const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                                         const Job& job) const override;

  /// Share of the state at an interior or surface point in a state.
  struct Part {
    double weight;
    int target;          ///< index into targets_; -1: surface point
    SurfacePoint place;  ///< without a target
  };
  /// Sources of a field without a body force: the particular state of the body force is subtracted
  /// at the sources and added at the points.
  void setSource(InteriorSources& sources, std::size_t index, const Eigen::Vector3d& y,
                 const Eigen::Vector3d& area, Eigen::Vector3d displacement,
                 Eigen::Vector3d force) const;
  struct Geometry {
    Eigen::Vector3d centroid, normal;
    double area, radius;
  };
  struct Fields;
  void resolve(const Eigen::Vector3d& x, double weight, int level, double layer,
               std::vector<Part>& parts, std::vector<Eigen::Vector3d>& targets) const;
  InteriorState sumAt(const Eigen::Vector3d& x, const Fields& fields,
                      InteriorSources& scratch) const;
  void addNear(int triangle, const Eigen::Vector3d& x, const Eigen::Matrix3d& cell, double part,
               int depth, const Fields& fields, InteriorSources& scratch, InteriorSums& sums) const;

  const BoundaryMesh& mesh_;
  const TractionSlots& slots_;
  Bulk bulk_;
  Eigen::Vector3d centre_;  // of the particular state of the body force, anywhere near the body
  InteriorConstants constants_;
  SumInterior sum_;
  TriangleTree tree_;
  std::vector<Geometry> triangles_;
  std::vector<Eigen::Vector3d> targets_;
  std::vector<std::vector<Part>> parts_;  // per point
};

}  // namespace palpa::bem

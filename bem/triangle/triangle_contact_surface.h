#pragma once

#include <span>
#include <vector>

#include "bem/contact/contact_surface.h"

namespace palpa::bem {

/// The surface of linear functions on triangles: neighbours, the search tree, the recovery weights.
///
/// Construction takes about 20 µs, storage 600 bytes per triangle.
class TriangleContactSurface final : public ContactSurface {
 public:
  TriangleContactSurface(const BoundaryMesh& mesh, const TractionSlots& slots,
                         const DegreesOfFreedom& dofs);

  const std::vector<Eigen::Vector3d>& places() const override { return mesh().nodes; }
  int coefficientAt(int meshNode) const override { return dofs().isFree(meshNode) ? meshNode : -1; }

  SurfacePoint at(int triangle, const Eigen::Vector3d& weights) const override {
    return {triangle, weights, mesh().point(triangle, weights), 0.0};
  }
  SurfacePoint nearest(const Eigen::Vector3d& x) const override { return tree().nearest(x); }
  /// Along the smooth normal. The nearest point of the triangles would stay at an edge while the
  /// tool moves by its height times the angle between the triangles, and then jump.
  SurfacePoint foot(const Eigen::Vector3d& tool, const SurfacePoint& start) const override;

  /// Interpolated from the corners' slots.
  Eigen::Vector3d normal(const SurfacePoint& point) const override;

  /// The triangle's edges become cubics as in DisplacementRecovery, so that smooth faces lie third
  /// instead of second order near it.
  Eigen::Vector3d smoothPosition(const SurfacePoint& point) const override;

  /// kMinWidth times the longest edges there, at which half the bump's height is as wide as that
  /// of a nodal basis function.
  static constexpr double kMinWidth = 1.25;
  double narrowestMask(const SurfacePoint& point) const override;
  double maskSpacing(const SurfacePoint& point) const override {
    return narrowestMask(point) / kMinWidth;
  }

  struct Weight {
    int node;
    double weight;
  };
  /// DisplacementRecovery::bulge() of the edge from a corner of a triangle to the next.
  std::span<const Weight> bulge(int triangle, int corner) const {
    const int edge = 3 * triangle + corner;
    return std::span(bulges_).subspan(
        static_cast<std::size_t>(firstBulge_[edge]),
        static_cast<std::size_t>(firstBulge_[edge + 1] - firstBulge_[edge]));
  }

  std::unique_ptr<ContactSurface::Workspace> makeWorkspace() const override;
  /// Cost: about 1 µs per node of the mask and some tens of µs.
  bool makeMask(const SurfacePoint& point, double radius, ContactSurface::Workspace& workspace,
                ContactMask& mask) const override;

  double strainEnergy(const Eigen::VectorXd& u, const Eigen::VectorXd& p) const override;

 private:
  struct Triangle {
    double area;
    double longestEdge;
  };
  class Workspace;
  void collectTriangles(const SurfacePoint& point, double radius, Workspace& work) const;
  void collectNodes(Workspace& work, std::vector<int>& nodes) const;
  double integrateBump(const SurfacePoint& point, double radius, Workspace& work) const;
  void project(Workspace& work, std::vector<double>& coefficients) const;
  void measure(Workspace& work, ContactMask& mask) const;

  std::vector<Triangle> triangles_;
  std::vector<int> firstOfNode_, ofNode_;  // triangles around each node
  std::vector<double> longestAt_;          // per node: longest edge of these
  std::vector<int> firstBulge_;            // per triangle and corner, into bulges_
  std::vector<Weight> bulges_;
};

}  // namespace palpa::bem

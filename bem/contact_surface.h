#pragma once
#include <span>
#include <vector>

#include "bem/boundary_conditions.h"
#include "bem/contact_mask.h"
#include "bem/triangle_tree.h"

namespace palpa::bem {

/// What contacts need to know of a body's surface, made once per model so that masks can be made a
/// thousand times a second: neighbours, the search tree, the recovery weights. Immutable; const use
/// from several threads is safe, each with a Workspace of its own. Mesh, slots and degrees of
/// freedom must outlive it.
///
/// Costs about 20 µs per triangle to make, 600 bytes per triangle to keep.
class ContactSurface {
 public:
  ContactSurface(const BoundaryMesh& mesh, const TractionSlots& slots,
                 const DegreesOfFreedom& dofs);

  const BoundaryMesh& mesh() const { return mesh_; }
  const TractionSlots& slots() const { return slots_; }
  const DegreesOfFreedom& dofs() const { return dofs_; }
  const TriangleTree& tree() const { return tree_; }

  /// Outward unit normal interpolated from the corners' slots: continuous along smooth faces.
  Eigen::Vector3d normal(const SurfacePoint& point) const;

  /// Where the body's true surface is at a point of a triangle: its edges become cubics as in
  /// DisplacementRecovery, so that smooth faces lie third instead of second order near it.
  Eigen::Vector3d smoothPosition(const SurfacePoint& point) const;

  /// The narrowest mask the mesh can carry at a point, mm: kNarrowest times the longest edges
  /// there, at which half the bump's height is as wide as that of a nodal basis function;
  /// continuous along the surface.
  static constexpr double kNarrowest = 1.25;
  double narrowestMask(const SurfacePoint& point) const;

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

  /// Memory that making masks needs; reused, so that nothing is allocated after the first few.
  class Workspace {
   public:
    explicit Workspace(const ContactSurface& surface);

   private:
    friend class ContactSurface;
    std::vector<unsigned> triangleStamp_, aroundStamp_, nodeStamp_, measureStamp_;
    unsigned stamp_ = 0;
    std::vector<int> touched_, around_, nodeIndex_, measureIndex_;
    std::vector<double> coefficients_;  // of the measure
    Eigen::Index count_ = 0;            // nodes of the mask
    // One number per node of the mask; longer than needed, so that they seldom grow.
    Eigen::VectorXd right_, residual_, search_, image_, diagonal_, fade_;
  };

  /// As makeContactMask(), into `mask`. False, with an empty mask, when supports hold all of the
  /// touched place. Cost: about 1 µs per node of the mask and some tens of µs.
  bool makeMask(const SurfacePoint& point, double radius, Workspace& workspace,
                ContactMask& mask) const;

 private:
  struct Triangle {
    double area;
    double longestEdge;
  };
  void collectTriangles(const SurfacePoint& point, double radius, Workspace& work) const;
  void collectNodes(Workspace& work, std::vector<int>& nodes) const;
  double integrateBump(const SurfacePoint& point, double radius, Workspace& work) const;
  void project(Workspace& work, std::vector<double>& coefficients) const;
  void measure(Workspace& work, ContactMask& mask) const;

  const BoundaryMesh& mesh_;
  const TractionSlots& slots_;
  const DegreesOfFreedom& dofs_;
  TriangleTree tree_;
  std::vector<Triangle> triangles_;
  std::vector<int> firstOfNode_, ofNode_;  // triangles around each node
  std::vector<double> longestAt_;          // per node: longest edge of these
  std::vector<int> firstBulge_;            // per triangle and corner, into bulges_
  std::vector<Weight> bulges_;
};

}  // namespace palpa::bem

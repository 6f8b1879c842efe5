#pragma once

#include <memory>
#include <vector>

#include "bem/contact/contact_mask.h"
#include "bem/model/boundary_conditions.h"
#include "bem/model/triangle_tree.h"

namespace palpa::bem {

/// What contacts need to know of a body's surface, made once per model so that masks can be made a
/// thousand times a second. Two kinds: TriangleContactSurface and SplineContactSurface. Places are
/// named by points of a triangle mesh; masks and fields are in the displacement coefficients of the
/// problem, which are nodes of that mesh or control points of splines. Immutable; const use from
/// several threads is safe, each with a Workspace of its own. What it was made of must outlive it.
class ContactSurface {
 public:
  virtual ~ContactSurface() = default;
  ContactSurface(const ContactSurface&) = delete;
  ContactSurface& operator=(const ContactSurface&) = delete;

  const BoundaryMesh& mesh() const { return mesh_; }
  /// Of the mesh.
  const TractionSlots& meshSlots() const { return meshSlots_; }
  const TriangleTree& tree() const { return tree_; }

  /// Of the problem: the traction coefficients of each displacement coefficient.
  const TractionSlots& slots() const { return slots_; }
  const DegreesOfFreedom& dofs() const { return dofs_; }
  /// Where each displacement coefficient weighs most, mm.
  virtual const std::vector<Eigen::Vector3d>& places() const = 0;
  /// The displacement coefficient that weighs most at a node of the mesh; -1 where a support holds
  /// it.
  virtual int coefficientAt(int meshNode) const = 0;

  /// A point of the surface by its name in the mesh.
  virtual SurfacePoint at(int triangle, const Eigen::Vector3d& weights) const = 0;
  /// The point of the surface nearest to `x`.
  virtual SurfacePoint nearest(const Eigen::Vector3d& x) const = 0;
  /// The surface point below a tool: where the line along the surface's normal goes through `tool`.
  /// Newton's method from `start`, a point near it such as the nearest one of the mesh; that
  /// point's surface only, so that at a sharp edge the foot stays where the face ends.
  virtual SurfacePoint foot(const Eigen::Vector3d& tool, const SurfacePoint& start) const = 0;

  /// The same point, by a name in that of the faces that meet there in a sharp edge whose normal is
  /// most along `direction`.
  SurfacePoint facing(const SurfacePoint& point, const Eigen::Vector3d& direction) const;

  /// Outward unit normal, continuous along smooth faces.
  virtual Eigen::Vector3d normal(const SurfacePoint& point) const = 0;
  /// Where the body's true surface is at a point, mm.
  virtual Eigen::Vector3d smoothPosition(const SurfacePoint& point) const = 0;

  /// The narrowest mask that the coefficients can carry at a point, mm; continuous along the
  /// surface.
  virtual double narrowestMask(const SurfacePoint& point) const = 0;
  /// The radius of the mask that carries one of `radius` (mm) at a point: `radius` where the
  /// coefficients can carry that, else the narrowest they can. It goes from the one to the other
  /// smoothly while the narrowest is at most a tenth wider than what is asked, and is narrower
  /// than that by up to 1.5 % there.
  double maskRadius(const SurfacePoint& point, double radius) const;
  /// How close masks beside each other may be placed there, mm: as the coefficients.
  virtual double maskSpacing(const SurfacePoint& point) const = 0;

  /// Memory that making masks needs; reused, so that nothing is allocated after the first few.
  class Workspace {
   public:
    virtual ~Workspace() = default;

   protected:
    Workspace() = default;
  };
  virtual std::unique_ptr<Workspace> makeWorkspace() const = 0;

  /// As makeContactMask(), into `mask`, with a workspace of this surface. False, with an empty
  /// mask, when supports hold all of the touched place.
  virtual bool makeMask(const SurfacePoint& point, double radius, Workspace& workspace,
                        ContactMask& mask) const = 0;

  /// Strain energy 1/2 ∫ p.u dΓ, mJ, of a field in coefficients.
  virtual double strainEnergy(const Eigen::VectorXd& u, const Eigen::VectorXd& p) const = 0;

 protected:
  ContactSurface(const BoundaryMesh& mesh, const TractionSlots& meshSlots,
                 const TractionSlots& slots, const DegreesOfFreedom& dofs);

 private:
  const BoundaryMesh& mesh_;
  const TractionSlots& meshSlots_;
  const TractionSlots& slots_;
  const DegreesOfFreedom& dofs_;
  TriangleTree tree_;
  std::vector<int>
      acrossSharpEdge_;  // per triangle and corner: of the edge to the next; -1: smooth
};

}  // namespace palpa::bem

#pragma once

#include <memory>
#include <vector>

#include "bem/contact/contact_mask.h"
#include "bem/model/boundary_conditions.h"
#include "bem/model/triangle_tree.h"

namespace palpa::bem {

/// Surface of a body for contacts, made once per model so that masks can be computed a thousand
/// times per second. Subclasses: TriangleContactSurface and SplineContactSurface. Surface points
/// are named by points of a triangle mesh; masks and fields are in the displacement coefficients of
/// the problem: nodes of that mesh, or control points of splines. Immutable; const use from several
/// threads is safe if each thread has its own Workspace. The objects that the surface was
/// constructed from must outlive it.
class ContactSurface {
 public:
  virtual ~ContactSurface() = default;
  ContactSurface(const ContactSurface&) = delete;
  ContactSurface& operator=(const ContactSurface&) = delete;

  const BoundaryMesh& mesh() const { return mesh_; }
  /// Slots of the mesh.
  const TractionSlots& meshSlots() const { return meshSlots_; }
  const TriangleTree& tree() const { return tree_; }

  /// Slots of the problem: the traction coefficients of each displacement coefficient.
  const TractionSlots& slots() const { return slots_; }
  const DegreesOfFreedom& dofs() const { return dofs_; }
  /// Position at which each displacement coefficient has the most weight, mm.
  virtual const std::vector<Eigen::Vector3d>& places() const = 0;
  /// Displacement coefficient with the most weight at a node of the mesh; -1 if a support fixes it.
  virtual int coefficientAt(int meshNode) const = 0;

  /// Surface point for a point of a mesh triangle with the barycentric coordinates `weights`.
  virtual SurfacePoint at(int triangle, const Eigen::Vector3d& weights) const = 0;
  /// Surface point nearest to `x` (mm).
  virtual SurfacePoint nearest(const Eigen::Vector3d& x) const = 0;
  /// Surface point below a tool: the point whose normal line passes through `tool` (mm). Newton's
  /// method from `start`, a nearby point such as the nearest point of the mesh. It stays on the
  /// smooth surface around `start`: at a sharp edge the foot stays on the border of the face.
  virtual SurfacePoint foot(const Eigen::Vector3d& tool, const SurfacePoint& start) const = 0;

  /// The same point, named by the face whose normal is most along `direction`, of the faces that
  /// meet at the point in a sharp edge.
  SurfacePoint facing(const SurfacePoint& point, const Eigen::Vector3d& direction) const;

  /// Outward unit normal, continuous along smooth faces.
  virtual Eigen::Vector3d normal(const SurfacePoint& point) const = 0;
  /// Position of a point on the true surface of the body, mm.
  virtual Eigen::Vector3d smoothPosition(const SurfacePoint& point) const = 0;

  /// Radius of the narrowest mask that the coefficients can represent at a point, mm; continuous
  /// along the surface.
  virtual double narrowestMask(const SurfacePoint& point) const = 0;
  /// Radius of the mask used at a point for a requested `radius` (mm): `radius` if the coefficients
  /// can represent it, otherwise the narrowest mask. The transition is smooth while the narrowest
  /// mask is at most a tenth wider than `radius`; there the result is smaller than the narrowest
  /// radius by up to 1.5 %.
  double maskRadius(const SurfacePoint& point, double radius) const;
  /// Smallest useful distance between adjacent masks at a point, mm: the spacing of the
  /// coefficients.
  virtual double maskSpacing(const SurfacePoint& point) const = 0;

  /// Memory for making masks, reused so that no memory is allocated after the first few masks.
  class Workspace {
   public:
    virtual ~Workspace() = default;

   protected:
    Workspace() = default;
  };
  virtual std::unique_ptr<Workspace> makeWorkspace() const = 0;

  /// Computes the mask of makeContactMask() in `mask`, with a workspace of this surface. Returns
  /// false and leaves an empty mask if supports fix the whole touched place.
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
  std::vector<int> acrossSharpEdge_;  // [3 triangle + corner]: next edge; -1: smooth
};

}  // namespace palpa::bem

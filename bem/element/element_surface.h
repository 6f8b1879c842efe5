#pragma once

#include <Eigen/Dense>
#include <optional>
#include <span>
#include <vector>

#include "bem/model/material.h"

namespace palpa::bem {

/// Surface point, given by an element and its local coordinates.
struct ElementPlace {
  int element;
  double u, v;
};

/// Position and first derivatives, mm per unit of the local coordinates.
struct SurfaceJet {
  Eigen::Vector3d position, du, dv;
  /// Outward; its length is the area per unit of the local coordinates.
  Eigen::Vector3d areaVector() const { return du.cross(dv); }
};

/// Surface point at which the boundary integral equation must hold.
struct CollocationPlace {
  Eigen::Vector3d position;          ///< mm
  std::vector<ElementPlace> places;  ///< in all elements that contain the point
};

/// Surface point and its distance from the query point, mm.
struct ElementFoot {
  ElementPlace place;
  double distance;
};

/// Surface point of a rule for integrals over the surface.
struct WeightedPlace {
  ElementPlace place;
  double weight;  ///< mm^2
};

/// Orthonormal tangents and outward normal of the surface near a place, and the derivatives of the
/// element's functions along the tangents. Where the surface metric is singular (the corner of a
/// round cap, a collapsed edge) they are evaluated slightly inside the element.
struct SurfaceTangents {
  Eigen::Vector3d position;  ///< mm, where they are evaluated
  Eigen::Matrix3d frame;     ///< columns: two tangents, the normal
  std::vector<double> values;
  std::vector<double> tractionValues;  ///< of the functions of tractions; empty: as `values`
  Eigen::Matrix2Xd slopes;             ///< one column per function of the element, 1/mm
};

/// Displacement (mm), its gradient (column j is the derivative along axis j) and Cauchy stress
/// (MPa) on the surface.
struct SurfaceState {
  Eigen::Vector3d position, displacement;
  Eigen::Matrix3d gradient, stress;
};

/// Closed surface of curved elements with outward normals, and the functions on them that carry
/// the fields: one displacement coefficient u_j per function N_j, and one traction coefficient p_s
/// per slot. Each element has a list of functions; `coefficients` and `slots` name the
/// coefficients that belong to them. Const use from several threads is safe.
class ElementSurface {
 public:
  virtual ~ElementSurface() = default;

  virtual int elementCount() const = 0;
  virtual int coefficientCount() const = 0;
  virtual int slotCount() const = 0;
  virtual const std::vector<int>& coefficients(int element) const = 0;
  virtual const std::vector<int>& slots(int element) const = 0;
  virtual double boundingSize() const = 0;  ///< of the body, mm

  virtual SurfaceJet evaluate(const ElementPlace& place) const = 0;
  /// Values of the element's functions at a place.
  virtual void evaluateBasis(const ElementPlace& place, std::vector<double>& values) const = 0;
  /// Values of the functions that carry the tractions: the same functions, except on elements
  /// beside the border of a support, where the functions of tractions are unbounded.
  virtual void evaluateTractionBasis(const ElementPlace& place, std::vector<double>& values) const {
    evaluateBasis(place, values);
  }
  /// Factors of an element's traction coefficients in sums over quadrature points, whose
  /// ElementPoints::tractionArea() contains the rest of their functions; empty: all are 1.
  virtual std::span<const double> tractionFactors(int /*element*/) const { return {}; }
  /// Displacement and traction coefficients of an element, one column per function in the tables
  /// of its quadrature points (ElementPoints): the functions of the element, except beside the
  /// border of a support; tractions times their factors.
  virtual Eigen::Matrix3Xd displacementsOfTable(int element, const Eigen::VectorXd& u) const;
  virtual Eigen::Matrix3Xd tractionsOfTable(int element, const Eigen::VectorXd& p) const;
  virtual SurfaceTangents tangents(const ElementPlace& place) const = 0;
  /// Point of an element nearest to x (mm). Exact for points on or near the element; otherwise
  /// possibly a local minimum.
  virtual ElementFoot nearestOnElement(int element, const Eigen::Vector3d& x) const = 0;
  /// Points of a coarse rule on an element, none of which is a collocation point.
  virtual void samplePlaces(int element, std::vector<WeightedPlace>& places) const = 0;
  /// Positive weights, one per function, of a value at a place in the mean of a quantity around
  /// each coefficient; they sum to 1.
  virtual void evaluateShares(const ElementPlace& place, std::vector<double>& shares) const {
    evaluateBasis(place, shares);
  }

  /// Tangential derivatives come from u; the others follow from the traction by Hooke's law, which
  /// is regular at nu = 0.5.
  SurfaceState state(const ElementPlace& place, const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                     const Material& material) const;
};

/// Σ w_f c_f of three-dimensional coefficients `all`, named by `indices`.
Eigen::Vector3d weightedSum(const std::vector<double>& weights, const std::vector<int>& indices,
                            const Eigen::VectorXd& all);

}  // namespace palpa::bem

#pragma once

#include <array>
#include <functional>
#include <vector>

#include "bem/element/element_surface.h"
#include "bem/model/boundary_mesh.h"
#include "bem/model/surface_point.h"
#include "bem/quadratic/border_coordinates.h"

namespace palpa::bem {

/// The root of the distance from the border of a support at which unbounded values are evaluated
/// instead of nearer to it, when a value at a point is wanted: 1 % of the element.
inline constexpr double kMinBorderRoot = 0.1;

/// The coefficient of a traction function at a node on the border is the traction that the function
/// alone would have at this root without its polynomial: at the next node.
inline constexpr double kBorderTractionRoot = 0.5;

/// Values of the six quadratic functions on a triangle at the barycentric coordinates (1 - u - v,
/// u, v): of the three corners, then of the middles of the edges 0-1, 1-2 and 2-0.
struct QuadraticBasis {
  std::array<double, 6> values, du, dv;

  QuadraticBasis(double u, double v);
};

/// Closed surface of curved six-node triangles with quadratic displacements and tractions. Const
/// use from several threads is safe.
class QuadraticSurface final : public ElementSurface {
 public:
  /// `mesh`: as quarteredMesh() makes it with these tags and `isPlain`; `slots`: of this mesh.
  /// Throws SolverError (kBadMesh) if an element is folded, std::invalid_argument if the mesh has
  /// another form. Mesh and slots may be destroyed afterwards.
  QuadraticSurface(const BoundaryMesh& mesh, const TractionSlots& slots,
                   const std::vector<int>& supportTags = {}, bool isPlain = false);

  int elementCount() const override { return static_cast<int>(elements_.size()); }
  int coefficientCount() const override { return static_cast<int>(nodes_.size()); }
  int slotCount() const override { return slotCount_; }
  const std::vector<int>& coefficients(int element) const override {
    return elements_[element].nodes;
  }
  const std::vector<int>& slots(int element) const override { return elements_[element].slots; }
  double boundingSize() const override { return boundingSize_; }
  SurfaceJet evaluate(const ElementPlace& place) const override;
  void evaluateBasis(const ElementPlace& place, std::vector<double>& values) const override;
  void evaluateTractionBasis(const ElementPlace& place, std::vector<double>& values) const override;
  std::span<const double> tractionFactors(int element) const override;
  SurfaceTangents tangents(const ElementPlace& place) const override;
  ElementFoot nearestOnElement(int element, const Eigen::Vector3d& x) const override;
  void samplePlaces(int element, std::vector<WeightedPlace>& places) const override;
  /// Linear functions on the quarters: the integrals of the corners' quadratic functions vanish on
  /// flat elements.
  void evaluateShares(const ElementPlace& place, std::vector<double>& shares) const override;

  const std::vector<Eigen::Vector3d>& nodes() const { return nodes_; }
  const BorderCoordinates& coordinates(int element) const { return elements_[element].coordinates; }
  /// True if the traction functions of an element are unbounded at the border of its support.
  bool hasBorderTractions(int element) const { return elements_[element].hasBorderTractions; }
  /// True if a node lies on the border of a support or a notch, where elements have
  /// BorderCoordinates.
  bool isOnBorder(int node) const { return isOnBorder_[node]; }
  /// Position as a polynomial in the geometric coordinates, which are the local ones except beside
  /// the border of a support: columns are the coefficients of 1, u, v,
  /// u^2, uv, v^2.
  using Polynomial = Eigen::Matrix<double, 3, 6>;
  const Polynomial& polynomial(int element) const { return elements_[element].polynomial; }
  Eigen::Vector3d position(const ElementPlace& place) const;
  /// Position and derivatives by the geometric coordinates.
  SurfaceJet geometricJet(int element, const Eigen::Vector2d& geometric) const;
  /// Elements that contain a node.
  const std::vector<int>& around(int node) const { return around_[node]; }
  /// Place of a node in one of its elements.
  ElementPlace placeOf(int node, int element) const;
  /// The node in all elements that contain it.
  CollocationPlace collocationAt(int node) const;
  /// Place of a point of the flat mesh.
  static ElementPlace place(int triangle, const Eigen::Vector3d& weights);
  /// Point of the flat mesh with the local coordinates of a place.
  static std::pair<int, Eigen::Vector3d> quarter(const ElementPlace& place);
  /// A surface point as a collocation point: in all elements that contain it.
  CollocationPlace placesAt(const ElementPlace& place) const;
  /// Calls visit(place, jet, weight in mm^2) at the points of a rule of degree 8 on the cells of an
  /// element: its division into cells^2 congruent ones in local coordinates.
  using Visit = std::function<void(const ElementPlace&, const SurfaceJet&, double)>;
  void visitPoints(int element, int cells, const Visit& visit) const;

 private:
  struct Element {
    std::vector<int> nodes, slots;
    Polynomial polynomial;
    BorderCoordinates coordinates;
    bool hasBorderTractions = false;
    std::array<double, 6> tractionFactors{};
  };
  void setCoordinates(const BoundaryMesh& mesh, const std::vector<int>& supportTags);

  std::vector<Eigen::Vector3d> nodes_;
  std::vector<Element> elements_;
  std::vector<std::vector<int>> around_;
  std::vector<bool> isOnBorder_;  ///< per node
  int slotCount_;
  double boundingSize_;
};

/// Slots with the mean normals of the curved elements instead of the flat triangles.
TractionSlots withCurvedNormals(TractionSlots slots, const QuadraticSurface& surface);

}  // namespace palpa::bem

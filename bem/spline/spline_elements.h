#pragma once

#include "bem/element/element_surface.h"
#include "bem/spline/spline_tractions.h"

namespace palpa::bem {

/// Spline surface and its traction slots as a surface of curved elements. Both must outlive it.
class SplineElements final : public ElementSurface {
 public:
  SplineElements(const SplineSurface& surface, const SplineTractions& tractions)
      : surface_(surface), tractions_(tractions) {}

  int elementCount() const override { return surface_.elementCount(); }
  int coefficientCount() const override { return surface_.coefficientCount(); }
  int slotCount() const override { return tractions_.slots.count(); }
  const std::vector<int>& coefficients(int element) const override {
    return surface_.functions(element);
  }
  const std::vector<int>& slots(int element) const override {
    return tractions_.ofFunction[element];
  }
  double boundingSize() const override { return surface_.boundingSize(); }
  SurfaceJet evaluate(const ElementPlace& place) const override { return surface_.evaluate(place); }
  void evaluateBasis(const ElementPlace& place, std::vector<double>& values) const override {
    surface_.evaluateBasis(place, values);
  }
  void evaluateTractionBasis(const ElementPlace& place,
                             std::vector<double>& values) const override {
    surface_.evaluateTractionBasis(place, values);
  }
  Eigen::Matrix3Xd displacementsOfTable(int element, const Eigen::VectorXd& u) const override;
  Eigen::Matrix3Xd tractionsOfTable(int element, const Eigen::VectorXd& p) const override;
  void evaluateShares(const ElementPlace& place, std::vector<double>& shares) const override;
  SurfaceTangents tangents(const ElementPlace& place) const override;
  ElementFoot nearestOnElement(int element, const Eigen::Vector3d& x) const override;
  void samplePlaces(int element, std::vector<WeightedPlace>& places) const override;

 private:
  const SplineSurface& surface_;
  const SplineTractions& tractions_;
};

}  // namespace palpa::bem

#pragma once

#include <array>
#include <memory>
#include <vector>

#include "app/core/model/touch_model.h"
#include "app/core/results/surface_quantity.h"
#include "modeling/mesh/display_mesh.h"

namespace palpa::app {

/// A model's surface for drawing: the exact surface of the solid, finer than the boundary mesh,
/// with displacements, colours and normals interpolated from the nodes. Points at sharp edges are
/// split, so that normals and colours may jump there. Immutable.
class DrawnBody {
 public:
  /// About 3 µs per point. Throws Cancelled.
  explicit DrawnBody(std::shared_ptr<const TouchModel> model,
                     const modeling::DisplaySettings& settings = {}, const Job& job = {});

  const TouchModel& model() const { return *model_; }
  /// Without displacements.
  const modeling::DisplayMesh& mesh() const { return mesh_; }
  /// Edges of triangles between two patches or on a sharp edge, as pairs of points.
  const std::vector<std::array<int, 2>>& borders() const { return borders_; }
  /// Per triangle: true if it lies in a support.
  const std::vector<bool>& isSupported() const { return isSupported_; }

  struct Shape {
    std::vector<Eigen::Vector3d> positions;
    std::vector<Eigen::Vector3d> normals;  ///< unit
    std::vector<double> sizes;             ///< lengths of the displacements (not scaled), mm
  };
  /// Writes the shape displaced by `scale` times `u`, the displacement coefficients of the model's
  /// discretisation, mm, with seven digits. Allocates nothing if `shape` has been used before.
  /// About 0.1 µs per point.
  void deform(const Eigen::Ref<const Eigen::VectorXd>& u, double scale, Shape& shape) const;
  /// Displacement of each point, mm.
  std::vector<Eigen::Vector3d> displacements(const Eigen::Ref<const Eigen::VectorXd>& u) const;

  /// Lengths of displacements().
  std::vector<double> displacementSizes(const Eigen::Ref<const Eigen::VectorXd>& u) const;

  /// One number per point; empty unless isOfField().
  /// Stresses take a few microseconds per node.
  std::vector<double> values(SurfaceQuantity quantity, const bem::BoundaryField& field) const;

  /// Cauchy stress per point, MPa.
  std::vector<Eigen::Matrix3d> stresses(const bem::BoundaryField& field) const;

  /// N/mm per point, from bem::StiffnessMap::compliances(): infinite on supports, NaN where it is
  /// not known yet.
  std::vector<double> stiffnesses(const std::vector<double>& compliances) const;

 private:
  /// Weights of displacement coefficients at places, row by row. Single precision, because every
  /// frame reads all of them: with splines 16 per place.
  class Weights {
   public:
    Weights() = default;
    explicit Weights(const bem::Discretisation::Weights& weights);
    /// x, y, z and a zero per coefficient, so that a sum takes whole registers.
    using Coefficients = Eigen::Matrix<float, 4, Eigen::Dynamic>;
    Eigen::Vector3d at(std::size_t place, const Coefficients& u) const {
      Eigen::Vector4f sum = Eigen::Vector4f::Zero();
      for (int k = first_[place]; k < first_[place + 1]; ++k)
        sum += value_[static_cast<std::size_t>(k)] * u.col(column_[static_cast<std::size_t>(k)]);
      return sum.head<3>().cast<double>();
    }

   private:
    std::vector<int> first_{0}, column_;
    std::vector<float> value_;
  };
  /// `u` in the form that Weights takes, in thread-local memory.
  static const Weights::Coefficients& coefficients(const Eigen::Ref<const Eigen::VectorXd>& u);
  /// Normals of the flat triangles at the sides of the nodes, weighted by area.
  void sideNormals(const Weights::Coefficients& u, double scale,
                   std::vector<Eigen::Vector3d>& normals) const;
  /// Value at a point from one value per side.
  template <class Value>
  Value atSides(std::size_t point, const std::vector<Value>& values) const;
  /// Value at each point from one value per slot: the mean over the slots on its side.
  template <class Value>
  std::vector<Value> fromSlots(const std::vector<Value>& ofSlot) const;
  void findBorders();

  std::shared_ptr<const TouchModel> model_;
  modeling::DisplayMesh mesh_;
  Weights atPoints_, atNodes_;
  /// Sides of the nodes: one for every smoothing group that meets at a node. Quantities that jump
  /// at sharp edges have one value per side.
  std::vector<std::array<int, 3>> sideOfCorner_;  // per boundary triangle
  std::vector<int> sideOfSlot_;
  int sideCount_ = 0;
  std::vector<Eigen::Vector3d> normalsAtRest_;  // per side
  std::vector<std::array<int, 2>> borders_;
  std::vector<bool> isSupported_;
};

}  // namespace palpa::app

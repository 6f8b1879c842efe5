#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

#include "modeling/project/project.h"

namespace palpa::app {

/// Motions of control points that a design allows, as a linear map of design variables y, mm: one
/// variable per point (along its normal or a direction) or three, one per point and its mirror
/// images. Neighbours move together: the map filters the variables over the control nets by
/// (I + c L)⁻¹ with the graph Laplacian L (vertex morphing: Bletzinger, Struct. Multidisc. Optim.
/// 56, 2017), scaled such that |y| <= limit() implies the largest movement. Tangent planes across
/// smooth edges are kept to first order. docs/theory.md, "Searching for a shape". Immutable; const
/// use from several threads is safe.
class DesignSpace {
 public:
  /// Throws ModelingError (with the path in the project file) for a mesh body, for a selection that
  /// selects nothing or mirror planes about which the points are not symmetric.
  DesignSpace(const modeling::Project& project, const modeling::Design& design);

  int variableCount() const { return static_cast<int>(variables_.size()); }
  /// Largest movement of a control point in each variable, mm.
  double limit() const { return limit_; }
  /// Control points that may move, ascending.
  const std::vector<int>& points() const { return points_; }
  const modeling::Solid& solid() const { return solid_; }

  /// Displacements of all control points, mm, one column each.
  Eigen::Matrix3Xd displacement(const Eigen::VectorXd& y) const;
  /// Derivative by y of a measure with this derivative by the control points.
  Eigen::VectorXd pullBack(const Eigen::Matrix3Xd& gradient) const;

  struct Moved {
    std::vector<Eigen::Vector3d> points;  ///< of all control points, mm
    Eigen::VectorXd y;                    ///< scaled back where a point would move too far
    double largestMovement = 0;           ///< mm
  };
  /// The control points at y. Smooth edges are restored to rounding where the nets allow it. Throws
  /// ModelingError if that would move points that may not move, or if the solid is inside out.
  Moved moved(const Eigen::VectorXd& y) const;

 private:
  using Sparse = Eigen::SparseMatrix<double>;
  struct Variable {
    int axis;     ///< variables of neighbours with the same axis are smoothed together; -1: none
    double size;  ///< number of mirror images
  };
  struct Entry {
    int point, variable;
    Eigen::Vector3d direction;
  };
  void addVariables(const modeling::Design& design);
  void makeFilter(double smoothness);
  void makeTangents();

  modeling::Solid solid_;
  double limit_ = 0;
  std::vector<int> points_, stays_;
  std::vector<Variable> variables_;
  std::vector<Entry> entries_;
  Eigen::SimplicialLDLT<Sparse> filter_, tangents_;
  Eigen::VectorXd sizes_, scale_;
  std::vector<int> freeOf_;  ///< per control point: its row in tangents_, -1 for others
  bool hasTangents_ = false;
};

}  // namespace palpa::app

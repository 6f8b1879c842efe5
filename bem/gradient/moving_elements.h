#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

#include "bem/element/element_surface.h"
#include "bem/quadratic/quadratic_surface.h"
#include "bem/spline/spline_surface.h"

namespace palpa::bem {

/// Functions that interpolate the position of an element, and so its motion, between material
/// points: y = Σ_k φ_k(c) X_k in two coordinates c of the element. Const use from several threads
/// is safe.
class MovingElements {
 public:
  virtual ~MovingElements() = default;

  struct Functions {
    Eigen::VectorXd value, du, dv;  ///< φ_k and their derivatives by the coordinates
  };
  /// Number of all material points.
  virtual int pointCount() const = 0;
  /// X_k of an element, mm, one column each.
  virtual Eigen::Matrix3Xd positions(int element) const = 0;
  /// Coordinates of a point of a rule from the values of the element's functions there
  /// (ElementPoints), and of a place.
  virtual Eigen::Vector2d coordinates(int element, const Eigen::VectorXd& values) const = 0;
  virtual Eigen::Vector2d coordinates(const ElementPlace& place) const = 0;
  virtual void evaluate(int element, const Eigen::Vector2d& at, Functions& functions) const = 0;
  /// Adds derivatives by X_k, one column per function, to derivatives by the material points.
  virtual void addTo(int element, const Eigen::Matrix3Xd& byFunctions,
                     Eigen::Matrix3Xd& byPoints) const = 0;
};

/// Elements of splines: tensor Lagrange functions of the patch's degree on the knot rectangle of
/// each element, whose nodes are the material points. Coordinates run from -1 to 1.
class MovingSplines final : public MovingElements {
 public:
  explicit MovingSplines(const SplineSurface& surface);

  /// Patch and parameters of a material point.
  struct Place {
    int patch;
    Eigen::Vector2d parameters;
  };
  const std::vector<Place>& places() const { return places_; }

  int pointCount() const override { return static_cast<int>(places_.size()); }
  Eigen::Matrix3Xd positions(int element) const override;
  Eigen::Vector2d coordinates(int element, const Eigen::VectorXd& values) const override;
  Eigen::Vector2d coordinates(const ElementPlace& place) const override;
  void evaluate(int element, const Eigen::Vector2d& at, Functions& functions) const override;
  void addTo(int element, const Eigen::Matrix3Xd& byFunctions,
             Eigen::Matrix3Xd& byPoints) const override;

 private:
  struct Element {
    int first;                     ///< material point
    Eigen::Vector2d middle, half;  ///< of the rectangle, in patch parameters
    Eigen::Matrix2Xd greville;     ///< of the functions of the net, in coordinates
  };
  struct Lagrange {
    std::vector<double> nodes;
    void evaluate(double at, double* values, double* slopes) const;
  };
  int degree(int element, int direction) const;
  Eigen::Vector2d inElement(int element, const Eigen::Vector2d& parameters) const;

  const SplineSurface& surface_;
  std::vector<Element> elements_;
  std::vector<Place> places_;
  std::array<Lagrange, kMaxSplineDegree + 1> lagrange_;  ///< by degree
};

/// Quadratic triangles, and flat ones as such: the material points are the nodes of the surface.
class MovingTriangles final : public MovingElements {
 public:
  explicit MovingTriangles(const QuadraticSurface& surface) : surface_(surface) {}

  int pointCount() const override { return surface_.coefficientCount(); }
  Eigen::Matrix3Xd positions(int element) const override;
  Eigen::Vector2d coordinates(int element, const Eigen::VectorXd& values) const override;
  Eigen::Vector2d coordinates(const ElementPlace& place) const override;
  void evaluate(int element, const Eigen::Vector2d& at, Functions& functions) const override;
  void addTo(int element, const Eigen::Matrix3Xd& byFunctions,
             Eigen::Matrix3Xd& byPoints) const override;

 private:
  /// X_k of an element from its nodes: column k has the weights of X_k.
  Eigen::Matrix<double, 6, 6> combination(int element) const;
  const QuadraticSurface& surface_;
};

}  // namespace palpa::bem

#pragma once

#include <Eigen/Dense>

namespace palpa::bem {

/// Local coordinates of a quadratic triangle beside the border between a support and a free part of
/// the surface. At a distance rho from such a border displacements vary like sqrt(rho) and the
/// support's tractions like 1 / sqrt(rho) (Williams 1952). The functions of the element are
/// polynomials in local coordinates (u, v) whose barycentric coordinates mu = (1 - u - v, u, v)
/// contain the root s of the relative distance; its position is a polynomial in geometric
/// coordinates with the barycentric coordinates lambda:
///
///   edge on the border, apex a:  s = mu_a,      lambda_a = s^2,     lambda_i = (1 + s) mu_i
///   vertex k on the border:      s = 1 - mu_k,  lambda_k = 1 - s^2, lambda_i = s mu_i
///
/// On edges of the element both are the same: lambda = mu^2 from a border vertex. This is the map
/// of the flat quarter-point triangle (Barsoum 1976) with a curved surface; the surface keeps its
/// accuracy. `geometric` and `local` stand for (second, third) barycentric coordinates.
class BorderCoordinates {
 public:
  /// An element away from borders: the coordinates are equal.
  BorderCoordinates() = default;
  /// `apex`: corner opposite to the edge on the border.
  static BorderCoordinates edge(int apex) { return {Kind::kEdge, apex}; }
  static BorderCoordinates vertex(int corner) { return {Kind::kVertex, corner}; }

  bool isPlain() const { return kind_ == Kind::kPlain; }
  /// s at local coordinates: 0 on the border; 1 in a plain element.
  double root(const Eigen::Vector2d& local) const;
  Eigen::Vector2d geometric(const Eigen::Vector2d& local) const;
  /// Derivatives of the geometric by the local coordinates; singular where s = 0.
  Eigen::Matrix2d derivative(const Eigen::Vector2d& local) const;
  /// Values at many points; `determinant`: of the derivatives.
  struct Mapped {
    Eigen::ArrayXd u, v, determinant, root;
  };
  /// Sets the geometric coordinates (u, v) of local coordinates (u, v), and the other values there.
  void map(const Eigen::Ref<const Eigen::ArrayXd>& u, const Eigen::Ref<const Eigen::ArrayXd>& v,
           Mapped& mapped) const;
  Eigen::Vector2d local(const Eigen::Vector2d& geometric) const;
  /// The point itself, or one farther from the border with the root `least`, in (0, 1).
  Eigen::Vector2d awayFromBorder(const Eigen::Vector2d& local, double least) const;

 private:
  enum class Kind { kPlain, kEdge, kVertex };
  BorderCoordinates(Kind kind, int corner) : kind_(kind), corner_(corner) {}
  Kind kind_ = Kind::kPlain;
  int corner_ = 0;
};

}  // namespace palpa::bem

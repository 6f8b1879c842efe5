#pragma once

#include <Eigen/Dense>
#include <functional>
#include <memory>
#include <vector>

#include "base/byte_stream.h"

namespace palpa::bem {

/// Function of the position (mm): negative inside a part of the surface, positive outside, zero on
/// the border. Like a distance it changes by at most 1 mm per mm.
using LevelFunction = std::function<double(const Eigen::Vector3d&)>;

/// Border of a support that runs through patches, with the weight that its singularity has.
///
/// At a distance ρ from such a border displacements vary like √ρ and the support's tractions like
/// 1/√ρ, times smooth functions (Williams 1952). The weight w = √(1 - (1 - ρ/width)⁴) varies like
/// √ρ at the border and is 1 beyond the width, with three continuous derivatives.
struct CutBorder {
  LevelFunction level;
  double width;  ///< mm

  /// ρ over the width at x (mm), without sign.
  double distance(const Eigen::Vector3d& x) const { return std::abs(level(x)) / width; }
  static double weight(double distance);
  static double slope(double distance);  ///< derivative of the weight; infinite at 0
};

/// Functions of a spline element beside such a border, made of the N_j of its patch ("net
/// functions").
///
/// Functions belong to the side of the border on which their Greville point lies. On the other side
/// they are replaced by extrapolation from functions that belong there, as with Höllig's weighted
/// extended B-splines (Höllig 2003), so that no function has an arbitrarily small part. On the free
/// side, with the coefficients c of functions that belong there and the displacements d of the
/// support,
///   u = w Σ_j N_j c_j + (1 - w) Σ_j N_j d_j,
/// which is continuous across the border and contains all translations; in the support u = Σ_j N_j
/// d_j and p = Σ_j N_j p_j / w. Extrapolated c_j, d_j, p_j are linear combinations: matrices.
///
/// Sums over quadrature points use a table with the net functions times w and, behind them, the
/// functions of the displacements d; reduce() turns these into the element's functions.
struct BorderFunctions {
  bool isSupport = false;
  /// True if w < 1 somewhere on the element; otherwise the table has the plain net functions.
  bool isWeighted = false;
  Eigen::MatrixXd own;  ///< (coefficient, net function): belonging to the element's side
  /// Displacements of a support around a free element.
  struct Other {
    int border;  ///< index into `borders`
    Eigen::MatrixXd ofNet;
  };
  std::vector<Other> others;
  std::shared_ptr<const std::vector<CutBorder>> borders;
  int ownBorder = 0;  ///< of a support
  /// Distances over widths at nine points of the element, by which elements are compared.
  std::vector<double> samples;

  int netCount() const { return static_cast<int>(own.cols()); }
  int ownCount() const { return static_cast<int>(own.rows()); }
  int otherCount() const;
  int tableCount() const { return netCount() + otherCount(); }
  int count() const { return ownCount() + otherCount(); }

  /// w at x (mm).
  double weight(const Eigen::Vector3d& x) const;
  /// Turns the net functions at the beginning of `table` into the table; returns w.
  double fillTable(const Eigen::Vector3d& x, double* table) const;
  /// Values of the element's functions from the table.
  void reduce(const double* table, double* values) const;
  /// Values of the functions that carry tractions, from plain net functions. Weights in supports
  /// below `leastWeight` are replaced by it.
  void tractionValues(const Eigen::Vector3d& x, const double* net, double leastWeight,
                      double* values) const;
  /// Turns the derivatives `slopes` of the net functions `net` along `tangent` (mm per unit) into
  /// the derivatives of the element's functions. Nearer to a border than a hundredth of the width,
  /// where derivatives are unbounded, the weight is taken from there.
  void jet(const Eigen::Vector3d& x, const Eigen::Vector3d& tangent, const std::vector<double>& net,
           std::vector<double>& slopes) const;
  /// Matrices from coefficients of the element to coefficients of the table, for displacements and
  /// for tractions.
  Eigen::MatrixXd displacementsOfTable() const;
  Eigen::MatrixXd tractionsOfTable() const;

  bool hasSameFunctions(const BorderFunctions& other) const;
  /// Writes all data byte by byte, for a hash.
  void write(const ByteSink& sink) const;

 private:
  /// Shares of the supports in the displacements on a free element; they sum to 1.
  double share(const Other& other, const Eigen::Vector3d& x) const;
};

}  // namespace palpa::bem

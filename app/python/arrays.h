#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "app/python/errors.h"

// numpy arrays of points and matrices. All arrays are copies.
namespace palpa::python {

/// Argument that numpy converts to a C-ordered array of doubles.
using Numbers = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// An array of shape (n, 3). Throws ArgumentError that begins with `name` for any other shape.
inline std::vector<Eigen::Vector3d> vectorsOf(const Numbers& numbers, const char* name) {
  if (numbers.ndim() != 2 || numbers.shape(1) != 3)
    throw ArgumentError(std::string(name) + ": expected an array of shape (n, 3)");
  std::vector<Eigen::Vector3d> vectors(static_cast<std::size_t>(numbers.shape(0)));
  for (pybind11::ssize_t k = 0; k < numbers.shape(0); ++k)
    vectors[static_cast<std::size_t>(k)] = Eigen::Map<const Eigen::Vector3d>(numbers.data(k, 0));
  return vectors;
}

/// Three numbers.
inline Eigen::Vector3d vectorOf(const Numbers& numbers, const char* name) {
  if (numbers.size() != 3 || numbers.ndim() != 1)
    throw ArgumentError(std::string(name) + ": expected three numbers");
  return Eigen::Map<const Eigen::Vector3d>(numbers.data());
}

inline pybind11::array_t<double> arrayOf(const Eigen::Vector3d& vector) {
  return pybind11::array_t<double>({3}, vector.data());
}

inline pybind11::array_t<double> arrayOf(const Eigen::VectorXd& vector) {
  return pybind11::array_t<double>({vector.size()}, vector.data());
}

/// One row of three numbers per column.
inline pybind11::array_t<double> rowsOf(const Eigen::Matrix3Xd& columns) {
  return pybind11::array_t<double>({columns.cols(), Eigen::Index{3}}, columns.data());
}

inline pybind11::array_t<double> rowsOf(const std::vector<Eigen::Vector3d>& vectors) {
  static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double));
  return pybind11::array_t<double>(
      {static_cast<pybind11::ssize_t>(vectors.size()), pybind11::ssize_t{3}},
      vectors.empty() ? nullptr : vectors.front().data());
}

/// A symmetric matrix, or one whose columns are wanted as rows.
inline pybind11::array_t<double> transposedOf(const Eigen::MatrixXd& matrix) {
  return pybind11::array_t<double>({matrix.cols(), matrix.rows()}, matrix.data());
}

}  // namespace palpa::python

#include "bem/gradient/moving_elements.h"

#include <cmath>
#include <numbers>

namespace palpa::bem {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::Vector2d;
using Eigen::VectorXd;

void MovingSplines::Lagrange::evaluate(double at, double* values, double* slopes) const {
  const std::size_t count = nodes.size();
  for (std::size_t k = 0; k < count; ++k) {
    double value = 1, slope = 0;
    for (std::size_t j = 0; j < count; ++j) {
      if (j == k) continue;
      const double inverse = 1 / (nodes[k] - nodes[j]), factor = (at - nodes[j]) * inverse;
      slope = slope * factor + value * inverse;
      value *= factor;
    }
    values[k] = value;
    slopes[k] = slope;
  }
}

MovingSplines::MovingSplines(const SplineSurface& surface) : surface_(surface) {
  // Chebyshev-Lobatto nodes.
  for (int p = 1; p <= kMaxSplineDegree; ++p)
    for (int k = 0; k <= p; ++k) lagrange_[p].nodes.push_back(-std::cos(std::numbers::pi * k / p));
  for (int e = 0; e < surface.elementCount(); ++e) {
    const SplineElement& shape = surface.elements()[e];
    const SplinePatch& patch = surface.patches()[shape.patch];
    Element element;
    element.first = pointCount();
    for (int d = 0; d < 2; ++d) {
      const auto& span = patch.basis[d].spans()[shape.span[d]];
      element.middle[d] = (span.lower + span.upper) / 2;
      element.half[d] = (span.upper - span.lower) / 2;
    }
    const int nu = degree(e, 0) + 1, nv = degree(e, 1) + 1;
    element.greville.resize(2, static_cast<Index>(nu) * nv);
    for (int j = 0; j < nv; ++j)
      for (int i = 0; i < nu; ++i) {
        const Vector2d greville(
            patch.basis[0].greville(patch.basis[0].spans()[shape.span[0]].first + i),
            patch.basis[1].greville(patch.basis[1].spans()[shape.span[1]].first + j));
        element.greville.col(i + static_cast<Index>(nu) * j) =
            (greville - element.middle).cwiseQuotient(element.half);
        const Vector2d node(lagrange_[nu - 1].nodes[i], lagrange_[nv - 1].nodes[j]);
        places_.push_back({shape.patch, element.middle + element.half.cwiseProduct(node)});
      }
    elements_.push_back(std::move(element));
  }
}

int MovingSplines::degree(int element, int direction) const {
  return surface_.patches()[surface_.elements()[element].patch].basis[direction].degree();
}

Vector2d MovingSplines::inElement(int element, const Vector2d& parameters) const {
  return (parameters - elements_[element].middle).cwiseQuotient(elements_[element].half);
}

Matrix3Xd MovingSplines::positions(int element) const {
  Matrix3Xd positions(3, elements_[element].greville.cols());
  for (Index k = 0; k < positions.cols(); ++k)
    positions.col(k) =
        surface_.positionAt(element, places_[elements_[element].first + k].parameters);
  return positions;
}

// B-splines reproduce the parameters: (u, v) = Σ greville_j N_j. Beside the border of a support the
// first functions of the table are N_j times a weight.
Vector2d MovingSplines::coordinates(int element, const VectorXd& values) const {
  const Eigen::Matrix2Xd& greville = elements_[element].greville;
  const auto net = values.head(greville.cols());
  return greville * net / net.sum();
}

Vector2d MovingSplines::coordinates(const ElementPlace& place) const {
  return inElement(place.element, surface_.parameters(place).parameters);
}

void MovingSplines::evaluate(int element, const Vector2d& at, Functions& functions) const {
  const int nu = degree(element, 0) + 1, nv = degree(element, 1) + 1;
  double u[kMaxSplineDegree + 1], v[kMaxSplineDegree + 1], slopeU[kMaxSplineDegree + 1],
      slopeV[kMaxSplineDegree + 1];
  lagrange_[nu - 1].evaluate(at[0], u, slopeU);
  lagrange_[nv - 1].evaluate(at[1], v, slopeV);
  const Index count = static_cast<Index>(nu) * nv;
  functions.value.resize(count);
  functions.du.resize(count);
  functions.dv.resize(count);
  for (int j = 0, k = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i, ++k) {
      functions.value[k] = u[i] * v[j];
      functions.du[k] = slopeU[i] * v[j];
      functions.dv[k] = u[i] * slopeV[j];
    }
}

void MovingSplines::addTo(int element, const Matrix3Xd& byFunctions, Matrix3Xd& byPoints) const {
  byPoints.middleCols(elements_[element].first, byFunctions.cols()) += byFunctions;
}

Eigen::Matrix<double, 6, 6> MovingTriangles::combination(int element) const {
  Eigen::Matrix<double, 6, 6> weights = Eigen::Matrix<double, 6, 6>::Identity();
  const std::vector<int>& nodes = surface_.coefficients(element);
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const bool from = surface_.isOnBorder(nodes[k]), to = surface_.isOnBorder(nodes[next]);
    if (from == to) continue;
    // The node lies at a quarter of the edge from the border; X is the middle of the quadratic
    // curve through border, node and end.
    weights.col(3 + k).setZero();
    weights(from ? k : next, 3 + k) = -0.5;
    weights(3 + k, 3 + k) = 4.0 / 3;
    weights(from ? next : k, 3 + k) = 1.0 / 6;
  }
  return weights;
}

Matrix3Xd MovingTriangles::positions(int element) const {
  const std::vector<int>& nodes = surface_.coefficients(element);
  Matrix3Xd positions(3, 6);
  for (int k = 0; k < 6; ++k) positions.col(k) = surface_.nodes()[nodes[k]];
  return positions * combination(element);
}

Vector2d MovingTriangles::coordinates(int element, const VectorXd& values) const {
  // The quadratic functions reproduce the local coordinates.
  const Vector2d local(values[1] + (values[3] + values[4]) / 2,
                       values[2] + (values[4] + values[5]) / 2);
  return surface_.coordinates(element).geometric(local);
}

Vector2d MovingTriangles::coordinates(const ElementPlace& place) const {
  return surface_.coordinates(place.element).geometric({place.u, place.v});
}

void MovingTriangles::evaluate(int /*element*/, const Vector2d& at, Functions& functions) const {
  const QuadraticBasis basis(at[0], at[1]);
  functions.value = Eigen::Map<const Eigen::Matrix<double, 6, 1>>(basis.values.data());
  functions.du = Eigen::Map<const Eigen::Matrix<double, 6, 1>>(basis.du.data());
  functions.dv = Eigen::Map<const Eigen::Matrix<double, 6, 1>>(basis.dv.data());
}

void MovingTriangles::addTo(int element, const Matrix3Xd& byFunctions, Matrix3Xd& byPoints) const {
  const Matrix3Xd byNodes = byFunctions * combination(element).transpose();
  const std::vector<int>& nodes = surface_.coefficients(element);
  for (int k = 0; k < 6; ++k) byPoints.col(nodes[k]) += byNodes.col(k);
}

}  // namespace palpa::bem

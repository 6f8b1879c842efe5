#include "bem/spline/spline_contact_elements.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/parallel.h"
#include "bem/base/gauss_rule.h"

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Gauss points of an element per narrowest radius: the integrals of bumps have errors of about
/// 1e-3 and are as smooth as the bumps (once differentiable) when these slide.
constexpr double kPointsPerRadius = 10;
/// Weight of the non-constant part of a polynomial over the whole knot rectangle, used where only a
/// piece of the rectangle is approximated: polynomials that are small on the piece are large
/// elsewhere.
constexpr double kSmoothing = 1e-3;

/// Values at the points of a rule on an element: rows are points.
struct Points {
  Eigen::MatrixX3d positions;
  VectorXd weights;  ///< mm^2
  MatrixXd basis;  ///< [point][function of the list; functions with equal coefficients are summed]
};

/// `list`: the distinct coefficients of the element; `indices`: the index of each function in it.
Points pointsOf(const SplineSurface& surface, int index, const std::array<int, 2>& counts,
                Index size, const std::vector<int>& indices) {
  const SplineElement& element = surface.elements()[index];
  const GaussRule &u = gaussRule(counts[0]), &v = gaussRule(counts[1]);
  const Index count = static_cast<Index>(counts[0]) * counts[1];
  const double width = element.upper[0] - element.lower[0];
  const double height = element.upper[1] - element.lower[1];
  Points result{Eigen::MatrixX3d(count, 3), VectorXd(count), MatrixXd::Zero(count, size)};
  std::vector<double> basis;
  Index row = 0;
  for (int j = 0; j < counts[1]; ++j)
    for (int i = 0; i < counts[0]; ++i, ++row) {
      const ElementPlace place{index, element.lower[0] + width * u.points[i],
                               element.lower[1] + height * v.points[j]};
      const SurfaceJet jet = surface.evaluate(place);
      surface.evaluateBasis(place, basis);
      result.positions.row(row) = jet.position.transpose();
      result.weights[row] = jet.areaVector().norm() * width * height * u.weights[i] * v.weights[j];
      for (std::size_t f = 0; f < basis.size(); ++f) result.basis(row, indices[f]) += basis[f];
    }
  return result;
}

/// Matrix of ∫ (f - mean f)^2 dΓ over the knot rectangle of a cut element.
MatrixXd variance(const SplineSurface& surface, int index, Index size,
                  const std::vector<int>& indices) {
  const SplineElement& element = surface.elements()[index];
  const SplinePatch& patch = surface.patches()[element.patch];
  const auto& spanU = patch.basis[0].spans()[element.span[0]];
  const auto& spanV = patch.basis[1].spans()[element.span[1]];
  // The area per unit of the parameters hardly varies within the rectangle; only its size matters.
  const SurfaceJet jet = surface.evaluate({index, 0.5, 0.5});
  const double scale =
      jet.areaVector().norm() / surface.parameters({index, 0.5, 0.5}).derivative.determinant();
  const double area = scale * (spanU.upper - spanU.lower) * (spanV.upper - spanV.lower);
  const GaussRule &u = gaussRule(patch.basis[0].degree() + 1),
                  &v = gaussRule(patch.basis[1].degree() + 1);
  MatrixXd mass = MatrixXd::Zero(size, size);
  VectorXd mean = VectorXd::Zero(size), values(size);
  std::vector<double> basis;
  for (std::size_t j = 0; j < v.points.size(); ++j)
    for (std::size_t i = 0; i < u.points.size(); ++i) {
      surface.evaluateBasis(index,
                            {spanU.lower + (spanU.upper - spanU.lower) * u.points[i],
                             spanV.lower + (spanV.upper - spanV.lower) * v.points[j]},
                            basis);
      values.setZero();
      for (std::size_t f = 0; f < basis.size(); ++f) values[indices[f]] += basis[f];
      mass += u.weights[i] * v.weights[j] * values * values.transpose();
      mean += u.weights[i] * v.weights[j] * values;
    }
  return area * (mass - mean * mean.transpose());
}

/// Lengths of an element along its coordinates, mm.
std::array<double, 2> lengths(const SplineSurface& surface, int index) {
  const SplineElement& element = surface.elements()[index];
  const double width = element.upper[0] - element.lower[0];
  const double height = element.upper[1] - element.lower[1];
  std::array<double, 2> longest{};
  for (const double v : {0.1, 0.5, 0.9})
    for (const double u : {0.1, 0.5, 0.9}) {
      const SurfaceJet jet =
          surface.evaluate({index, element.lower[0] + u * width, element.lower[1] + v * height});
      longest[0] = std::max(longest[0], width * jet.du.norm());
      longest[1] = std::max(longest[1], height * jet.dv.norm());
    }
  return longest;
}

}  // namespace

SplineContactElements::SplineContactElements(const SplineSurface& surface,
                                             const SplineTractions& tractions,
                                             const std::vector<double>& narrowest) {
  elements_.resize(surface.elements().size());
  connectCells(surface);
  constexpr int kElementsPerTask = 8;
  parallelFor((count() + kElementsPerTask - 1) / kElementsPerTask, {}, [&](std::ptrdiff_t task) {
    const auto begin = static_cast<int>(task) * kElementsPerTask;
    for (int e = begin; e < std::min(count(), begin + kElementsPerTask); ++e)
      fill(surface, tractions, e, narrowest);
  });
  setAround(surface.coefficientCount());
  VectorXd integrals = VectorXd::Zero(surface.coefficientCount());
  for (int e = 0; e < count(); ++e) {
    const Element& element = elements_[e];
    for (std::size_t a = 0; a < element.coefficients.size(); ++a) {
      integrals[element.coefficients[a]] += element.mass.row(static_cast<Index>(a)).sum();
    }
  }
  for (Element& element : elements_)
    for (std::size_t a = 0; a < element.coefficients.size(); ++a) {
      const auto row = static_cast<Index>(a);
      element.project.row(row) *= element.mass.row(row).sum() / integrals[element.coefficients[a]];
    }
}

void SplineContactElements::fill(const SplineSurface& surface, const SplineTractions& tractions,
                                 int index, const std::vector<double>& narrowest) {
  Element& element = elements_[index];
  const std::vector<int>& functions = surface.functions(index);
  std::vector<int> indices;
  double finest = INFINITY;
  for (std::size_t f = 0; f < functions.size(); ++f) {
    const auto known =
        std::find(element.coefficients.begin(), element.coefficients.end(), functions[f]);
    indices.push_back(static_cast<int>(known - element.coefficients.begin()));
    if (known != element.coefficients.end()) continue;
    element.coefficients.push_back(functions[f]);
    element.slots.push_back(tractions.ofFunction[index][f]);
    finest = std::min(finest, narrowest[functions[f]]);
  }
  const auto size = static_cast<Index>(element.coefficients.size());
  const SplinePatch& patch = surface.patches()[surface.elements()[index].patch];
  const std::array<double, 2> length = lengths(surface, index);
  std::array<int, 2> forBumps{}, forMeans{};
  for (int d = 0; d < 2; ++d) {
    const int degree = patch.basis[d].degree();
    forBumps[d] = static_cast<int>(std::clamp(std::ceil(kPointsPerRadius * length[d] / finest),
                                              degree + 3.0, 1.0 * kMaxGaussPoints));
    forMeans[d] = (degree + 4) / 2;  // exact for a quadratic function times a spline
  }
  const Points bumps = pointsOf(surface, index, forBumps, size, indices);
  const MatrixXd weighted = bumps.weights.asDiagonal() * bumps.basis;
  element.bumpPoints = bumps.positions;
  element.bumpWeights = bumps.weights;
  element.mass = bumps.basis.transpose() * weighted;
  MatrixXd system = element.mass;
  if (surface.isCut(index)) system += kSmoothing * variance(surface, index, size, indices);
  element.project = system.ldlt().solve(weighted.transpose());
  element.center = bumps.positions.colwise().mean().transpose();
  element.radius =
      (bumps.positions.rowwise() - element.center.transpose()).rowwise().norm().maxCoeff();
  const Points means = pointsOf(surface, index, forMeans, size, indices);
  element.points = means.positions.transpose();
  element.weightedBasis = means.weights.asDiagonal() * means.basis;
}

/// Connects cells: cells of one patch meet where their spans do; cells of different patches meet if
/// their sides have the same control points.
void SplineContactElements::connectCells(const SplineSurface& surface) {
  cellOf_.resize(surface.elements().size());
  std::map<std::vector<int>, std::vector<std::pair<int, int>>> atBorder;  // (cell, side)
  for (std::size_t p = 0; p < surface.patches().size(); ++p) {
    const SplinePatch& patch = surface.patches()[p];
    const auto& [u, v] = patch.basis;
    const int columns = static_cast<int>(u.spans().size());
    const int rows = static_cast<int>(v.spans().size());
    const int begin = cellCount();
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i) {
        const int index = cellCount();
        Cell& cell = cells_.emplace_back();
        cell.elements = surface.elementsAt(static_cast<int>(p), i, j);
        for (const int element : cell.elements) cellOf_[element] = index;
        const auto &spanU = u.spans()[i], &spanV = v.spans()[j];
        const std::vector<int>& functions = surface.functions(cell.elements.front());
        std::vector<double> basis;
        for (int s = 0; s < 4; ++s) {  // u lower, u upper, v lower, v upper
          Side& side = cell.sides[s];
          const bool isUpper = s % 2 == 1;
          for (int k = 0; k <= kPieces; ++k) {
            const double t = static_cast<double>(k) / kPieces;
            const Eigen::Vector2d at =
                s < 2 ? Eigen::Vector2d(isUpper ? spanU.upper : spanU.lower,
                                        spanV.lower + t * (spanV.upper - spanV.lower))
                      : Eigen::Vector2d(spanU.lower + t * (spanU.upper - spanU.lower),
                                        isUpper ? spanV.upper : spanV.lower);
            surface.evaluateBasis(cell.elements.front(), at, basis);
            side.points[k].setZero();
            for (std::size_t f = 0; f < basis.size(); ++f)
              side.points[k] += basis[f] * surface.controlPoints()[functions[f]];
          }
          side.radius = 0;
          for (const Vector3d& point : side.points)
            side.radius = std::max(side.radius, (point - side.points[kPieces / 2]).norm());
          const int nextI = i + (s < 2 ? 2 * (s % 2) - 1 : 0);
          const int nextJ = j + (s < 2 ? 0 : 2 * (s % 2) - 1);
          if (nextI >= 0 && nextI < columns && nextJ >= 0 && nextJ < rows) {
            side.neighbours.push_back(begin + nextI + nextJ * columns);
            continue;
          }
          std::vector<int> key;
          const int along = s < 2 ? 1 : 0, first = s < 2 ? spanV.first : spanU.first;
          for (int k = first; k <= first + patch.basis[along].degree(); ++k)
            key.push_back(s < 2 ? patch.net[(isUpper ? u.count() - 1 : 0) + k * u.count()]
                                : patch.net[k + (isUpper ? v.count() - 1 : 0) * u.count()]);
          if (key.front() > key.back()) std::reverse(key.begin(), key.end());
          atBorder[key].emplace_back(index, s);
        }
      }
  }
  for (const auto& [key, meeting] : atBorder)
    for (const auto& [cell, side] : meeting)
      for (const auto& [other, otherSide] : meeting)
        if (other != cell) cells_[cell].sides[side].neighbours.push_back(other);
}

}  // namespace palpa::bem

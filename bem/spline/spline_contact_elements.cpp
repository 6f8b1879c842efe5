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
  /// Functions of displacements and tractions, [point][function of the list; functions with equal
  /// coefficients are summed].
  MatrixXd basis, ofTractions;
  /// B-splines of the element's net, [point][function that belongs to the coefficient of the list].
  MatrixXd ofNet;
};

/// Indices of the functions of an element in the list of its distinct coefficients.
struct Indices {
  std::vector<int> functions;
  /// Of the net's functions; those that do not belong to the element's side follow the list.
  std::vector<int> net;
  Index size = 0, netSize = 0;  ///< of the list, and with the others
};

Points pointsOf(const SplineSurface& surface, int index, const std::array<int, 2>& counts,
                const Indices& indices) {
  const SplineElement& element = surface.elements()[index];
  const GaussRule &u = gaussRule(counts[0]), &v = gaussRule(counts[1]);
  const Index count = static_cast<Index>(counts[0]) * counts[1];
  const double width = element.upper[0] - element.lower[0];
  const double height = element.upper[1] - element.lower[1];
  Points result{Eigen::MatrixX3d(count, 3), VectorXd(count), MatrixXd::Zero(count, indices.size),
                MatrixXd::Zero(count, indices.size), MatrixXd::Zero(count, indices.netSize)};
  std::vector<double> basis;
  const auto add = [&](const std::vector<int>& columns, MatrixXd& to, Index row) {
    for (std::size_t f = 0; f < basis.size(); ++f) to(row, columns[f]) += basis[f];
  };
  Index row = 0;
  for (int j = 0; j < counts[1]; ++j)
    for (int i = 0; i < counts[0]; ++i, ++row) {
      const ElementPlace place{index, element.lower[0] + width * u.points[i],
                               element.lower[1] + height * v.points[j]};
      const SurfaceJet jet = surface.evaluate(place);
      surface.evaluateBasis(place, basis);
      add(indices.functions, result.basis, row);
      surface.evaluateTractionBasis(place, basis);
      add(indices.functions, result.ofTractions, row);
      surface.evaluateNet(index, surface.parameters(place).parameters, basis);
      add(indices.net, result.ofNet, row);
      result.positions.row(row) = jet.position.transpose();
      result.weights[row] = jet.areaVector().norm() * width * height * u.weights[i] * v.weights[j];
    }
  return result;
}

/// Matrix of ∫ (f - mean f)^2 dΓ over the knot rectangle of a cut element, for functions of the
/// net.
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
      surface.evaluateNet(index,
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

/// Least squares over an element's net functions; `projection` receives the rows of those in the
/// list of coefficients. Returns their integrals.
VectorXd projectOnNet(const SplineSurface& surface, int index, const Points& points,
                      const Indices& indices, MatrixXd& projection) {
  // Columns of coefficients without a net function here are zero: these get no contribution.
  std::vector<int> column(static_cast<std::size_t>(indices.netSize), -1);
  Index count = 0;
  for (const int k : indices.net)
    if (column[k] < 0) column[k] = static_cast<int>(count++);
  MatrixXd basis(points.ofNet.rows(), count);
  for (std::size_t k = 0; k < column.size(); ++k)
    if (column[k] >= 0) basis.col(column[k]) = points.ofNet.col(static_cast<Index>(k));
  std::vector<int> compressed;
  for (const int k : indices.net) compressed.push_back(column[k]);
  const MatrixXd weighted = points.weights.asDiagonal() * basis;
  MatrixXd system = basis.transpose() * weighted;
  if (surface.isCut(index)) system += kSmoothing * variance(surface, index, count, compressed);
  const MatrixXd all = system.ldlt().solve(weighted.transpose());
  VectorXd shares = VectorXd::Zero(indices.size);
  projection = MatrixXd::Zero(indices.size, points.ofNet.rows());
  for (Index a = 0; a < indices.size; ++a)
    if (column[a] >= 0) {
      projection.row(a) = all.row(column[a]);
      shares[a] = weighted.col(column[a]).sum();
    }
  return shares;
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
  std::vector<VectorXd> shares(elements_.size());  // of the coefficients' areas
  connectCells(surface);
  constexpr int kElementsPerTask = 8;
  parallelFor((count() + kElementsPerTask - 1) / kElementsPerTask, {}, [&](std::ptrdiff_t task) {
    const auto begin = static_cast<int>(task) * kElementsPerTask;
    for (int e = begin; e < std::min(count(), begin + kElementsPerTask); ++e)
      shares[e] = fill(surface, tractions, e, narrowest);
  });
  setAround(surface.coefficientCount());
  VectorXd integrals = VectorXd::Zero(surface.coefficientCount());
  for (int e = 0; e < count(); ++e) {
    const Element& element = elements_[e];
    for (std::size_t a = 0; a < element.coefficients.size(); ++a) {
      integrals[element.coefficients[a]] += shares[e][static_cast<Index>(a)];
    }
  }
  for (int e = 0; e < count(); ++e)
    for (std::size_t a = 0; a < elements_[e].coefficients.size(); ++a) {
      const auto row = static_cast<Index>(a);
      if (shares[e][row] > 0)
        elements_[e].project.row(row) *= shares[e][row] / integrals[elements_[e].coefficients[a]];
    }
}

VectorXd SplineContactElements::fill(const SplineSurface& surface, const SplineTractions& tractions,
                                     int index, const std::vector<double>& narrowest) {
  Element& element = elements_[index];
  const std::vector<int>& functions = surface.functions(index);
  Indices indices;
  double finest = INFINITY;
  for (std::size_t f = 0; f < functions.size(); ++f) {
    const auto known =
        std::find(element.coefficients.begin(), element.coefficients.end(), functions[f]);
    indices.functions.push_back(static_cast<int>(known - element.coefficients.begin()));
    if (known != element.coefficients.end()) continue;
    element.coefficients.push_back(functions[f]);
    element.slots.push_back(tractions.ofFunction[index][f]);
    finest = std::min(finest, narrowest[functions[f]]);
  }
  // Functions of the net that belong to another side of a border follow the list.
  std::vector<int> list = element.coefficients;
  indices.size = static_cast<Index>(list.size());
  const BorderFunctions* beside = surface.borderFunctions(index);
  for (const int point : surface.net(index)) {
    const auto own =
        std::find(functions.begin(),
                  beside ? functions.begin() + beside->ownCount() : functions.end(), point);
    const bool isOwn =
        own != functions.end() && (!beside || own != functions.begin() + beside->ownCount());
    auto known = std::find(isOwn ? list.begin() : list.begin() + indices.size, list.end(), point);
    indices.net.push_back(static_cast<int>(known - list.begin()));
    if (known == list.end()) list.push_back(point);
  }
  indices.netSize = static_cast<Index>(list.size());
  const SplinePatch& patch = surface.patches()[surface.elements()[index].patch];
  const std::array<double, 2> length = lengths(surface, index);
  std::array<int, 2> forBumps{};
  for (int d = 0; d < 2; ++d) {
    const int degree = patch.basis[d].degree();
    forBumps[d] = static_cast<int>(std::clamp(std::ceil(kPointsPerRadius * length[d] / finest),
                                              degree + 3.0, 1.0 * kMaxGaussPoints));
  }
  const Points bumps = pointsOf(surface, index, forBumps, indices);
  element.bumpPoints = bumps.positions;
  element.bumpWeights = bumps.weights;
  element.moments = bumps.basis.transpose() * bumps.weights.asDiagonal();
  element.mass = element.moments * bumps.ofTractions;
  const VectorXd shares = projectOnNet(surface, index, bumps, indices, element.project);
  element.center = bumps.positions.colwise().mean().transpose();
  element.radius =
      (bumps.positions.rowwise() - element.center.transpose()).rowwise().norm().maxCoeff();
  return shares;
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
        const std::vector<int>& functions = surface.net(cell.elements.front());
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
            surface.evaluateNet(cell.elements.front(), at, basis);
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

#include "app/core/design/design_space.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <numeric>
#include <set>

#include "app/core/design/mirror_images.h"
#include "modeling/error.h"
#include "modeling/project/field_check.h"
#include "modeling/solid/control_normals.h"
#include "modeling/solid/edge_band.h"
#include "modeling/solid/surface_properties.h"
#include "modeling/solid/tangent_continuity.h"

namespace palpa::app {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using modeling::Design;

/// Squared weight of the angles between tangent planes against motions over the size of the body.
constexpr double kTangentWeight = 10.0;
/// Default of Design::largestMovement over the diagonal of the body's box.
constexpr double kDefaultMovement = 0.1;

/// Points outside all patches that a support fixes as a whole.
std::vector<int> unsupportedPoints(const modeling::Project& project, const modeling::Solid& solid) {
  std::vector<char> isFree(solid.controlPoints().size(), 1);
  for (const modeling::Support& support : project.supports)
    for (const modeling::RegionPart& part : support.where.parts)
      if (const auto* set = std::get_if<modeling::PatchSet>(&part))
        for (const std::string& name : set->patches)
          if (const auto patch = solid.findPatch(name))
            for (const auto& row : solid.patches()[*patch].net)
              for (int index : row) isFree[static_cast<std::size_t>(index)] = 0;
  std::vector<int> points;
  for (std::size_t i = 0; i < isFree.size(); ++i)
    if (isFree[i]) points.push_back(static_cast<int>(i));
  if (points.empty())
    throw modeling::ModelingError(
        "design.points: supports fix every patch, so that no control point may move; select "
        "points");
  return points;
}

/// A unit vector along which a point may move.
struct Direction {
  int axis;  ///< neighbours with the same axis move together; kAlone: with none
  Vector3d along;
};
constexpr int kAlone = -1;

/// Directions in which a point may move that `keep`, a projector, allows.
std::vector<Direction> directionsOf(const Design& design, const Vector3d& normal,
                                    const Matrix3d& keep) {
  constexpr double kMinLength = 1e-3;
  std::vector<Direction> result;
  const auto add = [&](int axis, const Vector3d& direction) {
    const Vector3d kept = keep * direction;
    if (kept.norm() > kMinLength) result.push_back({axis, kept.normalized()});
  };
  if (design.along == Design::Along::kNormal) add(0, normal);
  if (design.along == Design::Along::kDirection) add(0, design.direction.normalized());
  if (design.along != Design::Along::kAny) return result;
  const bool isAligned = (keep - Matrix3d(keep.diagonal().asDiagonal())).norm() < 1e-9;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(keep);
  for (int axis = 0; axis < 3; ++axis)
    if (isAligned)
      add(axis, Vector3d::Unit(axis));
    else if (eigen.eigenvalues()[axis] > 0.5)
      add(kAlone, eigen.eigenvectors().col(axis));
  return result;
}

/// Pairs of control points that are neighbours in a net, each once.
std::set<std::pair<int, int>> neighbours(const modeling::Solid& solid) {
  std::set<std::pair<int, int>> pairs;
  const auto add = [&](int a, int b) {
    if (a != b) pairs.insert(std::minmax(a, b));
  };
  for (const modeling::Patch& patch : solid.patches())
    for (std::size_t i = 0; i < patch.net.size(); ++i)
      for (std::size_t j = 0; j < patch.net[i].size(); ++j) {
        if (i > 0) add(patch.net[i - 1][j], patch.net[i][j]);
        if (j > 0) add(patch.net[i][j - 1], patch.net[i][j]);
      }
  return pairs;
}

}  // namespace

DesignSpace::DesignSpace(const modeling::Project& project, const Design& design)
    : solid_(modeling::requireSolid(project)) {
  const auto [low, high] = modeling::boundingBox(solid_);
  limit_ = design.largestMovement.value_or(kDefaultMovement * (high - low).norm());
  points_ = design.points ? modeling::selectPoints(*design.points, solid_, "design.points")
                          : unsupportedPoints(project, solid_);
  addVariables(design);
  makeFilter(design.smoothness);
  makeTangents();
}

void DesignSpace::addVariables(const Design& design) {
  const std::size_t count = solid_.controlPoints().size();
  const MirrorImages images(solid_, design.mirrors);
  std::vector<char> isDone(count, 0);
  std::vector<int> moving;
  for (int point : points_) {
    if (isDone[static_cast<std::size_t>(point)]) continue;
    const MirrorImages::Orbit orbit = images.of(point);
    for (const auto& image : orbit.images) isDone[static_cast<std::size_t>(image.point)] = 1;
    const Vector3d normal = modeling::controlNormals(solid_, {point}).front();
    const auto directions = directionsOf(design, normal, orbit.keep);
    for (const Direction& direction : directions) {
      for (const auto& image : orbit.images)
        entries_.push_back({image.point, variableCount(), image.map * direction.along});
      variables_.push_back({direction.axis, static_cast<double>(orbit.images.size())});
    }
    if (!directions.empty())
      for (const auto& image : orbit.images) moving.push_back(image.point);
  }
  if (variables_.empty())
    throw modeling::ModelingError(
        "design.points: no selected control point can move in the directions of design.along");
  std::sort(moving.begin(), moving.end());
  points_ = std::move(moving);
  freeOf_.assign(count, -1);
  for (std::size_t k = 0; k < points_.size(); ++k)
    freeOf_[static_cast<std::size_t>(points_[k])] = static_cast<int>(k);
  for (std::size_t i = 0; i < count; ++i)
    if (freeOf_[i] < 0) stays_.push_back(static_cast<int>(i));
}

// diag(sizes) + c A, where A sums the differences of neighbours over all mirror images. Its inverse
// times diag(sizes) has no negative entries, and rows whose sum is at most 1.
void DesignSpace::makeFilter(double smoothness) {
  std::vector<std::vector<int>> variablesOf(solid_.controlPoints().size());
  for (const Entry& entry : entries_)
    variablesOf[static_cast<std::size_t>(entry.point)].push_back(entry.variable);
  const Index count = variableCount();
  sizes_.resize(count);
  std::vector<Eigen::Triplet<double>> terms;
  for (Index k = 0; k < count; ++k) {
    sizes_[k] = variables_[static_cast<std::size_t>(k)].size;
    terms.emplace_back(k, k, sizes_[k]);
  }
  std::vector<int> component(static_cast<std::size_t>(count));
  std::iota(component.begin(), component.end(), 0);
  const auto root = [&](int k) {
    while (component[static_cast<std::size_t>(k)] != k)
      k = component[static_cast<std::size_t>(k)] =
          component[static_cast<std::size_t>(component[static_cast<std::size_t>(k)])];
    return k;
  };
  const auto isFree = [&](int point) { return freeOf_[static_cast<std::size_t>(point)] >= 0; };
  for (const auto& [a, b] : neighbours(solid_)) {
    const auto& first = variablesOf[static_cast<std::size_t>(a)];
    const auto& second = variablesOf[static_cast<std::size_t>(b)];
    if (isFree(a) && isFree(b)) {
      for (int i : first)
        for (int j : second) {
          const int axis = variables_[static_cast<std::size_t>(i)].axis;
          if (i == j || axis == kAlone || axis != variables_[static_cast<std::size_t>(j)].axis)
            continue;
          terms.emplace_back(i, i, smoothness);
          terms.emplace_back(j, j, smoothness);
          terms.emplace_back(i, j, -smoothness);
          terms.emplace_back(j, i, -smoothness);
          if (smoothness > 0) component[static_cast<std::size_t>(root(i))] = root(j);
        }
    } else {
      for (int i : isFree(a) ? first : second) terms.emplace_back(i, i, smoothness);
    }
  }
  Sparse matrix(count, count);
  matrix.setFromTriplets(terms.begin(), terms.end());
  filter_.compute(matrix);
  // In each connected part one variable may reach the limit.
  const VectorXd sums = filter_.solve(sizes_);
  VectorXd largest = VectorXd::Zero(count);
  for (int k = 0; k < count; ++k) largest[root(k)] = std::max(largest[root(k)], sums[k]);
  scale_.resize(count);
  for (int k = 0; k < count; ++k) scale_[k] = 1 / largest[root(k)];
}

// Minimises |D' − D|² + weight size² |R D'|² with the equations R of all smooth edges
// (modeling/solid/tangent_continuity.cpp): D' = (I + weight size² RᵀR)⁻¹ D.
void DesignSpace::makeTangents() {
  const auto [low, high] = modeling::boundingBox(solid_);
  const double weight = std::sqrt(kTangentWeight) * (high - low).norm();
  std::vector<Eigen::Triplet<double>> terms;
  int rows = 0;
  for (std::size_t e = 0; e < solid_.edges().size(); ++e) {
    if (!solid_.edges()[e].smooth) continue;
    const modeling::EdgeBand band = modeling::bandOf(solid_, static_cast<int>(e));
    for (const auto& at : modeling::bandSamples(band, 2 * band.degree + 2)) {
      const auto relation = modeling::tangentRelation(band, at, solid_.controlPoints());
      if (!relation) continue;
      const auto& factor = relation->factor;
      bool isUsed = false;
      for (int k = 0; k <= band.degree; ++k) {
        const std::array<double, 3> coefficient{
            -(factor[0] + factor[1]) * at.value[k] + factor[2] * at.derivative[k],
            factor[0] * at.value[k], factor[1] * at.value[k]};
        for (std::size_t row = 0; row < 3; ++row) {
          const int point = band.rows[row][static_cast<std::size_t>(at.first + k)];
          const int column = freeOf_[static_cast<std::size_t>(point)];
          if (column < 0) continue;
          terms.emplace_back(rows, column, weight * coefficient[row]);
          isUsed = true;
        }
      }
      if (isUsed) ++rows;
    }
  }
  hasTangents_ = rows > 0;
  if (!hasTangents_) return;
  const auto count = static_cast<Index>(points_.size());
  Sparse equations(rows, count);
  equations.setFromTriplets(terms.begin(), terms.end());
  Sparse matrix = equations.transpose() * equations;
  Sparse identity(count, count);
  identity.setIdentity();
  matrix += identity;
  tangents_.compute(matrix);
}

Matrix3Xd DesignSpace::displacement(const VectorXd& y) const {
  const VectorXd x = scale_.cwiseProduct(filter_.solve(sizes_.cwiseProduct(y)).eval());
  Eigen::MatrixX3d free = Eigen::MatrixX3d::Zero(static_cast<Index>(points_.size()), 3);
  for (const Entry& entry : entries_)
    free.row(freeOf_[static_cast<std::size_t>(entry.point)]) +=
        x[entry.variable] * entry.direction.transpose();
  if (hasTangents_) free = tangents_.solve(free).eval();
  Matrix3Xd result = Matrix3Xd::Zero(3, static_cast<Index>(solid_.controlPoints().size()));
  for (std::size_t k = 0; k < points_.size(); ++k)
    result.col(points_[k]) = free.row(static_cast<Index>(k)).transpose();
  return result;
}

VectorXd DesignSpace::pullBack(const Matrix3Xd& gradient) const {
  Eigen::MatrixX3d free(static_cast<Index>(points_.size()), 3);
  for (std::size_t k = 0; k < points_.size(); ++k)
    free.row(static_cast<Index>(k)) = gradient.col(points_[k]).transpose();
  if (hasTangents_) free = tangents_.solve(free).eval();
  VectorXd x = VectorXd::Zero(variableCount());
  for (const Entry& entry : entries_)
    x[entry.variable] +=
        free.row(freeOf_[static_cast<std::size_t>(entry.point)]).dot(entry.direction);
  return sizes_.cwiseProduct(filter_.solve(scale_.cwiseProduct(x)).eval());
}

DesignSpace::Moved DesignSpace::moved(const VectorXd& y) const {
  const Matrix3Xd motion = displacement(y);
  const std::vector<Vector3d>& from = solid_.controlPoints();
  std::vector<Vector3d> points = from;
  for (int point : points_) points[static_cast<std::size_t>(point)] += motion.col(point);
  const modeling::Solid restored =
      modeling::restoreTangents(solid_, solid_.withControlPoints(std::move(points)), stays_);
  Moved result{restored.controlPoints(), y, 0};
  for (int point : stays_)
    if (result.points[static_cast<std::size_t>(point)] != from[static_cast<std::size_t>(point)])
      throw modeling::ModelingError(
          "control point " + std::to_string(point) +
          " may not move, but the smooth edge beside it could not stay smooth");
  for (std::size_t i = 0; i < from.size(); ++i)
    result.largestMovement = std::max(result.largestMovement, (result.points[i] - from[i]).norm());
  const double allowed = limit_;
  if (result.largestMovement > allowed) {
    const double part = allowed / result.largestMovement;
    for (std::size_t i = 0; i < from.size(); ++i)
      result.points[i] = from[i] + part * (result.points[i] - from[i]);
    result.y *= part;
    result.largestMovement = allowed;
  }
  return result;
}

}  // namespace palpa::app

#include "bem/gradient/residual_derivative.h"

#include <array>
#include <cmath>

#include "base/parallel.h"
#include "bem/gradient/kelvin_derivative.h"

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kLanes = 8;
using Lanes = Eigen::Array<double, kLanes, 1>;
constexpr std::ptrdiff_t kTasks = 48;

/// The collocation points with their weights λ and the displacement there.
struct Points {
  Matrix3Xd position, lambda, displacement;
};

/// Some collocation points, in groups of kLanes; padding has λ = 0.
struct PointGroup {
  Lanes position[3], lambda[3], displacement[3];
  std::array<int, kLanes> index;
  int count;
};

class ElementTask {
 public:
  ElementTask(const ElementSurface& surface, const ElementQuadrature& quadrature,
              const MovingElements& motion, const WeightedEquations& equations,
              const Points& points, const KelvinDerivatives& kernel)
      : surface_(surface),
        quadrature_(quadrature),
        motion_(motion),
        equations_(equations),
        points_(points),
        kernel_(kernel),
        workspace_(quadrature.makeWorkspace()) {}

  /// Adds one element: derivatives by material points, and by the collocation points.
  void add(int element, const VectorXd& u, const VectorXd& p, Matrix3Xd& byPoints,
           Matrix3Xd& byCollocation) {
    element_ = element;
    displacements_ = surface_.displacementsOfTable(element, u);
    tractions_ = surface_.tractionsOfTable(element, p);
    positions_ = motion_.positions(element);
    byFunctions_.setZero(3, positions_.cols());
    std::array<std::vector<PointGroup>, ElementQuadrature::kKeptRules> far;
    for (int i = 0; i < static_cast<int>(equations_.points.size()); ++i) {
      const CollocationPlace& point = equations_.points[i];
      const ElementPlace* inside = placeIn(point, element);
      const int rule = inside ? -1 : quadrature_.keptRule(element, point.position);
      if (rule >= 0)
        addToGroup(i, far[rule]);
      else
        addNear(i, inside, byCollocation);
    }
    for (int rule = 0; rule < ElementQuadrature::kKeptRules; ++rule)
      if (!far[rule].empty()) addFar(rule, far[rule], byCollocation);
    motion_.addTo(element, byFunctions_, byPoints);
  }

 private:
  struct Source {
    double position[3], area[3], displacement[3], traction[3];
    double tractionArea;
    Eigen::Vector2d coordinates;
  };

  void addToGroup(int i, std::vector<PointGroup>& groups) const {
    if (groups.empty() || groups.back().count == kLanes) {
      PointGroup& group = groups.emplace_back();
      group.count = 0;
      for (int c = 0; c < 3; ++c) {
        group.position[c].setConstant(points_.position(c, i));
        group.lambda[c].setZero();
        group.displacement[c].setConstant(points_.displacement(c, i));
      }
    }
    PointGroup& group = groups.back();
    const int lane = group.count++;
    group.index[lane] = i;
    for (int c = 0; c < 3; ++c) {
      group.position[c][lane] = points_.position(c, i);
      group.lambda[c][lane] = points_.lambda(c, i);
      group.displacement[c][lane] = points_.displacement(c, i);
    }
  }

  Source sourceAt(const ElementPoints& points, int k) {
    points.basisAt(k, basis_);
    const Vector3d u = displacements_ * basis_, p = tractions_ * basis_;
    Source source;
    for (int c = 0; c < 3; ++c) {
      source.position[c] = points.position(c)[k];
      source.area[c] = points.area(c)[k];
      source.displacement[c] = u[c];
      source.traction[c] = p[c];
    }
    source.tractionArea = points.tractionArea()[k];
    source.coordinates = motion_.coordinates(element_, basis_);
    return source;
  }

  void addNear(int i, const ElementPlace* inside, Matrix3Xd& byCollocation) {
    const Vector3d x = points_.position.col(i);
    const auto root = [](double square) { return std::sqrt(square); };
    quadrature_.visitRules(element_, x, inside, *workspace_, [&](const ElementPoints& points) {
      for (int k = 0; k < points.used; ++k) {
        const Source at = sourceAt(points, k);
        double r[3], lambda[3], w[3];
        for (int c = 0; c < 3; ++c) {
          r[c] = at.position[c] - x[c];
          lambda[c] = points_.lambda(c, i);
          w[c] = at.displacement[c] - points_.displacement(c, i);
        }
        const auto by = kernel_.at(r, lambda, w, at.traction, at.tractionArea, at.area, root);
        const Vector3d byPoint(by.byPoint[0], by.byPoint[1], by.byPoint[2]);
        byCollocation.col(i) -= byPoint;
        addSource(at, byPoint, {by.byArea[0], by.byArea[1], by.byArea[2]}, by.perArea);
      }
    });
  }

  void addFar(int rule, const std::vector<PointGroup>& groups, Matrix3Xd& byCollocation) {
    const ElementPoints& points = quadrature_.keptPoints(element_, rule);
    const auto root = [](const Lanes& square) -> Lanes { return square.sqrt(); };
    std::vector<std::array<Lanes, 3>> byGroup(groups.size());
    for (auto& each : byGroup)
      for (Lanes& lanes : each) lanes.setZero();
    for (int k = 0; k < points.used; ++k) {
      const Source at = sourceAt(points, k);
      Lanes byPoint[3], byArea[3], perArea = Lanes::Zero();
      for (int c = 0; c < 3; ++c) {
        byPoint[c].setZero();
        byArea[c].setZero();
      }
      for (std::size_t g = 0; g < groups.size(); ++g) {
        const PointGroup& group = groups[g];
        Lanes r[3], w[3];
        for (int c = 0; c < 3; ++c) {
          r[c] = at.position[c] - group.position[c];
          w[c] = at.displacement[c] - group.displacement[c];
        }
        const auto by = kernel_.at(r, group.lambda, w, at.traction, at.tractionArea, at.area, root);
        for (int c = 0; c < 3; ++c) {
          byPoint[c] += by.byPoint[c];
          byArea[c] += by.byArea[c];
          byGroup[g][c] -= by.byPoint[c];
        }
        perArea += by.perArea;
      }
      addSource(at, {byPoint[0].sum(), byPoint[1].sum(), byPoint[2].sum()},
                {byArea[0].sum(), byArea[1].sum(), byArea[2].sum()}, perArea.sum());
    }
    for (std::size_t g = 0; g < groups.size(); ++g)
      for (int lane = 0; lane < groups[g].count; ++lane)
        for (int c = 0; c < 3; ++c) byCollocation(c, groups[g].index[lane]) += byGroup[g][c][lane];
  }

  // With y = Σ φ_k X_k and the area vector A = (y_u × y_v) ω,
  //   c · dA = ω [ dy_u · (y_v × c) + dy_v · (c × y_u) ];
  // the area of the tractions changes in proportion to |A|.
  void addSource(const Source& at, const Vector3d& byPoint, Vector3d byArea, double perArea) {
    motion_.evaluate(element_, at.coordinates, functions_);
    const Vector3d yu = positions_ * functions_.du, yv = positions_ * functions_.dv;
    const Vector3d area(at.area[0], at.area[1], at.area[2]);
    const double square = area.squaredNorm();
    byArea += perArea * at.tractionArea / square * area;
    const double weight = std::sqrt(square) / yu.cross(yv).norm();
    const Vector3d byU = weight * yv.cross(byArea), byV = weight * byArea.cross(yu);
    byFunctions_.noalias() += byPoint * functions_.value.transpose() +
                              byU * functions_.du.transpose() + byV * functions_.dv.transpose();
  }

  const ElementSurface& surface_;
  const ElementQuadrature& quadrature_;
  const MovingElements& motion_;
  const WeightedEquations& equations_;
  const Points& points_;
  const KelvinDerivatives& kernel_;
  std::unique_ptr<ElementQuadrature::Workspace> workspace_;
  int element_ = 0;
  Matrix3Xd displacements_, tractions_, positions_, byFunctions_;
  VectorXd basis_;
  MovingElements::Functions functions_;
};

Points pointsOf(const ElementSurface& surface, const WeightedEquations& equations,
                const VectorXd& lambda, const VectorXd& u) {
  const Index count = static_cast<Index>(equations.points.size());
  // Rows of the operators: all first components, then all second ones, then all third ones.
  const Eigen::Map<const Eigen::MatrixX3d> ofEquations(lambda.data(), lambda.size() / 3, 3);
  Points points{Matrix3Xd(3, count), ofEquations.transpose() * equations.weights,
                Matrix3Xd(3, count)};
  std::vector<double> basis;
  for (Index i = 0; i < count; ++i) {
    const CollocationPlace& point = equations.points[static_cast<std::size_t>(i)];
    const ElementPlace& place = point.places.front();
    surface.evaluateBasis(place, basis);
    points.position.col(i) = point.position;
    points.displacement.col(i) = weightedSum(basis, surface.coefficients(place.element), u);
  }
  return points;
}

}  // namespace

Matrix3Xd residualDerivative(const ElementSurface& surface, const ElementQuadrature& quadrature,
                             const MovingElements& motion, const WeightedEquations& equations,
                             const VectorXd& lambda, const VectorXd& u, const VectorXd& p,
                             const Material& material, const Job& job) {
  const Points points = pointsOf(surface, equations, lambda, u);
  const KelvinDerivatives kernel(material);
  std::vector<Matrix3Xd> byPoints(kTasks), byCollocation(kTasks);
  parallelFor(kTasks, job, [&](std::ptrdiff_t task) {
    ElementTask work(surface, quadrature, motion, equations, points, kernel);
    byPoints[task] = Matrix3Xd::Zero(3, motion.pointCount());
    byCollocation[task] = Matrix3Xd::Zero(3, points.position.cols());
    for (int e = static_cast<int>(task); e < surface.elementCount();
         e += static_cast<int>(kTasks)) {
      job.throwIfCancelled();
      work.add(e, u, p, byPoints[task], byCollocation[task]);
    }
  });
  Matrix3Xd result = std::move(byPoints.front()), atPoints = std::move(byCollocation.front());
  for (std::size_t task = 1; task < byPoints.size(); ++task) {
    result += byPoints[task];
    atPoints += byCollocation[task];
  }
  MovingElements::Functions functions;
  for (Index i = 0; i < atPoints.cols(); ++i) {
    const ElementPlace& place = equations.points[static_cast<std::size_t>(i)].places.front();
    motion.evaluate(place.element, motion.coordinates(place), functions);
    motion.addTo(place.element, atPoints.col(i) * functions.value.transpose(), result);
  }
  return result;
}

}  // namespace palpa::bem

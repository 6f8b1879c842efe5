#include "bem/spline/spline_contact_surface.h"

#include <algorithm>
#include <cmath>

#include "bem/contact_foot.h"
#include "bem/spline/spline_collocation.h"

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// What masks of a lattice overlap by, radius over spacing: so they are never narrower than the
/// splines can carry.
constexpr double kOverlap = 1.7;
/// Where less than this part of the bump falls on free coefficients, a support holds the place.
constexpr double kLeastPart = 0.02;
constexpr double kSingular = 1e-6;

struct Basis1d {
  double value[kMostSplineDegree + 1], slope[kMostSplineDegree + 1], bend[kMostSplineDegree + 1];

  Basis1d(const SpanPolynomials& span, double parameter) {
    const double s = (parameter - span.lower) * span.scale - 1;
    const int size = span.degree + 1;
    for (int f = 0; f < size; ++f) {
      double v = 0, first = 0, second = 0;  // the last one half of the second derivative
      for (int m = span.degree; m >= 0; --m) {
        second = second * s + first;
        first = first * s + v;
        v = v * s + span.coefficients[m * size + f];
      }
      value[f] = v;
      slope[f] = first * span.scale;
      bend[f] = 2 * second * span.scale * span.scale;
    }
  }
};

struct Jet2 {
  Vector3d position = Vector3d::Zero(), u = Vector3d::Zero(), v = Vector3d::Zero(),
           uu = Vector3d::Zero(), uv = Vector3d::Zero(), vv = Vector3d::Zero();
};

/// By parameters of the patch.
Jet2 evaluate(const SplineSurface& surface, const SplineMesh::Point& at) {
  const SplineElement& element = surface.elements()[at.element];
  const auto& basis = surface.patches()[element.patch].basis;
  const Basis1d a(basis[0].polynomials(element.span[0]), at.parameters[0]);
  const Basis1d b(basis[1].polynomials(element.span[1]), at.parameters[1]);
  Jet2 jet;
  const int* function = surface.functions(at.element).data();
  for (int j = 0; j <= basis[1].degree(); ++j)
    for (int i = 0; i <= basis[0].degree(); ++i) {
      const Vector3d& point = surface.controlPoints()[*function++];
      jet.position += a.value[i] * b.value[j] * point;
      jet.u += a.slope[i] * b.value[j] * point;
      jet.v += a.value[i] * b.slope[j] * point;
      jet.uu += a.bend[i] * b.value[j] * point;
      jet.uv += a.slope[i] * b.slope[j] * point;
      jet.vv += a.value[i] * b.bend[j] * point;
    }
  return jet;
}

/// Newton's step towards (tool - x) . x_u = (tool - x) . x_v = 0; where the tool is beyond the
/// centre of curvature, without what depends on curvature.
Vector2d stepToFoot(const Jet2& jet, const Vector3d& tool) {
  const Vector3d off = tool - jet.position;
  const Vector2d right(off.dot(jet.u), off.dot(jet.v));
  Matrix2d metric, bend;
  metric << jet.u.squaredNorm(), jet.u.dot(jet.v), jet.u.dot(jet.v), jet.v.squaredNorm();
  bend << off.dot(jet.uu), off.dot(jet.uv), off.dot(jet.uv), off.dot(jet.vv);
  const auto isDefinite = [&](const Matrix2d& matrix) {
    return matrix.trace() > 0 && matrix.determinant() > kSingular * metric(0, 0) * metric(1, 1);
  };
  if (isDefinite(metric - bend)) return (metric - bend).inverse() * right;
  if (isDefinite(metric)) return metric.inverse() * right;
  return Vector2d::Zero();
}

std::vector<double> narrowestOf(const SplineSurface& surface) {
  std::vector<double> widths = functionSpreads(surface);
  for (double& width : widths) width *= SplineContactSurface::kNarrowest;
  return widths;
}

}  // namespace

class SplineContactSurface::Workspace final : public ContactSurface::Workspace {
 public:
  explicit Workspace(const SplineContactSurface& surface)
      : cellStamp_(surface.elements_.cellCount(), 0),
        elementStamp_(surface.elements_.count(), 0),
        nodeStamp_(surface.places_.size(), 0),
        measureStamp_(surface.places_.size(), 0),
        nodeIndex_(surface.places_.size(), 0),
        measureIndex_(surface.places_.size(), 0) {
    Index points = 0, functions = 0, means = 0;
    for (int e = 0; e < surface.elements_.count(); ++e) {
      points = std::max(points, surface.elements_[e].project.cols());
      functions = std::max(functions, surface.elements_[e].project.rows());
      means = std::max(means, surface.elements_[e].points.cols());
    }
    bump_.resize(points);
    local_.resize(functions);
    measured_.resize(functions);
    atPoints_.resize(means);
  }

 private:
  friend class SplineContactSurface;
  std::vector<unsigned> cellStamp_, elementStamp_, nodeStamp_, measureStamp_;
  unsigned stamp_ = 0;
  std::vector<int> cells_, around_, nodeIndex_, measureIndex_;
  Eigen::VectorXd bump_, local_, measured_, atPoints_;  // of one element
};

SplineContactSurface::SplineContactSurface(const SplineMesh& mesh, const DegreesOfFreedom& dofs)
    : ContactSurface(mesh.mesh(), mesh.meshSlots(), mesh.tractions().slots, dofs),
      mesh_(mesh),
      widths_(narrowestOf(mesh.surface())),
      elements_(mesh.surface(), mesh.tractions(), widths_) {
  for (const SplineCollocationPoint& point : grevilleCollocation(mesh.surface()))
    places_.push_back(point.position);
  coefficientAt_.assign(mesh.mesh().nodes.size(), -2);  // -2: not seen yet
  std::vector<double> basis;
  for (int t = 0; t < mesh.mesh().triangleCount(); ++t)
    for (int corner = 0; corner < 3; ++corner) {
      int& coefficient = coefficientAt_[mesh.mesh().triangles[t][corner]];
      if (coefficient == -1) continue;
      const SplineMesh::Point at = mesh.at(t, Vector3d::Unit(corner));
      mesh.surface().evaluateBasis(at.element, at.parameters, basis);
      const std::vector<int>& functions = mesh.surface().functions(at.element);
      double most = kSingular;  // what is less is rounding
      int best = -1;
      for (std::size_t f = 0; f < basis.size(); ++f) {
        if (basis[f] <= most || !dofs.isFree(functions[f])) continue;
        most = basis[f];
        best = functions[f];
      }
      coefficient = best;
    }
}

SurfacePoint SplineContactSurface::at(int triangle, const Vector3d& weights) const {
  SurfacePoint point{triangle, weights, Vector3d::Zero(), 0.0};
  point.position = smoothPosition(point);
  return point;
}

SurfacePoint SplineContactSurface::nearest(const Vector3d& x) const {
  const SurfacePoint onMesh = tree().nearest(x);
  SurfacePoint start = at(onMesh.triangle, onMesh.weights);
  start.distance = (start.position - x).norm();
  const SurfacePoint found = foot(x, start);
  return found.distance < start.distance ? found : start;
}

SurfacePoint SplineContactSurface::foot(const Vector3d& tool, const SurfacePoint& start) const {
  const BoundaryMesh& triangles = mesh();
  SurfacePoint onMesh = start;
  onMesh.position = triangles.point(start.triangle, start.weights);
  // No step is longer than the narrowest mask: more than the nearest point of the mesh can be off.
  onMesh =
      walkToFoot(triangles, tree(), onMesh, narrowestMask(start), [&](const SurfacePoint& from) {
        const Jet2 jet = evaluate(mesh_.surface(), mesh_.at(from));
        const auto& corners = mesh_.triangle(from.triangle).corners;
        Matrix2d edges;
        edges << corners[1] - corners[0], corners[2] - corners[0];
        return Vector2d(edges.inverse() * stepToFoot(jet, tool));
      });
  SurfacePoint found = at(onMesh.triangle, onMesh.weights);
  found.distance = (found.position - tool).norm();
  return found;
}

Vector3d SplineContactSurface::normal(const SurfacePoint& point) const {
  // A little inside the triangle where the derivatives are parallel.
  for (const double inwards : {0.0, 1e-3, 1e-2}) {
    const Vector3d weights = (1 - inwards) * point.weights + Vector3d::Constant(inwards / 3);
    const Jet2 jet = evaluate(mesh_.surface(), mesh_.at(point.triangle, weights));
    const Vector3d area = jet.u.cross(jet.v);
    if (area.norm() > 1e-9 * jet.u.norm() * jet.v.norm()) return area.normalized();
  }
  return mesh().normal(point.triangle);
}

Vector3d SplineContactSurface::smoothPosition(const SurfacePoint& point) const {
  return evaluate(mesh_.surface(), mesh_.at(point)).position;
}

double SplineContactSurface::narrowestMask(const SurfacePoint& point) const {
  const SplineMesh::Point at = mesh_.at(point);
  const SplineElement& element = mesh_.surface().elements()[at.element];
  const auto& basis = mesh_.surface().patches()[element.patch].basis;
  const Basis1d a(basis[0].polynomials(element.span[0]), at.parameters[0]);
  const Basis1d b(basis[1].polynomials(element.span[1]), at.parameters[1]);
  const int* function = mesh_.surface().functions(at.element).data();
  double width = 0;
  for (int j = 0; j <= basis[1].degree(); ++j)
    for (int i = 0; i <= basis[0].degree(); ++i)
      width += a.value[i] * b.value[j] * widths_[*function++];
  return width;
}

double SplineContactSurface::maskSpacing(const SurfacePoint& point) const {
  return narrowestMask(point) / kOverlap;
}

std::unique_ptr<ContactSurface::Workspace> SplineContactSurface::makeWorkspace() const {
  return std::make_unique<Workspace>(*this);
}

bool SplineContactSurface::makeMask(const SurfacePoint& point, double radius,
                                    ContactSurface::Workspace& workspace, ContactMask& mask) const {
  auto& work = static_cast<Workspace&>(workspace);
  mask.point = point;
  mask.radius = std::max(radius, narrowestMask(point));
  mask.nodes.clear();
  mask.traction.clear();
  mask.measureNodes.clear();
  mask.measure.clear();
  mask.points.clear();
  mask.pointWeights.clear();
  ++work.stamp_;
  work.cells_.clear();
  work.cells_.push_back(elements_.cellOf(mesh_.at(point).element));
  work.cellStamp_[work.cells_.front()] = work.stamp_;
  const double bump = project(smoothPosition(point), mask.radius, work, mask);
  const double carried = measure(work, mask);
  if (carried > kLeastPart * bump) {
    for (double& coefficient : mask.traction) coefficient /= carried;
    for (double& weight : mask.measure) weight /= carried;
    return true;
  }
  mask.nodes.clear();
  mask.traction.clear();
  mask.measureNodes.clear();
  mask.measure.clear();
  mask.points.clear();
  mask.pointWeights.clear();
  return false;
}

/// The coefficients of the bump (1 - (ρ/radius)^2)^2 on the elements that reach into the ball and
/// hang together with the touched one: the far side of a thin body must not be touched as well.
/// What would fall on held coefficients is left out. Returns the integral of the bump.
double SplineContactSurface::project(const Vector3d& middle, double radius, Workspace& work,
                                     ContactMask& mask) const {
  const double inverse = 1.0 / (radius * radius);
  double integral = 0;
  for (std::size_t k = 0; k < work.cells_.size(); ++k) {
    elements_.visitNeighbours(work.cells_[k], middle, radius, [&](int neighbour) {
      if (work.cellStamp_[neighbour] == work.stamp_) return;
      work.cellStamp_[neighbour] = work.stamp_;
      work.cells_.push_back(neighbour);
    });
    for (const int e : elements_.elementsOf(work.cells_[k])) {
      const SplineContactElements::Element& element = elements_[e];
      if ((element.center - middle).norm() >= radius + element.radius) continue;
      const Index points = element.bumpPoints.rows();
      bool isReached = false;
      for (Index q = 0; q < points; ++q) {
        const double s =
            1 - inverse * (element.bumpPoints.row(q).transpose() - middle).squaredNorm();
        work.bump_[q] = s > 0 ? s * s : 0.0;
        isReached = isReached || s > 0;
      }
      if (!isReached) continue;
      integral += element.bumpWeights.dot(work.bump_.head(points));
      auto local = work.local_.head(element.project.rows());
      local.noalias() = element.project * work.bump_.head(points);
      for (Index a = 0; a < local.size(); ++a) {
        const int node = element.coefficients[a];
        if (!dofs().isFree(node)) continue;
        if (work.nodeStamp_[node] != work.stamp_) {
          work.nodeStamp_[node] = work.stamp_;
          work.nodeIndex_[node] = static_cast<int>(mask.nodes.size());
          mask.nodes.push_back(node);
          mask.traction.push_back(0.0);
        }
        mask.traction[work.nodeIndex_[node]] += local[a];
      }
    }
  }
  return integral;
}

/// ∫ Φ N_j dΓ, and points for other means; returns ∫ Φ dΓ.
double SplineContactSurface::measure(Workspace& work, ContactMask& mask) const {
  work.around_.clear();
  for (const int node : mask.nodes)
    for (const int e : elements_.around(node)) {
      if (work.elementStamp_[e] == work.stamp_) continue;
      work.elementStamp_[e] = work.stamp_;
      work.around_.push_back(e);
    }
  double integral = 0, integralOfPoints = 0;
  for (const int e : work.around_) {
    const SplineContactElements::Element& element = elements_[e];
    const Index size = element.mass.rows();
    auto local = work.local_.head(size);
    for (Index a = 0; a < size; ++a) {
      const int node = element.coefficients[a];
      local[a] = work.nodeStamp_[node] == work.stamp_ ? mask.traction[work.nodeIndex_[node]] : 0.0;
    }
    auto measured = work.measured_.head(size);
    measured.noalias() = element.mass * local;
    for (Index a = 0; a < size; ++a) {
      const int node = element.coefficients[a];
      if (work.measureStamp_[node] != work.stamp_) {
        work.measureStamp_[node] = work.stamp_;
        work.measureIndex_[node] = static_cast<int>(mask.measureNodes.size());
        mask.measureNodes.push_back(node);
        mask.measure.push_back(0.0);
      }
      mask.measure[work.measureIndex_[node]] += measured[a];
    }
    integral += measured.sum();
    const Index points = element.points.cols();
    auto atPoints = work.atPoints_.head(points);
    atPoints.noalias() = element.weightedBasis * local;
    for (Index q = 0; q < points; ++q) {
      mask.points.push_back(element.points.col(q));
      mask.pointWeights.push_back(atPoints[q]);
    }
    integralOfPoints += atPoints.sum();
  }
  for (double& weight : mask.pointWeights) weight /= integralOfPoints;
  return integral;
}

double SplineContactSurface::strainEnergy(const Eigen::VectorXd& u,
                                          const Eigen::VectorXd& p) const {
  double sum = 0;
  for (int e = 0; e < elements_.count(); ++e) {
    const SplineContactElements::Element& element = elements_[e];
    const Index size = element.mass.rows();
    for (Index a = 0; a < size; ++a) {
      const Vector3d traction = p.segment<3>(3 * element.slots[a]);
      if (traction.isZero(0)) continue;
      for (Index b = 0; b < size; ++b)
        sum += element.mass(a, b) * traction.dot(u.segment<3>(3 * element.coefficients[b]));
    }
  }
  return 0.5 * sum;
}

}  // namespace palpa::bem

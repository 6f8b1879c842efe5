#include "bem/element/element_contact_surface.h"

#include <algorithm>
#include <cmath>

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

/// If a smaller part of the bump lies on free coefficients, the place counts as fixed by a support.
constexpr double kMinPart = 0.02;

}  // namespace

class ElementContactSurface::Workspace final : public ContactSurface::Workspace {
 public:
  explicit Workspace(const ElementContactSurface& surface)
      : cellStamp_(surface.elements().cellCount(), 0),
        elementStamp_(surface.elements().count(), 0),
        nodeStamp_(surface.places().size(), 0),
        measureStamp_(surface.places().size(), 0),
        nodeIndex_(surface.places().size(), 0),
        measureIndex_(surface.places().size(), 0) {
    Index points = 0, functions = 0, means = 0;
    for (int e = 0; e < surface.elements().count(); ++e) {
      points = std::max(points, surface.elements()[e].project.cols());
      functions = std::max(functions, surface.elements()[e].project.rows());
      means = std::max(means, surface.elements()[e].points.cols());
    }
    bump_.resize(points);
    local_.resize(functions);
    measured_.resize(functions);
    atPoints_.resize(means);
  }

 private:
  friend class ElementContactSurface;
  std::vector<unsigned> cellStamp_, elementStamp_, nodeStamp_, measureStamp_;
  unsigned stamp_ = 0;
  std::vector<int> cells_, around_, nodeIndex_, measureIndex_;
  Eigen::VectorXd bump_, local_, measured_, atPoints_;  // of one element
};

SurfacePoint ElementContactSurface::nearest(const Vector3d& x) const {
  const SurfacePoint onMesh = tree().nearest(x);
  SurfacePoint start = at(onMesh.triangle, onMesh.weights);
  start.distance = (start.position - x).norm();
  SurfacePoint best = foot(x, start);
  if (best.distance > start.distance) best = start;
  // The mesh is inside a curved sharp edge: points of one face between mesh and edge are nearest to
  // the edge of the mesh, and belong to either of its triangles. Points off the surface, as those
  // of tools, stay on one face: both are about as near.
  constexpr double kOnSurface = 0.1;
  const SurfacePoint across = facing(start, -normal(start));
  if (across.triangle == start.triangle) return best;
  const SurfacePoint found = foot(x, across);
  return found.distance < kOnSurface * best.distance ? found : best;
}

std::unique_ptr<ContactSurface::Workspace> ElementContactSurface::makeWorkspace() const {
  return std::make_unique<Workspace>(*this);
}

bool ElementContactSurface::makeMask(const SurfacePoint& point, double radius,
                                     ContactSurface::Workspace& workspace,
                                     ContactMask& mask) const {
  auto& work = static_cast<Workspace&>(workspace);
  mask.point = point;
  mask.radius = maskRadius(point, radius);
  mask.nodes.clear();
  mask.traction.clear();
  mask.measureNodes.clear();
  mask.measure.clear();
  mask.points.clear();
  mask.pointWeights.clear();
  ++work.stamp_;
  work.cells_.clear();
  work.cells_.push_back(elements().cellOf(elementAt(point)));
  work.cellStamp_[work.cells_.front()] = work.stamp_;
  const double bump = project(smoothPosition(point), mask.radius, work, mask);
  const double carried = measure(work, mask);
  if (carried > kMinPart * bump) {
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

/// Computes the coefficients of the bump (1 - (ρ/radius)^2)^2 on the elements that reach into the
/// ball and are connected with the touched element: the far side of a thin body must stay
/// untouched. The part on fixed coefficients is omitted. Returns the integral of the bump.
double ElementContactSurface::project(const Vector3d& middle, double radius, Workspace& work,
                                      ContactMask& mask) const {
  const double inverse = 1.0 / (radius * radius);
  double integral = 0;
  for (std::size_t k = 0; k < work.cells_.size(); ++k) {
    elements().visitNeighbours(work.cells_[k], middle, radius, [&](int neighbour) {
      if (work.cellStamp_[neighbour] == work.stamp_) return;
      work.cellStamp_[neighbour] = work.stamp_;
      work.cells_.push_back(neighbour);
    });
    for (const int e : elements().elementsOf(work.cells_[k])) {
      const ContactElements::Element& element = elements()[e];
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

/// Computes ∫ Φ N_j dΓ, and points for other means; returns ∫ Φ dΓ.
double ElementContactSurface::measure(Workspace& work, ContactMask& mask) const {
  work.around_.clear();
  for (const int node : mask.nodes)
    for (const int e : elements().around(node)) {
      if (work.elementStamp_[e] == work.stamp_) continue;
      work.elementStamp_[e] = work.stamp_;
      work.around_.push_back(e);
    }
  double integral = 0, integralOfPoints = 0;
  for (const int e : work.around_) {
    const ContactElements::Element& element = elements()[e];
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

double ElementContactSurface::strainEnergy(const Eigen::VectorXd& u,
                                           const Eigen::VectorXd& p) const {
  double sum = 0;
  for (int e = 0; e < elements().count(); ++e) {
    const ContactElements::Element& element = elements()[e];
    const Index size = element.mass.rows();
    for (Index a = 0; a < size; ++a) {
      const Vector3d traction = p.segment<3>(3 * element.slots[a]);
      if (traction.isZero(0)) continue;
      for (Index b = 0; b < size; ++b)
        sum += element.mass(b, a) * traction.dot(u.segment<3>(3 * element.coefficients[b]));
    }
  }
  return 0.5 * sum;
}

}  // namespace palpa::bem

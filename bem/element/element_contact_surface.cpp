#include "bem/element/element_contact_surface.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

/// If a smaller part of the bump lies on free coefficients, the place counts as fixed by a support.
constexpr double kMinPart = 0.02;
/// Least mean of the projection Φ over the measure of a mask, over its mean over Φ itself.
constexpr double kMinOverlap = 0.5;

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
    Index points = 0, functions = 0;
    for (int e = 0; e < surface.elements().count(); ++e) {
      points = std::max(points, surface.elements()[e].project.cols());
      functions = std::max(functions, surface.elements()[e].project.rows());
    }
    bump_.resize(points);
    local_.resize(functions);
    ofElement_.resize(functions);
  }

  /// Share θ of the wanted bump in the measure Ψ = (1 - 2θ) Φ + 2θ b of a mask, with Φ and b over
  /// their integrals. 1, except where a support fixes most of the bump: there the projection is a
  /// tail outside of the support, b hardly reaches it, and with θ = 1 a mask would move against its
  /// own force. `carried` = ∫ Φ dΓ, `free` = ∫ b dΓ, mm^2.
  double shareOfWanted(double carried, double free) const {
    double withBump = 0, withItself = 0;
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      withBump += traction_[k] * moments_[k] / free;
      withItself += traction_[k] * ofTraction_[measureIndex_[nodes_[k]]] / carried;
    }
    const double lost = 1 - withBump / withItself;
    return 2 * lost > 1 - kMinOverlap ? (1 - kMinOverlap) / (2 * lost) : 1.0;
  }

 private:
  friend class ElementContactSurface;
  std::vector<unsigned> cellStamp_, elementStamp_, nodeStamp_, measureStamp_;
  unsigned stamp_ = 0;
  std::vector<int> cells_, around_, nodeIndex_, measureIndex_;
  std::vector<int> nodes_;                    // coefficients that the bump reaches
  std::vector<double> traction_;              // their values of the projection; 0 where fixed
  std::vector<double> moments_;               // ∫ b N dΓ outside of supports, mm^2
  std::vector<double> ofTraction_;            // per measured_: ∫ N Φ dΓ, mm^2
  std::vector<int> measured_;                 // displacement coefficients around the projection
  Eigen::VectorXd bump_, local_, ofElement_;  // of one element
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
  integrate(work);
  const double carried = std::accumulate(work.ofTraction_.begin(), work.ofTraction_.end(), 0.0);
  const double free = std::accumulate(work.moments_.begin(), work.moments_.end(), 0.0);
  if (carried <= kMinPart * bump || free <= kMinPart * bump) {
    mask.points.clear();
    mask.pointWeights.clear();
    return false;
  }
  for (std::size_t k = 0; k < work.nodes_.size(); ++k) {
    if (!dofs().isFree(work.nodes_[k])) continue;
    mask.nodes.push_back(work.nodes_[k]);
    mask.traction.push_back(work.traction_[k] / carried);
  }
  mask.measureNodes = work.measured_;
  const double share = work.shareOfWanted(carried, free);
  for (const double integral : work.ofTraction_)
    mask.measure.push_back((1 - 2 * share) * integral / carried);
  for (std::size_t k = 0; k < work.nodes_.size(); ++k)
    mask.measure[work.measureIndex_[work.nodes_[k]]] += 2 * share * work.moments_[k] / free;
  for (double& weight : mask.pointWeights) weight /= free;
  return true;
}

/// Projects the bump b = (1 - (ρ/radius)^2)^2 on the elements that reach into the ball and are
/// connected with the touched element: the far side of a thin body must stay untouched. Computes
/// its moments outside of supports, and appends its points there and their parts of the integral to
/// the mask. Returns the integral of the whole bump, mm^2.
double ElementContactSurface::project(const Vector3d& middle, double radius, Workspace& work,
                                      ContactMask& mask) const {
  const double inverse = 1.0 / (radius * radius);
  work.nodes_.clear();
  work.traction_.clear();
  work.moments_.clear();
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
      addElement(element, work, mask);
    }
  }
  return integral;
}

/// Adds the bump on one element, unless a support fixes all of it.
void ElementContactSurface::addElement(const ContactElements::Element& element, Workspace& work,
                                       ContactMask& mask) const {
  if (std::none_of(element.coefficients.begin(), element.coefficients.end(),
                   [this](int node) { return dofs().isFree(node); }))
    return;
  const auto bump = work.bump_.head(element.bumpPoints.rows());
  for (Index q = 0; q < bump.size(); ++q) {
    if (bump[q] == 0) continue;
    mask.points.push_back(element.bumpPoints.row(q).transpose());
    mask.pointWeights.push_back(element.bumpWeights[q] * bump[q]);
  }
  auto local = work.local_.head(element.project.rows());
  auto moments = work.ofElement_.head(element.project.rows());
  local.noalias() = element.project * bump;
  moments.noalias() = element.moments * bump;
  for (Index a = 0; a < local.size(); ++a) {
    const int node = element.coefficients[a];
    if (work.nodeStamp_[node] != work.stamp_) {
      work.nodeStamp_[node] = work.stamp_;
      work.nodeIndex_[node] = static_cast<int>(work.nodes_.size());
      work.nodes_.push_back(node);
      work.traction_.push_back(0.0);
      work.moments_.push_back(0.0);
    }
    if (dofs().isFree(node)) work.traction_[work.nodeIndex_[node]] += local[a];
    work.moments_[work.nodeIndex_[node]] += moments[a];
  }
}

/// Computes ∫ N_j Φ dΓ for the displacement functions N_j around the projection Φ.
void ElementContactSurface::integrate(Workspace& work) const {
  work.around_.clear();
  for (const int node : work.nodes_)
    for (const int e : elements().around(node)) {
      if (work.elementStamp_[e] == work.stamp_) continue;
      work.elementStamp_[e] = work.stamp_;
      work.around_.push_back(e);
    }
  work.measured_.clear();
  work.ofTraction_.clear();
  for (const int e : work.around_) {
    const ContactElements::Element& element = elements()[e];
    const std::vector<int>& nodes = element.coefficients;
    auto local = work.local_.head(element.mass.cols());
    auto ofElement = work.ofElement_.head(element.mass.rows());
    for (std::size_t a = 0; a < nodes.size(); ++a)
      local[static_cast<Index>(a)] = work.nodeStamp_[nodes[a]] == work.stamp_
                                         ? work.traction_[work.nodeIndex_[nodes[a]]]
                                         : 0.0;
    ofElement.noalias() = element.mass * local;
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      if (work.measureStamp_[nodes[a]] != work.stamp_) {
        work.measureStamp_[nodes[a]] = work.stamp_;
        work.measureIndex_[nodes[a]] = static_cast<int>(work.measured_.size());
        work.measured_.push_back(nodes[a]);
        work.ofTraction_.push_back(0.0);
      }
      work.ofTraction_[work.measureIndex_[nodes[a]]] += ofElement[static_cast<Index>(a)];
    }
  }
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

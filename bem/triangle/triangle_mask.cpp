#include <algorithm>
#include <cmath>

#include "bem/base/triangle_rule.h"
#include "bem/triangle/triangle_contact_surface.h"

// Masks of contacts on a TriangleContactSurface.

namespace palpa::bem {
namespace {

using Eigen::Vector3d;

/// Integration cells are at most this part of the radius.
constexpr double kCell = 1.0 / 4;

/// Nodes whose mean of the bump is below this fade out of the projection. Otherwise a node that the
/// bump just reaches would change the coefficients of all others at once, and the force of a
/// sliding contact would jump by half a per cent.
constexpr double kFade = 0.002;
constexpr double kMaxFading = 1e9;

/// Relative residual of the projection.
constexpr double kProjectionTolerance = 1e-13;
constexpr int kMaxIterations = 200;

}  // namespace

class TriangleContactSurface::Workspace final : public ContactSurface::Workspace {
 public:
  explicit Workspace(const TriangleContactSurface& surface)
      : triangleStamp_(surface.mesh().triangles.size(), 0),
        aroundStamp_(surface.mesh().triangles.size(), 0),
        nodeStamp_(surface.mesh().nodes.size(), 0),
        measureStamp_(surface.mesh().nodes.size(), 0),
        nodeIndex_(surface.mesh().nodes.size(), 0),
        measureIndex_(surface.mesh().nodes.size(), 0) {}

 private:
  friend class TriangleContactSurface;
  std::vector<unsigned> triangleStamp_, aroundStamp_, nodeStamp_, measureStamp_;
  unsigned stamp_ = 0;
  std::vector<int> touched_, around_, nodeIndex_, measureIndex_;
  std::vector<double> coefficients_;  // of the measure
  Eigen::Index count_ = 0;            // nodes of the mask
  // One number per node of the mask; longer than needed, to allocate rarely.
  Eigen::VectorXd right_, residual_, search_, image_, diagonal_, fade_;
};

std::unique_ptr<ContactSurface::Workspace> TriangleContactSurface::makeWorkspace() const {
  return std::make_unique<Workspace>(*this);
}

bool TriangleContactSurface::makeMask(const SurfacePoint& point, double radius,
                                      ContactSurface::Workspace& workspace,
                                      ContactMask& mask) const {
  auto& work = static_cast<Workspace&>(workspace);
  mask.point = point;
  mask.radius = maskRadius(point, radius);
  ++work.stamp_;
  collectTriangles(point, mask.radius, work);
  collectNodes(work, mask.nodes);
  mask.measureNodes.clear();
  mask.points.clear();
  mask.pointWeights.clear();
  if (mask.nodes.empty() || integrateBump(point, mask.radius, work) <= 0) {
    mask.nodes.clear();
    mask.traction.clear();
    mask.measure.clear();
    return false;
  }
  project(work, mask.traction);
  measure(work, mask);
  return true;
}

/// Triangles that reach into the ball and are connected to the touched one: the far side of a thin
/// body must not be touched.
void TriangleContactSurface::collectTriangles(const SurfacePoint& point, double radius,
                                              Workspace& work) const {
  work.touched_.clear();
  work.touched_.push_back(point.triangle);
  work.triangleStamp_[point.triangle] = work.stamp_;
  for (std::size_t k = 0; k < work.touched_.size(); ++k) {
    for (const int node : mesh().triangles[work.touched_[k]]) {
      if ((mesh().nodes[node] - point.position).squaredNorm() >= radius * radius) continue;
      for (int i = firstOfNode_[node]; i < firstOfNode_[node + 1]; ++i) {
        const int neighbour = ofNode_[i];
        if (work.triangleStamp_[neighbour] == work.stamp_) continue;
        work.triangleStamp_[neighbour] = work.stamp_;
        work.touched_.push_back(neighbour);
      }
    }
  }
}

/// The free nodes of the touched triangles, and all triangles around these.
void TriangleContactSurface::collectNodes(Workspace& work, std::vector<int>& nodes) const {
  nodes.clear();
  work.around_.clear();
  for (const int t : work.touched_)
    for (const int node : mesh().triangles[t]) {
      if (work.nodeStamp_[node] == work.stamp_ || !dofs().isFree(node)) continue;
      work.nodeStamp_[node] = work.stamp_;
      work.nodeIndex_[node] = static_cast<int>(nodes.size());
      nodes.push_back(node);
      for (int i = firstOfNode_[node]; i < firstOfNode_[node + 1]; ++i) {
        const int neighbour = ofNode_[i];
        if (work.aroundStamp_[neighbour] == work.stamp_) continue;
        work.aroundStamp_[neighbour] = work.stamp_;
        work.around_.push_back(neighbour);
      }
    }
  work.count_ = static_cast<Eigen::Index>(nodes.size());
  if (work.right_.size() < work.count_)
    for (Eigen::VectorXd* vector :
         {&work.right_, &work.residual_, &work.search_, &work.image_, &work.diagonal_, &work.fade_})
      vector->resize(2 * work.count_);
  work.right_.head(work.count_).setZero();
}

/// ∫ N_k (1 - (ρ/radius)^2)^2 dΓ over the touched triangles, by a rule of degree 5 on congruent
/// cells; returns the sum.
double TriangleContactSurface::integrateBump(const SurfacePoint& point, double radius,
                                             Workspace& work) const {
  const double inverse = 1.0 / (radius * radius);
  for (const int t : work.touched_) {
    const auto& c = mesh().triangles[t];
    const Vector3d origin = mesh().nodes[c[0]] - point.position;
    const Vector3d ab = mesh().nodes[c[1]] - mesh().nodes[c[0]];
    const Vector3d ac = mesh().nodes[c[2]] - mesh().nodes[c[0]];
    const int cells = static_cast<int>(
        std::clamp(std::ceil(triangles_[t].longestEdge / (kCell * radius)), 1.0, 32.0));
    const double weight = triangles_[t].area / (cells * cells);
    Vector3d sum = Vector3d::Zero();
    const auto visitCell = [&](double i, double j, double sign) {
      for (const TrianglePoint& q : triangleRule7()) {
        const double u = (i + sign * q.barycentric[1]) / cells;
        const double v = (j + sign * q.barycentric[2]) / cells;
        const double s = 1.0 - (origin + u * ab + v * ac).squaredNorm() * inverse;
        if (s > 0) sum += (weight * q.weight * s * s) * Vector3d(1 - u - v, u, v);
      }
    };
    for (int i = 0; i < cells; ++i)
      for (int j = 0; i + j < cells; ++j) {
        visitCell(i, j, 1);
        if (i + j + 1 < cells) visitCell(i + 1, j + 1, -1);
      }
    for (int a = 0; a < 3; ++a)
      if (work.nodeStamp_[c[a]] == work.stamp_) work.right_[work.nodeIndex_[c[a]]] += sum[a];
  }
  return work.right_.head(work.count_).sum();
}

/// Solves (M + F) φ = ∫ N b dΓ for the coefficients of the bump b: M is the mass matrix of the free
/// nodes over the whole surface, F = m_k (kFade / mean of b at k)^2 on the diagonal, m_k = ∫ N_k.
/// Conjugate gradients with the diagonal, with a condition number below 20 for any size of the
/// elements (A. J. Wathen, IMA J. Numer. Anal. 7 (1987) 449-457).
void TriangleContactSurface::project(Workspace& work, std::vector<double>& coefficients) const {
  const Eigen::Index count = work.count_;
  auto right = work.right_.head(count), residual = work.residual_.head(count);
  auto search = work.search_.head(count), image = work.image_.head(count);
  auto diagonal = work.diagonal_.head(count), fade = work.fade_.head(count);
  const auto indexOf = [&](int node) {
    return work.nodeStamp_[node] == work.stamp_ ? work.nodeIndex_[node] : -1;
  };
  diagonal.setZero();
  for (const int t : work.around_)
    for (const int node : mesh().triangles[t])
      if (const int k = indexOf(node); k >= 0) diagonal[k] += triangles_[t].area / 6.0;
  // The diagonal of M is half of m_k.
  for (Eigen::Index k = 0; k < count; ++k) {
    const double weight = kFade * 2 * diagonal[k] / right[k];
    fade[k] = 2 * diagonal[k] * std::min(weight * weight, kMaxFading);
  }
  diagonal += fade;
  // ∫ λ_a λ_b = area / 12, twice that where the corners are the same.
  const auto multiply = [&] {
    image = fade.cwiseProduct(search);
    for (const int t : work.around_) {
      int index[3];
      double value[3], sum = 0;
      for (int a = 0; a < 3; ++a) {
        index[a] = indexOf(mesh().triangles[t][a]);
        value[a] = index[a] >= 0 ? search[index[a]] : 0.0;
        sum += value[a];
      }
      for (int a = 0; a < 3; ++a)
        if (index[a] >= 0) image[index[a]] += triangles_[t].area / 12.0 * (sum + value[a]);
    }
  };
  coefficients.assign(work.count_, 0.0);
  Eigen::Map<Eigen::VectorXd> traction(coefficients.data(), count);
  residual = right;
  search = residual.cwiseQuotient(diagonal);
  double rho = residual.dot(search);
  const double enough = rho * kProjectionTolerance * kProjectionTolerance;
  for (int iteration = 0; iteration < kMaxIterations && rho > enough; ++iteration) {
    multiply();
    const double step = rho / search.dot(image);
    traction += step * search;
    residual -= step * image;
    image = residual.cwiseQuotient(diagonal);
    const double next = residual.dot(image);
    search = image + (next / rho) * search;
    rho = next;
  }
}

/// Ψ: ∫ Φ u dΓ as weights of nodal displacements, u between the nodes recovered to third order.
/// Also normalises the traction to ∫ Φ dΓ = 1.
void TriangleContactSurface::measure(Workspace& work, ContactMask& mask) const {
  work.coefficients_.clear();
  const auto add = [&](int node, double weight) {
    if (work.measureStamp_[node] != work.stamp_) {
      work.measureStamp_[node] = work.stamp_;
      work.measureIndex_[node] = static_cast<int>(mask.measureNodes.size());
      mask.measureNodes.push_back(node);
      work.coefficients_.push_back(0.0);
    }
    work.coefficients_[work.measureIndex_[node]] += weight;
  };
  for (const int t : work.around_) {
    const auto& c = mesh().triangles[t];
    double phi[3];
    for (int a = 0; a < 3; ++a)
      phi[a] = work.nodeStamp_[c[a]] == work.stamp_ ? mask.traction[work.nodeIndex_[c[a]]] : 0.0;
    const double sum = phi[0] + phi[1] + phi[2];
    for (int a = 0; a < 3; ++a) {
      // ∫ λ_a λ_b = area / 12 and ∫ λ_a λ_b λ_c = area / 60, twice that where an index repeats.
      add(c[a], triangles_[t].area / 12.0 * (sum + phi[a]));
      const double cubic = triangles_[t].area / 60.0 * (sum + phi[a] + phi[(a + 1) % 3]);
      for (const Weight& bulged : bulge(t, a)) add(bulged.node, cubic * bulged.weight);
    }
  }
  // The bulges of a translation vanish, so the sum is ∫ Φ dΓ.
  double integral = 0;
  for (const double weight : work.coefficients_) integral += weight;
  for (double& coefficient : mask.traction) coefficient /= integral;
  mask.measure.resize(work.coefficients_.size());
  for (std::size_t k = 0; k < mask.measure.size(); ++k)
    mask.measure[k] = work.coefficients_[k] / integral;
  // At nodes the mesh lies on the true surface, and between them Ψ recovers it.
  for (const int node : mask.measureNodes) mask.points.push_back(mesh().nodes[node]);
  mask.pointWeights = mask.measure;
}

}  // namespace palpa::bem

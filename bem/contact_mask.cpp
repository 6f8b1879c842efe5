#include "bem/contact_mask.h"

#include <Eigen/Sparse>
#include <algorithm>
#include <cstdio>
#include <map>
#include <numeric>
#include <set>

#include "bem/displacement_recovery.h"
#include "bem/error.h"
#include "bem/traction_projection.h"

namespace palpa::bem {
namespace {

using Eigen::Vector3d;

/// Radius over edge length at which half the bump's height is as wide as that of a nodal basis
/// function.
constexpr double kNarrowest = 1.25;

std::vector<std::vector<int>> trianglesOfNodes(const BoundaryMesh& mesh) {
  std::vector<std::vector<int>> result(mesh.nodes.size());
  for (int t = 0; t < mesh.triangleCount(); ++t)
    for (const int node : mesh.triangles[t]) result[node].push_back(t);
  return result;
}

double longestEdge(const BoundaryMesh& mesh, int t) {
  const auto& c = mesh.triangles[t];
  double longest = 0;
  for (int k = 0; k < 3; ++k)
    longest = std::max(longest, (mesh.nodes[c[(k + 1) % 3]] - mesh.nodes[c[k]]).norm());
  return longest;
}

/// Longest edges around the corners, interpolated: continuous when the point moves, so that the
/// radius is, too.
double localEdgeLength(const BoundaryMesh& mesh, const std::vector<std::vector<int>>& ofNode,
                       const SurfacePoint& point) {
  double length = 0;
  for (int corner = 0; corner < 3; ++corner) {
    double longest = 0;
    for (const int t : ofNode[mesh.triangles[point.triangle][corner]])
      longest = std::max(longest, longestEdge(mesh, t));
    length += point.weights[corner] * longest;
  }
  return length;
}

/// Triangles that reach into the ball and hang together with the touched one: the far side of a
/// thin body must not be touched as well.
std::vector<int> touchedTriangles(const BoundaryMesh& mesh,
                                  const std::vector<std::vector<int>>& ofNode,
                                  const SurfacePoint& point, double radius) {
  std::set<int> touched{point.triangle};
  std::vector<int> open{point.triangle};
  while (!open.empty()) {
    const int t = open.back();
    open.pop_back();
    for (const int node : mesh.triangles[t]) {
      if ((mesh.nodes[node] - point.position).norm() >= radius) continue;
      for (const int neighbour : ofNode[node])
        if (touched.insert(neighbour).second) open.push_back(neighbour);
    }
  }
  return {touched.begin(), touched.end()};
}

std::string formatPoint(const Vector3d& p) {
  char text[80];
  std::snprintf(text, sizeof text, "(%.4g, %.4g, %.4g)", p[0], p[1], p[2]);
  return text;
}

}  // namespace

Eigen::MatrixXd ContactMask::displacement(const Eigen::MatrixXd& u) const {
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(3, u.cols());
  for (std::size_t k = 0; k < measureNodes.size(); ++k)
    d += measure[static_cast<Eigen::Index>(k)] * u.middleRows<3>(3 * measureNodes[k]);
  return d;
}

ContactMask makeContactMask(const BoundaryMesh& mesh, const TractionSlots& slots,
                            const DegreesOfFreedom& dofs, const Vector3d& at, double radius) {
  ContactMask mask;
  mask.point = nearestSurfacePoint(mesh, at);
  const auto ofNode = trianglesOfNodes(mesh);
  mask.radius = std::max(radius, kNarrowest * localEdgeLength(mesh, ofNode, mask.point));

  const std::vector<int> touched = touchedTriangles(mesh, ofNode, mask.point, mask.radius);
  std::map<int, int> index;  // free nodes of the touched triangles
  for (const int t : touched)
    for (const int node : mesh.triangles[t])
      if (dofs.isFree(node)) index.try_emplace(node, 0);
  for (auto& [node, k] : index) {
    k = static_cast<int>(mask.nodes.size());
    mask.nodes.push_back(node);
  }

  // L2 projection: the mass matrix of these nodes over the whole surface, the bump over the touched
  // triangles.
  const auto count = static_cast<Eigen::Index>(mask.nodes.size());
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  const Vector3d center = mask.point.position;
  visitQuadraturePoints(
      mesh, touched, mask.radius / 8, [&](int t, const Vector3d& weights, double area) {
        const double s =
            (mesh.point(t, weights) - center).squaredNorm() / (mask.radius * mask.radius);
        if (s >= 1) return;
        for (int a = 0; a < 3; ++a) {
          const auto place = index.find(mesh.triangles[t][a]);
          if (place != index.end()) right[place->second] += area * weights[a] * (1 - s) * (1 - s);
        }
      });
  if (count == 0 || right.sum() <= 0)
    throw SolverError(SolverError::Kind::kBadCondition,
                      "the place touched at " + formatPoint(center) +
                          " mm is held by a support; touch the body where it is free");

  std::set<int> around;
  for (const int node : mask.nodes) around.insert(ofNode[node].begin(), ofNode[node].end());
  std::vector<Eigen::Triplet<double>> entries;
  for (const int t : around)
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        const auto i = index.find(mesh.triangles[t][a]), j = index.find(mesh.triangles[t][b]);
        if (i != index.end() && j != index.end())
          entries.emplace_back(i->second, j->second, mesh.area(t) / (a == b ? 6.0 : 12.0));
      }
  Eigen::SparseMatrix<double> mass(count, count);
  mass.setFromTriplets(entries.begin(), entries.end());
  mask.traction = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(mass).solve(right);

  // Ψ: ∫ Φ u dΓ as weights of nodal displacements, u between the nodes recovered to third order.
  const DisplacementRecovery recovery(mesh, slots);
  const auto coefficient = [&](int t, int corner) {
    const auto place = index.find(mesh.triangles[t][corner]);
    return place == index.end() ? 0.0 : mask.traction[place->second];
  };
  std::map<int, double> measure;
  for (const int t : around)
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      const double phiA = coefficient(t, a), phiB = coefficient(t, b), phiC = coefficient(t, c);
      // ∫ λ_a λ_b = area / 12 and ∫ λ_a λ_b λ_c = area / 60, twice that where an index repeats.
      measure[mesh.triangles[t][a]] += mesh.area(t) / 12.0 * (2 * phiA + phiB + phiC);
      for (const auto& [node, weight] : recovery.bulge(t, a))
        measure[node] += mesh.area(t) / 60.0 * (2 * phiA + 2 * phiB + phiC) * weight;
    }
  // The bulges of a translation vanish, so the sum is ∫ Φ dΓ.
  const double integral =
      std::accumulate(measure.begin(), measure.end(), 0.0,
                      [](double sum, const auto& entry) { return sum + entry.second; });
  mask.traction /= integral;
  mask.measure.resize(static_cast<Eigen::Index>(measure.size()));
  for (const auto& [node, weight] : measure) {
    mask.measure[static_cast<Eigen::Index>(mask.measureNodes.size())] = weight / integral;
    mask.measureNodes.push_back(node);
  }
  return mask;
}

}  // namespace palpa::bem

#include "bem/triangle/triangle_body_force.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "bem/base/triangle_rule.h"
#include "bem/model/displacement_recovery.h"

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

/// Distances over the radius of a triangle from which the rules of 16 and 7 points have errors
/// below 1e-8 of its area (tests/bem/body_force_test.cpp).
constexpr double kFar16 = 5, kFar7 = 14;

Vector3d byRule(std::span<const TrianglePoint> rule, const double* corners, double area,
                const Vector3d& x) {
  Vector3d sum = Vector3d::Zero();
  for (const TrianglePoint& q : rule) {
    Vector3d r;
    for (int i = 0; i < 3; ++i)
      r[i] = q.barycentric[0] * corners[i] + q.barycentric[1] * corners[3 + i] +
             q.barycentric[2] * corners[6 + i] - x[i];
    sum += q.weight / r.norm() * r;
  }
  return area * sum;
}

/// Calls visit(triangle, barycentric weights, point, area vector) at the points of a rule of degree
/// 5.
template <class Visit>
void visitPoints(const BoundaryMesh& mesh, const Visit& visit) {
  for (int t = 0; t < mesh.triangleCount(); ++t) {
    const Vector3d area = mesh.area(t) * mesh.normal(t);
    for (const TrianglePoint& q : triangleRule7()) {
      const Vector3d weights(q.barycentric[0], q.barycentric[1], q.barycentric[2]);
      visit(t, weights, mesh.point(t, weights), Vector3d(q.weight * area));
    }
  }
}

}  // namespace

Vector3d directionIntegral(const FlatTriangle& t, const Vector3d& x) {
  const double tiny = 1e-14 * t.radius;
  const Vector3d q = x - Vector3d(t.origin);
  const double x1 = q.dot(Vector3d(t.axis[0])), x2 = q.dot(Vector3d(t.axis[1]));
  const double height = -q.dot(Vector3d(t.normal));
  const double z = std::abs(height) < 1e-12 * t.radius ? 0 : height;
  double c[3][2], R[3];
  for (int k = 0; k < 3; ++k) {
    c[k][0] = t.corner[k][0] - x1;
    c[k][1] = t.corner[k][1] - x2;
    R[k] = std::max(std::sqrt(c[k][0] * c[k][0] + c[k][1] * c[k][1] + z * z), tiny);
  }
  const auto dot = [&](int a, int b) { return c[a][0] * c[b][0] + c[a][1] * c[b][1] + z * z; };
  const double solidAngle =
      z == 0 ? 0
             : 2 * std::atan2(2 * t.area * z, R[0] * R[1] * R[2] + dot(0, 1) * R[2] +
                                                  dot(0, 2) * R[1] + dot(1, 2) * R[0]);
  double inverse = -z * solidAngle, inPlane[2] = {0, 0};  // ∫ 1/R, ∫ ρ/R = Σ m ∫ R ds
  for (int k = 0; k < 3; ++k) {
    const double t0 = t.tangent[k][0], t1 = t.tangent[k][1], m0 = t1, m1 = -t0;
    const double s1 = c[k][0] * t0 + c[k][1] * t1, s2 = s1 + t.length[k];
    const double p = c[k][0] * m0 + c[k][1] * m1;
    const double R1 = R[k], R2 = R[(k + 1) % 3], R0 = std::max(p * p + z * z, tiny * tiny);
    const double L = s1 >= 0   ? std::log((R2 + s2) / (R1 + s1))
                     : s2 <= 0 ? std::log((R1 - s1) / (R2 - s2))
                               : std::log((R2 + s2) * (R1 - s1) / R0);
    const double integralR = 0.5 * (s2 * R2 - s1 * R1 + R0 * L);
    inverse += p * L;
    inPlane[0] += m0 * integralR;
    inPlane[1] += m1 * integralR;
  }
  return inPlane[0] * Vector3d(t.axis[0]) + inPlane[1] * Vector3d(t.axis[1]) +
         z * inverse * Vector3d(t.normal);
}

TriangleBodyForce::TriangleBodyForce(const BoundaryMesh& mesh) {
  for (int t = 0; t < mesh.triangleCount(); ++t) {
    double corners[3][3];
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) {
        corners[k][i] = mesh.nodes[mesh.triangles[t][k]][i];
        corners_.push_back(corners[k][i]);
      }
    shapes_.push_back(makeFlatTriangle(corners));
  }
}

Vector3d TriangleBodyForce::at(const Vector3d& x, const Bulk& bulk) const {
  double flux = 0;                       // Σ I.n
  Vector3d weighted = Vector3d::Zero();  // Σ I b.n / (2 (1 - nu))
  for (std::size_t k = 0; k < shapes_.size(); ++k) {
    const FlatTriangle& shape = shapes_[k];
    const double ofNormal =
        bulk.bodyForce.dot(Vector3d(shape.normal)) / (2 * (1 - bulk.material.poissonRatio));
    const double ratio = (x - Vector3d(shape.centroid)).norm() / shape.radius;
    const double* corners = corners_.data() + 9 * k;
    const Vector3d integral = ratio >= kFar7    ? byRule(triangleRule7(), corners, shape.area, x)
                              : ratio >= kFar16 ? byRule(triangleRule16(), corners, shape.area, x)
                                                : directionIntegral(shape, x);
    flux += integral.dot(Vector3d(shape.normal));
    weighted += ofNormal * integral;
  }
  return (flux * bulk.bodyForce - weighted) / (8 * std::numbers::pi * bulk.material.shear());
}

Eigen::VectorXd TriangleBodyForce::term(const std::vector<CollocationPoint>& points,
                                        const Bulk& bulk, const Job& job) const {
  constexpr std::ptrdiff_t kPerTask = 8;
  const auto count = static_cast<std::ptrdiff_t>(points.size());
  Eigen::VectorXd rows(3 * count);
  parallelFor((count + kPerTask - 1) / kPerTask, job, [&](std::ptrdiff_t task) {
    for (std::ptrdiff_t k = task * kPerTask; k < std::min(count, (task + 1) * kPerTask); ++k) {
      const Vector3d value = at(points[static_cast<std::size_t>(k)].position, bulk);
      for (int c = 0; c < 3; ++c) rows[c * count + k] = value[c];
    }
  });
  return rows;
}

VolumeMoments volumeMoments(const BoundaryMesh& mesh) {
  VolumeMoments moments(mesh.nodes.front());
  visitPoints(mesh, [&](int, const Vector3d&, const Vector3d& point, const Vector3d& area) {
    moments.add(point, area);
  });
  return moments;
}

BodyForceWork bodyForceWork(const BoundaryMesh& mesh, const TractionSlots& slots,
                            const Bulk& bulk) {
  BodyForceWork work;
  if (!bulk.hasBodyForce()) return work;
  const VolumeMoments moments = volumeMoments(mesh);
  const Vector3d centre = moments.centroid();
  work.ofDisplacement = Eigen::VectorXd::Zero(3 * static_cast<Index>(mesh.nodeCount()));
  work.ofTraction = Eigen::VectorXd::Zero(3 * static_cast<Index>(slots.count()));
  work.constant = particularWork(moments, bulk);
  visitPoints(mesh,
              [&](int t, const Vector3d& weights, const Vector3d& point, const Vector3d& area) {
                const Vector3d displacement =
                    particularState(point - centre, mesh.normal(t), bulk).displacement;
                for (int a = 0; a < 3; ++a)
                  work.ofTraction.segment<3>(3 * static_cast<Index>(slots.ofCorner[t][a])) +=
                      area.norm() * weights[a] * displacement;
              });
  // t* is linear on a triangle, and u is linear plus the bulges of the edges: see results.cpp.
  const DisplacementRecovery recovery(mesh, slots);
  for (int t = 0; t < mesh.triangleCount(); ++t) {
    const auto& corners = mesh.triangles[t];
    const double area = mesh.area(t);
    Vector3d traction[3];
    for (int a = 0; a < 3; ++a)
      traction[a] = particularState(mesh.nodes[corners[a]] - centre, mesh.normal(t), bulk).traction;
    const auto subtract = [&](int node, const Vector3d& value) {
      work.ofDisplacement.segment<3>(3 * static_cast<Index>(node)) -= value;
    };
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      subtract(corners[a], area / 12 * (2 * traction[a] + traction[b] + traction[c]));
      for (const auto& [node, weight] : recovery.bulge(t, a))
        subtract(node, area / 60 * weight * (2 * traction[a] + 2 * traction[b] + traction[c]));
    }
  }
  return work;
}

}  // namespace palpa::bem

#include "app/verification/exact/simple_meshes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

namespace palpa::verification {
using namespace bem;

namespace {

using Eigen::Vector3d;
constexpr double kPi = std::numbers::pi;

/// Collects triangles of parametrised sheets; points that coincide become one node.
class MeshBuilder {
 public:
  explicit MeshBuilder(double tolerance) : tolerance_(tolerance) {}

  int node(const Vector3d& p) {
    const auto key =
        std::make_tuple(std::llround(p[0] / tolerance_), std::llround(p[1] / tolerance_),
                        std::llround(p[2] / tolerance_));
    const auto [place, isNew] = index_.try_emplace(key, mesh_.nodeCount());
    if (isNew) mesh_.nodes.push_back(p);
    return place->second;
  }

  void triangle(int a, int b, int c, int group) {
    if (a == b || b == c || c == a) return;
    mesh_.triangles.push_back({a, b, c});
    mesh_.smoothingGroups.push_back(group);
    mesh_.tags.push_back(group);
  }

  /// Sheet of nu x nv cells; `position` maps [0,1]^2 with d/du x d/dv outward. Cells are split
  /// along the shorter diagonal, alternating where both are alike.
  void sheet(int nu, int nv, int group, const std::function<Vector3d(double, double)>& position) {
    std::vector<int> ids((nu + 1) * (nv + 1));
    for (int j = 0; j <= nv; ++j)
      for (int i = 0; i <= nu; ++i)
        ids[j * (nu + 1) + i] =
            node(position(static_cast<double>(i) / nu, static_cast<double>(j) / nv));
    for (int j = 0; j < nv; ++j)
      for (int i = 0; i < nu; ++i) {
        const int a = ids[j * (nu + 1) + i], b = ids[j * (nu + 1) + i + 1];
        const int d = ids[(j + 1) * (nu + 1) + i], c = ids[(j + 1) * (nu + 1) + i + 1];
        const double ac = (mesh_.nodes[a] - mesh_.nodes[c]).norm();
        const double bd = (mesh_.nodes[b] - mesh_.nodes[d]).norm();
        const bool alike = std::abs(ac - bd) < 1e-6 * (ac + bd);
        if (alike ? (i + j) % 2 == 0 : ac < bd) {
          triangle(a, b, c, group);
          triangle(a, c, d, group);
        } else {
          triangle(a, b, d, group);
          triangle(b, c, d, group);
        }
      }
  }

  BoundaryMesh take() { return std::move(mesh_); }

 private:
  double tolerance_;
  BoundaryMesh mesh_;
  std::map<std::tuple<long long, long long, long long>, int> index_;
};

/// The six faces of the cube [-1,1]^3 in the order xmin, xmax, ymin, ymax, zmin, zmax.
Vector3d cubePoint(int face, double s, double t) {
  const double a = 2 * s - 1, b = 2 * t - 1;
  switch (face) {
    case 0:
      return {-1, b, a};
    case 1:
      return {1, a, b};
    case 2:
      return {a, -1, b};
    case 3:
      return {b, 1, a};
    case 4:
      return {b, a, -1};
    default:
      return {a, b, 1};
  }
}

void addSphere(MeshBuilder& builder, double radius, int n, bool inward) {
  for (int face = 0; face < 6; ++face)
    builder.sheet(n, n, 0, [&](double s, double t) {
      if (inward) std::swap(s, t);
      const Vector3d p = cubePoint(face, s, t);
      const Vector3d q = (p * (kPi / 4)).array().tan();  // equal angles
      return Vector3d(radius * q.normalized());
    });
}

/// Disc as a square bent to a circle, d/ds x d/dt along +z.
Vector3d discPoint(double radius, double s, double t) {
  const double a = (2 * s - 1) * kPi / 4, b = (2 * t - 1) * kPi / 4;
  return {radius * std::sqrt(2.0) * std::sin(a) * std::cos(b),
          radius * std::sqrt(2.0) * std::cos(a) * std::sin(b), 0};
}

Vector3d cylinderPoint(double radius, double height, double s, double t) {
  const double angle = 2 * kPi * s + kPi / 4;
  return {radius * std::cos(angle), radius * std::sin(angle), height * t};
}

}  // namespace

BoundaryMesh sphereMesh(double radius, int n) {
  MeshBuilder builder(1e-9 * radius);
  addSphere(builder, radius, n, false);
  return builder.take();
}

BoundaryMesh hollowSphereMesh(double inner, double outer, int nInner, int nOuter) {
  MeshBuilder builder(1e-9 * outer);
  addSphere(builder, outer, nOuter, false);
  addSphere(builder, inner, nInner, true);
  return builder.take();
}

BoundaryMesh boxMesh(const Vector3d& low, const Vector3d& high, int nx, int ny, int nz) {
  MeshBuilder builder(1e-9 * (high - low).norm());
  const int cells[6][2] = {{nz, ny}, {ny, nz}, {nx, nz}, {nz, nx}, {ny, nx}, {nx, ny}};
  for (int face = 0; face < 6; ++face)
    builder.sheet(cells[face][0], cells[face][1], face, [&](double s, double t) {
      const Vector3d p = (cubePoint(face, s, t) + Vector3d::Ones()) / 2;
      return Vector3d(low + p.cwiseProduct(high - low));
    });
  return builder.take();
}

BoundaryMesh cylinderMesh(double radius, double height, int around, int up) {
  MeshBuilder builder(1e-9 * radius);
  builder.sheet(around, up, 0,
                [&](double s, double t) { return cylinderPoint(radius, height, s, t); });
  builder.sheet(around / 4, around / 4, 1,
                [&](double s, double t) { return discPoint(radius, t, s); });
  builder.sheet(around / 4, around / 4, 2, [&](double s, double t) {
    return Vector3d(discPoint(radius, s, t) + Vector3d(0, 0, height));
  });
  return builder.take();
}

BoundaryMesh gradedCylinderMesh(double radius, double height, int around, int up) {
  BoundaryMesh mesh = cylinderMesh(radius, height, around, up);
  for (Vector3d& x : mesh.nodes) {
    const double r = std::hypot(x[0], x[1]);
    if (r > 0) x.head<2>() *= radius * std::sin(kPi / 2 * std::min(r / radius, 1.0)) / r;
    x[2] = height / 2 * (1 - std::cos(kPi * x[2] / height));
  }
  return mesh;
}

BoundaryMesh hollowCylinderMesh(double inner, double outer, double height, int around, int up) {
  MeshBuilder builder(1e-9 * outer);
  const int rings = std::max(
      2, static_cast<int>(std::lround(around * (outer - inner) / (kPi * (outer + inner)))));
  builder.sheet(around, up, 0,
                [&](double s, double t) { return cylinderPoint(outer, height, s, t); });
  builder.sheet(around, up, 3,
                [&](double s, double t) { return cylinderPoint(inner, height, 1 - s, t); });
  builder.sheet(rings, around, 2, [&](double s, double t) {
    return cylinderPoint(inner + s * (outer - inner), height, t, 1.0);
  });
  builder.sheet(rings, around, 1, [&](double s, double t) {
    return cylinderPoint(inner + s * (outer - inner), height, 1 - t, 0.0);
  });
  return builder.take();
}

BoundaryMesh torusMesh(double major, double minor, int nMajor, int nMinor) {
  MeshBuilder builder(1e-9 * major);
  builder.sheet(nMajor, nMinor, 0, [&](double s, double t) {
    const double a = 2 * kPi * s, b = 2 * kPi * t;
    const double r = major + minor * std::cos(b);
    return Vector3d(r * std::cos(a), r * std::sin(a), minor * std::sin(b));
  });
  return builder.take();
}

}  // namespace palpa::verification

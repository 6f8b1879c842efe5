#include "test_bodies.h"
#include "modeling/mesh/mesh.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

namespace palpa::modeling::test {
namespace {

using Eigen::Vector3d;
using Triangle = std::array<int, 3>;

constexpr double kPi = std::numbers::pi;

struct Soup {
  std::vector<Vector3d> positions;
  std::vector<Triangle> triangles;

  void quad(int a, int b, int c, int d) {
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  }
};

Soup sphereSoup(double radius, int level) {
  const double g = std::numbers::phi;
  Soup soup{{{-1, g, 0},
             {1, g, 0},
             {-1, -g, 0},
             {1, -g, 0},
             {0, -1, g},
             {0, 1, g},
             {0, -1, -g},
             {0, 1, -g},
             {g, 0, -1},
             {g, 0, 1},
             {-g, 0, -1},
             {-g, 0, 1}},
            {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
             {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
             {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  for (int i = 0; i < level; ++i) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [place, isNew] =
          middles.try_emplace(std::minmax(a, b), static_cast<int>(soup.positions.size()));
      if (isNew) soup.positions.push_back(soup.positions[a] + soup.positions[b]);
      return place->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : soup.triangles) {
      const int ab = middle(a, b);
      const int bc = middle(b, c);
      const int ca = middle(c, a);
      for (const Triangle& t : {Triangle{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}})
        finer.push_back(t);
    }
    soup.triangles = finer;
    for (Vector3d& p : soup.positions) p.normalize();
  }
  for (Vector3d& p : soup.positions) p = radius * p.normalized();
  return soup;
}

}  // namespace

MeshBody oneFace(std::vector<Vector3d> positions, std::vector<Triangle> triangles) {
  const std::size_t count = triangles.size();
  return MeshBody(
      {std::move(positions), std::move(triangles), std::vector<int>(count, 0), {"all"}});
}

MeshBody bodyOf(const Solid& solid, double edgeLength) {
  MeshSettings settings;
  settings.edgeLength = edgeLength;
  const SurfaceMesh surface = mesh(solid, settings);
  std::vector<std::string> names;
  for (const Patch& patch : solid.patches()) names.push_back(patch.name);
  return MeshBody({surface.positions, surface.triangles, surface.patchOfTriangle, names});
}

MeshBody torus(double radius, double tube, int around, int across) {
  Soup soup;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double u = 2 * kPi * i / around;
      const double v = 2 * kPi * j / across;
      const double r = radius + tube * std::cos(v);
      soup.positions.emplace_back(r * std::cos(u), r * std::sin(u), tube * std::sin(v));
      const int nextI = (i + 1) % around;
      const int nextJ = (j + 1) % across;
      soup.quad(i * across + j, nextI * across + j, nextI * across + nextJ, i * across + nextJ);
    }
  return oneFace(soup.positions, soup.triangles);
}

MeshBody boredCylinder(double radius, double bore, double height, int sides) {
  Soup soup;
  for (int i = 0; i < sides; ++i) {
    const Vector3d out(std::cos(2 * kPi * i / sides), std::sin(2 * kPi * i / sides), 0);
    for (const double r : {radius, bore})
      for (const double z : {0.0, height}) soup.positions.push_back(r * out + Vector3d(0, 0, z));
    const int a = 4 * i;  // outer bottom, outer top, inner bottom, inner top
    const int b = 4 * ((i + 1) % sides);
    soup.quad(a, b, b + 1, a + 1);
    soup.quad(b + 2, a + 2, a + 3, b + 3);
    soup.quad(a + 1, b + 1, b + 3, a + 3);
    soup.quad(a + 2, b + 2, b, a);
  }
  return oneFace(soup.positions, soup.triangles);
}

MeshBody icosphere(double radius, int level) {
  const Soup soup = sphereSoup(radius, level);
  return oneFace(soup.positions, soup.triangles);
}

MeshBody hollowSphere(double radius, double cavity, int level) {
  Soup soup = sphereSoup(radius, level);
  const Soup inner = sphereSoup(cavity, level);
  const int offset = static_cast<int>(soup.positions.size());
  soup.positions.insert(soup.positions.end(), inner.positions.begin(), inner.positions.end());
  for (const auto& [a, b, c] : inner.triangles)
    soup.triangles.push_back({a + offset, c + offset, b + offset});
  return oneFace(soup.positions, soup.triangles);
}

MeshBody plainBox(const Vector3d& size) {
  Soup soup;
  for (int i = 0; i < 8; ++i)
    soup.positions.push_back(size.cwiseProduct(Vector3d(i & 1, (i >> 1) & 1, i >> 2)));
  soup.quad(0, 2, 3, 1);
  soup.quad(4, 5, 7, 6);
  soup.quad(0, 1, 5, 4);
  soup.quad(2, 6, 7, 3);
  soup.quad(0, 4, 6, 2);
  soup.quad(1, 3, 7, 5);
  return oneFace(soup.positions, soup.triangles);
}

MeshBody noisy(const MeshBody& body, double amplitude) {
  std::mt19937 generator(1);
  const auto random = [&] { return 2.0 * generator() / 4294967295.0 - 1.0; };
  std::vector<Vector3d> positions = body.positions();
  for (Vector3d& p : positions) {
    const double x = random();
    const double y = random();
    p += amplitude * Vector3d(x, y, random());
  }
  return MeshBody({positions, body.triangles(), body.faceOfTriangle(), body.faceNames()});
}

MeshBody withSlivers(const MeshBody& body) {
  MeshBody::Data data{body.positions(), {}, {}, body.faceNames()};
  for (std::size_t t = 0; t < body.triangles().size(); ++t) {
    const auto [a, b, c] = body.triangles()[t];
    std::vector<Triangle> parts{{a, b, c}};
    if (t % 3 == 0) {
      const int m = static_cast<int>(data.positions.size());
      const auto& p = data.positions;
      data.positions.push_back(0.37 * p[a] + 0.6299 * p[b] + 0.0001 * p[c]);
      parts = {{a, b, m}, {b, c, m}, {c, a, m}};
    }
    for (const Triangle& part : parts) {
      data.triangles.push_back(part);
      data.faceOfTriangle.push_back(body.faceOfTriangle()[t]);
    }
  }
  return MeshBody(data);
}

}  // namespace palpa::modeling::test

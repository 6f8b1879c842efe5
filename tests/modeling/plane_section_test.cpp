#include "modeling/mesh/plane_section.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>

#include "modeling/mesh/display_mesh.h"
#include "modeling/mesh/mesh.h"
#include "modeling/project/project_file.h"
#include "modeling/shapes/primitives.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

double areaOf(const PlaneSection& section, const Vector3d& normal) {
  double area = 0;
  for (const auto& t : section.triangles) {
    const auto at = [&](int k) { return section.positions[static_cast<std::size_t>(t[k])]; };
    const double part = normal.dot((at(1) - at(0)).cross(at(2) - at(0))) / 2;
    EXPECT_GT(part, 0) << "seen from the normal's side";
    area += part;
  }
  return area;
}

/// A box by its corners; the vertices of each face are its own.
struct Box {
  std::vector<Vector3d> positions;
  std::vector<std::array<int, 3>> triangles;

  void add(const Vector3d& low, const Vector3d& high, bool isCavity = false) {
    for (int axis = 0; axis < 3; ++axis)
      for (const bool isHigh : {false, true}) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3,
                  first = static_cast<int>(positions.size());
        for (const auto& [a, b] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
          Vector3d x = isHigh ? high : low;
          x[u] = a ? high[u] : low[u];
          x[v] = b ? high[v] : low[v];
          positions.push_back(x);
        }
        for (std::array<int, 3> t : {std::array{0, 1, 2}, {0, 2, 3}}) {
          if (isHigh == isCavity) std::swap(t[1], t[2]);
          triangles.push_back({first + t[0], first + t[1], first + t[2]});
        }
      }
  }
};

void expectSound(const PlaneSection& section, const Plane& plane, const Box& box) {
  for (const Vector3d& x : section.positions) EXPECT_NEAR(plane.distance(x), 0, 1e-9);
  ASSERT_LE(section.outline.size(), section.positions.size());
  for (std::size_t k = 0; k < section.outline.size(); ++k) {
    Vector3d x = Vector3d::Zero();
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      x += section.outline[k].weights[i] *
           box.positions[static_cast<std::size_t>(section.outline[k].vertices[i])];
      sum += section.outline[k].weights[i];
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_LE((x - section.positions[k]).norm(), 1e-9);
  }
}

TEST(PlaneSection, OfABoxHasItsArea) {
  Box box;
  box.add({-20, -15, 0}, {20, 15, 20});
  for (const Plane& plane :
       {Plane{Vector3d::UnitX(), 3}, Plane{-Vector3d::UnitX(), 3}, Plane{Vector3d::UnitZ(), 10},
        Plane{Vector3d(1, 0, 1).normalized(), 7}}) {
    const PlaneSection section = planeSection(box.positions, box.triangles, plane, 4);
    expectSound(section, plane, box);
    const double expected = plane.normal.cwiseAbs().isApprox(Vector3d::UnitX()) ? 30 * 20
                            : plane.normal.cwiseAbs().isApprox(Vector3d::UnitZ())
                                ? 40 * 30
                                : 30 * 20 * std::sqrt(2.0);
    EXPECT_NEAR(areaOf(section, plane.normal), expected, 1e-6 * expected);
    EXPECT_GT(section.positions.size(), 50U);
  }
}

TEST(PlaneSection, LeavesOutCavitiesAndKeepsSeparatePieces) {
  Box box;
  box.add({-20, -15, 0}, {20, 15, 20});
  box.add({-5, -5, 5}, {5, 5, 15}, true);
  box.add({-1, -1, 9}, {1, 1, 11});
  box.add({30, -15, 0}, {40, 15, 20});
  const Plane plane{Vector3d::UnitZ(), 10};
  const PlaneSection section = planeSection(box.positions, box.triangles, plane, 3);
  expectSound(section, plane, box);
  EXPECT_NEAR(areaOf(section, plane.normal), 40 * 30 - 100 + 4 + 300, 1e-6);
}

TEST(PlaneSection, IsEmptyWhereThePlaneMissesOrOnlyTouches) {
  Box box;
  box.add({-20, -15, 0}, {20, 15, 20});
  for (const double offset : {-21.0, 20.0, 21.0, 1e6})
    EXPECT_TRUE(planeSection(box.positions, box.triangles, {Vector3d::UnitX(), offset}, 4)
                    .triangles.empty())
        << offset;
  // The face at -20 counts as in front; what is left of the body behind it is nothing.
  EXPECT_TRUE(
      planeSection(box.positions, box.triangles, {Vector3d::UnitX(), -20}, 4).triangles.empty());
  EXPECT_TRUE(planeSection({}, {}, {Vector3d::UnitX(), 0}, 4).triangles.empty());
}

TEST(PlaneSection, ThroughVerticesAndEdgesIsClosed) {
  Box box;
  box.add({-20, -15, 0}, {20, 15, 20});
  // Through two opposite edges, and through a corner with two diagonals.
  const Plane diagonal{Vector3d(30, -40, 0).normalized(), 0};
  const PlaneSection section = planeSection(box.positions, box.triangles, diagonal, 4);
  expectSound(section, diagonal, box);
  EXPECT_NEAR(areaOf(section, diagonal.normal), 50 * 20, 1e-6 * 1000);
}

TEST(PlaneSection, OfASphereIsACircleWithAClosedOutline) {
  const Solid sphere = makeSphere(25, 7);
  MeshSettings settings;
  settings.edgeLength = 6;
  const DisplayMesh drawn = displayMesh(mesh(sphere, settings), sphere);
  for (const Vector3d& direction : {Vector3d(0, 0, 1), Vector3d(1, 2, -0.5)})
    for (const double offset : {-24.9, -20.0, -5.0, 0.0, 1e-12, 4.0, 12.0, 24.0}) {
      const Plane plane{direction.normalized(), offset};
      const PlaneSection section = planeSection(drawn.positions, drawn.triangles, plane, 3);
      const double circle = std::numbers::pi * (25 * 25 - offset * offset);
      EXPECT_NEAR(areaOf(section, plane.normal), circle, 0.01 * circle + 3) << offset;
      std::map<std::array<int, 2>, int> uses;
      for (const auto& t : section.triangles)
        for (std::size_t k = 0; k < 3; ++k)
          ++uses[{std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])}];
      for (const auto& edge : section.edges)
        EXPECT_EQ((uses[{std::min(edge[0], edge[1]), std::max(edge[0], edge[1])}]), 1);
      EXPECT_LE(section.positions.size(), 2000U) << "graded, not refined everywhere";
    }
}

/// By Cavalieri's principle the areas of parallel sections add up to the volume.
TEST(PlaneSection, OfEveryExampleProjectAddsUpToItsVolume) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator("../projects")) {
    if (entry.path().extension() != ".json") continue;
    const Project project = readProject(entry.path());
    MeshSettings settings = project.mesh;
    settings.edgeLength = std::max(settings.edgeLength, 4.0);
    const SurfaceMesh surface = mesh(project.body, settings);
    const auto& x = surface.positions;
    double volume = 0;
    for (const auto& t : surface.triangles)
      volume += x[static_cast<std::size_t>(t[0])].dot(
                    x[static_cast<std::size_t>(t[1])].cross(x[static_cast<std::size_t>(t[2])])) /
                6;
    for (int axis = 0; axis < 3; ++axis) {
      const auto [low, high] = std::minmax_element(
          x.begin(), x.end(), [axis](const auto& a, const auto& b) { return a[axis] < b[axis]; });
      const double from = (*low)[axis], width = (*high)[axis] - from;
      constexpr int kCuts = 50;
      double sum = 0;
      for (int k = 0; k < kCuts; ++k) {
        const Plane plane{Vector3d::Unit(axis), from + (k + 0.5) / kCuts * width};
        sum += areaOf(planeSection(x, surface.triangles, plane, width), plane.normal);
      }
      EXPECT_NEAR(sum * width / kCuts, volume, 0.02 * volume) << entry.path() << axis;
      // A plane through the ends touches the body or takes a sliver of it.
      for (const double offset : {from, from + width})
        areaOf(planeSection(x, surface.triangles, {Vector3d::Unit(axis), offset}, width),
               Vector3d::Unit(axis));
    }
    ++count;
  }
  EXPECT_GE(count, 5);
}

TEST(PlaneSection, CanBeCancelled) {
  Box box;
  box.add({-20, -15, 0}, {20, 15, 20});
  std::stop_source stop;
  stop.request_stop();
  Job job;
  job.stop = stop.get_token();
  EXPECT_THROW(planeSection(box.positions, box.triangles, {Vector3d::UnitX(), 0}, 4, job),
               Cancelled);
}

}  // namespace
}  // namespace palpa::modeling

#include <array>
#include <limits>
#include <set>

#include "editing_fixture.h"
#include "modeling/editing/command_file.h"
#include "modeling/mesh/mesh.h"
#include "test_bodies.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

Project supported(Body body, Region first, Region second) {
  Project project;
  project.name = "test";
  project.body = std::move(body);
  project.supports = {{"base", Support::Kind::kFixed, std::move(first), Vector3d::Zero()},
                      {"hand", Support::Kind::kFixed, std::move(second), {0, 0, 1}}};
  project.mesh.edgeLength = 4;
  return project;
}

Project taken(const Project& project, const std::string& name, const std::string& from,
              double gap) {
  return apply(TakeOverlap{name, from, gap}, project).project;
}

double areaOf(const SurfaceMesh& mesh, const std::vector<int>& triangles) {
  double area = 0;
  for (const int t : triangles) {
    const auto& [a, b, c] = mesh.triangles[t];
    const auto& p = mesh.positions;
    area += 0.5 * (p[b] - p[a]).cross(p[c] - p[a]).norm();
  }
  return area;
}

/// Smallest distance between the nodes of the first two regions of a mesh, mm.
double distanceOfRegions(const SurfaceMesh& mesh) {
  std::array<std::set<int>, 2> nodes;
  for (const int region : {0, 1})
    for (const int t : mesh.trianglesOfRegion[region])
      nodes[region].insert(mesh.triangles[t].begin(), mesh.triangles[t].end());
  double least = std::numeric_limits<double>::infinity();
  for (const int a : nodes[0])
    for (const int b : nodes[1])
      least = std::min(least, (mesh.positions[a] - mesh.positions[b]).norm());
  return least;
}

struct Case {
  std::string name;
  Project project;
};

/// Pairs of all kinds of regions that overlap, on solids and on mesh bodies. Boxes of 40 x 30 x 20
/// mm on the plane z = 0.
std::vector<Case> cases() {
  const Solid box = makeBox({40, 30, 20});
  const Region low = Region::below(Vector3d::UnitZ(), 5), bottom = Region::ofPatches({"bottom"}),
               stroke{{Stroke{{{-10, 0, 0}, {10, 0, 0}}, 5}}},
               left = Region::below(Vector3d::UnitX(), -10);
  std::vector<Case> result{{"half space, stroke", supported(box, low, stroke)},
                           {"patch, stroke", supported(box, bottom, stroke)},
                           {"half space, half space", supported(box, low, left)},
                           {"half space, patch", supported(box, low, bottom)},
                           {"patch, half space", supported(box, bottom, left)}};
  const MeshBody body = test::bodyOf(box, 4);
  for (const Case& each : std::vector<Case>(result))
    result.push_back({"mesh body: " + each.name, supported(body, each.project.supports[0].where,
                                                           each.project.supports[1].where)});
  return result;
}

TEST(TakeOverlap, LeavesTheGapBetweenBothInEitherDirection) {
  for (const auto& [name, project] : cases()) {
    const auto whole = mesh(project.body, project.mesh, meshRegions(project));
    for (const int taker : {0, 1}) {
      const std::string to = project.supports[taker].name, from = project.supports[1 - taker].name;
      const Project result = taken(project, to, from, 3);
      if (result.supports.size() == 1) {  // nothing but the patch that was taken
        EXPECT_EQ(result.supports[0].name, to);
        continue;
      }
      EXPECT_EQ(result.supports[taker], project.supports[taker]) << name;
      SurfaceMesh fitted;
      try {
        fitted = mesh(result.body, result.mesh, meshRegions(result));
      } catch (const ModelingError& error) {
        // All of the stroke lies in the patch or half space that took it.
        EXPECT_EQ(from, "hand") << name << ": " << error.what();
        continue;
      }
      const double area = areaOf(whole, whole.trianglesOfRegion[taker]);
      EXPECT_NEAR(areaOf(fitted, fitted.trianglesOfRegion[taker]), area, 0.02 * area) << name;
      EXPECT_LT(areaOf(fitted, fitted.trianglesOfRegion[1 - taker]),
                areaOf(whole, whole.trianglesOfRegion[1 - taker]) - 10)
          << name;
      EXPECT_GT(distanceOfRegions(fitted), 0.9 * 3) << name << ", " << to;
    }
  }
}

TEST(TakeOverlap, WithoutAGapTheRegionsMeet) {
  const Project project = supported(makeBox({40, 30, 20}), Region::ofPatches({"bottom"}),
                                    {{Stroke{{{-10, 0, 0}, {10, 0, 0}}, 5}}});
  const Project result = taken(project, "hand", "base", 0);
  const auto fitted = mesh(result.body, result.mesh, meshRegions(result));
  EXPECT_EQ(distanceOfRegions(fitted), 0);
  EXPECT_NEAR(
      areaOf(fitted, fitted.trianglesOfRegion[0]) + areaOf(fitted, fitted.trianglesOfRegion[1]),
      40 * 30, 1e-6);
}

TEST(TakeOverlap, PatchesChangeTheirOwner) {
  const Project project = supported(makeBox({40, 30, 20}), Region::ofPatches({"bottom", "top"}),
                                    Region::ofPatches({"top"}));
  EXPECT_EQ(taken(project, "hand", "base", 0).supports[0].where, Region::ofPatches({"bottom"}));
  const Project result = taken(project, "base", "hand", 0);
  ASSERT_EQ(result.supports.size(), 1U);  // nothing was left of the other one
  EXPECT_EQ(result.supports[0].name, "base");
}

TEST(TakeOverlap, IsOneStepOfUndoAndSurvivesAFile) {
  const Project project = supported(makeBox({40, 30, 20}), Region::below(Vector3d::UnitZ(), 5),
                                    {{Stroke{{{0, 0, 0}}, 5}}});
  Document document(project);
  const Command command = TakeOverlap{"hand", "base", 1.5};
  document.perform(command);
  EXPECT_EQ(document.undoLabel(), "Take overlap from support \"base\"");
  const Region region = document.project().supports[0].where;
  ASSERT_EQ(region.except.size(), 1U);
  EXPECT_EQ(std::get<Stroke>(region.except[0]).radius, 6.5);
  document.perform(command);  // again: nothing changes
  EXPECT_EQ(document.project().supports[0].where, region);
  const std::string text = "{\"commands\": [" + toJson(command) + "]}";
  const auto read = std::get<TakeOverlap>(parseCommands(text, "test").at(0));
  EXPECT_EQ(read.name, "hand");
  EXPECT_EQ(read.from, "base");
  EXPECT_EQ(read.gap, 1.5);
}

TEST(TakeOverlap, NamesTheWrongField) {
  const Project project =
      supported(makeBox({40, 30, 20}), Region::ofPatches({"bottom"}), Region::ofPatches({"top"}));
  const auto fault = [&](const TakeOverlap& command) {
    return faultOf([&] { apply(command, project); });
  };
  expectBegins(fault({"foot", "base", 0}), "name: no support is named \"foot\"");
  expectBegins(fault({"base", "foot", 0}), "from: no support is named \"foot\"");
  expectBegins(fault({"base", "base", 0}), "from: must be another support");
  expectBegins(fault({"base", "hand", -1}), "gap_mm: must not be negative");
}

TEST(TakeOverlap, ExceptionsFollowTheBody) {
  Project project = supported(makeBox({40, 30, 20}), Region::below(Vector3d::UnitZ(), 5),
                              {{Stroke{{{0, 0, 0}}, 5}}});
  project = taken(project, "hand", "base", 1);
  const Project moved = apply(TransformSolid{Translation{{1, 2, 3}}}, project).project;
  EXPECT_EQ(std::get<Stroke>(moved.supports[0].where.except[0]).points[0], Vector3d(1, 2, 3));
  project.supports[0].where.except.emplace_back(PatchSet{{"top"}});
  const Project renamed = apply(RenamePatch{"top", "lid"}, project).project;
  EXPECT_EQ(std::get<PatchSet>(renamed.supports[0].where.except[1]).patches[0], "lid");
  project.supports[0].where.except.emplace_back(PatchSet{{"nowhere"}});
  expectBegins(faultOf([&] { checkProject(project); }),
               "supports[0].where[1].except[2].patches[0]: no patch is named \"nowhere\"");
}

}  // namespace
}  // namespace palpa::modeling

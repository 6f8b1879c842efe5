#include "modeling/editing/change.h"

#include <gtest/gtest.h>

#include "modeling/shapes/primitives.h"

namespace palpa::modeling {
namespace {

const Stroke kStroke{{{1, 2, 3}}, 2.0};

Project project() {
  Project project;
  project.body = makeBox({40, 30, 20});
  project.primitive = Primitive{};
  project.supports.push_back({"base", Support::Kind::kFixed, Region::ofPatches({"bottom"})});
  project.loads = {{"air", Pressure{Region::ofPatches({"top"}), 0.1}},
                   {"wind", UniformTraction{{{kStroke}}, {0, 0, 1}}},
                   {"finger", Bump{}}};
  project.touches.emplace_back();
  project.measurements.push_back({"height", MeasurementKind::kDistance, {{}, {}}});
  project.design.emplace().targets.push_back({"poke"});
  project.design->points = PointSelection::of({1});
  project.design->mirrors.emplace_back();
  return project;
}

UniformTraction& wind(Project& project) {
  return std::get<UniformTraction>(project.loads[1].what);
}

Bump& bump(Project& project) {
  return std::get<Bump>(project.loads[2].what);
}

using Edit = void (*)(Project&);

/// Every edit changes one value and must be reported as this part and no other.
void expectEach(bool Change::*part, std::initializer_list<Edit> edits) {
  const Project before = project();
  int number = 0;
  for (const Edit edit : edits) {
    SCOPED_TRACE("edit " + std::to_string(number++));
    Project after = before;
    edit(after);
    Change change = compare(before, after);
    EXPECT_TRUE(change.*part);
    EXPECT_TRUE(change.any());
    change.*part = false;
    EXPECT_FALSE(change.any());
  }
}

TEST(Change, EqualProjectsDoNotDiffer) {
  EXPECT_FALSE(compare(project(), project()).any());
}

TEST(Change, EveryFieldOfASupportCounts) {
  expectEach(&Change::supports,
             {[](Project& p) { p.supports.clear(); }, [](Project& p) { p.supports[0].name = "x"; },
              [](Project& p) { p.supports[0].kind = Support::Kind::kRoller; },
              [](Project& p) { p.supports[0].where = Region::ofPatches({"top"}); },
              [](Project& p) { p.supports[0].where.parts.emplace_back(HalfSpace{}); },
              [](Project& p) { p.supports[0].where.parts[0] = HalfSpace{}; },
              [](Project& p) { p.supports[0].displacement.z() = 1e-300; }});
}

TEST(Change, EveryFieldOfALoadCounts) {
  expectEach(&Change::loads,
             {[](Project& p) { p.loads.pop_back(); }, [](Project& p) { p.loads[0].name = "x"; },
              [](Project& p) { p.loads[0].what = Bump{}; },
              [](Project& p) { std::get<Pressure>(p.loads[0].what).pressure = 0.2; },
              [](Project& p) { std::get<Pressure>(p.loads[0].what).where.parts.clear(); },
              [](Project& p) { wind(p).traction.y() = 1; }, [](Project& p) { wind(p).where = {}; },
              [](Project& p) { std::get<Stroke>(wind(p).where.parts[0]).radius = 3; },
              [](Project& p) { std::get<Stroke>(wind(p).where.parts[0]).points[0].x() = 3; },
              [](Project& p) { bump(p).center.x() = 1; }, [](Project& p) { bump(p).radius = 2; },
              [](Project& p) { bump(p).peak = 2; }, [](Project& p) { bump(p).direction.x() = 2; }});
}

TEST(Change, EveryFieldOfATouchCounts) {
  expectEach(
      &Change::touches,
      {[](Project& p) { p.touches.clear(); }, [](Project& p) { p.touches[0].name = "x"; },
       [](Project& p) { p.touches[0].at.x() = 1; },
       [](Project& p) { p.touches[0].kind = TouchKind::kBall; },
       [](Project& p) { p.touches[0].vector.z() = 1; }, [](Project& p) { p.touches[0].radius = 1; },
       [](Project& p) { p.touches[0].friction = 0.5; }});
}

TEST(Change, EveryFieldOfAMeasurementCounts) {
  expectEach(
      &Change::measurements,
      {[](Project& p) { p.measurements.clear(); }, [](Project& p) { p.measurements[0].name = "x"; },
       [](Project& p) { p.measurements[0].kind = MeasurementKind::kLength; },
       [](Project& p) { p.measurements[0].places.pop_back(); },
       [](Project& p) { p.measurements[0].places[0].what = MeasuredPlace::What::kFace; },
       [](Project& p) { p.measurements[0].places[0].patch = "x"; },
       [](Project& p) { p.measurements[0].places[0].other = "x"; },
       [](Project& p) { p.measurements[0].places[0].side = Side::kUMax; },
       [](Project& p) { p.measurements[0].places[0].at = Eigen::Vector2d(0.5, 0.25); },
       [](Project& p) { p.measurements[0].places[0].at = Eigen::Vector3d(1, 2, 3); }});
}

TEST(Change, EveryFieldOfADesignCounts) {
  expectEach(
      &Change::design,
      {[](Project& p) { p.design.reset(); }, [](Project& p) { p.design->targets.clear(); },
       [](Project& p) { p.design->targets[0].touch = "x"; },
       [](Project& p) { p.design->targets[0].kind = DesignTarget::Kind::kForce; },
       [](Project& p) { p.design->targets[0].value = 2; },
       [](Project& p) { p.design->targets[0].depth = 2; },
       [](Project& p) { p.design->targets[0].weight = 2; },
       [](Project& p) { p.design->points = PointSelection::of({2}); },
       [](Project& p) { p.design->points.reset(); },
       [](Project& p) { p.design->along = Design::Along::kAny; },
       [](Project& p) { p.design->direction.x() = 1; },
       [](Project& p) { p.design->largestMovement = 1; },
       [](Project& p) { p.design->mirrors.pop_back(); },
       [](Project& p) { p.design->mirrors[0].normal.y() = 1; },
       [](Project& p) { p.design->volume = Design::Volume::kKept; },
       [](Project& p) { p.design->smallestThickness = 1; },
       [](Project& p) { p.design->smoothness = 2; }, [](Project& p) { p.design->tolerance = 0.01; },
       [](Project& p) { p.design->steps = 5; }});
}

TEST(Change, EveryFieldOfTheMaterialCounts) {
  [[maybe_unused]] const auto [name, youngsModulus, poissonRatio, density] = Material{};  // below
  expectEach(&Change::material, {[](Project& p) { p.material.name = "x"; },
                                 [](Project& p) { p.material.youngsModulus = 2; },
                                 [](Project& p) { p.material.densityKgPerM3 = 1100; },
                                 [](Project& p) { p.material.poissonRatio = 0.4; }});
}

TEST(Change, EveryFieldOfTheMeshSettingsCounts) {
  expectEach(
      &Change::mesh,
      {[](Project& p) { p.mesh.edgeLength = 6; }, [](Project& p) { p.mesh.refinementLevels = 1; },
       [](Project& p) { p.mesh.refineAtSharpEdges = true; },
       [](Project& p) { p.mesh.refineAtBorders = true; },
       [](Project& p) { p.mesh.patchFactors["top"] = 2; },
       [](Project& p) { p.mesh.engine = Engine::kTriangles; },
       [](Project& p) { p.mesh.accuracy = 0.02; }, [](Project& p) { p.mesh.splineDensity = 2; },
       [](Project& p) { p.mesh.elementLength = 1; }});
}

TEST(Change, EverythingElseCounts) {
  expectEach(&Change::name, {[](Project& p) { p.name = "x"; }});
  expectEach(&Change::view, {[](Project& p) { p.view = "{}"; }});
  expectEach(&Change::primitive,
             {[](Project& p) { p.primitive.reset(); }, [](Project& p) { p.primitive->degree = 2; },
              [](Project& p) { p.primitive->controlPoints = 7; },
              [](Project& p) { p.primitive->shape = SphereShape{}; },
              [](Project& p) { std::get<BoxShape>(p.primitive->shape).size.x() = 41; }});
}

}  // namespace
}  // namespace palpa::modeling

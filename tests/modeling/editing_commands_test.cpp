// Effect of each command on a project.
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "modeling/solid/control_normals.h"
#include "modeling/solid/knot_operations.h"
#include "modeling/solid/surface_properties.h"
#include "modeling/solid/tangent_continuity.h"
#include "tests/modeling/editing_fixture.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

const Project& box() {
  static const Project project = editingProject(makeBox({40, 30, 20}));
  return project;
}

std::vector<int> selected(const PointSelection::Part& part) {
  return selectPoints({{part}}, solidOf(box()));
}

std::vector<Vector3d> pointsAfter(const Command& command, const Project& project = box()) {
  return solidOf(apply(command, project).project).controlPoints();
}

TEST(PointSelection, ByPositionInTheNets) {
  EXPECT_EQ(selectPoints(PointSelection::of({7, 3, 7}), solidOf(box())), (std::vector{7, 3}));
  EXPECT_EQ(selected(PatchPoints{{"top"}}).size(), 16U);
  EXPECT_EQ(selected(PatchPoints{{"top", "bottom"}}).size(), 32U);
  EXPECT_EQ(selected(PatchPoints{{"top", "side_xmax"}}).size(), 28U);  // a common edge of 4
  EXPECT_EQ(selected(NetPoints{"top", {}}).size(), 16U);
  EXPECT_EQ(selected(NetPoints{"top", {-1, std::nullopt}}),
            selected(SidePoints{"top", Side::kUMax}));
  EXPECT_EQ(selected(NetPoints{"top", {std::nullopt, 0}}),
            selected(SidePoints{"top", Side::kVMin}));
  EXPECT_EQ(selected(NetPoints{"top", {1, 2}}).front(), solidOf(box()).patches()[5].net[1][2]);
}

TEST(PointSelection, ByPosition) {
  EXPECT_EQ(selected(SlabPoints{{0, 0, 1}, 19.9, std::nullopt}), selected(PatchPoints{{"top"}}));
  EXPECT_EQ(selected(SlabPoints{{0, 0, 1}, 1.0, 10.0}).size(), 12U);
  EXPECT_EQ(selected(BoxPoints{{-21, -16, 19}, {21, 16, 21}}), selected(PatchPoints{{"top"}}));
  EXPECT_EQ(selected(BallPoints{{20, 15, 20}, 1.0}).size(), 1U);
  const PointSelection top{{PatchPoints{{"top"}}}};
  const PointSelection right{{PatchPoints{{"side_xmax"}}}};
  EXPECT_EQ(selected(AllOf{{top, right}}).size(), 4U);
  EXPECT_EQ(selected(NoneOf{{top, right}}).size(), 56U - 28U);
  EXPECT_EQ(selectPoints({{PatchPoints{{"top"}}, PatchPoints{{"bottom"}}}}, solidOf(box())).size(),
            32U);
}

TEST(PointSelection, ErrorsNameTheLocation) {
  const auto fault = [](const PointSelection::Part& part) {
    return faultOf([&] { selected(part); });
  };
  expectBegins(fault(PointIndices{{1, 56}}), "points[1]: control point 56 does not exist; the");
  expectBegins(fault(PatchPoints{{"tip"}}), "points.patches[0]: no patch is named \"tip\"; the");
  expectBegins(fault(NetPoints{"top", {4, std::nullopt}}), "points.net.row[0]: row 4 does not");
  expectBegins(fault(SlabPoints{{0, 0, 0}, 1.0, {}}), "points.half_space.normal: the vector has");
  expectBegins(fault(BallPoints{{0, 0, 0}, 0.1}), "points: no control point is selected");
  expectBegins(fault(BallPoints{{0, 0, 0}, -1.0}), "points.sphere_mm.radius: found -1");
  expectBegins(fault(AllOf{{{{PatchPoints{{"tip"}}}}}}), "points.all_of[0].patches[0]: no patch");
}

TEST(EditPoints, MovesOnlyTheSelectedPointsByAVector) {
  const auto before = solidOf(box()).controlPoints();
  const auto after = pointsAfter(MovePoints{PointSelection::of({3, 5}), MoveBy{{1, 2, 3}}, {}});
  for (int i = 0; i < 56; ++i)
    EXPECT_EQ(after[i], i == 3 || i == 5 ? Vector3d(before[i] + Vector3d(1, 2, 3)) : before[i]);
}

TEST(EditPoints, MovesToExactPositions) {
  const Vector3d place(-20.1, 15.3, 0.7);
  EXPECT_EQ(pointsAfter(MovePoints{PointSelection::of({0}), MoveTo{{place}}, {}})[0], place);
  expectBegins(faultOf([&] {
                 apply(MovePoints{PointSelection::of({0, 1}), MoveTo{{place}}, {}}, box());
               }),
               "to_mm: 1 positions for 2 selected control points");
}

TEST(EditPoints, MovesAlongTheNormal) {
  // Inside a face of a box the normal is the normal of the face; at an edge the mean of two faces.
  const Solid& solid = solidOf(box());
  const auto& net = solid.patches()[5].net;
  const std::vector<Vector3d> normals = controlNormals(solid, {net[1][1], net[1][0], net[0][0]});
  EXPECT_LT((normals[0] - Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_NEAR(normals[1].z(), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(normals[2].z(), std::sqrt(1.0 / 3.0), 1e-12);
  const auto after =
      pointsAfter(MovePoints{PointSelection::of({net[1][1]}), MoveAlongNormal{2.0}, {}});
  EXPECT_NEAR(after[net[1][1]].z(), 22.0, 1e-12);
  // A sphere inflated along its normals is the larger sphere.
  const Project ball = editingProject(makeSphere(20, 6));
  MovePoints inflate{{{SlabPoints{{0, 0, 1}, -100.0, {}}}}, MoveAlongNormal{2.0}, {}};
  EXPECT_NEAR(volume(SurfaceEvaluator(solidOf(apply(inflate, ball).project))),
              4.0 / 3.0 * std::numbers::pi * 22 * 22 * 22, 700.0);
}

TEST(EditPoints, FalloffFollowsItsFormula) {
  const auto before = solidOf(box()).controlPoints();
  const auto after =
      pointsAfter(MovePoints{PointSelection::of({3}), MoveBy{{0, 0, 1}}, {12.0, std::nullopt}});
  int followers = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double r = (before[i] - before[3]).norm() / 12.0;
    const double expected = r < 1.0 ? std::pow(1.0 - r * r, 2) : 0.0;
    EXPECT_NEAR((after[i] - before[i]).z(), expected, 1e-12);
    followers += expected > 0.0 && expected < 1.0;
  }
  EXPECT_GE(followers, 2);
}

TEST(EditPoints, MirrorMovesCounterparts) {
  const Solid& solid = solidOf(box());
  const Vector3d move(1, 0.5, 0.25);
  for (const std::optional<double> falloff : {std::optional<double>(), std::optional(15.0)}) {
    const Reach reach{falloff, MirrorPlane{{0, 0, 0}, {2, 0, 0}}};
    const auto before = solid.controlPoints();
    const auto after = pointsAfter(MovePoints{PointSelection::of({3}), MoveBy{move}, reach});
    EXPECT_EQ(after[3], before[3] + move);
    // The result is symmetric: the mirror image of every point is a point.
    for (const Vector3d& p : after) {
      const Vector3d image(-p.x(), p.y(), p.z());
      EXPECT_TRUE(std::any_of(after.begin(), after.end(),
                              [&](const Vector3d& q) { return (q - image).norm() < 1e-9; }));
    }
  }
  // Both points of a pair selected and moved equally: the part along the normal cancels.
  const auto corner = selected(BallPoints{{-20, 15, 20}, 1.0}).front();
  const auto other = selected(BallPoints{{20, 15, 20}, 1.0}).front();
  const auto after = pointsAfter(MovePoints{
      PointSelection::of({corner, other}), MoveBy{move}, {{}, MirrorPlane{{0, 0, 0}, {1, 0, 0}}}});
  EXPECT_NEAR(after[corner].x(), -20.0, 1e-12);
  EXPECT_NEAR(after[other].y(), 15.5, 1e-12);
  expectBegins(faultOf([&] {
                 apply(MovePoints{PointSelection::of({3}),
                                  MoveBy{move},
                                  {{}, MirrorPlane{{1, 0, 0}, {1, 0, 0}}}},
                       box());
               }),
               "mirror: control point 3 has no mirror image");
}

TEST(EditPoints, ScalesRotatesAndAligns) {
  const PointSelection top{{PatchPoints{{"top"}}}};
  const auto indices = selectPoints(top, solidOf(box()));
  const auto before = solidOf(box()).controlPoints();
  auto after = pointsAfter(ScalePoints{top, {0.5, 0.5, 1}, std::nullopt, {}});
  for (int i : indices)
    EXPECT_LT((after[i] - Vector3d(0.5 * before[i].x(), 0.5 * before[i].y(), 20)).norm(), 1e-9);
  after = pointsAfter(RotatePoints{top, {0, 0, 3}, 30.0, Vector3d(0, 0, 0), {}});
  const Eigen::AngleAxisd turn(std::numbers::pi / 6, Vector3d::UnitZ());
  for (int i : indices) EXPECT_LT((after[i] - turn * before[i]).norm(), 1e-9);
  after = pointsAfter(AlignPoints{top, Vector3d(0, 0, 1), 25.0});
  for (int i : indices) EXPECT_EQ(after[i].z(), 25.0);
  // A tilted top is flattened into its own plane, so nothing moves.
  Project tilted = apply(RotatePoints{top, {1, 1, 0}, 10.0, {}, {}}, box()).project;
  after = pointsAfter(AlignPoints{top, {}, {}}, tilted);
  for (int i : indices) EXPECT_LT((after[i] - solidOf(tilted).controlPoints()[i]).norm(), 1e-9);
  expectBegins(faultOf([&] {
                 apply(AlignPoints{PointSelection::of({1, 2}), {}, {}}, box());
               }),
               "points: a best plane needs three control points");
  expectBegins(faultOf([&] { apply(AlignPoints{top, {}, 3.0}, box()); }), "offset_mm: needs");
}

TEST(EditPoints, SmoothEdgesStaySmooth) {
  const Solid cylinder = makeCylinder(15, 40);
  std::vector<int> sides;
  for (std::size_t e = 0; e < cylinder.edges().size(); ++e)
    if (tangentAngle(cylinder, static_cast<int>(e)) < 0.1) sides.push_back(static_cast<int>(e));
  Project project = editingProject(makeTangent(cylinder.withSmoothEdges(sides, true), sides));
  MovePoints bulge{{{SlabPoints{{0, 0, 1}, 15.0, 25.0}}}, MoveAlongNormal{3.0}, {}};
  project = apply(bulge, project).project;
  bulge.how = MoveBy{{4, 0, 0}};
  bulge.points = PointSelection::of({solidOf(project).patches()[1].net[0][2]});
  bulge.reach.falloff = 10.0;
  project = apply(bulge, project).project;
  EXPECT_LT(largestTangentAngle(solidOf(project)), 1e-6);
}

TEST(EditBody, TransformsKeepVolumeAndAttachments) {
  Project project = box();
  project.primitive = Primitive{};
  project.touches.push_back({"slide", {0, 0, 25}, TouchKind::kPush, {0, 0, -1}, {}, 0.3});
  const double before = volume(project.body);
  const Project moved = apply(TransformSolid{Translation{{1, 2, 3}}}, project).project;
  EXPECT_FALSE(moved.primitive);
  EXPECT_NEAR(volume(moved.body), before, 1e-6);
  EXPECT_EQ(std::get<HalfSpace>(moved.supports[0].where.parts[0]).below, -2.0);
  EXPECT_EQ(moved.touches[0].at, Vector3d(1, 2, 28));
  EXPECT_EQ(moved.touches[0].vector, Vector3d(0, 0, -1));

  const Project turned =
      apply(TransformSolid{Rotation{{1, 0, 0}, 90.0, {0, 0, 0}}}, project).project;
  EXPECT_NEAR(volume(turned.body), before, 1e-6);
  const HalfSpace half = std::get<HalfSpace>(turned.supports[0].where.parts[0]);
  EXPECT_LT((half.normal - Vector3d(0, -1, 0)).norm(), 1e-12);
  EXPECT_NEAR(half.below, -5.0, 1e-12);
  EXPECT_LT((std::get<Bump>(turned.loads[1].what).direction - Vector3d(0, 1, 0)).norm(), 1e-12);
  const Touch& push = turned.touches[1];
  EXPECT_LT((push.vector - Vector3d(0, 1, 0)).norm(), 1e-12);
  EXPECT_EQ(push.friction, 0.3);

  // Forces turn with the solid, gravity stays; a moment is an axial vector.
  Project heavy = project;
  heavy.loads = {{"rope", TotalForce{Region::ofPatches({"top"}), {0, 0, 2}}},
                 {"key", Moment{Region::ofPatches({"top"}), {3, 0, 2}}},
                 {"weight", Gravity{}}};
  const Project leaning =
      apply(TransformSolid{Rotation{{1, 0, 0}, 90.0, {0, 0, 0}}}, heavy).project;
  EXPECT_LT((std::get<TotalForce>(leaning.loads[0].what).force - Vector3d(0, -2, 0)).norm(), 1e-12);
  EXPECT_LT((std::get<Moment>(leaning.loads[1].what).moment - Vector3d(3, -2, 0)).norm(), 1e-12);
  EXPECT_EQ(leaning.loads[2], heavy.loads[2]);
  const Project reflected =
      apply(TransformSolid{MirrorPlane{Vector3d::Zero(), Vector3d::UnitX()}}, heavy).project;
  EXPECT_LT((std::get<Moment>(reflected.loads[1].what).moment - Vector3d(3, 0, -2)).norm(), 1e-12);

  const Project scaled = apply(TransformSolid{Scaling{{1, 2, 3}, {0, 0, 20}}}, project).project;
  EXPECT_NEAR(volume(scaled.body), 6 * before, 1e-6);
  EXPECT_NEAR(std::get<HalfSpace>(scaled.supports[0].where.parts[0]).below, 20 - 3 * 25, 1e-12);

  // Mirroring reverses the patches, so that the normals still point outwards.
  Solid smooth = solidOf(box()).withSmoothEdges({0, 5}, true);
  project.body = smooth;
  const Project mirrored =
      apply(TransformSolid{MirrorPlane{{5, 0, 0}, {1, 0, 0}}}, project).project;
  EXPECT_NEAR(volume(mirrored.body), before, 1e-6);
  EXPECT_NEAR(boundingBox(mirrored.body)[1].x(), 30.0, 1e-9);
  int count = 0;
  for (const SolidEdge& edge : solidOf(mirrored).edges()) count += edge.smooth;
  EXPECT_EQ(count, 2);
  expectBegins(faultOf([&] {
                 apply(TransformSolid{Scaling{{1, 0, 1}, {0, 0, 0}}}, project);
               }),
               "scale.factors[1]: found 0, expected a finite number greater than 0");
}

TEST(EditBody, PrimitivesReplaceTheBodyAndAreRemembered) {
  const Project made = apply(MakePrimitive{{SphereShape{20.0}}}, box()).project;
  ASSERT_TRUE(made.primitive);
  EXPECT_NEAR(volume(made.body), 4.0 / 3.0 * std::numbers::pi * 8000, 10.0);
  EXPECT_GT(apply(MakePrimitive{{SphereShape{20.0}}}, box()).deviation, 0.0);
  const Project moved =
      apply(MovePoints{PointSelection::of({0}), MoveBy{{1, 0, 0}}, {}}, made).project;
  EXPECT_FALSE(moved.primitive);
  EXPECT_TRUE(
      apply(MovePoints{PointSelection::of({0}), MoveBy{{0, 0, 0}}, {}}, made).project.primitive);
  EXPECT_TRUE(apply(RenameProject{"x"}, made).project.primitive);
}

TEST(EditKnots, RefiningDoesNotChangeTheShape) {
  const Project refined = apply(InsertKnot{"top", 0, 0.5, 1}, box()).project;
  EXPECT_LT(sampledDistance(solidOf(box()), solidOf(refined)), 1e-12 * 60);
  const Project raised = apply(ElevateDegree{"top", 1, 5}, refined).project;
  EXPECT_LT(sampledDistance(solidOf(box()), solidOf(raised)), 1e-12 * 60);
  const Edited back = apply(RemoveKnot{"top", 0, 0.5, 1, 1e-9}, refined);
  EXPECT_EQ(solidOf(back.project).controlPoints().size(), 56U);
  EXPECT_LT(back.deviation, 1e-9);
  expectBegins(faultOf([] {
                 apply(InsertKnot{"tip", 0, 0.5, 1}, box());
               }),
               "patch: no patch is named \"tip\"");
}

TEST(EditKnots, RemovalKeepsSmoothEdgesSmooth) {
  const Solid cylinder = makeCylinder(15, 40);
  std::vector<int> sides;
  for (std::size_t e = 0; e < cylinder.edges().size(); ++e)
    if (tangentAngle(cylinder, static_cast<int>(e)) < 0.1) sides.push_back(static_cast<int>(e));
  const Project before = editingProject(makeTangent(cylinder.withSmoothEdges(sides, true), sides));
  // A knot next to the vertical edges: without it the quarters would meet at an angle.
  const Edited after = apply(RemoveKnot{"side_xmin", 0, 0.25, 1, 1.0}, before);
  EXPECT_GT(after.deviation, 1e-4);
  EXPECT_LT(largestTangentAngle(solidOf(after.project)), 1e-6);
  EXPECT_NEAR(sampledDistance(solidOf(before), solidOf(after.project)), after.deviation, 1e-12);
}

TEST(EditKnots, AnEdgeBecomesSmoothAndSharpAgain) {
  const Project smooth = apply(SetEdge{"top", Side::kUMax, true}, box()).project;
  EXPECT_LT(largestTangentAngle(solidOf(smooth)), 1e-6);
  const Change change = compare(box(), smooth);
  EXPECT_TRUE(change.edges);
  EXPECT_FALSE(change.topology);
  const Project sharp = apply(SetEdge{"top", Side::kUMax, false}, smooth).project;
  EXPECT_EQ(solidOf(sharp).controlPoints(), solidOf(smooth).controlPoints());
  EXPECT_FALSE(compare(smooth, apply(SetEdge{"top", Side::kUMax, true}, smooth).project).any());
}

TEST(EditConditions, AddSetRemoveAndRename) {
  const Support wall{"wall", Support::Kind::kRoller, Region::ofPatches({"side_xmin"}), {0, 0, 0}};
  Project project = apply(AddSupport{wall}, box()).project;
  ASSERT_EQ(project.supports.size(), 2U);
  expectBegins(faultOf([&] { apply(AddSupport{wall}, project); }),
               "supports[2].name: \"wall\" is used twice");
  Support changed = wall;
  changed.name = "left";
  project = apply(SetSupport{"wall", changed}, project).project;
  EXPECT_EQ(project.supports[1].name, "left");
  project = apply(RenamePatch{"side_xmin", "back"}, project).project;
  EXPECT_EQ(std::get<PatchSet>(project.supports[1].where.parts[0]).patches[0], "back");
  project = apply(RenamePatch{"top", "lid"}, project).project;
  EXPECT_EQ(project.mesh.patchFactors.count("lid"), 1U);
  EXPECT_EQ(std::get<Pressure>(project.loads[0].what).where.parts.size(), 1U);
  EXPECT_TRUE(compare(box(), apply(RenamePatch{"top", "lid"}, box()).project).patchNames);
  project = apply(RemoveSupport{"left"}, project).project;
  EXPECT_EQ(project.supports.size(), 1U);
  expectBegins(faultOf([&] { apply(RemoveSupport{"left"}, project); }),
               "name: no support is named \"left\"; there are \"base\"");
  expectBegins(faultOf([&] {
                 apply(RenamePatch{"lid", "bottom"}, project);
               }),
               "name: \"bottom\" is already the name of a patch");
  expectBegins(faultOf([&] { apply(RenamePatch{"lid", ""}, project); }), "name: is empty");
  expectBegins(faultOf([&] {
                 apply(SetMaterial{{"", -1.0, 0.3}}, project);
               }),
               "material.youngs_modulus_MPa: -1 must be");
  EXPECT_TRUE(apply(RemoveLoad{"finger"}, project).project.loads.size() == 1U);
  EXPECT_TRUE(apply(RemoveTouch{"poke"}, project).project.touches.empty());
}

TEST(EditBody, MeshBodiesCanBeTransformedButNotRemodelled) {
  MeshBody::Data data{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                      {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}},
                      {0, 0, 1, 0},
                      {"walls", "slope"}};
  Project project;
  project.material = {"silicone", 0.1, 0.48};
  project.body = MeshBody(data);
  const Project mirrored =
      apply(TransformSolid{MirrorPlane{{0, 0, 0}, {0, 0, 1}}}, project).project;
  EXPECT_NEAR(volume(mirrored.body), 1.0 / 6.0, 1e-12);
  EXPECT_TRUE(compare(project, mirrored).topology);
  EXPECT_TRUE(compare(project, apply(RenamePatch{"slope", "s"}, project).project).patchNames);
  expectBegins(faultOf([&] {
                 apply(MovePoints{PointSelection::of({0}), MoveBy{{1, 0, 0}}, {}}, project);
               }),
               "the body is a mesh without control points");
}

TEST(EditPoints, RefusesImpossibleResults) {
  const PointSelection all{{SlabPoints{{0, 0, 1}, -100.0, {}}}};
  expectBegins(faultOf([&] {
                 apply(ScalePoints{all, {-1, 1, 1}, {}, {}}, box());
               }),
               "solid.patches: the enclosed volume is");
  expectBegins(faultOf([&] {
                 apply(MovePoints{all, MoveBy{{0, std::nan(""), 0}}, {}}, box());
               }),
               "by_mm[1]: found nan");
  expectBegins(faultOf([&] {
                 apply(MovePoints{all, MoveBy{{1e300, 0, 0}}, {}}, box());
               }),
               "solid.control_points_mm[0][0]: 1e+300 is not a finite number within");
  expectBegins(faultOf([&] {
                 apply(MovePoints{all, MoveBy{{1, 0, 0}}, {-1.0, std::nullopt}}, box());
               }),
               "falloff_mm: found -1");
  expectBegins(faultOf([&] { apply(RotatePoints{all, {0, 0, 0}, 10, {}, {}}, box()); }), "axis:");
}

}  // namespace
}  // namespace palpa::modeling

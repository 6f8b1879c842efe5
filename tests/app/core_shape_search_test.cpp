// The search for a shape, each found shape verified by a full build from its file.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "app/core/design/shape_measures.h"
#include "app/core/design/shape_search.h"
#include "app/core/model/build_touch_model.h"
#include "app/core/results/touch.h"
#include "modeling/error.h"
#include "modeling/project/project_file.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;
using modeling::Design;
using modeling::DesignTarget;
using modeling::Project;

constexpr const char* kPress = "press the top";
constexpr const char* kPull = "pull the corner region";

Project example(const std::string& name) {
  return modeling::readProject(std::string(PALPA_PROJECTS) + "/" + name + ".json");
}

const modeling::Solid& solidOf(const Project& project) {
  return std::get<modeling::Solid>(project.body);
}

DesignTarget stiffness(const std::string& touch, double value) {
  return {touch, DesignTarget::Kind::kStiffness, value};
}

Design designFor(std::vector<DesignTarget> targets) {
  Design design;
  design.targets = std::move(targets);
  design.largestMovement = 5.0;
  return design;
}

/// Contacts of the project as a file would give them, built from scratch.
std::vector<TouchState::Contact> contactsOf(const Project& project) {
  const Project read = modeling::parseProject(modeling::toJson(project), "found");
  const auto model = buildTouchModel(read, {}, {});
  return playTouches(*model, read.touches).contacts;
}

TouchState::Contact contactNamed(const Project& project, const std::string& touch) {
  for (const auto& contact : contactsOf(project))
    if (contact.name == touch) return contact;
  throw std::logic_error("no contact " + touch);
}

double stiffnessOf(const Project& project, const std::string& touch) {
  return contactNamed(project, touch).stiffness;
}

bool has(const ShapeResult& result, ShapeLimit::Kind kind) {
  return std::any_of(result.limits.begin(), result.limits.end(),
                     [&](const ShapeLimit& limit) { return limit.kind == kind; });
}

double largestMovement(const Project& from, const Project& to) {
  double largest = 0;
  for (std::size_t i = 0; i < solidOf(from).controlPoints().size(); ++i)
    largest = std::max(largest,
                       (solidOf(to).controlPoints()[i] - solidOf(from).controlPoints()[i]).norm());
  return largest;
}

TEST(ShapeSearch, ReachesAStiffnessThatAFullBuildConfirms) {
  const Project box = example("box");
  const Design design = designFor({stiffness(kPress, 1.25)});
  std::vector<int> reported;
  ShapeSearchOptions options;
  options.onStep = [&](const ShapeStep& step) { reported.push_back(step.number); };
  const ShapeResult result = findShape(box, design, options);
  ASSERT_TRUE(result.isReached);
  EXPECT_TRUE(result.limits.empty());
  EXPECT_NEAR(stiffnessOf(result.project, kPress), 1.25, 0.01 * 1.25);
  EXPECT_NEAR(result.final.values[0], 1.25, design.tolerance * 1.25);
  EXPECT_NEAR(result.steps.front().values[0], 1.16, 0.02);
  EXPECT_EQ(reported.size(), result.steps.size());
  EXPECT_NEAR(largestMovement(box, result.project), result.final.largestMovement, 1e-9);
  // The fixed patch stays.
  for (std::size_t i = 0; i < solidOf(box).controlPoints().size(); ++i)
    if (solidOf(box).controlPoints()[i].z() < 1e-9) {
      EXPECT_EQ(solidOf(result.project).controlPoints()[i], solidOf(box).controlPoints()[i]);
    }
}

TEST(ShapeSearch, ReachesTwoStiffnessesWithTheSameVolume) {
  const Project box = example("box");
  Design design = designFor({stiffness(kPress, 1.14), stiffness(kPull, 0.9)});
  design.volume = Design::Volume::kKept;
  const ShapeResult result = findShape(box, design);
  ASSERT_TRUE(result.isReached);
  EXPECT_NEAR(stiffnessOf(result.project, kPress), 1.14, 0.0114);
  EXPECT_NEAR(stiffnessOf(result.project, kPull), 0.9, 0.009);
  const double before = modeling::volume(box.body);
  EXPECT_NEAR(modeling::volume(result.project.body), before, 2e-3 * before);
}

TEST(ShapeSearch, ReachesAForceAtADepth) {
  const Project box = example("box");
  DesignTarget target{kPress, DesignTarget::Kind::kForce, 3.7, 3.0};
  const ShapeResult result = findShape(box, designFor({target}));
  ASSERT_TRUE(result.isReached);
  Project deeper = result.project;
  deeper.touches.front().vector *= 3.0 / deeper.touches.front().vector.norm();
  EXPECT_NEAR(contactNamed(deeper, kPress).force.norm(), 3.7, 0.037);
}

TEST(ShapeSearch, MirrorsKeepTheBodySymmetric) {
  const Project box = example("box");
  Design design = designFor({stiffness(kPress, 1.22)});
  design.mirrors = {{Vector3d::Zero(), Vector3d::UnitX()}, {Vector3d::Zero(), Vector3d::UnitY()}};
  const ShapeResult result = findShape(box, design);
  ASSERT_TRUE(result.isReached);
  const auto& points = solidOf(result.project).controlPoints();
  for (const Vector3d& flip : {Vector3d(-1, 1, 1), Vector3d(1, -1, 1)})
    for (const Vector3d& point : points)
      EXPECT_TRUE(std::any_of(points.begin(), points.end(), [&](const Vector3d& other) {
        return (other - flip.cwiseProduct(point)).norm() < 1e-6;
      }));
}

TEST(ShapeSearch, KeepsTheSmallestThickness) {
  const Project box = example("box");
  Design design = designFor({stiffness(kPress, 0.9)});
  design.smallestThickness = 19.5;  // the box is 20 mm high, thinner shapes would be softer
  const ShapeResult result = findShape(box, design);
  const auto thinnest = smallestThickness(solidOf(result.project));
  ASSERT_TRUE(thinnest);
  EXPECT_GT(thinnest->value, 19.5 * (1 - 2e-3));
  ASSERT_TRUE(result.final.thinnest);
  EXPECT_GT(*result.final.thinnest, 19.5 * (1 - 2e-3));
}

TEST(ShapeSearch, MakesTheVolumeSmall) {
  const Project box = example("box");
  Design design = designFor({stiffness(kPress, 1.16)});
  design.volume = Design::Volume::kMinimised;
  const ShapeResult result = findShape(box, design);
  ASSERT_TRUE(result.isReached);
  EXPECT_NEAR(stiffnessOf(result.project, kPress), 1.16, 0.0116);
  EXPECT_LT(modeling::volume(result.project.body), 0.9 * modeling::volume(box.body));
}

TEST(ShapeSearch, AnImpossibleTargetEndsWithTheNearestShapeAndItsLimit) {
  const Project box = example("box");
  Design design = designFor({stiffness(kPress, 20.0)});
  design.largestMovement = 1.0;
  const ShapeResult result = findShape(box, design);
  EXPECT_FALSE(result.isReached);
  EXPECT_TRUE(has(result, ShapeLimit::Kind::kMovement));
  EXPECT_GT(result.final.values[0], result.steps.front().values[0] * 1.01);
  EXPECT_LE(largestMovement(box, result.project), 1.0 + 1e-9);
  EXPECT_GT(largestMovement(box, result.project), 0.9);
}

// 3.6 N lies between the forces on two coarse choices of elements, which a finer accuracy brings
// together.
TEST(ShapeSearch, AJumpOfTheElementsIsNamedAndAccuracyRemovesIt) {
  Project box = example("box");
  const Design design = designFor({{kPress, DesignTarget::Kind::kForce, 3.6, 3.0}});
  box.mesh.accuracy = 0.02;
  const ShapeResult coarse = findShape(box, design);
  EXPECT_FALSE(coarse.isReached);
  EXPECT_TRUE(has(coarse, ShapeLimit::Kind::kElements));
  box.mesh.accuracy = 0.003;
  EXPECT_TRUE(findShape(box, design).isReached);
}

TEST(ShapeSearch, PointsWithoutInfluenceAreNamed) {
  const Project box = example("box");
  Design design = designFor({stiffness(kPress, 3.0)});
  design.points = modeling::PointSelection::of({0});  // a corner of the fixed patch
  design.largestMovement = 0.05;
  const ShapeResult result = findShape(box, design);
  EXPECT_FALSE(result.isReached);
  EXPECT_TRUE(has(result, ShapeLimit::Kind::kPoints));
}

TEST(ShapeSearch, ASmallAllowedMovementIsNamedInsteadOfThePoints) {
  const Project box = example("box");
  Design design = designFor({stiffness(kPress, 3.0)});
  design.largestMovement = 0.05;
  const ShapeResult result = findShape(box, design);
  EXPECT_FALSE(result.isReached);
  EXPECT_TRUE(has(result, ShapeLimit::Kind::kMovement));
  EXPECT_FALSE(has(result, ShapeLimit::Kind::kPoints));
}

TEST(ShapeSearch, NoShapeFoldsHoweverFarPointsMayMove) {
  const Project box = example("box");
  Design design = designFor({stiffness(kPress, 0.02)});
  design.largestMovement = 60.0;
  design.along = Design::Along::kAny;
  design.smoothness = 0;
  const ShapeResult result = findShape(box, design);
  // A full build checks the surface and throws if it folds.
  EXPECT_NEAR(stiffnessOf(result.project, kPress), result.final.values[0],
              1e-6 * result.final.values[0]);
  EXPECT_LT(result.final.values[0], result.steps.front().values[0]);
}

TEST(ShapeSearch, TouchesStayOnTheirMaterial) {
  const Project box = example("box");
  const ShapeResult result = findShape(box, designFor({stiffness(kPress, 1.25)}));
  const Vector3d before = box.touches.front().at, after = result.project.touches.front().at;
  EXPECT_GT((after - before).norm(), 1e-3);
  const modeling::Solid& found = solidOf(result.project);
  const auto model = buildTouchModel(result.project, {}, {});
  const auto surface = model->setup().discretisation->makeContactSurface(model->problem()->dofs());
  EXPECT_LT((surface->nearest(after).position - after).norm(), 1e-2);
  EXPECT_EQ(found.controlPoints().size(), solidOf(box).controlPoints().size());
}

TEST(ShapeSearch, AcceptingIsOneStepOfUndo) {
  const Project box = example("box");
  const ShapeResult result = findShape(box, designFor({stiffness(kPress, 1.22)}));
  ASSERT_TRUE(result.isReached);
  modeling::Document document(box);
  applyShape(result, document);
  EXPECT_EQ(solidOf(document.project()).controlPoints(), solidOf(result.project).controlPoints());
  EXPECT_EQ(document.project().touches, result.project.touches);
  EXPECT_EQ(document.undoLabel(), "Find a shape");
  document.undo();
  EXPECT_EQ(modeling::toJson(document.project()), modeling::toJson(box));
  EXPECT_FALSE(document.canUndo());
}

TEST(ShapeSearch, ATargetThatIsMetMovesNothing) {
  const Project box = example("box");
  const double present = stiffnessOf(box, kPress);
  const ShapeResult result = findShape(box, designFor({stiffness(kPress, present)}));
  EXPECT_TRUE(result.isReached);
  EXPECT_TRUE(result.commands.empty());
  EXPECT_EQ(result.movedPoints, 0);
  EXPECT_EQ(result.steps.size(), 1U);
}

TEST(ShapeSearch, CanBeCancelledDuringAStep) {
  const Project box = example("box");
  std::stop_source source;
  Job job;
  job.stop = source.get_token();
  ShapeSearchOptions options;
  options.onStep = [&](const ShapeStep&) { source.request_stop(); };
  double last = -1;
  job.progress = [&](Phase phase, double fraction) {
    EXPECT_EQ(phase, Phase::kSearch);
    EXPECT_GE(fraction, last);
    last = fraction;
  };
  EXPECT_THROW(findShape(box, designFor({stiffness(kPress, 1.25)}), options, job), Cancelled);
  EXPECT_GE(last, 0);
}

TEST(ShapeSearch, MeshBodiesAreRefused) {
  Project project = example("box");
  modeling::MeshBody::Data data;
  data.positions = {{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {0, 0, 9}};
  data.triangles = {{0, 2, 1}, {3, 0, 1}, {2, 3, 1}, {0, 3, 2}};
  data.faceOfTriangle = {0, 0, 0, 0};
  data.faceNames = {"all"};
  project.body = modeling::MeshBody(std::move(data));
  EXPECT_THROW(findShape(project, designFor({stiffness(kPress, 1.25)})), modeling::ModelingError);
}

/// The shipped examples, from their own design section.
class DesignExamples : public testing::TestWithParam<const char*> {};

TEST_P(DesignExamples, EveryTargetIsMetWithinAPercent) {
  const Project project = example(std::string("design/") + GetParam());
  ASSERT_TRUE(project.design);
  const ShapeResult result = findShape(project, *project.design);
  ASSERT_TRUE(result.isReached);
  for (const DesignTarget& target : project.design->targets) {
    ASSERT_FALSE(target.depth) << "the touches are played as they are";
    const auto contact = contactNamed(result.project, target.touch);
    EXPECT_NEAR(
        target.kind == DesignTarget::Kind::kForce ? contact.force.norm() : contact.stiffness,
        target.value, 0.01 * target.value)
        << target.touch;
  }
  const double limit = project.design->largestMovement.value();
  EXPECT_LE(largestMovement(project, result.project), limit + 1e-9);
}

INSTANTIATE_TEST_SUITE_P(All, DesignExamples,
                         testing::Values("two-stiffness-pad", "one-newton-finger", "seal-bead"),
                         [](const auto& each) {
                           std::string name = each.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace palpa::app

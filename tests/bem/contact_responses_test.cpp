// Contacts whose columns are not known: responses of single masks, rough responses, rough columns.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <span>

#include "bem/contact/field_evaluator.h"
#include "tests/bem/contact_sphere.h"
#include "tests/bem/roughly_solved.h"

namespace palpa::bem {
namespace {

using Eigen::Vector3d;
using Kind = ContactTool::Kind;
using Status = ContactSimulation::Status;
using test::kSide;
using test::kSoft;
using test::kTop;
using test::sphere;

/// Computes the response of a place that waits.
void answer(ContactSimulation& simulation, GreensColumns& columns) {
  simulation.step();
  const auto waiting = simulation.waiting();
  ASSERT_TRUE(waiting);
  ContactMask mask;
  const auto workspace = sphere().surface->makeWorkspace();
  ASSERT_TRUE(sphere().surface->makeMask(waiting->point, waiting->radius, *workspace, mask));
  columns.computeResponse(mask.point, mask.radius, mask.nodes, mask.traction, Job{});
}

TEST(ContactResponses, APushingToolKeepsTheFirstPlaceThatIsAnswered) {
  GreensColumns columns(sphere().problem);
  ContactSimulation simulation(*sphere().surface, columns, sphere().base, kSoft);
  const auto id = simulation.begin({Kind::kPush, 8, 0}, kTop, {0, 0, 24.5});
  simulation.step();
  const auto first = simulation.waiting();
  ASSERT_TRUE(first);
  simulation.set(id, {2, 0, 23});
  simulation.step(3);
  ASSERT_TRUE(simulation.waiting());
  EXPECT_EQ(simulation.waiting()->point.position, first->point.position);
  simulation.set(id, {8, 0, 22});
  answer(simulation, columns);
  simulation.step();
  EXPECT_EQ(simulation.find(id)->status, Status::kSlipping);
  EXPECT_GT(simulation.find(id)->force.norm(), 0);
  EXPECT_FALSE(simulation.waiting());
  // It slides when the columns have come, to the force that it has with all of them.
  test::computeMissing(simulation, columns);
  EXPECT_TRUE(simulation.missed().empty());
  ContactSimulation whole = sphere().simulation();
  whole.begin({Kind::kPush, 8, 0}, kTop, {8, 0, 22});
  whole.step(50);
  EXPECT_LE((simulation.find(id)->force - whole.contacts()[0].force).norm(),
            1e-3 * whole.contacts()[0].force.norm());
}

TEST(ContactResponses, TheResponsesOfGrabbedPlacesReplaceColumns) {
  GreensColumns none(sphere().problem);
  const auto grab = [](ContactSimulation& simulation) {
    simulation.begin({Kind::kGrab, 8}, kTop, {0, 0.5, -2});
    simulation.begin({Kind::kForce, 6}, kSide, {-0.1, 0.05, 0});
  };
  ContactSimulation simulation(*sphere().surface, none, sphere().base, kSoft);
  grab(simulation);
  const auto ball = simulation.begin({Kind::kBall, 6, 0}, {0, 25, 0}, {0, 30.5, 0});
  answer(simulation, none);
  answer(simulation, none);
  simulation.step();
  EXPECT_EQ(none.readyCount(), 0);
  EXPECT_FALSE(simulation.waiting());  // a ball has many masks, which need columns
  EXPECT_FALSE(simulation.missing().empty());
  simulation.end(ball);
  simulation.step();
  EXPECT_TRUE(simulation.missed().empty());
  ContactSimulation whole = sphere().simulation();
  grab(whole);
  whole.step();
  std::vector<ContactSimulation::PatchForce> patches;
  for (int k = 0; k < 2; ++k) {
    const auto &contact = simulation.contacts()[k], &expected = whole.contacts()[k];
    EXPECT_EQ(contact.status, Status::kGrabbed);
    EXPECT_LE((contact.force - expected.force).norm(), 1e-5 * expected.force.norm());
    EXPECT_LE((contact.displacement - expected.displacement).norm(), 1e-5);
    patches.insert(patches.end(), expected.patch.begin(), expected.patch.end());
  }
  FieldEvaluator fromResponses(*sphere().surface, none, sphere().base),
      fromColumns(*sphere().surface, *sphere().columns, sphere().base);
  BoundaryField field = sphere().base, expected = sphere().base;
  for (int frame = 0; frame < 2; ++frame) {  // the second one uses what the first one kept
    fromResponses.evaluate(patches, true, field);
    fromColumns.evaluate(patches, true, expected);
    EXPECT_LE((field.u - expected.u).norm(), 1e-5 * expected.u.norm());
    EXPECT_LE((field.p - expected.p).norm(), 1e-4 * expected.p.norm());
  }
}

/// A grab at the top with rough and better responses, and its field.
struct RoughGrab {
  GreensColumns columns{std::make_shared<RoughlySolved>(sphere().problem)};
  ContactSimulation simulation{*sphere().surface, columns, sphere().base, kSoft};
  FieldEvaluator evaluator{*sphere().surface, columns, sphere().base};
  ContactMask mask;
  Vector3d expectedForce;
  BoundaryField expected = sphere().base;

  RoughGrab() {
    simulation.begin({Kind::kGrab, 8}, kTop, {0, 0.5, -2});
    simulation.step();
    const auto waiting = simulation.waiting();
    sphere().surface->makeMask(waiting->point, waiting->radius, *sphere().surface->makeWorkspace(),
                               mask);
    ContactSimulation whole = sphere().simulation();
    whole.begin({Kind::kGrab, 8}, kTop, {0, 0.5, -2});
    whole.step();
    expectedForce = whole.contacts()[0].force;
    FieldEvaluator(*sphere().surface, *sphere().columns, sphere().base)
        .evaluate(whole.contacts()[0].patch, true, expected);
  }

  void solve(ReferenceProblem::Effort effort) {
    columns.computeResponse(mask.point, mask.radius, mask.nodes, mask.traction, Job{}, effort);
  }
  /// Relative difference of the force from `factor` times the right one.
  double differenceOfForce(double factor) {
    simulation.step();
    return (simulation.contacts()[0].force - factor * expectedForce).norm() / expectedForce.norm();
  }
  /// Of the displacements under the grabbed place's right force.
  double differenceOfField(double factor) {
    BoundaryField field = sphere().base;
    const ContactSimulation::PatchForce patch{mask.point, mask.radius, expectedForce};
    evaluator.evaluate(std::span(&patch, 1), true, field);
    return (field.u - factor * expected.u).norm() / expected.u.norm();
  }
};

TEST(ContactResponses, BetterResponsesReplaceRoughOnes) {
  constexpr double kFactor = RoughlySolved::kFactor;
  RoughGrab grab;
  grab.solve(ReferenceProblem::Effort::kRough);
  EXPECT_LE(grab.differenceOfForce(1 / kFactor), 1e-5);
  EXPECT_LE(grab.differenceOfField(kFactor), 1e-5);
  EXPECT_LE(grab.differenceOfField(kFactor), 1e-5);  // of the kept response
  grab.solve(ReferenceProblem::Effort::kFast);
  EXPECT_FALSE(grab.columns.responses().find(grab.mask.point, grab.mask.radius)->isRough);
  EXPECT_LE(grab.differenceOfForce(1), 1e-5);
  EXPECT_LE(grab.differenceOfField(1), 1e-5);
  // A rough one is of no use any more.
  grab.solve(ReferenceProblem::Effort::kRough);
  EXPECT_FALSE(grab.columns.responses().find(grab.mask.point, grab.mask.radius)->isRough);
}

TEST(ContactResponses, ColumnsReplaceRoughResponses) {
  RoughGrab grab;
  grab.solve(ReferenceProblem::Effort::kRough);
  EXPECT_GE(grab.differenceOfForce(1), 0.04);
  EXPECT_GE(grab.differenceOfField(1), 0.04);
  grab.columns.compute(grab.mask.nodes, Job{});
  EXPECT_LE(grab.differenceOfForce(1), 1e-5);
  EXPECT_LE(grab.differenceOfField(1), 1e-5);
}

TEST(ContactResponses, BetterColumnsReplaceRoughOnes) {
  constexpr double kFactor = RoughlySolved::kFactor;
  RoughGrab grab;
  ASSERT_GT(grab.mask.nodes.size(), GreensColumns::kBlock);  // two blocks
  grab.columns.computeRough(grab.mask.nodes, Job{});
  EXPECT_TRUE(grab.columns.hasAllRough(grab.mask.nodes));
  EXPECT_EQ(grab.columns.readyCount(), 0);
  EXPECT_LE(grab.differenceOfForce(1 / kFactor), 1e-5);
  EXPECT_LE(grab.differenceOfField(kFactor), 1e-5);
  EXPECT_LE(grab.differenceOfField(kFactor), 1e-5);  // of the kept response
  // Nodes with better columns and nodes with rough ones.
  grab.columns.compute(std::span(grab.mask.nodes).first(1), Job{});
  EXPECT_GE(grab.differenceOfForce(1), 0.02);
  grab.columns.compute(grab.mask.nodes, Job{});
  EXPECT_LE(grab.differenceOfForce(1), 1e-5);
  EXPECT_LE(grab.differenceOfField(1), 1e-5);
}

TEST(GreensColumns, HoldALimitedNumberOfRoughOnes) {
  GreensColumns columns(std::make_shared<RoughlySolved>(sphere().problem));
  std::vector<int> free;
  for (int node = 0; node < columns.problem().dofs().nodeCount(); ++node)
    if (columns.problem().dofs().isFree(node)) free.push_back(node);
  ASSERT_GT(free.size(), RoughColumns::kMaxBlocks);
  for (int k = 0; k < RoughColumns::kMaxBlocks; ++k) {
    EXPECT_TRUE(columns.takesRough()) << k;
    columns.computeRough(std::span(free).subspan(k, 1), Job{});
    EXPECT_TRUE(columns.hasRough(free[k])) << k;
  }
  EXPECT_FALSE(columns.takesRough());
  columns.computeRough(std::span(free).subspan(RoughColumns::kMaxBlocks, 1), Job{});
  EXPECT_FALSE(columns.hasRough(free[RoughColumns::kMaxBlocks]));
  EXPECT_EQ(columns.usedBytes(), RoughColumns::kMaxBlocks * columns.blockBytes());
}

TEST(GreensColumns, AreNotRoughWhereNothingIsQuicker) {
  GreensColumns columns(sphere().problem);
  EXPECT_FALSE(columns.takesRough());
  const int node = static_cast<int>(sphere().surface->places().size()) - 1;
  columns.computeRough(std::span(&node, 1), Job{});
  EXPECT_FALSE(columns.hasRough(node));
}

TEST(GreensColumns, BlocksBeginWithTheFirstNodesWithoutColumns) {
  GreensColumns columns(std::make_shared<RoughlySolved>(sphere().problem));
  const auto& places = sphere().surface->places();
  const std::vector<int> near = columns.nodesNear(places, kTop);
  columns.compute(std::span(near).first(1), Job{});
  columns.computeRough(std::span(near).subspan(1, 1), Job{});
  const std::vector<int> asked{near[0], near[1], near[2], near[2]},
      block = columns.blockFor(asked, places), rough = columns.blockFor(asked, places, true);
  ASSERT_EQ(block.size(), GreensColumns::kBlock);
  ASSERT_EQ(rough.size(), GreensColumns::kBlock);
  EXPECT_EQ(block[0], near[1]);
  EXPECT_EQ(block[1], near[2]);
  EXPECT_EQ(rough[0], near[2]);
  EXPECT_EQ(std::set<int>(rough.begin(), rough.end()).size(), rough.size());
  EXPECT_EQ(std::find(rough.begin(), rough.end(), near[1]), rough.end());
  EXPECT_TRUE(columns.blockFor(std::span(near).first(1), places).empty());
}

TEST(MaskResponses, HoldALimitedNumberOfMasks) {
  MaskResponses responses;
  SurfacePoint point = sphere().surface->nearest(kTop);
  for (int k = 0; k <= MaskResponses::kMaxCount; ++k)
    responses.add({point, 1.0 + k, Eigen::MatrixX3f::Constant(3, 3, static_cast<float>(k))});
  EXPECT_TRUE(responses.isFull());
  ASSERT_TRUE(responses.find(point, 5));
  EXPECT_EQ(responses.find(point, 5)->unknowns(0, 0), 4);
  EXPECT_FALSE(responses.find(point, 5.5));
  EXPECT_FALSE(responses.find(point, 1.0 + MaskResponses::kMaxCount));
  point.position.x() += 1;
  EXPECT_FALSE(responses.find(point, 5));
}

}  // namespace
}  // namespace palpa::bem

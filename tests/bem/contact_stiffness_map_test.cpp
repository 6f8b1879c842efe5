#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "app/verification/exact/simple_meshes.h"
#include "bem/contact/bilateral_contact_solver.h"
#include "bem/contact/stiffness_map.h"
#include "tests/bem/contact_body.h"

namespace palpa::bem {
namespace {

using Eigen::Vector3d;

enum class Support { kFixed, kRoller };

constexpr Material kMaterial{1.0, 0.3};

/// Box of 20 x 20 x 10 mm with sharp edges whose bottom is fixed.
struct Box : test::ContactBody {
  explicit Box(Support bottom)
      : ContactBody(verification::boxMesh({0, 0, 0}, {20, 20, 10}, 8, 8, 4), kMaterial,
                    [bottom](int tag) {
                      constexpr int kLeft = 0, kBottom = 4;
                      // Rollers alone would let the box slide, so one side is fixed as well.
                      if (bottom == Support::kRoller)
                        return tag == kLeft     ? SlotCondition::kFixed
                               : tag == kBottom ? SlotCondition::kRoller
                                                : SlotCondition::kTraction;
                      return tag == kBottom ? SlotCondition::kFixed : SlotCondition::kTraction;
                    }) {}
  int slotNear(const Vector3d& at, const Vector3d& normal) const {
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int slot = 0; slot < slots.count(); ++slot) {
      const double off = (mesh.nodes[slots.slots[slot].node] - at).norm() +
                         100 * (slots.slots[slot].normal - normal).norm();
      if (off >= least) continue;
      least = off;
      best = slot;
    }
    return best;
  }
};

constexpr double kRadius = 5;

/// Force along the normal per normal displacement, free to move sideways: two solves with the exact
/// solver, one grab at a time.
double stiffnessByGrab(const Box& box, int node, const Vector3d& normal) {
  BilateralContactSolver solver(box.problem, box.slots, box.base);
  const auto mask = makeContactMask(*box.surface, box.mesh.nodes[node], kRadius);
  solver.addForce(mask, normal);
  return 1 / solver.contacts(solver.forces()).front().displacement.dot(normal);
}

void expectGrabs(Box& box) {
  box.computeAll();
  StiffnessMap map(*box.surface, kRadius);
  map.update(*box.columns, {});
  ASSERT_TRUE(map.isComplete());
  int compared = 0;
  for (int slot = 0; slot < box.slots.count(); slot += 7) {
    const int node = box.slots.slots[slot].node;
    if (!box.problem->dofs().isFree(node)) {
      EXPECT_EQ(map.compliances()[slot], 0) << slot;
      continue;
    }
    const double wanted = stiffnessByGrab(box, node, box.slots.slots[slot].normal);
    EXPECT_NEAR(1 / map.compliances()[slot], wanted, 2e-5 * wanted) << slot;
    ++compared;
  }
  EXPECT_GT(compared, 15);
}

TEST(StiffnessMap, EqualsSingleGrabs) {
  Box box(Support::kFixed);
  expectGrabs(box);
}

TEST(StiffnessMap, BesideRollersMeasuredNodesMoveOnlyAlongThem) {
  Box box(Support::kRoller);
  expectGrabs(box);
}

/// Contacts of the simulation: a grab along the normal that is also fixed sideways is at least as
/// stiff, and a finger without friction exactly as stiff.
TEST(StiffnessMap, EqualsAFingerWithoutFriction) {
  Box box(Support::kFixed);
  box.computeAll();
  StiffnessMap map(*box.surface, kRadius);
  map.update(*box.columns, {});
  const int slot = box.slotNear({10, 10, 10}, Vector3d::UnitZ());
  const double wanted = 1 / map.compliances()[slot];
  const Vector3d at = box.mesh.nodes[box.slots.slots[slot].node];
  ContactSimulation simulation(*box.surface, *box.columns, box.base, kMaterial);
  constexpr double kDepth = 1e-3;
  simulation.begin({ContactTool::Kind::kPush, kRadius, 0}, at, at - Vector3d(0, 0, kDepth));
  simulation.step(1);
  EXPECT_NEAR(simulation.contacts().front().force.norm() / kDepth, wanted, 1e-4 * wanted);
  ContactSimulation grab(*box.surface, *box.columns, box.base, kMaterial);
  grab.begin({ContactTool::Kind::kGrab, kRadius, 0}, at, {0, 0, -kDepth});
  grab.step(1);
  EXPECT_GE(-grab.contacts().front().force.z() / kDepth, wanted * (1 - 1e-6));
}

TEST(StiffnessMap, IsSofterFarFromTheSupport) {
  Box box(Support::kFixed);
  box.computeAll();
  StiffnessMap map(*box.surface, kRadius);
  map.update(*box.columns, {});
  const Vector3d side(1, 0, 0);
  const int high = box.slotNear({20, 10, 7.5}, side), low = box.slotNear({20, 10, 2.5}, side);
  EXPECT_GT(map.compliances()[high], 1.5 * map.compliances()[low]);
}

TEST(StiffnessMap, FillsWhileColumnsArrive) {
  Box box(Support::kFixed);
  StiffnessMap map(*box.surface, kRadius);
  EXPECT_EQ(map.update(*box.columns, {}), 0);
  EXPECT_EQ(map.readyCount(), 0);
  std::vector<int> order = box.columns->nodesNear(box.mesh.nodes, {10, 10, 10});
  order.resize(order.size() / 2);
  box.columns->compute(order, {});
  const int first = map.update(*box.columns, {});
  EXPECT_GT(first, 0);
  EXPECT_FALSE(map.isComplete());
  int unknown = 0;
  for (const double compliance : map.compliances()) unknown += std::isnan(compliance) ? 1 : 0;
  EXPECT_GT(unknown, 0);
  box.computeAll();
  EXPECT_EQ(map.update(*box.columns, {}), map.nodeCount() - first);
  EXPECT_TRUE(map.isComplete());
  // In two parts as in one, and on any number of threads.
  Job alone;
  alone.threads = 1;
  StiffnessMap whole(*box.surface, kRadius);
  whole.update(*box.columns, alone);
  EXPECT_EQ(map.compliances(), whole.compliances());
}

TEST(StiffnessMap, ACancelledUpdateKeepsThePreviousMap) {
  Box box(Support::kFixed);
  box.computeAll();
  StiffnessMap map(*box.surface, kRadius);
  std::stop_source stop;
  Job job;
  job.stop = stop.get_token();
  job.progress = [&](Phase phase, double) {
    EXPECT_EQ(phase, Phase::kStiffness);
    stop.request_stop();
  };
  EXPECT_THROW(map.update(*box.columns, job), Cancelled);
  EXPECT_EQ(map.readyCount(), 0);
  map.update(*box.columns, {});
  EXPECT_TRUE(map.isComplete());
}

}  // namespace
}  // namespace palpa::bem

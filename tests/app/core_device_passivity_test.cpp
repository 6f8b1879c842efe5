// A simulated handle in simulated time: the body never drives it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>
#include <random>

#include "app/core/device/device_tool.h"
#include "app/core/model/build_touch_model.h"
#include "bench/virtual_device.h"
#include "tests/app/core_projects.h"
#include "tests/app/stepped_target.h"

namespace palpa::app {
namespace {

using bench::VirtualDevice;
using Eigen::Vector3d;
using Kind = bem::ContactTool::Kind;

constexpr double kPeriod = 1e-3;       // s
constexpr double kDelay = 0.3e-3;      // s, from the position to its force at the handle
constexpr double kHand = 0.5;          // N/mm, of a hand around its target
constexpr double kHandDamping = 4e-3;  // N s/mm
const Vector3d kTop(0, 0, 25);

std::shared_ptr<const TouchableModel> sphere(double youngsModulus) {
  modeling::Project project = test::clampedSphere(6);
  project.material.youngsModulus = youngsModulus;
  return std::make_shared<const TouchableModel>(buildTouchModel(project, {}, {}));
}

/// Stiffness of the sphere at its top, N/mm, for a tool 1 mm deep.
double stiffnessOf(const std::shared_ptr<const TouchableModel>& model,
                   const bem::ContactTool& tool) {
  test::SteppedTarget target(model, 1);
  const double radius = tool.kind == Kind::kBall ? tool.radius : 0;
  const TouchId id = target.begin(tool, kTop, kTop + Vector3d(0, 0, radius - 1));
  for (int k = 0; k < 3; ++k) target.step({});
  return target.newest().find(id)->stiffness;
}

enum class Motion { kPress, kTap, kTremble, kFall };

struct Wall {
  double stiffness;  // N/mm
  Kind kind;
  double friction;
  double mass;  // kg
};
std::ostream& operator<<(std::ostream& out, const Wall& wall) {
  return out << wall.stiffness << " N/mm, " << (wall.kind == Kind::kBall ? "ball" : "push")
             << ", friction " << wall.friction << ", " << wall.mass << " kg";
}

struct Outcome {
  double mostEnergy = -1;    // mJ, from the body to the handle, largest over time
  double lateSpeed = 0;      // mm/s, in the last quarter
  double deepest = 0;        // mm
  int touching = 0;          // samples
  double forceAtHandle = 0;  // N, at the end
  double forceOfBody = 0;    // N, at the end, of the solver
};

/// `seconds` of a hand that moves the handle on the body, with walls of a given stiffness.
Outcome simulate(const Wall& wall, Motion motion, double seconds) {
  const bem::ContactTool tool{wall.kind, 8, wall.friction};
  static const double kSoft = 0.1;  // MPa; forces are proportional
  const double modulus = kSoft * wall.stiffness / stiffnessOf(sphere(kSoft), tool);
  test::SteppedTarget target(sphere(modulus), 3);
  DeviceTool device(target, tool, {});
  const double radius = wall.kind == Kind::kBall ? tool.radius : 0;
  const Vector3d start = kTop + Vector3d(0, 0, radius + 2);
  VirtualDevice handle({wall.mass, 0.5e-3, 0.01}, start);
  const double force = std::min(4.0, 2 * wall.stiffness);  // N, of a press
  const double reach = 2 + std::min(force / wall.stiffness, 3.0) + force / kHand;
  std::mt19937 random(7);
  std::normal_distribution<> step(0, 0.15);
  Vector3d noise = Vector3d::Zero(), applied = Vector3d::Zero();
  Outcome result;
  const int count = static_cast<int>(seconds / kPeriod);
  for (int i = 0; i < count; ++i) {
    const double time = kPeriod * i;
    Vector3d goal = start;
    switch (motion) {
      case Motion::kPress:
        goal[2] -= reach * std::min(1.0, time / 0.3);
        break;
      case Motion::kTap:
        goal[2] -= reach * (0.5 - 0.5 * std::cos(4 * std::numbers::pi * time));
        break;
      case Motion::kTremble:
        for (int a = 0; a < 3; ++a) noise[a] += step(random) - 0.01 * noise[a];
        goal += noise - Vector3d(0, 0, 0.5 * reach);
        break;
      case Motion::kFall:
        break;
    }
    Vector3d hand = kHand * (goal - handle.position()) - kHandDamping * handle.velocity();
    if (motion == Motion::kFall) hand[2] = -0.3;  // a weight, not a hand
    const DeviceTool::Time now{std::chrono::milliseconds(i + 1)};
    const DeviceReply reply =
        device.update({static_cast<std::uint64_t>(i), handle.measured(), 0}, now);
    handle.advance(applied, hand, kDelay);
    result.mostEnergy = std::max(result.mostEnergy, handle.energyFromDevice());
    applied = reply.force;
    handle.advance(applied, hand, kPeriod - kDelay);
    result.mostEnergy = std::max(result.mostEnergy, handle.energyFromDevice());
    if ((reply.status & DeviceReply::kTouching) != 0) ++result.touching;
    if (4 * i > 3 * count) result.lateSpeed = std::max(result.lateSpeed, handle.velocity().norm());
    result.deepest = std::max(result.deepest, 25 + radius - handle.position()[2]);
    target.step(now);
  }
  result.forceAtHandle = applied.norm();
  if (!target.newest().touched().empty())
    result.forceOfBody = target.newest().touched().front().force.norm();
  return result;
}

class DevicePassivity : public testing::TestWithParam<Wall> {
 protected:
  /// Energy of one period that the device counts one period late, mJ.
  static constexpr double kTolerance = 0.02;
};

TEST_P(DevicePassivity, APressComesToRestWithTheForceOfTheBody) {
  const Outcome press = simulate(GetParam(), Motion::kPress, 2);
  EXPECT_GT(press.touching, 1000);
  EXPECT_LT(press.mostEnergy, kTolerance);
  EXPECT_LT(press.lateSpeed, 5);
  EXPECT_GT(press.forceOfBody, 0.05);
  EXPECT_NEAR(press.forceAtHandle, press.forceOfBody, 0.05 * press.forceOfBody);
}

TEST_P(DevicePassivity, TapsAndTremblingGiveNoEnergy) {
  for (const Motion motion : {Motion::kTap, Motion::kTremble}) {
    const Outcome moving = simulate(GetParam(), motion, 3);
    EXPECT_GT(moving.touching, 500);
    EXPECT_LT(moving.mostEnergy, kTolerance);
    EXPECT_LT(moving.deepest, 8);
  }
}

TEST_P(DevicePassivity, AFallingWeightComesToRestOnTheBody) {
  Wall wall = GetParam();
  // Lighter handles than usual ones take longer to come to rest.
  wall.mass = std::max(wall.mass, 0.08);
  const Outcome fall = simulate(wall, Motion::kFall, 4);
  EXPECT_LT(fall.mostEnergy, kTolerance);
  EXPECT_LT(fall.lateSpeed, 12);
  EXPECT_NEAR(fall.forceOfBody, 0.3, 0.03);
}

INSTANTIATE_TEST_SUITE_P(
    Walls, DevicePassivity,
    testing::Values(Wall{0.1, Kind::kPush, 0, 0.08}, Wall{1, Kind::kPush, 0, 0.05},
                    Wall{3, Kind::kPush, 0, 0.08}, Wall{10, Kind::kPush, 0, 0.05},
                    Wall{10, Kind::kPush, 0.5, 0.15}, Wall{1, Kind::kBall, 0.3, 0.1},
                    Wall{10, Kind::kBall, 0, 0.08}));

/// The measurement sees what it should see: a plain sampled spring drives the same handle.
TEST(VirtualDevice, GainsEnergyFromAPlainSampledSpring) {
  VirtualDevice handle({0.05, 0.5e-3, 0.01}, {0, 0, 1});
  Vector3d applied = Vector3d::Zero();
  double most = -1;
  for (int i = 0; i < 1000; ++i) {
    const Vector3d hand = Vector3d(0, 0, -2) - kHandDamping * handle.velocity();
    const Vector3d force(0, 0, std::max(0.0, -10 * handle.measured()[2]));
    handle.advance(applied, hand, kDelay);
    applied = force;
    handle.advance(applied, hand, kPeriod - kDelay);
    most = std::max(most, handle.energyFromDevice());
  }
  EXPECT_GT(most, 10);
}

TEST(HandleForce, IsTheForceOfTheBodyAtRestAndBrakesInMotion) {
  HandleForce force;
  const SolvedContact contact{{0, 0, -1}, {0, 0, 1}, 2, 2, false};
  const HandleLimits limits;
  Vector3d result;
  double time = 1;
  for (int k = 0; k < 500; ++k) result = force.update({0, 0, -1}, time += 1e-3, contact, limits);
  EXPECT_NEAR(result[2], 2, 1e-3);
  EXPECT_EQ(force.tool(), Vector3d(0, 0, -1));
  // Deeper by 0.1 mm before the solver knows: the spring's 0.2 N and the damping.
  result = force.update({0, 0, -1.1}, time += 1e-3, contact, limits);
  EXPECT_GT(result[2], 2.2);
  for (int k = 0; k < 500; ++k) result = force.update({0, 0, -1.1}, time += 1e-3, contact, limits);
  EXPECT_NEAR(result[2], 2.2, 1e-3);
}

TEST(HandleForce, KeepsTheToolNearerToTheSurfaceOfAStifferBody) {
  HandleForce force;
  const SolvedContact contact{{0, 0, 0}, {0, 0, 1}, 0, 10, false};
  const HandleLimits limits{2, 0};
  Vector3d result;
  double time = 1;
  for (int k = 0; k < 500; ++k) result = force.update({0, 0, -1}, time += 1e-3, contact, limits);
  EXPECT_NEAR(result[2], 2, 1e-3);
  // The body's force at the tool: 10 N/mm * 0.2 mm.
  EXPECT_NEAR(force.tool()[2], -0.2, 1e-9);
  result = force.update({0, 0, -1}, time + 1e-3, contact, {2, 0.5});
  EXPECT_NEAR(result[2], 0.5, 1e-9);
  EXPECT_TRUE(force.isLimited());
}

/// The machine stalls while a trembling hand pushes the handle into the body; the device lets go
/// meanwhile.
class HandleForceInStalls : public testing::TestWithParam<double> {};
TEST_P(HandleForceInStalls, GivesNoEnergy) {
  const double stiffness = GetParam();
  HandleForce force;
  VirtualDevice handle({0.08, 0.5e-3, 0.01}, {0, 0, 1});
  Vector3d applied = Vector3d::Zero();
  double most = -1, time = 1;
  std::mt19937 random(3);
  for (int i = 0; i < 60'000; ++i) {
    // Once in some hundred milliseconds the next one takes up to 40.
    const double period = random() % 200 == 0 ? kPeriod * (2 + random() % 39) : kPeriod;
    const Vector3d at = handle.measured();
    const SolvedContact contact{at, {0, 0, 1}, -stiffness * at[2], stiffness, false};
    const Vector3d next = force.update(at, time, contact, {});
    // The force arrives in the middle of a usual period.
    for (double passed = 0; passed < period - 1e-9; passed += kPeriod / 2) {
      if (passed > 0 && passed < kPeriod) applied = next;
      if (passed > HandleForce::kMaxAge) applied.setZero();
      const double now = time + passed;
      const Vector3d goal(0, 0, -4 + 4 * std::cos(4 * now) + 0.3 * std::sin(70 * now));
      const Vector3d hand = kHand * (goal - handle.position()) - kHandDamping * handle.velocity();
      handle.advance(applied, hand, kPeriod / 2);
      most = std::max(most, handle.energyFromDevice());
    }
    time += period;
  }
  // The motion in a silence is not known exactly: 0.13 mJ in 1 of 60 other runs.
  EXPECT_LT(most, 0.2);
}
INSTANTIATE_TEST_SUITE_P(Walls, HandleForceInStalls, testing::Values(0.3, 1.0, 3.0, 10.0));

/// Another touch pushes the body against a hand that yields.
// A program without priority on a busy machine: positions come in bursts, 8 ms apart.
TEST(HandleForce, ARestingHandleHasTheBodysForceOnABusyMachine) {
  HandleForce force;
  const SolvedContact contact{{0, 0, 0}, {0, 0, 1}, 0, 1.2, false};
  Vector3d result = Vector3d::Zero();
  double time = 1;
  for (int k = 0; k < 2000; ++k) {
    const double at = 1 - 0.02 * std::min(k, 150);  // from 1 mm outside to 2 mm deep
    result = force.update({0, 0, at}, time += k % 8 == 0 ? 8e-3 : 1e-3, contact, {});
  }
  EXPECT_NEAR(result[2], 2.4, 1e-3);
  EXPECT_FALSE(force.isLimited());
}

// A hand rests, yields by a hundredth of a millimetre, pushes back after a silence, and rests
// again.
TEST(HandleForce, LeavingARestAgainAndAgainGivesLittleEnergy) {
  HandleForce force;
  const SolvedContact contact{{0, 0, -1}, {0, 0, 1}, 1, 1, false};
  Vector3d result = Vector3d::Zero();
  double time = 1, at = -1, given = 0;
  const auto go = [&](double to, double elapsed) {
    if (elapsed <= HandleForce::kMaxAge) given += result[2] * (to - at);  // else it has let go
    at = to;
    result = force.update({0, 0, at}, time += elapsed, contact, {});
  };
  for (int k = 0; k < 100; ++k) {
    for (int rest = 0; rest < 200; ++rest) go(at, 1e-3);
    go(at + 0.01, 1e-3);
    go(at - 0.01, 40e-3);
  }
  EXPECT_LT(given, 0.5);
}

TEST(HandleForce, ABodyThatMovesAgainstTheHandleDoesNotDriveIt) {
  HandleForce force;
  double given = 0, time = 1, at = 0;
  Vector3d result = Vector3d::Zero();
  for (int k = 0; k < 2000; ++k) {
    const double surface = 0.01 * k;  // 10 mm/s outwards
    const SolvedContact contact{{0, 0, at}, {0, 0, 1}, std::max(0.0, surface - at), 1, false};
    result = force.update({0, 0, at}, time += 1e-3, contact, {});
    const double moved = 0.002 * result[2];  // the user yields
    given += result[2] * moved;
    at += moved;
  }
  EXPECT_LT(given, 0.05);
}

}  // namespace
}  // namespace palpa::app

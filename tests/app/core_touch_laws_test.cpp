#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>
#include <random>

#include "app/core/model/build_touch_model.h"
#include "contact_laws.h"
#include "core_projects.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;
using Kind = bem::ContactTool::Kind;
using Command = TouchCommand::Kind;
using Status = TouchSnapshot::Status;

constexpr double kRadius = 25;  // mm
const Vector3d kNone = Vector3d::Zero(), kTop(0, 0, kRadius);

/// A sphere that can be touched everywhere, and how well its field may be known.
struct Sphere {
  const char* name;
  modeling::Project project;
  unsigned histories;
  /// Largest errors; the moment's over force times radius, the others relative.
  double force, moment, position, mirror, compliance;
};

modeling::Project sphereOf(modeling::Engine engine, double elementLength) {
  modeling::Project project = test::clampedSphere(4.5);
  project.mesh.engine = engine;
  project.mesh.elementLength = elementLength;
  return project;
}

modeling::Project splinesHeldByAPatch() {
  modeling::Project project = sphereOf(modeling::Engine::kSplines, 7);
  project.supports[0].where = modeling::Region::ofPatches({"bottom"});
  return project;
}

/// n = 386, 642 and 602: on coarser splines a finger's mask is so wide that it never slips on its
/// way. Limits are about twice what is measured. The field of a force belongs to the projected
/// bump, the mean displacement of a contact refers to the wanted one: single means of the field
/// differ in first order of the projection's error, and are symmetric to this order (decision 087).
const Sphere kSpheres[] = {
    {"Triangles", sphereOf(modeling::Engine::kTriangles, 7), 15, 0.01, 0.015, 0.015, 0.02, 0.005},
    {"Splines", splinesHeldByAPatch(), 8, 0.003, 0.005, 0.009, 1e-4, 3e-3},
    {"SplinesCutByTheSupport", sphereOf(modeling::Engine::kSplines, 7), 6, 0.003, 0.006, 0.012,
     2e-3, 1e-3}};

class TouchLaws : public testing::TestWithParam<int> {
 protected:
  static const Sphere& limits() { return kSpheres[GetParam()]; }
  static const std::shared_ptr<const TouchableModel>& sphere() {
    static std::shared_ptr<const TouchableModel> bodies[std::size(kSpheres)];
    auto& body = bodies[GetParam()];
    if (!body) {
      const auto made = std::make_shared<TouchableModel>(buildTouchModel(limits().project, {}, {}));
      made->columns()->compute(made->columns()->nodesNear(made->surface().places(), kTop), {});
      std::printf("%s: n = %d\n", limits().name, made->surface().dofs().nodeCount());
      body = made;
    }
    return body;
  }
};

INSTANTIATE_TEST_SUITE_P(Engines, TouchLaws,
                         testing::Range(0, static_cast<int>(std::size(kSpheres))),
                         [](const auto& tested) { return kSpheres[tested.param].name; });

/// A tool that wanders about over one part of the sphere, up to some millimetres in and out of it.
struct Wanderer {
  TouchId id = 0;
  bem::ContactTool tool;
  Vector3d middle = kNone, direction = kNone, velocity = kNone;
  double depth = -1, sinking = 0;

  Wanderer(TouchId number, Vector3d around, std::mt19937& random)
      : id(number), middle(std::move(around)), direction(middle) {
    std::uniform_real_distribution<double> unit(0, 1);
    tool.kind = static_cast<Kind>(static_cast<int>(4 * unit(random)));
    tool.radius = 6 + 6 * unit(random);
    tool.friction = unit(random) < 0.3 ? 0 : 0.8 * unit(random);
  }
  void move(std::mt19937& random) {
    std::normal_distribution<double> step(0, 1);
    velocity = 0.95 * velocity + 4e-4 * Vector3d(step(random), step(random), step(random)) -
               2e-4 * (direction - middle);
    direction = (direction + velocity).normalized();
    sinking = 0.95 * sinking + 0.02 * step(random) - 0.002 * (depth - 0.7);
    depth += sinking;
  }
  Vector3d value() const {
    if (tool.kind == Kind::kGrab) return -0.5 * depth * middle + 5 * (direction - middle);
    if (tool.kind == Kind::kForce) return -0.1 * depth * direction;
    return (25 - depth + (tool.kind == Kind::kBall ? tool.radius : 0)) * direction;
  }
};

TEST_P(TouchLaws, HoldAtEveryStepOfRandomHistories) {
  const Vector3d middles[] = {Vector3d(0, 0, 1), Vector3d(1, 0, 0.1).normalized(),
                              Vector3d(-0.5, 0.8, 0).normalized(),
                              Vector3d(-0.6, -0.7, 0.2).normalized()};
  int slipping = 0, sticking = 0, open = 0;
  test::Equilibrium largest;
  for (unsigned seed = 1; seed <= limits().histories; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    auto stepper = std::make_unique<TouchStepper>(sphere());
    TouchField field(sphere());
    std::vector<std::unique_ptr<Wanderer>> tools(std::size(middles));
    TouchId last = 0;
    for (int step = 0; step < 150; ++step) {
      SCOPED_TRACE(testing::Message() << "step " << step);
      for (std::size_t k = 0; k < tools.size(); ++k) {
        auto& tool = tools[k];
        if (!tool && random() % 15 == 0) {
          tool = std::make_unique<Wanderer>(++last, middles[k], random);
          stepper->apply({Command::kBegin, last, tool->tool, 25 * middles[k], tool->value()});
        } else if (tool && random() % 80 == 0) {
          stepper->apply({Command::kEnd, tool->id, {}, kNone, kNone});
          tool = nullptr;
        } else if (tool && random() % 10 != 0) {  // now and then it rests
          tool->move(random);
          stepper->apply({Command::kSet, tool->id, {}, kNone, tool->value()});
        }
      }
      if (step == 75) {  // an equal model takes over
        auto next = std::make_unique<TouchStepper>(sphere(), 2);
        next->takeOver(*stepper);
        stepper = std::move(next);
      }
      stepper->step();
      ASSERT_TRUE(stepper->simulation().converged()) << stepper->simulation().residual();
      test::expectLaws(stepper->simulation());
      if (step % 10 == 9) test::measureEquilibrium(*stepper, field, kRadius, largest);
      for (const auto& contact : stepper->simulation().contacts()) {
        slipping += contact.status == Status::kSlipping;
        sticking += contact.status == Status::kSticking;
        open += contact.status == Status::kOpen;
      }
      if (HasFailure()) return;
    }
  }
  std::printf("forces off by %.2f %%, moments by %.2f %%, places by %.2f %%\n", 100 * largest.force,
              100 * largest.moment, 100 * largest.position);
  EXPECT_LE(largest.force, limits().force);
  EXPECT_LE(largest.moment, limits().moment);
  EXPECT_LE(largest.position, limits().position);
  // All that can happen did.
  EXPECT_GT(slipping, 100);
  EXPECT_GT(sticking, 20);
  EXPECT_GT(open, 20);
}

/// Work of the tools along a closed path: the loss by friction, never negative.
TEST_P(TouchLaws, FrictionTakesEnergyAroundClosedWays) {
  for (const Kind kind : {Kind::kPush, Kind::kBall})
    for (const double friction : {0.0, 0.2, 0.6}) {
      SCOPED_TRACE(testing::Message() << "kind " << static_cast<int>(kind) << ", mu " << friction);
      TouchStepper stepper(sphere());
      const double high = 23.8 + (kind == Kind::kBall ? 10 : 0);
      const auto at = [&](int step) -> Vector3d {
        const double angle = 2 * std::numbers::pi * step / 400;
        return {2.5 * (1 - std::cos(angle)), 2.5 * std::sin(angle),
                high - 0.4 * std::sin(2 * angle)};
      };
      stepper.apply({Command::kBegin, 1, {kind, 10, friction}, kTop, at(0)});
      Vector3d before = kNone;
      double work = 0, sliding = 0;
      for (int step = 0; step <= 800; ++step) {
        stepper.apply({Command::kSet, 1, {}, kNone, at(step)});
        stepper.step();
        ASSERT_TRUE(stepper.simulation().converged());
        const Vector3d force = stepper.simulation().contacts()[0].force;
        if (step > 400) {  // the first time around friction builds up
          const double part = 0.5 * (force + before).dot(at(step) - at(step - 1));
          work += part;
          sliding += std::abs(part);
        }
        before = force;
      }
      // Without friction the way leads back to the same energy, but for the time a mask takes to
      // follow the tool: one step.
      std::printf("kind %d, mu %.1f: work %.4f of %.4f mJ\n", static_cast<int>(kind), friction,
                  work, sliding);
      if (friction == 0)
        EXPECT_NEAR(work, 0, 0.02 * sliding);
      else
        EXPECT_GT(work, 0);
    }
}

/// The body and all touches mirrored give the mirrored forces. The body equals its mirror image
/// except for the mesh, so the forces agree to the error of the discretisation.
TEST_P(TouchLaws, MirrorImagesGiveMirrorImages) {
  const Vector3d mirror(1, -1, 1);
  const auto play = [&](bool isMirrored) {
    const auto image = [&](const Vector3d& v) -> Vector3d {
      return isMirrored ? Vector3d(mirror.cwiseProduct(v)) : v;
    };
    TouchStepper stepper(sphere());
    stepper.apply({Command::kBegin, 1, {Kind::kBall, 12, 0.3}, kTop, image({0, 0, 36})});
    stepper.apply(
        {Command::kBegin, 2, {Kind::kPush, 8, 0.2}, image({15, 20, 0}), image({14.2, 18.8, 0})});
    stepper.apply(
        {Command::kBegin, 3, {Kind::kGrab, 8}, image({-25, 0, 0}), image({1, 0.5, -0.4})});
    std::vector<Vector3d> forces;
    for (int k = 0; k < 80; ++k) {
      stepper.apply({Command::kSet, 1, {}, kNone, image({0.03 * k, 0.04 * k, 35.8})});
      stepper.apply({Command::kSet, 2, {}, kNone, image({14.2, 18.8 - 0.01 * k, 0.04 * k})});
      stepper.step();
      for (const auto& contact : stepper.simulation().contacts())
        forces.push_back(image(contact.force));
    }
    return forces;
  };
  const auto here = play(false), there = play(true);
  double largest = 0, off = 0;
  for (std::size_t k = 0; k < here.size(); ++k) {
    largest = std::max(largest, here[k].norm());
    off = std::max(off, (here[k] - there[k]).norm());
  }
  std::printf("mirror images differ by %.1e\n", off / largest);
  EXPECT_LE(off, limits().mirror * largest);
}

/// Betti: what a force here does there is what the same force there does here.
TEST_P(TouchLaws, ComplianceIsSymmetric) {
  const Vector3d places[] = {kTop, {25, 0, 0}};
  const Vector3d forces[] = {{0.05, 0.02, -0.2}, {-0.15, 0.1, 0.05}};
  double work[2];
  for (const int loaded : {0, 1}) {
    TouchStepper stepper(sphere());
    stepper.apply({Command::kBegin, 1, {Kind::kForce, 8}, places[loaded], forces[loaded]});
    stepper.step();
    TouchSnapshot snapshot;
    stepper.describe(snapshot);
    TouchField field(sphere());
    const auto mask = bem::makeContactMask(sphere()->surface(), places[1 - loaded], 8);
    work[loaded] = forces[1 - loaded].dot(mask.displacement(field.displacements(snapshot)).col(0));
  }
  std::printf("works differ by %.1e\n", std::abs(work[0] / work[1] - 1));
  EXPECT_NEAR(work[0], work[1], limits().compliance * std::abs(work[0]));
}

/// Two tools at one place that want different things: the forces stay bounded, the laws hold for
/// all others, and a touch that begins meanwhile has its force at once.
TEST_P(TouchLaws, ATouchBeginsWhileOthersContradictEachOther) {
  TouchStepper stepper(sphere());
  stepper.apply({Command::kBegin, 1, {Kind::kGrab, 8}, kTop, {0, 0, -1}});
  stepper.step();
  const double alone = stepper.simulation().contacts()[0].force.norm();
  stepper.apply({Command::kBegin, 2, {Kind::kGrab, 8}, kTop, {0, 0, -2}});
  stepper.step();
  EXPECT_FALSE(stepper.simulation().converged());
  EXPECT_GT(stepper.simulation().softness(), 0);
  stepper.apply({Command::kBegin, 3, {Kind::kGrab, 8}, {25, 0, 0}, {-1, 0, 0}});
  stepper.step();
  EXPECT_FALSE(stepper.simulation().converged());
  EXPECT_GT(stepper.simulation().residual(), 0);
  const auto& contacts = stepper.simulation().contacts();
  EXPECT_LE((contacts[2].displacement - Vector3d(-1, 0, 0)).norm(), 1e-6);
  EXPECT_GT(contacts[2].force.norm(), 0.1 * alone);
  const Vector3d both = contacts[0].force + contacts[1].force;
  EXPECT_NEAR(both.norm(), 1.5 * alone, 0.3 * alone);
  EXPECT_LE(contacts[1].force.norm(), 20 * alone);
  stepper.apply({Command::kEnd, 1, {}, kNone, kNone});
  stepper.step();
  EXPECT_TRUE(stepper.simulation().converged());
}

}  // namespace
}  // namespace palpa::app

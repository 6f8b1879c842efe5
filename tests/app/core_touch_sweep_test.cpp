// Force-depth curves, and the figures of a contact that belong together.
#include "app/core/results/touch_sweep.h"

#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>

#include "app/core/live/touch_stepper.h"
#include "app/core/model/build_touch_model.h"
#include "app/core/results/touch.h"
#include "core_projects.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;
using modeling::Touch;
using modeling::TouchKind;

const Vector3d kTop{0, 0, 25};

std::shared_ptr<const TouchModel> sphere() {
  static const auto model = buildTouchModel(test::clampedSphere(6), {}, {});
  return model;
}

std::vector<SweepRow> sweep(const std::vector<Touch>& touches, int count) {
  std::vector<SweepRow> rows;
  sweepTouches(*sphere(), touches, count, 0, {}, [&](SweepRow row) { rows.push_back(row); });
  return rows;
}

void expectSingleTouches(const std::vector<Touch>& touches, int count) {
  const auto rows = sweep(touches, count);
  ASSERT_EQ(rows.size(), static_cast<std::size_t>(count) + 1);
  for (int k = 0; k <= count; ++k) {
    EXPECT_EQ(rows[k].share, static_cast<double>(k) / count);
    const TouchState alone = playTouches(*sphere(), scaled(touches, rows[k].share));
    ASSERT_EQ(rows[k].contacts.size(), touches.size());
    EXPECT_EQ(rows[k].energy, alone.energy);
    for (std::size_t i = 0; i < touches.size(); ++i) {
      EXPECT_EQ(rows[k].contacts[i].force, alone.contacts[i].force) << k;
      EXPECT_EQ(rows[k].contacts[i].displacement, alone.contacts[i].displacement) << k;
      EXPECT_EQ(rows[k].contacts[i].status, alone.contacts[i].status) << k;
    }
  }
}

TEST(TouchSweep, EqualsSingleTouchesBitForBit) {
  // Across the pole, so that the ball sticks and slips.
  expectSingleTouches({{"ball", {6, 0, 24.27}, TouchKind::kBall, {0.6, 0, -1.6}, 8.0, 0.4}}, 2);
  expectSingleTouches({{"grab", kTop, TouchKind::kGrab, {0.5, 0, -2}, 8.0},
                       {"pin", {25, 0, 0}, TouchKind::kPin, {0, 0, 0}, 8.0},
                       {"pull", {-25, 0, 0}, TouchKind::kForce, {-0.3, 0, 0}, 8.0}},
                      3);
}

TEST(TouchSweep, ABallStartsAtFirstContact) {
  const auto rows = sweep({{"ball", kTop, TouchKind::kBall, {0, 0, -3}, 20.0}}, 3);
  EXPECT_EQ(rows[0].contacts[0].force.norm(), 0);
  EXPECT_EQ(rows[0].contacts[0].stiffness, 0);
  for (std::size_t k = 1; k < rows.size(); ++k)
    EXPECT_GT(rows[k].contacts[0].force.norm(), 1.3 * rows[k - 1].contacts[0].force.norm());
}

TEST(TouchSweep, StopsAndRefuses) {
  const std::vector<Touch> touches{{"grab", kTop, TouchKind::kGrab, {0, 0, -2}, 8.0}};
  std::stop_source stop;
  Job job;
  job.stop = stop.get_token();
  int seen = 0;
  EXPECT_THROW(sweepTouches(*sphere(), touches, 100, 0, job,
                            [&](const SweepRow&) {
                              if (++seen == 3) stop.request_stop();
                            }),
               Cancelled);
  EXPECT_EQ(seen, 3);
  for (const int count : {0, -1, kMaxSweepSteps + 1})
    EXPECT_THROW(sweepTouches(*sphere(), touches, count, 0, {}, [](const SweepRow&) {}),
                 std::invalid_argument);
}

TEST(TouchSweep, ReportsItsProgressOnce) {
  const std::vector<Touch> touches{{"ball", kTop, TouchKind::kBall, {0, 0, -0.5}, 8.0}};
  Job job;
  double last = 0;
  job.progress = [&](Phase phase, double done) {
    EXPECT_EQ(phase, Phase::kTouch);
    EXPECT_GE(done, last);
    last = done;
  };
  sweepTouches(*sphere(), touches, 2, 0, job, [](const SweepRow&) {});
  EXPECT_EQ(last, 1);
}

TEST(TouchSweep, IsATableWithALinePerTouchAndState) {
  const auto rows = sweep({{"a, \"b\"", kTop, TouchKind::kGrab, {0, 0, -2}, 8.0},
                           {"pull", {-25, 0, 0}, TouchKind::kForce, {-0.5, 0, 0}, 8.0}},
                          2);
  std::ostringstream out;
  writeSweep(rows, out);
  std::istringstream in(out.str());
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 7u);
  EXPECT_TRUE(lines[0].starts_with("share,touch,kind,status,given,given_unit,force_N,"));
  EXPECT_TRUE(lines[3].starts_with("0.5,\"a, \"\"b\"\"\",grab,holding,1,mm,")) << lines[3];
  EXPECT_TRUE(lines[6].starts_with("1,pull,force,holding,0.5,N,0.5,")) << lines[6];
}

/// Displacement of a place by a force alone.
Vector3d moved(const Vector3d& at, double radius, const Vector3d& force) {
  return playTouches(*sphere(), std::vector<Touch>{{"force", at, TouchKind::kForce, force, radius}})
      .contacts[0]
      .displacement;
}

TEST(TouchFigures, OneContactDividesForceByMotion) {
  for (const TouchKind kind : {TouchKind::kGrab, TouchKind::kForce, TouchKind::kPush}) {
    const auto contact =
        playTouches(*sphere(), std::vector<Touch>{{"one", kTop, kind, {0.3, 0, -1}, 8.0, 0.5}})
            .contacts[0];
    EXPECT_LE((contact.deflection - contact.displacement).norm(),
              1e-4 * contact.displacement.norm());
    EXPECT_NEAR(contact.stiffness, contact.force.norm() / contact.displacement.norm(),
                1e-4 * contact.stiffness);
  }
}

/// Beside a pin that pulls far, most of the motion of a push is the pin's.
TEST(TouchFigures, TwoContactsHaveTheirOwnDeflections) {
  const Vector3d beside(15, 0, 20);
  const std::vector<Touch> touches{{"pin", kTop, TouchKind::kGrab, {0, 0, -4}, 8.0},
                                   {"push", beside, TouchKind::kPush, {-0.3, 0, -0.3}, 8.0}};
  const TouchState state = playTouches(*sphere(), touches);
  for (const auto& contact : state.contacts) {
    const Vector3d alone = moved(contact.at, contact.radius, contact.force);
    EXPECT_LE((contact.deflection - alone).norm(), 2e-3 * contact.displacement.norm());
    EXPECT_NEAR(contact.stiffness, contact.force.norm() / contact.deflection.norm(),
                1e-12 * contact.stiffness);
  }
  EXPECT_GT(state.contacts[1].displacement.norm(), 2 * state.contacts[1].deflection.norm());

  // The live loop has the same figures.
  const auto model = std::make_shared<const TouchableModel>(sphere());
  TouchStepper stepper(model);
  const auto& push = state.contacts[1];
  stepper.apply(
      {TouchCommand::Kind::kBegin, 1, {bem::ContactTool::Kind::kGrab, 8}, kTop, {0, 0, -4}});
  stepper.apply(
      {TouchCommand::Kind::kBegin, 2, {bem::ContactTool::Kind::kForce, 8}, push.at, push.force});
  while (!stepper.missing().empty()) model->columns()->compute(stepper.missing(), {});
  stepper.step();
  TouchSnapshot snapshot;
  stepper.describe(snapshot);
  for (int k = 0; k < 2; ++k) {
    const auto& live = snapshot.contacts[k];
    EXPECT_LE((live.deflection - state.contacts[k].deflection).norm(),
              2e-3 * state.contacts[k].displacement.norm());
    EXPECT_NEAR(live.stiffness, state.contacts[k].stiffness, 1e-3 * live.stiffness);
  }
}

}  // namespace
}  // namespace palpa::app

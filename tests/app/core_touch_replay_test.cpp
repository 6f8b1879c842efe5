#include "app/core/live/touch_replay.h"
#include "app/core/model/build_touch_model.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <vector>

#include "app/core/live/touch_loop.h"
#include "base/parallel.h"
#include "core_projects.h"

namespace palpa::app {
namespace {

using namespace std::chrono_literals;
using Eigen::Vector3d;
using Kind = bem::ContactTool::Kind;

std::shared_ptr<const TouchModel> build(double edgeLength) {
  return buildTouchModel(test::clampedSphere(edgeLength), {}, {});
}

/// A push with friction, a ball and a grab that move for a while.
TouchRecording touches() {
  using Command = TouchCommand::Kind;
  TouchRecording recording;
  const Vector3d none = Vector3d::Zero();
  recording.steps = 120;
  recording.entries.push_back(
      {0, {Command::kBegin, 1, {Kind::kPush, 8, 0.3}, {0, 0, 25}, {0, 0, 23}}});
  recording.entries.push_back(
      {10, {Command::kBegin, 2, {Kind::kBall, 10, 0.2}, {0, 25, 0}, {0, 34, 0}}});
  recording.entries.push_back(
      {20, {Command::kBegin, 3, {Kind::kGrab, 8, 0}, {25, 0, 0}, {-1, 0, 0}}});
  for (std::uint64_t k = 20; k < 100; ++k) {
    if (k == 90) recording.entries.push_back({k, {Command::kEnd, 3, {}, none, none}});
    const double t = 0.01 * static_cast<double>(k);
    recording.entries.push_back({k, {Command::kSet, 1, {}, none, {4 * t, t, 23 - t}}});
    recording.entries.push_back({k, {Command::kSet, 2, {}, none, {t, 33.5 - t, t}}});
  }
  return recording;
}

std::vector<Vector3d> forcesOf(const std::shared_ptr<const TouchableModel>& body,
                               const TouchRecording& recording, int threads) {
  Job job;
  job.threads = threads;
  std::vector<Vector3d> forces;
  replay(body, recording, job, [&](const TouchSnapshot& snapshot) {
    for (const auto& contact : snapshot.touched()) forces.push_back(contact.force);
  });
  return forces;
}

TEST(TouchReplay, IsTheSameOnAnyNumberOfThreads) {
  for (const double edgeLength : {6.0, 4.5}) {
    const auto model = build(edgeLength);
    const auto one = forcesOf(std::make_shared<TouchableModel>(model), touches(), 1);
    const auto two = forcesOf(std::make_shared<TouchableModel>(model), touches(), 2);
    EXPECT_EQ(one.size(), 120u + 110u + 70u);
    EXPECT_EQ(one, two);
    EXPECT_GT(one.back().norm(), 0);
  }
}

TEST(TouchReplay, DoesNotDependOnTheOrderOfTheColumns) {
  const auto model = build(6);
  const auto whole = std::make_shared<TouchableModel>(model);
  whole->columns()->compute(whole->columns()->nodesNear(whole->surface().places(), {0, 0, -25}),
                            {});
  EXPECT_EQ(forcesOf(whole, touches(), 2),
            forcesOf(std::make_shared<TouchableModel>(model), touches(), 2));
}

TEST(TouchReplay, ComputesNearlyWholeBlocksOfColumns) {
  // A slide needs new columns at many places; one at a time, each of them would cost a block.
  const auto model = build(4.5);
  const auto body = std::make_shared<TouchableModel>(model);
  int blocks = 0, ready = 0;
  replay(body, touches(), {}, [&](const TouchSnapshot&) {
    const int now = body->columns()->readyCount();
    blocks += (now - ready + bem::GreensColumns::kBlock - 1) / bem::GreensColumns::kBlock;
    EXPECT_TRUE((now - ready) % bem::GreensColumns::kBlock == 0 || body->columns()->isComplete());
    ready = now;
  });
  EXPECT_GT(blocks, 3);
}

TEST(TouchReplay, MayUseTheModelOfARunningLoop) {
  const auto model = build(6);
  const auto alone = forcesOf(std::make_shared<TouchableModel>(model), touches(), 2);
  TouchLoop loop;
  const auto number = loop.setModel(model);
  std::shared_ptr<const TouchableModel> body;
  const auto end = std::chrono::steady_clock::now() + 60s;
  while (!body && std::chrono::steady_clock::now() < end) body = loop.model(number);
  ASSERT_TRUE(body);
  // The loop computes all columns meanwhile.
  EXPECT_EQ(forcesOf(body, touches(), 2), alone);
}

TEST(TouchReplay, GivesTheForcesOfTheLiveLoopThroughASwapToo) {
  const auto model = build(6);
  TouchLoop loop;
  TouchSnapshot snapshot;
  const auto await = [&](const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + 60s;
    do {
      loop.read(snapshot);
      if (condition()) return true;
    } while (std::chrono::steady_clock::now() < end);
    return false;
  };
  const auto number = loop.setModel(model);
  ASSERT_TRUE(await([&] { return snapshot.model == number && snapshot.columnsReady == 1; }));
  for (const bool isSwapping : {false, true}) {
    loop.startRecording();
    const TouchId push = loop.begin({Kind::kPush, 8, 0.3}, {0, 0, 25}, {0, 0, 23});
    const TouchId grab = loop.begin({Kind::kGrab, 8, 0}, {25, 0, 0}, {-1, 0, 0});
    ASSERT_TRUE(await([&] { return snapshot.find(grab) != nullptr; }));
    struct Seen {
      std::uint64_t step;
      Vector3d push, grab;
    };
    std::vector<Seen> seen;
    std::uint64_t swapped = 0;
    for (int k = 0; k < 150; ++k) {
      loop.set(push, {0.04 * k, 0.01 * k, 23 - 0.01 * k});
      std::this_thread::sleep_for(700us);
      if (isSwapping && k == 60) swapped = loop.setModel(build(6));
      loop.read(snapshot);
      if (seen.empty() || seen.back().step != snapshot.step)
        seen.push_back({snapshot.step, snapshot.find(push)->force, snapshot.find(grab)->force});
    }
    if (isSwapping) {
      ASSERT_TRUE(await([&] { return snapshot.model == swapped; }));
      seen.push_back({snapshot.step, snapshot.find(push)->force, snapshot.find(grab)->force});
    }
    loop.end(push);
    loop.end(grab);
    ASSERT_TRUE(await([&] { return snapshot.contactCount == 0; }));
    const std::uint64_t last = snapshot.step;
    const TouchRecording recording = loop.stopRecording();
    EXPECT_EQ(recording.modelChanges, isSwapping ? 1 : 0);
    EXPECT_FALSE(recording.isFull);
    ASSERT_GE(recording.steps, 1u);
    std::vector<TouchSnapshot::Contact> pushed(recording.steps), grabbed(recording.steps);
    std::uint64_t endedAt = 0;
    replay(std::make_shared<TouchableModel>(model), recording, {}, [&](const TouchSnapshot& at) {
      if (const auto* contact = at.find(push)) pushed[at.step - 1] = *contact;
      if (const auto* contact = at.find(grab)) grabbed[at.step - 1] = *contact;
      if (endedAt == 0 && at.step > 10 && at.contactCount == 0) endedAt = at.step;
    });
    // The loop counts all its steps, the recording those since its beginning.
    ASSERT_GT(endedAt, 0u);
    ASSERT_LE(endedAt, last);
    std::size_t compared = 0;
    for (std::uint64_t offset = last - recording.steps; offset <= last - endedAt; ++offset) {
      compared = 0;
      for (const Seen& live : seen) {
        if (live.step <= offset || live.step - offset > recording.steps) continue;
        const auto& again = pushed[live.step - offset - 1];
        const double tolerance = isSwapping ? 1e-9 * live.push.norm() : 0;
        if ((again.force - live.push).norm() > tolerance) break;
        if ((grabbed[live.step - offset - 1].force - live.grab).norm() > tolerance) break;
        ++compared;
      }
      if (compared == seen.size()) break;
    }
    EXPECT_EQ(compared, seen.size());
  }
}

TEST(TouchReplay, CanBeCancelled) {
  std::stop_source stop;
  Job job;
  job.stop = stop.get_token();
  int steps = 0;
  EXPECT_THROW(replay(std::make_shared<TouchableModel>(build(8)), touches(), job,
                      [&](const TouchSnapshot&) {
                        if (++steps == 5) stop.request_stop();
                      }),
               Cancelled);
  EXPECT_EQ(steps, 5);
}

TEST(TouchReplay, CommandsThatMakeNoSenseAreIgnored) {
  using Command = TouchCommand::Kind;
  const Vector3d none = Vector3d::Zero();
  TouchRecording recording;
  recording.steps = 2;
  recording.entries.push_back({0, {Command::kSet, 7, {}, none, {0, 0, 1}}});
  recording.entries.push_back({0, {Command::kEnd, 7, {}, none, none}});
  for (TouchId id = 1; id <= 100; ++id)
    recording.entries.push_back(
        {0, {Command::kBegin, id, {Kind::kForce, 8, 0}, {0, 0, 25}, {0, 0, -0.01}}});
  replay(std::make_shared<TouchableModel>(build(8)), recording, {},
         [](const TouchSnapshot& snapshot) {
           EXPECT_EQ(snapshot.contactCount, TouchSnapshot::kMaxContacts);
         });
}

}  // namespace
}  // namespace palpa::app

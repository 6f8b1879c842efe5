#include "app/core/live/touch_loop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "allocation_counter.h"
#include "app/core/results/touch.h"
#include "app/core/system/destroy_in_background.h"
#include "core_projects.h"
#include "touch_loop_sphere.h"

namespace palpa::app {
namespace {

using namespace std::chrono_literals;
using Eigen::Vector3d;
using Kind = bem::ContactTool::Kind;
using Status = TouchSnapshot::Status;
using test::await;
using test::build;
using test::hasForce;
using test::hasValue;
using test::isComplete;
using test::kSide;
using test::kTop;
using test::largerSphere;
using test::sphere;
using test::stepsAfter;

TEST(TripleBuffer, HandsOverTheNewestWholeValue) {
  struct Pair {
    int a = 0, b = 0;
  };
  TripleBuffer<Pair> buffer;
  EXPECT_FALSE(buffer.update());
  constexpr int kLast = 200'000;
  std::jthread writer([&] {
    for (int k = 1; k <= kLast; ++k) {
      buffer.back() = {k, -k};
      buffer.publish();
    }
  });
  int last = 0;
  while (last < kLast) {
    if (!buffer.update()) continue;
    const Pair pair = buffer.front();
    ASSERT_EQ(pair.a, -pair.b);
    ASSERT_GT(pair.a, last);
    last = pair.a;
  }
}

/// The loop ends contacts while their threads still move them, and other threads get their slots.
TEST(TouchInput, APlaceThatWasTakenAwayHasOneWriterAtATime) {
  TouchInput input;
  std::atomic<bool> isOver{false};
  const auto valueOf = [](double k, TouchId id) { return Vector3d(k, -k, id); };
  std::vector<std::jthread> hands;
  for (int hand = 0; hand < 3; ++hand)
    hands.emplace_back([&] {
      for (double k = 1; !isOver; ++k) {
        TouchId id = 0;
        try {
          id = input.begin({Kind::kGrab, 8}, kTop, Vector3d::Zero());
        } catch (const TouchRefused&) {  // those that were ended are still being taken away
          std::this_thread::yield();
          continue;
        }
        for (int i = 0; i < 50 && !isOver; ++i) input.set(id, valueOf(k + i, id));
        input.end(id);
      }
    });
  long seen = 0;
  const auto check = [&](const TouchCommand& command) {
    if (command.kind != TouchCommand::Kind::kSet) return;
    ++seen;
    ASSERT_EQ(command.value.x(), -command.value.y());
    ASSERT_EQ(command.value.z(), command.id);
  };
  const auto end = std::chrono::steady_clock::now() + 1s;
  while (std::chrono::steady_clock::now() < end && !HasFatalFailure()) {
    input.take(input.begun(), check);
    input.clearSaid();
    input.endAll(input.count(), check);
  }
  isOver = true;
  EXPECT_GT(seen, 0);
}

TEST(LatencyHistogram, GivesQuantiles) {
  LatencyHistogram histogram;
  EXPECT_EQ(histogram.read().count, 0u);
  EXPECT_EQ(histogram.read().p99, 0);
  for (int k = 1; k <= 1000; ++k) histogram.add(std::chrono::microseconds(k));
  histogram.add(5s);
  const Latency latency = histogram.read();
  EXPECT_EQ(latency.count, 1001u);
  EXPECT_NEAR(latency.p50, 500e-6, 21e-6);
  EXPECT_NEAR(latency.p99, 990e-6, 21e-6);
  EXPECT_EQ(latency.largest, 5);
  histogram.clear();
  EXPECT_EQ(histogram.read().count, 0u);
}

TEST(TouchLoop, GivesTheForceOfTheExactSolver) {
  TouchLoop loop;
  loop.setModel(sphere());
  const TouchId id = loop.begin({Kind::kGrab, 8}, kTop, {0, 0.5, -2});
  const TouchSnapshot snapshot = await(loop, hasForce(id));
  const modeling::Touch touch{"exact", kTop, modeling::TouchKind::kGrab, {0, 0.5, -2}, 8.0};
  const TouchState exact = playTouches(*sphere(), std::span(&touch, 1));
  const auto* contact = snapshot.find(id);
  EXPECT_EQ(contact->status, Status::kGrabbed);
  EXPECT_TRUE(snapshot.isConverged);
  EXPECT_LE((contact->force - exact.contacts[0].force).norm(), 1e-5 * contact->force.norm());
  EXPECT_NEAR(contact->stiffness, exact.contacts[0].stiffness, 1e-4 * contact->stiffness);
}

TEST(TouchLoop, ATouchThatBeganBeforeTheModelIsThereBeginsWithIt) {
  TouchLoop loop;
  const TouchId id = loop.begin({Kind::kPush, 8, 0.3}, kTop, {0, 0, 24});
  const TouchId ended = loop.begin({Kind::kGrab, 8}, kSide, {1, 0, 0});
  loop.set(id, {0, 0, 23});
  loop.end(ended);
  const auto number = loop.setModel(sphere());
  const TouchSnapshot snapshot = await(loop, hasForce(id));
  EXPECT_EQ(snapshot.model, number);
  EXPECT_EQ(snapshot.find(id)->value, Vector3d(0, 0, 23));
  EXPECT_EQ(snapshot.find(ended), nullptr);
}

TEST(TouchLoop, TheFirstForceNeedsFewColumns) {
  TouchLoop::Options options;
  options.computesAll = false;
  TouchLoop loop(options);
  loop.setModel(sphere());
  const TouchId id = loop.begin({Kind::kGrab, 8}, kTop, {0, 0, -2});
  const TouchSnapshot snapshot = await(loop, hasForce(id));
  EXPECT_GT(snapshot.columnsReady, 0);
  EXPECT_LT(snapshot.columnsReady, 0.5);
  // A tool that slides away from them asks for more and keeps its force meanwhile.
  const TouchId push = loop.begin({Kind::kPush, 6, 0}, kSide, {24, 0, 0});
  await(loop, hasForce(push));
  for (int k = 0; k <= 200; ++k) {
    const Vector3d value = 24 * Vector3d(std::cos(0.01 * k), std::sin(0.01 * k), 0);
    loop.set(push, value);
    EXPECT_GT(await(loop, hasValue(push, value)).find(push)->force.norm(), 0);
  }
}

/// With splines coefficients are not nodes of the mesh.
TEST(TouchLoop, ColumnsThatComeWithTheNeededOnesAreAroundThem) {
  modeling::Project project = test::clampedSphere(6);
  project.mesh.engine = modeling::Engine::kSplines;
  project.mesh.elementLength = 8;
  TouchLoop::Options options;
  options.computesAll = false;
  TouchLoop loop(options);
  const auto number = loop.setModel(build(project));
  await(loop, hasForce(loop.begin({Kind::kGrab, 5}, kTop, {0, 0, -1})));
  const auto body = loop.model(number);
  const std::vector<Vector3d>& places = body->surface().places();
  ASSERT_LT(body->columns()->readyCount(), body->columns()->nodeCount() / 2);
  double farthest = 0;
  for (int k = 0; k < static_cast<int>(places.size()); ++k)
    if (body->columns()->has(k)) farthest = std::max(farthest, (places[k] - kTop).norm());
  EXPECT_LT(farthest, 25 * std::numbers::sqrt2);  // on the upper half
}

TEST(TouchLoop, ColumnsComeNearestToTheExpectedTouchFirst) {
  TouchLoop loop;
  loop.expect(kSide);
  const auto number = loop.setModel(sphere());
  await(loop, [&](const TouchSnapshot& snapshot) { return snapshot.columnsReady > 0; });
  const auto body = loop.model(number);
  ASSERT_NE(body, nullptr);
  const auto& nodes = body->surface().mesh().nodes;
  const std::vector<int> order = body->columns()->nodesNear(body->surface().places(), kSide);
  // Looked at from far to near: behind a node that is there all nearer ones are.
  double farthest = 0;
  for (auto node = order.rbegin(); node != order.rend(); ++node) {
    const double distance = (nodes[*node] - kSide).norm();
    if (body->columns()->has(*node))
      farthest = std::max(farthest, distance);
    else
      EXPECT_GE(distance, farthest * (1 - 1e-9));
  }
  EXPECT_GT(farthest, 0);
}

TEST(TouchLoop, TheNewestValueWins) {
  TouchLoop loop;
  loop.setModel(sphere());
  const TouchId id = loop.begin({Kind::kGrab, 8}, kTop, Vector3d::Zero());
  for (int k = 1; k <= 100'000; ++k) loop.set(id, {0, 0, -2e-5 * k});
  const auto snapshot = await(loop, hasValue(id, {0, 0, -2}));
  EXPECT_LT(snapshot.find(id)->force[2], 0);
  EXPECT_GE(loop.latency().count, 1u);
  EXPECT_LT(loop.latency().count, 100'000u);
  EXPECT_GT(loop.latency().largest, 0);
  loop.set(id, {0, 0, std::numeric_limits<double>::quiet_NaN()});
  EXPECT_EQ(await(loop, stepsAfter(snapshot.step + 5)).find(id)->value, Vector3d(0, 0, -2));
}

TEST(TouchLoop, RefusesWhatItCannotHold) {
  TouchLoop loop;
  loop.setModel(sphere());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(loop.begin({Kind::kGrab, 8}, {nan, 0, 0}, kTop), TouchRefused);
  EXPECT_THROW(loop.begin({Kind::kGrab, 8}, kTop, {0, 0, nan}), TouchRefused);
  EXPECT_THROW(loop.begin({Kind::kGrab, 0}, kTop, kTop), TouchRefused);
  EXPECT_THROW(loop.begin({Kind::kPush, 8, -1}, kTop, kTop), TouchRefused);
  std::vector<TouchId> ids;
  for (int k = 0; k < TouchSnapshot::kMaxBalls; ++k)
    ids.push_back(loop.begin({Kind::kBall, 5, 0}, kTop, {0, 0, 40}));
  EXPECT_THROW(loop.begin({Kind::kBall, 5, 0}, kTop, {0, 0, 40}), TouchRefused);
  while (ids.size() < TouchSnapshot::kMaxContacts)
    ids.push_back(loop.begin({Kind::kPush, 5, 0}, kTop, {0, 0, 40}));
  EXPECT_THROW(loop.begin({Kind::kPush, 5, 0}, kTop, {0, 0, 40}), TouchRefused);
  await(loop, [](const TouchSnapshot& snapshot) {
    return snapshot.contactCount == TouchSnapshot::kMaxContacts;
  });
  for (const TouchId id : ids) loop.end(id);
  for (const TouchId id : ids) loop.end(id);  // nothing happens
  await(loop, [](const TouchSnapshot& snapshot) { return snapshot.contactCount == 0; });
  const TouchId again = loop.begin({Kind::kBall, 5, 0}, kTop, {0, 0, 29});
  loop.set(ids.front(), kSide);  // the same place in the loop, another contact
  EXPECT_EQ(await(loop, hasForce(again)).find(again)->value, Vector3d(0, 0, 29));
}

TEST(TouchLoop, PinsStay) {
  TouchLoop loop;
  loop.setModel(sphere());
  const TouchId pin = loop.begin({Kind::kGrab, 8}, kSide, {-1, 0, 0});
  const Vector3d alone = await(loop, hasForce(pin)).find(pin)->force;
  const TouchId other = loop.begin({Kind::kGrab, 8}, kTop, {0, 0, -2});
  EXPECT_GT((await(loop, hasForce(other)).find(pin)->force - alone).norm(), 1e-6);
  loop.end(other);
  const auto after = await(loop, [&](const TouchSnapshot& s) { return s.contactCount == 1; });
  EXPECT_LE((after.find(pin)->force - alone).norm(), 1e-9 * alone.norm());
}

TEST(TouchLoop, AnEqualModelChangesNothing) {
  TouchLoop loop;
  await(loop, isComplete(loop.setModel(sphere())));
  const TouchId grab = loop.begin({Kind::kGrab, 8}, kSide, {-1, 0.2, 0});
  const TouchId push = loop.begin({Kind::kPush, 8, 0.3}, kTop, {0, 0, 23});
  await(loop, hasForce(push));
  const Vector3d last(3, 0, 22.6);
  for (int k = 0; k <= 100; ++k) {  // into friction
    loop.set(push, Vector3d(0, 0, 23) + 0.01 * k * (last - Vector3d(0, 0, 23)));
    std::this_thread::sleep_for(200us);
  }
  loop.set(push, last);
  const auto settled = await(loop, hasValue(push, last));
  const auto before = await(loop, stepsAfter(settled.step + 200));
  const auto number = loop.setModel(build(test::clampedSphere(6)));
  const auto after =
      await(loop, [&](const TouchSnapshot& snapshot) { return snapshot.model == number; });
  for (const TouchId id : {grab, push})
    EXPECT_LE((after.find(id)->force - before.find(id)->force).norm(),
              1e-9 * before.find(id)->force.norm());
}

TEST(TouchLoop, AnEditedModelChangesTheForceByTheChangeOfTheModel) {
  const auto edited = largerSphere(1.01);
  TouchLoop loop;
  await(loop, isComplete(loop.setModel(sphere())));
  const TouchId id = loop.begin({Kind::kGrab, 8}, kTop, {0, 0.5, -2});
  const Vector3d before = await(loop, hasForce(id)).find(id)->force;
  const auto number = loop.setModel(edited);
  Vector3d after = before;
  TouchSnapshot snapshot;
  do {  // every force belongs to one of the two models
    loop.read(snapshot);
    const Vector3d force = snapshot.find(id)->force;
    if (snapshot.model == number)
      after = force;
    else
      EXPECT_EQ(force, before);
  } while (snapshot.model != number);
  const Vector3d at = snapshot.find(id)->point.position;
  EXPECT_LE((at - 1.01 * kTop).norm(), 0.5);
  const modeling::Touch touch{"exact", at, modeling::TouchKind::kGrab, {0, 0.5, -2}, 8.0};
  const TouchState exact = playTouches(*edited, std::span(&touch, 1));
  EXPECT_LE((after - exact.contacts[0].force).norm(), 1e-5 * after.norm());
  EXPECT_GT((after - before).norm(), 1e-4 * after.norm());
  EXPECT_LT((after - before).norm(), 0.05 * after.norm());
}

TEST(TouchLoop, EqualOperatorsShareTheirColumns) {
  TouchLoop loop;
  const auto first = loop.setModel(sphere());
  await(loop, isComplete(first));
  const auto columns = loop.model(first)->columns();
  modeling::Project project = test::clampedSphere(6);
  project.supports[0].displacement = {0, 0, 0.1};  // a right-hand side
  const auto other = loop.setModel(build(project));
  const auto snapshot = await(loop, [&](const TouchSnapshot& s) { return s.model == other; });
  EXPECT_EQ(snapshot.columnsReady, 1);
  EXPECT_EQ(loop.model(other)->columns(), columns);
  loop.setModel(nullptr);
  await(loop, [&](const TouchSnapshot& s) { return s.model == 0; });
  const auto again = loop.setModel(sphere());
  EXPECT_EQ(await(loop, [&](const TouchSnapshot& s) { return s.model == again; }).columnsReady, 1);
}

TEST(TouchLoop, ContactsThatEndWithoutAModelMakeRoomForOthers) {
  TouchLoop loop;
  const auto end = std::chrono::steady_clock::now() + 60s;
  int begun = 0;
  while (begun < 200 && std::chrono::steady_clock::now() < end) try {
      loop.end(loop.begin({Kind::kBall, 5}, kTop, {0, 0, 31}));
      ++begun;
    } catch (const TouchRefused&) {  // those that were ended are still being taken away
      std::this_thread::sleep_for(1ms);
    }
  EXPECT_EQ(begun, 200);
}

TEST(TouchLoop, WithoutAModelTouchesEnd) {
  TouchLoop loop;
  loop.setModel(sphere());
  const TouchId id = loop.begin({Kind::kBall, 8, 0}, kTop, {0, 0, 32});
  await(loop, hasForce(id));
  loop.setModel(nullptr);
  const auto none = await(loop, [](const TouchSnapshot& snapshot) { return snapshot.model == 0; });
  EXPECT_EQ(none.contactCount, 0);
  EXPECT_EQ(none.rate, 0);
  loop.set(id, kTop);
  loop.end(id);
  loop.setModel(sphere());
  const TouchId next = loop.begin({Kind::kBall, 8, 0}, kTop, {0, 0, 32});
  const auto snapshot = await(loop, hasForce(next));
  EXPECT_EQ(snapshot.contactCount, 1);
}

TEST(TouchLoop, ContactsEndWithoutAModelThoughAnotherFollowsAtOnce) {
  const std::shared_ptr<const TouchModel> models[] = {sphere(), largerSphere(1.01)};
  TouchLoop loop;
  auto number = loop.setModel(sphere());
  for (int round = 0; round < 20; ++round) {
    const TouchId old = loop.begin({Kind::kGrab, 8}, kTop, {0, 0, -1});
    // Every other time what ends has been touched; otherwise it may not even have begun.
    if (round % 2 == 0) await(loop, hasForce(old));
    loop.setModel(nullptr);
    if (round % 3 == 0) loop.setModel(models[0]);
    number = loop.setModel(models[round % 2]);
    const TouchId next = loop.begin({Kind::kGrab, 8}, kSide, Vector3d::Zero());
    loop.set(next, {-1, 0, 0});
    const auto snapshot = await(loop, [&](const TouchSnapshot& at) {
      return at.model == number && hasForce(next)(at) && at.find(next)->value == Vector3d(-1, 0, 0);
    });
    EXPECT_EQ(snapshot.find(old), nullptr) << round;
    EXPECT_EQ(snapshot.contactCount, 1) << round;
    loop.end(old);
    loop.end(next);
    await(loop, [](const TouchSnapshot& at) { return at.contactCount == 0; });
  }
}

TEST(TouchLoop, OldModelsAreReleasedElsewhere) {
  TouchLoop loop;
  std::weak_ptr<const TouchModel> old;
  {
    const auto model = build(test::clampedSphere(8));
    old = model;
    const auto number = loop.setModel(model);
    const TouchId id = loop.begin({Kind::kGrab, 8}, kTop, {0, 0, -1});
    await(loop, hasForce(id));
    EXPECT_NE(loop.model(number), nullptr);
  }
  const auto number = loop.setModel(sphere());
  await(loop, [&](const TouchSnapshot& snapshot) { return snapshot.model == number; });
  for (int k = 0; k < 60'000 && !old.expired(); ++k) std::this_thread::sleep_for(1ms);
  EXPECT_TRUE(old.expired());
  EXPECT_EQ(loop.model(number - 1), nullptr);
}

TEST(TouchLoop, SaysWhenThereIsNoMemoryForColumns) {
  TouchLoop::Options options;
  options.columnsLimit = 1000;
  TouchLoop loop(options);
  loop.setModel(sphere());
  const TouchId id = loop.begin({Kind::kGrab, 8}, kTop, {0, 0, -2});
  const auto end = std::chrono::steady_clock::now() + 60s;
  while (loop.status().error.empty() && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(1ms);
  EXPECT_NE(loop.status().error.find("edge length"), std::string::npos);
  TouchSnapshot snapshot;
  loop.read(snapshot);
  EXPECT_EQ(snapshot.find(id)->status, Status::kWaiting);
  EXPECT_EQ(snapshot.find(id)->force.norm(), 0);
}

TEST(TouchLoop, AllocatesNothingWhileContactsMove) {
  TouchLoop loop;
  await(loop, isComplete(loop.setModel(sphere())));
  const TouchId grab = loop.begin({Kind::kGrab, 8}, kSide, {-1, 0.2, 0});
  const TouchId push = loop.begin({Kind::kPush, 8, 0.3}, kTop, {0, 0, 23});
  const TouchId ball = loop.begin({Kind::kBall, 10, 0.2}, {0, 25, 0}, {0, 34, 0});
  const auto move = [&] {  // there and back
    for (int k = 0; k <= 400; ++k) {
      const double t = std::sin(std::numbers::pi * k / 200);
      loop.set(grab, {-1 + 0.3 * t, 0.2, 0.5 * t});
      loop.set(push, 23 * Vector3d(std::sin(0.3 * t), 0, std::cos(0.3 * t)));
      const Vector3d last = (34 - t) * Vector3d(std::sin(0.2 * t), std::cos(0.2 * t), 0);
      loop.set(ball, last);
      await(loop, hasValue(ball, last));
    }
  };
  move();
  move();
  const int thread = test::threadNamed(TouchLoop::kThreadName);
  ASSERT_NE(thread, 0);
  test::watchAllocations(thread);
  move();
  EXPECT_EQ(test::allocations(), 0);
  // The counter works: a new contact allocates.
  const TouchId last = loop.begin({Kind::kBall, 10, 0.2}, -kSide, {-34, 0, 0});
  await(loop, hasForce(last));
  EXPECT_GT(test::allocations(), 0);
  test::watchAllocations(0);
}

TEST(TouchLoop, SurvivesEverythingAtOnce) {
  const std::shared_ptr<const TouchModel> models[] = {sphere(), largerSphere(1.02), nullptr};
  for (const bool answersPlaces : {false, true}) {
    TouchLoop::Options options;
    if (answersPlaces) options.answersPlacesFrom = 0;
    TouchLoop loop(options);
    loop.setModel(sphere());
    std::vector<std::jthread> hands;
    for (int hand = 0; hand < 3; ++hand)
      hands.emplace_back([&, hand] {
        const Kind kinds[] = {Kind::kGrab, Kind::kPush, Kind::kBall};
        const Vector3d none = Vector3d::Zero();
        for (int round = 0; round < 15; ++round) {
          const Vector3d at = 25 * Vector3d(std::cos(round + hand), std::sin(round + hand), 0);
          TouchId id = 0;
          while (id == 0) try {
              id = loop.begin({kinds[hand], 8, 0.2}, at, kinds[hand] == Kind::kGrab ? none : at);
            } catch (const TouchRefused&) {  // those that were ended are still being taken away
              std::this_thread::sleep_for(1ms);
            }
          for (int k = 0; k < 20; ++k) {
            loop.set(id, (kinds[hand] == Kind::kGrab ? 0.0 : 1.0) * at - 0.002 * k * at);
            std::this_thread::sleep_for(300us);
          }
          if (round % 5 != 0) loop.end(id);
        }
      });
    for (int k = 0; k < 9; ++k) {
      loop.setModel(models[k % 3]);
      loop.expect(kTop);
      loop.startRecording();
      std::this_thread::sleep_for(10ms);
      if (k % 2 == 0) loop.stopRecording();
    }
    loop.setModel(sphere());
    hands.clear();
    const TouchId id = loop.begin({Kind::kGrab, 8}, kTop, {0, 0, -2});
    const auto last = await(loop, [&](const TouchSnapshot& s) { return s.find(id) != nullptr; });
    await(loop, stepsAfter(last.step + 3));
  }
  waitUntilDestroyed();
}

}  // namespace
}  // namespace palpa::app

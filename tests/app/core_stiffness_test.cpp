#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <thread>
#include <vector>

#include "app/core/live/stiffness_worker.h"
#include "app/core/model/build_touch_model.h"
#include "app/core/results/drawn_body.h"
#include "app/core/results/stiffness_colours.h"
#include "app/core/results/touch.h"
#include "app/core/system/priority.h"
#include "core_projects.h"

namespace palpa::app {
namespace {

using namespace std::chrono_literals;
using Eigen::Vector3d;

const std::shared_ptr<const TouchModel>& sphere() {
  static const auto shared = buildTouchModel(test::clampedSphere(6), {}, {});
  return shared;
}

constexpr double kRadius = 8;

const std::vector<double>& sphereMap() {
  static const auto shared = stiffnessMap(sphere(), kRadius, {});
  return shared;
}

/// A pull of 1 N at the pole, as `palpa-cli touch` plays it.
TEST(Stiffness, OfAPlaceIsThatOfATouchThere) {
  modeling::Touch touch;
  touch.at = {0, 0, 25};
  touch.radius = kRadius;
  touch.kind = modeling::TouchKind::kForce;
  touch.vector = {0, 0, 1};
  const TouchState state = playTouches(*sphere(), {&touch, 1});
  const double wanted = 1 / state.contacts.front().displacement.z();

  const DrawnBody drawn(sphere());
  const std::vector<double> stiffnesses = drawn.stiffnesses(sphereMap());
  std::size_t top = 0;
  for (std::size_t i = 0; i < drawn.mesh().positions.size(); ++i)
    if (drawn.mesh().positions[i].z() > drawn.mesh().positions[top].z()) top = i;
  EXPECT_NEAR(stiffnesses[top], wanted, 2e-3 * wanted);
  // The sphere is turned into itself about z, and tilts on its small base when pushed at its side.
  std::vector<double> equator;
  for (std::size_t i = 0; i < stiffnesses.size(); ++i)
    if (std::abs(drawn.mesh().positions[i].z()) < 0.5) equator.push_back(stiffnesses[i]);
  ASSERT_GT(equator.size(), 8u);
  const auto [low, high] = std::minmax_element(equator.begin(), equator.end());
  EXPECT_LT(*high, 1.12 * *low);
  EXPECT_LT(*high, 0.6 * stiffnesses[top]);
}

TEST(Stiffness, ColoursReachFromTheSoftestToNearlyAll) {
  const auto& setup = sphere()->setup();
  const auto colours = StiffnessColours::of(setup.mesh(), setup.meshSlots(), sphereMap());
  EXPECT_TRUE(colours.isCapped);  // it is held
  double softest = 1e9;
  for (const double compliance : sphereMap())
    if (compliance > 0) softest = std::min(softest, 1 / compliance);
  EXPECT_LE(colours.range[0], softest);
  EXPECT_GT(colours.range[0], 0.6 * softest);
  std::vector<double> values = DrawnBody(sphere()).stiffnesses(sphereMap());
  EXPECT_TRUE(std::any_of(values.begin(), values.end(), [](double v) { return std::isinf(v); }));
  const auto above = std::count_if(values.begin(), values.end(),
                                   [&](double value) { return value > colours.range[1]; });
  // Those near the support: a twentieth of the free surface, and the held tenth.
  EXPECT_LT(above, 0.25 * static_cast<double>(values.size()));
  values.push_back(std::numeric_limits<double>::quiet_NaN());
  colours.cap(values);
  EXPECT_TRUE(std::isnan(values.back()));
  values.pop_back();
  EXPECT_EQ(*std::max_element(values.begin(), values.end()), colours.range[1]);
}

TEST(Stiffness, NothingKnownHasARangeAllTheSame) {
  const auto& setup = sphere()->setup();
  const std::vector<double> unknown(static_cast<std::size_t>(setup.meshSlots().count()),
                                    std::numeric_limits<double>::quiet_NaN());
  const auto colours = StiffnessColours::of(setup.mesh(), setup.meshSlots(), unknown);
  EXPECT_GT(colours.range[0], 0);
  EXPECT_GT(colours.range[1], colours.range[0]);
}

TEST(Stiffness, ComesInTheBackgroundWhileColumnsDo) {
  const auto body = std::make_shared<const TouchableModel>(sphere());
  std::mutex mutex;
  std::vector<StiffnessWorker::Result> results;
  StiffnessWorker worker([&](StiffnessWorker::Result result) {
    const std::lock_guard lock(mutex);
    results.push_back(std::move(result));
  });
  const auto await = [&](double ready) {
    const auto end = std::chrono::steady_clock::now() + 60s;
    while (std::chrono::steady_clock::now() < end) {
      {
        const std::lock_guard lock(mutex);
        if (!results.empty() && results.back().ready >= ready) return results.back();
      }
      std::this_thread::sleep_for(5ms);
    }
    ADD_FAILURE() << "waited for a minute";
    return StiffnessWorker::Result{};
  };
  worker.start(body, kRadius);
  EXPECT_EQ(await(0).ready, 0);  // it says at once that there is nothing yet
  std::vector<int> near = body->columns()->nodesNear(body->surface().places(), {0, 0, 25});
  near.resize(near.size() / 2);
  body->columns()->compute(near, {});
  EXPECT_LT(await(0.1).ready, 0.6);
  std::vector<int> all(static_cast<std::size_t>(body->surface().mesh().nodeCount()));
  std::iota(all.begin(), all.end(), 0);
  body->columns()->compute(all, {});
  const auto last = await(1);
  EXPECT_EQ(last.model, body);
  ASSERT_EQ(last.compliances.size(), sphereMap().size());
  for (std::size_t i = 0; i < last.compliances.size(); ++i)
    EXPECT_NEAR(last.compliances[i], sphereMap()[i], 1e-5 * sphereMap()[i]);
  worker.stop();
  const std::lock_guard lock(mutex);
  EXPECT_EQ(results.back().ready, 1);
}

/// Whether the system lets it go first or not: while it works too much it does not.
TEST(RealtimeScope, DoesNotGoFirstWhileItIsOverloaded) {
  std::jthread thread([] {
    using Clock = RealtimeScope::Clock;
    RealtimeScope scope;
    const bool mayBeFirst = scope.isRealtime();
    const auto begin = Clock::now();
    const auto at = [&](int ms) { return begin + std::chrono::milliseconds(ms); };
    for (int ms = 0; ms < 150; ++ms) scope.worked(at(ms), at(ms) + 100us);
    EXPECT_EQ(scope.isRealtime(), mayBeFirst);
    for (int ms = 150; ms < 400; ++ms) scope.worked(at(ms), at(ms) + 900us);
    EXPECT_FALSE(scope.isRealtime());
    for (int ms = 400; ms < 650; ++ms) scope.worked(at(ms), at(ms) + 100us);
    EXPECT_EQ(scope.isRealtime(), mayBeFirst);
  });
}

}  // namespace
}  // namespace palpa::app

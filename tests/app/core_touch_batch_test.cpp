// Many touches one at a time, the compliance between places, and sensors on the surface.
#include "app/core/results/touch_batch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "app/core/model/build_touch_model.h"
#include "app/core/results/mask_compliance.h"
#include "app/core/results/surface_sensor.h"
#include "app/core/results/touch.h"
#include "bem/base/error.h"
#include "core_projects.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;
using modeling::Touch;
using modeling::TouchKind;

constexpr double kRadius = 25;

std::shared_ptr<const TouchableModel> sphere() {
  static const auto model =
      std::make_shared<const TouchableModel>(buildTouchModel(test::clampedSphere(6), {}, {}));
  return model;
}

/// Touches of all kinds along the equator, into the sphere.
std::vector<Touch> touchesAround(int count, TouchKind kind) {
  std::vector<Touch> touches;
  for (int k = 0; k < count; ++k) {
    const double angle = 0.3 + 2.1 * k;
    const Vector3d normal(std::cos(angle), std::sin(angle), 0);
    touches.push_back({"touch", kRadius * normal, kind, -normal, 6.0,
                       modeling::infoOf(kind).presses ? 0.3 : 0.0});
  }
  return touches;
}

class TouchBatchOf : public testing::TestWithParam<TouchKind> {};

TEST_P(TouchBatchOf, EqualsSingleTouches) {
  const std::vector<Touch> touches = touchesAround(3, GetParam());
  const TouchBatch batch = touchOneByOne(*sphere(), touches);
  ASSERT_EQ(batch.size(), touches.size());
  for (std::size_t k = 0; k < touches.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const auto contact = playTouches(sphere()->model(), {&touches[k], 1}).contacts.front();
    const double size = contact.force.norm();
    EXPECT_LT((batch.forces.col(column) - contact.force).norm(), 1e-4 * size);
    EXPECT_LT((batch.displacements.col(column) - contact.displacement).norm(), 1e-4);
    EXPECT_LT((batch.deflections.col(column) - contact.deflection).norm(), 1e-4);
    EXPECT_NEAR(batch.stiffness[column], contact.stiffness, 1e-4 * contact.stiffness);
    EXPECT_LT((batch.places.col(column) - contact.at).norm(), 1e-9);
    EXPECT_LT((batch.normals.col(column) - contact.normal).norm(), 1e-9);
    EXPECT_EQ(batch.statuses[k], contact.status);
  }
}

INSTANTIATE_TEST_SUITE_P(AllKinds, TouchBatchOf,
                         testing::Values(TouchKind::kGrab, TouchKind::kForce, TouchKind::kPush,
                                         TouchKind::kBall, TouchKind::kPin),
                         [](const auto& tested) { return modeling::infoOf(tested.param).name; });

TEST(TouchBatch, DoesNotDependOnThreadsOrOtherTouches) {
  const std::vector<Touch> touches = touchesAround(100, TouchKind::kGrab);
  const TouchBatch whole = touchOneByOne(*sphere(), touches);
  const TouchBatch single = touchOneByOne(*sphere(), touches, 0, Job{{}, {}, 1});
  EXPECT_EQ(whole.forces, single.forces);
  const TouchBatch alone = touchOneByOne(*sphere(), {&touches[41], 1});
  EXPECT_EQ(alone.forces.col(0), whole.forces.col(41));
}

TEST(TouchBatch, NamesTheTouchThatIsImpossible) {
  std::vector<Touch> touches = touchesAround(4, TouchKind::kGrab);
  touches[2].at = {0, 0, -kRadius};
  try {
    touchOneByOne(*sphere(), touches);
    FAIL() << "a touch on a support must be refused";
  } catch (const bem::SolverError& error) {
    EXPECT_EQ(error.kind(), bem::SolverError::Kind::kBadCondition);
    EXPECT_EQ(std::string(error.what()).rfind("touch 2", 0), 0) << error.what();
  }
  touches[2].at = {0, 0, 2 * kRadius};
  EXPECT_THROW(touchOneByOne(*sphere(), touches), bem::SolverError);
  EXPECT_EQ(touchOneByOne(*sphere(), {}).size(), 0);
}

TEST(TouchBatch, CanBeCancelled) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(
      touchOneByOne(*sphere(), touchesAround(9, TouchKind::kGrab), 0, Job{stop.get_token(), {}, 0}),
      Cancelled);
}

TEST(MaskCompliance, AnswersTouchesAtOnce) {
  std::vector<Touch> touches = touchesAround(4, TouchKind::kGrab);
  std::vector<Vector3d> places;
  for (Touch& touch : touches) {
    touch.vector += Vector3d(0.2, -0.1, 0.3);
    places.push_back(touch.at);
  }
  const Eigen::MatrixXd compliance = maskCompliance(*sphere(), places, 6);
  ASSERT_EQ(compliance.rows(), 12);
  EXPECT_EQ(compliance, compliance.transpose());
  Eigen::VectorXd displacements(12);
  for (std::size_t k = 0; k < touches.size(); ++k)
    displacements.segment<3>(3 * static_cast<Eigen::Index>(k)) = touches[k].vector;
  const Eigen::VectorXd forces = compliance.ldlt().solve(displacements);
  const TouchState state = playTouches(sphere()->model(), touches);
  for (std::size_t k = 0; k < touches.size(); ++k)
    EXPECT_LT(
        (forces.segment<3>(3 * static_cast<Eigen::Index>(k)) - state.contacts[k].force).norm(),
        1e-9);
  EXPECT_THROW(maskCompliance(*sphere(), std::vector<Vector3d>{{0, 0, 90}}, 6), bem::SolverError);
}

TEST(SurfaceSensor, ReadsBatchesAsStates) {
  const std::vector<Touch> touches = touchesAround(3, TouchKind::kGrab);
  std::vector<Vector3d> taxels{{0, 0, kRadius}, {0, 0, -kRadius}};
  for (const Touch& touch : touches) taxels.push_back(touch.at);
  const SurfaceSensor sensor(sphere(), taxels);
  const TouchBatch batch = touchOneByOne(*sphere(), touches);
  const Eigen::MatrixXd moved = sensor.displacements(batch), pressures = sensor.pressures(batch);
  ASSERT_EQ(moved.rows(), 15);
  ASSERT_EQ(pressures.rows(), 5);
  for (std::size_t k = 0; k < touches.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const TouchState state = playTouches(sphere()->model(), {&touches[k], 1});
    EXPECT_LT((moved.col(column) - sensor.displacements(state.field).reshaped()).norm(), 1e-4);
    EXPECT_LT((pressures.col(column) - sensor.pressures(state.field)).norm(),
              1e-4 * pressures.col(column).norm());
    // Pressed below the touch only; the support does not move.
    EXPECT_GT(pressures(2 + column, column), 0);
    EXPECT_NEAR(pressures(0, column), 0, 1e-12);
    EXPECT_EQ(moved.col(column).segment<3>(3), Vector3d::Zero());
  }
}

}  // namespace
}  // namespace palpa::app

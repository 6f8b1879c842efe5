// Gradients of a stiffness while a body is touched: the background worker, the limits below which a
// touch stays the same, and the values on the surface.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "app/core/design/gradient_worker.h"
#include "app/core/design/live_rule.h"
#include "app/core/design/shape_measures.h"
#include "app/core/live/touchable_model.h"
#include "app/core/model/build_touch_model.h"
#include "app/core/results/touch.h"
#include "modeling/project/project_file.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;

std::shared_ptr<const modeling::Project> example(const std::string& name) {
  return std::make_shared<const modeling::Project>(
      modeling::readProject(std::string(PALPA_PROJECTS) + "/" + name + ".json"));
}

StiffnessRule firstRule(const TouchModel& model, const modeling::Project& project) {
  return stiffnessRuleOf(playTouches(model, project.touches).contacts.front());
}

double largestOf(const Eigen::Matrix3Xd& gradient) {
  return gradient.colwise().norm().maxCoeff();
}

/// Results of a worker, for the thread of the test.
class Mail {
 public:
  std::function<void(GradientWorker::Result)> receiver() {
    return [this](GradientWorker::Result result) {
      const std::lock_guard lock(mutex_);
      results_.push_back(std::move(result));
      arrived_.notify_all();
    };
  }
  /// Waits for so many results.
  std::vector<GradientWorker::Result> wait(std::size_t count) {
    std::unique_lock lock(mutex_);
    arrived_.wait(lock, [&] { return results_.size() >= count; });
    return results_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::vector<GradientWorker::Result> results_;
};

class LiveGradient : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    project_ = example("box");
    model_ = buildTouchModel(*project_, {}, {});
  }
  static void TearDownTestSuite() {
    project_.reset();
    model_.reset();
  }
  static inline std::shared_ptr<const modeling::Project> project_;
  static inline std::shared_ptr<const TouchModel> model_;
};

TEST_F(LiveGradient, TheStiffnessComesFirstThenTheGradient) {
  const StiffnessRule rule = firstRule(*model_, *project_);
  const StiffnessGradient expected = StiffnessGradients(*project_, *model_).of(rule);
  const auto drawn = std::make_shared<const DrawnBody>(model_);
  Mail mail;
  GradientWorker worker(mail.receiver());
  const std::uint64_t number = worker.start({model_, project_, rule, nullptr, drawn});
  const auto results = mail.wait(2);
  EXPECT_EQ(results[0].number, number);
  EXPECT_DOUBLE_EQ(results[0].stiffness, expected.stiffness);
  EXPECT_EQ(results[0].gradient.cols(), 0);
  EXPECT_EQ(results[1].number, number);
  EXPECT_TRUE(results[1].problem.empty());
  EXPECT_LT((results[1].gradient - expected.gradient).norm(), 1e-9 * expected.gradient.norm());
  EXPECT_EQ(results[1].surface.size(), drawn->mesh().positions.size());
}

TEST_F(LiveGradient, ANewerRequestReplacesTheOneBefore) {
  StiffnessRule first = firstRule(*model_, *project_), last = first;
  first.name = "first";
  last.name = "last";
  Mail mail;
  std::uint64_t number = 0;
  {
    GradientWorker worker(mail.receiver());
    for (int i = 0; i < 20; ++i) worker.start({model_, project_, first, nullptr, nullptr});
    number = worker.start({model_, project_, last, nullptr, nullptr});
    while (mail.wait(1).back().gradient.cols() == 0 || mail.wait(1).back().number != number)
      std::this_thread::yield();
    // The destructor ends what still runs.
    worker.start({model_, project_, first, nullptr, nullptr});
  }
  int complete = 0;
  for (const auto& result : mail.wait(1)) complete += result.gradient.cols() > 0 ? 1 : 0;
  EXPECT_LE(complete, 3) << "stopped computations should have no gradient";
}

TEST_F(LiveGradient, ARefusedSupportIsAProblemWithItsName) {
  modeling::Project rolling = *project_;
  rolling.supports.front().kind = modeling::Support::Kind::kRoller;
  EXPECT_NE(gradientObstacle(rolling).find(rolling.supports.front().name), std::string::npos);
  EXPECT_TRUE(gradientObstacle(*project_).empty());
  Mail mail;
  GradientWorker worker(mail.receiver());
  worker.start({model_, std::make_shared<const modeling::Project>(rolling),
                firstRule(*model_, *project_), nullptr, nullptr});
  EXPECT_EQ(mail.wait(2)[1].problem, gradientObstacle(rolling));
}

TEST_F(LiveGradient, ATouchIsCarriedToTheEditedBody) {
  auto moved = std::make_shared<modeling::Project>(*project_);
  const auto before =
      std::make_shared<const modeling::Solid>(std::get<modeling::Solid>(project_->body));
  std::vector<Vector3d> points = before->controlPoints();
  const Vector3d shift(3, -2, 1);
  for (Vector3d& point : points) point += shift;
  moved->body = before->withControlPoints(points);
  const auto model = buildTouchModel(*moved, {}, {});
  const StiffnessRule rule = firstRule(*model_, *project_);
  Mail mail;
  GradientWorker worker(mail.receiver());
  worker.start({model, moved, rule, before, nullptr});
  const auto result = mail.wait(2)[1];
  EXPECT_LT((result.rule.masks.front().at - rule.masks.front().at - shift).norm(), 1e-6);
  const TouchableModel touchable(model_);
  EXPECT_NEAR(result.stiffness,
              contactStiffness(*model_->problem(), touchable.surface(), rule).value,
              1e-4 * result.stiffness);
}

// A grab or force is linear: how far it pulls does not matter, its place and direction do.
TEST_F(LiveGradient, ATouchStaysTheSameHoweverFarItPulls) {
  modeling::Touch touch = project_->touches.front();
  touch.kind = modeling::TouchKind::kGrab;
  const auto ruleFor = [&](const Vector3d& at, const Vector3d& displacement) {
    touch.at = at;
    touch.vector = displacement;
    return stiffnessRuleOf(playTouches(*model_, std::span(&touch, 1)).contacts.front());
  };
  const Vector3d at = touch.at, pull(0.5, 0.2, -1);
  const StiffnessRule rule = ruleFor(at, pull);
  EXPECT_TRUE(isSameTouch(rule, ruleFor(at, 7 * pull)));
  EXPECT_TRUE(isSameTouch(rule, ruleFor(at, -pull)));
  const double radius = rule.masks.front().radius;
  const auto turned = [&](double angle) {
    return Vector3d(Eigen::AngleAxisd(angle, Vector3d::UnitY()) * pull);
  };
  EXPECT_TRUE(isSameTouch(rule, ruleFor(at, turned(0.8 * kMaxTurn))));
  EXPECT_FALSE(isSameTouch(rule, ruleFor(at, turned(2 * kMaxTurn))));
  EXPECT_FALSE(isSameTouch(rule, ruleFor(at + Vector3d(0.3 * radius, 0, 0), pull)));
}

// Within these limits the shown gradient may be the former one.
TEST_F(LiveGradient, HardlyChangesWithinTheLimits) {
  const StiffnessGradients gradients(*project_, *model_);
  for (const modeling::Touch& touch : project_->touches) {
    const StiffnessRule rule =
        stiffnessRuleOf(playTouches(*model_, std::span(&touch, 1)).contacts.front());
    const Eigen::Matrix3Xd gradient = gradients.of(rule).gradient;
    StiffnessRule turned = rule, moved = rule;
    const Eigen::AngleAxisd turn(kMaxTurn, Vector3d(1, 1, 0).normalized());
    turned.deflection = turn * turned.deflection;
    for (auto& mask : turned.masks) mask.force = turn * mask.force;
    for (auto& mask : moved.masks) mask.at.x() += kMaxPlaceChange * mask.radius;
    for (const StiffnessRule* other : {&turned, &moved}) {
      const double change =
          largestOf(gradients.of(*other).gradient - gradient) / largestOf(gradient);
      RecordProperty(touch.name + (other == &turned ? " turned" : " moved"),
                     std::to_string(change));
      std::printf("%s %s: %.3f\n", touch.name.c_str(), other == &turned ? "turned" : "moved",
                  change);
      EXPECT_LT(change, 0.1) << touch.name;
    }
  }
}

// Added material changes the volume by its volume: the gradient of the volume is 1 everywhere.
TEST_F(LiveGradient, OnTheSurfaceIsPerVolume) {
  const StiffnessGradients gradients(*project_, *model_);
  const DrawnBody drawn(model_);
  const SurfaceGradient surface(gradients.surface(), drawn);
  for (const double value : surface.values(volumeOf(gradients.surface()).gradient))
    ASSERT_NEAR(value, 1000, 1e-6);  // mm³ per cm³
}

// A bar that is pulled along is stiffer with more material around it.
TEST_F(LiveGradient, ThePulledBodyIsStifferWithMaterialOnItsSides) {
  const StiffnessGradients gradients(*project_, *model_);
  const DrawnBody drawn(model_);
  const SurfaceGradient surface(gradients.surface(), drawn);
  const auto [low, high] = modeling::boundingBox(project_->body);
  const Vector3d top(0.5 * (low.x() + high.x()), 0.5 * (low.y() + high.y()), high.z());
  StiffnessRule pull{"pull", {{top, 0.2 * (high.x() - low.x())}}, Vector3d::UnitZ()};
  const std::vector<double> values = surface.values(gradients.of(pull).gradient);
  double sides = 0;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (std::abs(drawn.mesh().normals[k].z()) < 0.1) sides += values[k];
  EXPECT_GT(sides, 0);
  EXPECT_GT(surfaceGradientEnd(values), 0);
  EXPECT_EQ(surfaceGradientEnd({}), 1);
}

}  // namespace
}  // namespace palpa::app

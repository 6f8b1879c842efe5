#include "app/cli/film.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/cli/errors.h"
#include "app/cli/simulation.h"
#include "app/cli/text.h"
#include "app/core/live/touch_field.h"
#include "app/core/live/touch_replay.h"
#include "modeling/error.h"

namespace palpa::cli {
namespace {

using Eigen::Vector3d;

/// What the pictures of a film have in common.
class CommonView {
 public:
  void add(const view::SurfaceScene& scene) {
    if (scene.field) {
      const auto [low, high] =
          std::minmax_element(scene.field->values.begin(), scene.field->values.end());
      range_[0] = std::min(range_[0], scene.field->range ? (*scene.field->range)[0] : *low);
      range_[1] = std::max(range_[1], *high);
    }
    for (const Vector3d& point : scene.deformedPositions()) reach(point);
    for (const view::ProbeBall& ball : scene.balls)
      for (const Vector3d& direction : directions()) reach(ball.center + ball.radius * direction);
    double force = 0;
    for (const view::ForceArrow& arrow : scene.arrows) {
      arrows_.push_back(arrow);
      force = std::max(force, arrow.force.norm());
    }
    if (force >= fullForce_) {
      fullForce_ = force;
      camera_ = scene.camera;
    }
    if (diagonal_ == 0) diagonal_ = diagonalOf(scene);
    arrowLength_ = scene.arrowLength;
  }

  /// To be called once, after all.
  void finish() {
    for (const view::ForceArrow& arrow : arrows_) {
      if (fullForce_ == 0) break;
      const Vector3d along = arrowLength_ * diagonal_ / fullForce_ * arrow.force;
      reach(arrow.anchor == view::ForceArrow::Anchor::kTail ? Vector3d(arrow.at + along)
                                                            : Vector3d(arrow.at - along));
    }
  }

  void applyTo(view::SurfaceScene& scene) const {
    if (scene.field && range_[0] <= range_[1]) scene.field->range = range_;
    scene.fullForce = fullForce_;
    scene.camera = camera_;
    scene.room.assign(extremes_.begin(), extremes_.end());
  }

 private:
  static constexpr int kDirections = 26;

  /// Towards the faces, edges and corners of a cube.
  static const std::array<Vector3d, kDirections>& directions() {
    static const auto all = [] {
      std::array<Vector3d, kDirections> result;
      int count = 0;
      for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
          for (int z = -1; z <= 1; ++z)
            if (x != 0 || y != 0 || z != 0) result[count++] = Vector3d(x, y, z).normalized();
      return result;
    }();
    return all;
  }

  static double diagonalOf(const view::SurfaceScene& scene) {
    Vector3d low = scene.positions.front(), high = low;
    for (const Vector3d& point : scene.positions) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
    return (high - low).norm();
  }

  void reach(const Vector3d& point) {
    if (!isAny_) extremes_.fill(point);
    isAny_ = true;
    for (int k = 0; k < kDirections; ++k)
      if (directions()[k].dot(point) > directions()[k].dot(extremes_[k])) extremes_[k] = point;
  }

  std::array<double, 2> range_{std::numeric_limits<double>::infinity(),
                               -std::numeric_limits<double>::infinity()};
  std::vector<view::ForceArrow> arrows_;
  std::array<Vector3d, kDirections> extremes_;
  bool isAny_ = false;
  double fullForce_ = 0, diagonal_ = 0, arrowLength_ = 0;
  view::CameraView camera_;
};

}  // namespace

Film::Film(const modeling::Project& project, std::shared_ptr<const app::TouchModel> model,
           const app::TouchRecording& recording, const SceneOptions& options)
    : project_(project),
      body_(std::make_shared<const app::TouchableModel>(std::move(model))),
      recording_(recording),
      options_(options) {}

void Film::forEachScene(double rate, const Context& context,
                        const std::function<void(view::SurfaceScene&, int number)>& seen) const {
  app::TouchField field(body_);
  int number = 0;
  std::uint64_t step = 0;
  app::replay(body_, recording_, jobOf(context), [&](const app::TouchSnapshot& snapshot) {
    const auto due = static_cast<std::uint64_t>(std::llround(1000.0 * number / rate));
    if (step++ < due) return;
    view::SurfaceScene scene =
        makeScene(project_, body_->sharedModel(), field.describe(snapshot), options_);
    scene.captions.push_back(format("%.3f s", 1e-3 * static_cast<double>(due)));
    seen(scene, number++);
  });
}

int Film::draw(const std::filesystem::path& folder, double rate, const view::PictureOptions& size,
               const Context& context) const {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw OutputError("cannot make the folder " + folder.string() + ": " + error.message());
  CommonView common;
  int count = 0;
  forEachScene(rate, context, [&](view::SurfaceScene& scene, int) {
    common.add(scene);
    ++count;
  });
  common.finish();
  forEachScene(rate, context, [&](view::SurfaceScene& scene, int number) {
    common.applyTo(scene);
    view::renderToPng(scene, folder / format("frame_%05d.png", number), size);
    context.progress.show("draw", static_cast<double>(number + 1) / count);
  });
  context.progress.clear();
  return count;
}

app::TouchState Film::at(double seconds, const Context& context) const {
  const double wanted = std::round(1000 * seconds);
  if (!(wanted < static_cast<double>(recording_.steps)))
    throw modeling::ModelingError(
        format("the recording lasts %.3f s; there is nothing after %.6g s",
               1e-3 * static_cast<double>(recording_.steps), seconds));
  app::TouchRecording until = recording_;
  until.steps = static_cast<std::uint64_t>(wanted) + 1;
  app::TouchField field(body_);
  app::TouchSnapshot last;
  app::replay(body_, until, jobOf(context),
              [&](const app::TouchSnapshot& snapshot) { last = snapshot; });
  context.progress.clear();
  return field.describe(last);
}

}  // namespace palpa::cli

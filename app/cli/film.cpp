#include "app/cli/film.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/cli/errors.h"
#include "app/cli/text.h"
#include "app/core/live/touch_field.h"
#include "app/core/live/touch_replay.h"
#include "app/view/scene/arrows.h"
#include "modeling/error.h"

namespace palpa::cli {
namespace {

using Eigen::Vector3d;

/// Colours, arrow lengths and camera for all pictures of a film.
class CommonView {
 public:
  void add(const view::Picture& picture) {
    if (picture.field) {
      const auto [low, high] =
          std::minmax_element(picture.field->values.begin(), picture.field->values.end());
      range_[0] = std::min(range_[0], picture.field->range ? (*picture.field->range)[0] : *low);
      range_[1] = std::max(range_[1], *high);
    }
    for (const Vector3d& point : picture.positions) reach(point);
    for (const view::Ball& ball : picture.balls)
      for (const Vector3d& direction : directions()) reach(ball.center + ball.radius * direction);
    double force = 0;
    for (const view::ForceArrow& arrow : picture.arrows.arrows) {
      arrows_.arrows.push_back(arrow);
      if (arrow.kind != view::ForceArrow::Kind::kMoment)
        force = std::max(force, arrow.force.norm());
    }
    if (force >= fullForce_) {
      fullForce_ = force;
      camera_ = picture.camera;
    }
    if (fullLength_ == 0) fullLength_ = view::kFullArrowLength * diagonalOf(picture.body);
  }

  /// To be called once, after all.
  void finish() {
    if (fullForce_ > 0) arrows_.fullForce = fullForce_;
    for (const view::PlacedArrow& placed : view::placeArrows(arrows_, fullLength_))
      reach(placed.freeEnd());
  }

  void applyTo(view::Picture& picture) const {
    if (picture.field && range_[0] <= range_[1]) picture.field->range = range_;
    picture.arrows.fullForce = arrows_.fullForce;
    picture.arrows.minShare = 0;
    picture.camera = camera_;
    picture.room.assign(extremes_.begin(), extremes_.end());
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

  static double diagonalOf(const view::ViewportBody& body) {
    Vector3d low = body.positions.front(), high = low;
    for (const Vector3d& point : body.positions) {
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
  view::LiveArrows arrows_;  // of all pictures
  std::array<Vector3d, kDirections> extremes_;
  bool isAny_ = false;
  double fullForce_ = 0;   // N
  double fullLength_ = 0;  // mm
  view::CameraView camera_;
};

}  // namespace

Film::Film(const modeling::Project& project, std::shared_ptr<const app::TouchModel> model,
           const app::TouchRecording& recording, const report::PictureOptions& options)
    : project_(project),
      body_(std::make_shared<const app::TouchableModel>(std::move(model))),
      recording_(recording),
      options_(options) {}

void Film::forEachPicture(double rate, const Context& context,
                          const std::function<void(view::Picture&, int number)>& seen) const {
  app::TouchField field(body_);
  int number = 0;
  std::uint64_t step = 0;
  app::replay(body_, recording_, context.job(), [&](const app::TouchSnapshot& snapshot) {
    const auto due = static_cast<std::uint64_t>(std::llround(1000.0 * number / rate));
    if (step++ < due) return;
    view::Picture picture =
        report::makePicture(project_, body_->sharedModel(), field.describe(snapshot), options_);
    picture.caption.lines.push_back(format("%.3f s", 1e-3 * static_cast<double>(due)));
    seen(picture, number++);
  });
}

int Film::draw(const std::filesystem::path& folder, double rate, const view::PictureSize& size,
               const Context& context) const {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw OutputError("cannot make the folder " + folder.string() + ": " + error.message());
  CommonView common;
  int count = 0;
  forEachPicture(rate, context, [&](view::Picture& picture, int) {
    common.add(picture);
    ++count;
  });
  common.finish();
  forEachPicture(rate, context, [&](view::Picture& picture, int number) {
    common.applyTo(picture);
    view::writePicture(picture, size, folder / format("frame_%05d.png", number));
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
  app::replay(body_, until, context.job(),
              [&](const app::TouchSnapshot& snapshot) { last = snapshot; });
  context.progress.clear();
  return field.describe(last);
}

}  // namespace palpa::cli

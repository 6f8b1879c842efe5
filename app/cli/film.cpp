#include "app/cli/film.h"

#include <cmath>

#include "app/cli/errors.h"
#include "app/cli/text.h"
#include "app/core/live/touch_field.h"
#include "app/core/live/touch_replay.h"
#include "app/report/common_view.h"
#include "modeling/error.h"

namespace palpa::cli {

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
  report::CommonView common;
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

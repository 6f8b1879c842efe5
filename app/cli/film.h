#pragma once

#include <filesystem>
#include <memory>

#include "app/cli/command.h"
#include "app/core/live/touch_command.h"
#include "app/core/live/touchable_model.h"
#include "app/report/state_picture.h"

namespace palpa::cli {

/// Pictures of a replay.
class Film {
 public:
  Film(const modeling::Project& project, std::shared_ptr<const app::TouchModel> model,
       const app::TouchRecording& recording, const report::PictureOptions& options);

  /// Draws frame_00000.png, … into a folder, which is created: colours, arrow lengths and camera
  /// are the same in all of them. Replays twice, first to find the extremes. `rate`: pictures per
  /// second, 1 … 1000. Returns the number of pictures. Throws OutputError, ViewError, Cancelled.
  int draw(const std::filesystem::path& folder, double rate, const view::PictureSize& size,
           const Context& context) const;

  /// The state after `seconds`. Throws ModelingError when the recording is shorter.
  app::TouchState at(double seconds, const Context& context) const;

 private:
  /// Calls `seen` with the pictures of the film.
  void forEachPicture(double rate, const Context& context,
                      const std::function<void(view::Picture&, int number)>& seen) const;

  const modeling::Project& project_;
  std::shared_ptr<const app::TouchableModel> body_;
  const app::TouchRecording& recording_;
  report::PictureOptions options_;
};

}  // namespace palpa::cli

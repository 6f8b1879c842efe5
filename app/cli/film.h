#pragma once

#include <filesystem>
#include <memory>

#include "app/cli/command.h"
#include "app/cli/state_scene.h"
#include "app/core/live/touch_command.h"
#include "app/core/live/touchable_model.h"
#include "app/view/picture.h"

namespace palpa::cli {

/// Pictures of a replay.
class Film {
 public:
  Film(const modeling::Project& project, std::shared_ptr<const app::TouchModel> model,
       const app::TouchRecording& recording, const SceneOptions& options);

  /// Draws frame_00000.png, … into a folder, which is made: colours, arrows and camera mean the
  /// same in all of them. Replays twice, first to find out what there is to be seen. `rate`:
  /// pictures per second, 1 … 1000. Returns how many. Throws OutputError, ViewError, Cancelled.
  int draw(const std::filesystem::path& folder, double rate, const view::PictureOptions& size,
           const Context& context) const;

  /// The state after `seconds`. Throws ModelingError when the recording is shorter.
  app::TouchState at(double seconds, const Context& context) const;

 private:
  /// Calls `seen` with the scenes of the film.
  void forEachScene(double rate, const Context& context,
                    const std::function<void(view::SurfaceScene&, int number)>& seen) const;

  const modeling::Project& project_;
  std::shared_ptr<const app::TouchableModel> body_;
  const app::TouchRecording& recording_;
  SceneOptions options_;
};

}  // namespace palpa::cli

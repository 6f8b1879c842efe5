#pragma once

#include <filesystem>

#include "app/view/scene.h"

namespace palpa::view {

/// Size of a picture in pixels. Text and margins grow with the picture.
struct PictureOptions {
  int width = 1200;  ///< 160 … 8192
  int height = 900;  ///< 120 … 8192
};

/// Draws `scene` without a window and writes it as a PNG file, replacing an existing one.
///
/// Needs an X display (a virtual one will do); the result does not depend on the screen's size.
/// Throws std::invalid_argument for a malformed scene or size, NoDisplayError without a display,
/// ViewError when the file cannot be written.
void renderToPng(const SurfaceScene& scene, const std::filesystem::path& path,
                 const PictureOptions& options = {});

}  // namespace palpa::view

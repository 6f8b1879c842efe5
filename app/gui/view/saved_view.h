#pragma once

#include <optional>
#include <string>

#include "app/view/viewport/viewport.h"

namespace palpa::gui {

/// Camera and visible items, stored in Project::view.
struct SavedView {
  view::CameraView camera;
  view::Shading shading = view::Shading::kShadedWithEdges;
  bool showsNet = true, showsGrid = true, showsAxes = true, showsCube = true;
  bool showsConditions = true, showsTouches = true, showsWarnings = true;
  bool showsDimensions = true;
};

/// The view as a JSON object. Entries of `present` with other keys stay.
std::string viewText(const SavedView& view, const std::string& present = {});

/// Nothing for text that is empty, damaged or out of range, so that such a file opens with the
/// default view. Missing entries take their defaults; unknown ones are ignored.
std::optional<SavedView> viewFromText(const std::string& text);

}  // namespace palpa::gui

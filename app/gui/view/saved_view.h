#pragma once

#include <optional>
#include <string>

#include "app/view/viewport.h"

namespace palpa::gui {

/// How the window shows a project: what is kept in Project::view.
struct SavedView {
  view::CameraView camera;
  view::Shading shading = view::Shading::kShadedWithEdges;
  bool showsNet = true, showsGrid = true, showsAxes = true;
  bool showsConditions = true, showsTouches = true, showsWarnings = true;
};

/// As a JSON object.
std::string viewText(const SavedView& view);

/// Nothing for text that is empty, damaged or out of range, so that a strange file opens with the
/// usual view. Entries that are missing take their defaults; unknown ones are passed over.
std::optional<SavedView> viewFromText(const std::string& text);

}  // namespace palpa::gui

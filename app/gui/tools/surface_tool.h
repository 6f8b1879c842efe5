#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/gui/document/editor.h"
#include "app/gui/view/scene_controller.h"
#include "app/gui/base/settings.h"
#include "app/gui/view/tool.h"
#include "app/gui/view/viewport_widget.h"

namespace palpa::gui {

/// What the tools that put things onto the surface share.
class SurfaceTool : public Tool {
 public:
  SurfaceTool(Settings& settings, Editor& editor, SceneController& scene, ViewportWidget& widget)
      : settings_(settings), editor_(editor), scene_(scene), widget_(widget) {}

  void deactivate() override;
  void leave() override { hideHover(); }

 protected:
  /// Draws what the pointer would do; an empty drawing removes it.
  void draw(const view::ToolDrawing& drawing);
  /// Removes the drawing and the highlight of a patch.
  void hideHover();

  /// The name of a selected thing of this kind.
  std::optional<std::string> selected(Selection::Kind kind) const;
  std::string patchName(int patch) const;
  QString shownLength(double length) const;

  /// Largest extent of the body along an axis, mm.
  double bodySize() const;

  Settings& settings_;
  Editor& editor_;
  SceneController& scene_;
  ViewportWidget& widget_;
};

/// "support 3": the first with a number that none of the things in the list has.
template <class List>
std::string freeName(const std::string& stem, const List& list) {
  for (int i = 1;; ++i) {
    const std::string name = stem + " " + std::to_string(i);
    bool isFree = true;
    for (const auto& each : list) isFree = isFree && each.name != name;
    if (isFree) return name;
  }
}

/// The thing with a name; null when there is none.
template <class List>
auto findNamed(const List& list, const std::string& name) -> decltype(list.data()) {
  for (const auto& each : list)
    if (each.name == name) return &each;
  return nullptr;
}

/// Adds a patch to a region, or takes it away; a region may be left without parts.
void setPatch(modeling::Region& region, const std::string& patch, bool isInside);
bool namesPatch(const modeling::Region& region, const std::string& patch);

}  // namespace palpa::gui

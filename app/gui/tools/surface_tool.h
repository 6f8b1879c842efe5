#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/gui/base/settings.h"
#include "app/gui/document/editor.h"
#include "app/gui/document/named_items.h"
#include "app/gui/view/scene_controller.h"
#include "app/gui/view/tool.h"
#include "app/gui/view/viewport_widget.h"

namespace palpa::gui {

/// Base of the tools that place items on the surface.
class SurfaceTool : public Tool {
 public:
  SurfaceTool(Settings& settings, Editor& editor, SceneController& scene, ViewportWidget& widget)
      : settings_(settings), editor_(editor), scene_(scene), widget_(widget) {}

  void deactivate() override;
  void leave() override { hideHover(); }
  /// A group for all of these tools; each adds its rows.
  KeyHelp keyHelp() const override;

 protected:
  virtual std::vector<KeyHelp::Row> keyRows() const { return {}; }
  /// Draws a preview of a click; an empty drawing removes it.
  void draw(const view::ToolDrawing& drawing);
  /// Removes the drawing and the highlight of a patch.
  void hideHover();

  /// Name of the selected item if it is of this kind.
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

/// Adds a patch to a region or removes it; the region may become empty.
void setPatch(modeling::Region& region, const std::string& patch, bool isInside);
bool namesPatch(const modeling::Region& region, const std::string& patch);

}  // namespace palpa::gui

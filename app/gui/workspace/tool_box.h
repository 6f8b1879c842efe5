#pragma once

#include <QActionGroup>
#include <QObject>
#include <array>
#include <memory>
#include <vector>

#include "app/gui/workspace/menus.h"
#include "app/gui/view/tool.h"
#include "app/gui/view/viewport_widget.h"

namespace palpa::gui {

/// What the window is used for; each mode has tools of its own.
enum class Mode { kModel, kSimulate };

/// All tools; one of them is active and gets the events of the view. Escape with nothing to cancel
/// goes back to the first of the mode.
class ToolBox : public QObject {
  Q_OBJECT

 public:
  ToolBox(Menus& menus, ViewportWidget& widget);
  ~ToolBox() override;

  /// Adds a tool with its button and its place in a menu. The first one is active from the start.
  Tool* add(std::unique_ptr<Tool> tool, QMenu* menu, const Menus::Item& item,
            Mode mode = Mode::kModel);

  Mode mode() const { return mode_; }
  /// Shows the mode's tools and activates the one of them that was active last.
  void setMode(Mode mode);

  Tool& active() { return *active_; }
  void activate(Tool* tool);
  /// Ends what the active tool has begun.
  void restart();
  /// The name of the active tool, as in its menu without "&".
  QString activeTitle() const;

 Q_SIGNALS:
  /// Another tool is active now, or its hint() or options() changed.
  void changed();

 private:
  Menus& menus_;
  ViewportWidget& widget_;
  QActionGroup group_;
  struct Entry {
    std::unique_ptr<Tool> tool;
    QAction* action;
    Mode mode;
  };
  std::vector<Entry> entries_;
  Tool* active_ = nullptr;
  Mode mode_ = Mode::kModel;
  std::array<Tool*, 2> last_{};  // active in each mode
};

}  // namespace palpa::gui

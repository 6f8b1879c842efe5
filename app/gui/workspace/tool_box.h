#pragma once

#include <QActionGroup>
#include <QObject>
#include <array>
#include <memory>
#include <vector>

#include "app/gui/view/tool.h"
#include "app/gui/view/viewport_widget.h"
#include "app/gui/workspace/menus.h"

namespace palpa::gui {

/// Mode of the window; each mode has its own tools.
enum class Mode { kModel, kSimulate };

/// All tools. The active one receives the events of the view. It stays active until the user
/// chooses another tool or the mode changes.
class ToolBox : public QObject {
  Q_OBJECT

 public:
  ToolBox(Menus& menus, ViewportWidget& widget);
  ~ToolBox() override;

  /// Adds a tool with its button and menu entry. `item` needs an icon, a key and a tip. The first
  /// tool is active.
  Tool* add(std::unique_ptr<Tool> tool, QMenu* menu, const Menus::Item& item,
            Mode mode = Mode::kModel);

  Mode mode() const { return mode_; }
  /// Shows the tools of the mode and activates the last active one.
  void setMode(Mode mode);

  Tool& active() { return *active_; }
  void activate(Tool* tool);
  /// Groups of all tools, in the order of add().
  std::vector<KeyHelp> keyHelp() const;
  /// Aborts the operation of the active tool.
  void restart();
  /// Name of the active tool: its menu text without "&".
  QString activeTitle() const;
  /// Text by which the guide introduces the active tool: "Name (key)".
  QString activeTopic() const;

 Q_SIGNALS:
  /// Another tool became active, or its hint() changed.
  void changed();
  /// The user pressed the key of a tool of the other mode; `text` says what to do.
  void explained(const QString& text);

 private:
  void explain(int key);

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
  std::array<Tool*, 2> last_{};  // last active tool of each mode
};

}  // namespace palpa::gui

#pragma once

class QStatusBar;
class QWidget;

namespace palpa::gui {

class Editor;
class Menus;
class SceneController;
class Settings;
class ToolBox;
class ViewportWidget;

/// References that the parts of the window share. All outlive the parts.
struct Workspace {
  QWidget& window;  ///< owner of the parts, parent of their dialogs
  QStatusBar& statusBar;
  Settings& settings;
  Editor& editor;
  ViewportWidget& view;
  SceneController& scene;
  Menus& menus;
  ToolBox& tools;
};

}  // namespace palpa::gui

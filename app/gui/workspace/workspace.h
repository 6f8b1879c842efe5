#pragma once

namespace palpa::gui {

class Editor;
class MainWindow;
class Menus;
class SceneController;
class Settings;
class ToolBox;
class ViewportWidget;

/// What the parts of the window share. All outlive the parts.
struct Workspace {
  MainWindow& window;
  Settings& settings;
  Editor& editor;
  ViewportWidget& view;
  SceneController& scene;
  Menus& menus;
  ToolBox& tools;
};

}  // namespace palpa::gui

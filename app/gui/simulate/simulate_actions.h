#pragma once

#include <QObject>

#include "app/gui/simulate/project_touches.h"
#include "app/gui/simulate/recording_actions.h"
#include "app/gui/simulate/samples.h"
#include "app/gui/simulate/section_view.h"
#include "app/gui/simulate/simulate_tool.h"
#include "app/gui/simulate/simulation_view.h"
#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// The Simulate menu: modes, tools, display.
class SimulateActions : public QObject {
  Q_OBJECT

 public:
  SimulateActions(const Workspace& workspace, Simulation& simulation, SimulationView& pictures,
                  SectionView& section, Samples& samples);

 private:
  void addModes();
  void addTools();
  void addPictures();
  void addSection();
  void addGradient();
  /// Greys out the gradient where the project has none; the tool tip says why.
  void updateGradient();
  void addColourRange();
  void chooseRange();
  void show(bool isActive);
  void updatePlay();

  Workspace workspace_;
  Simulation& simulation_;
  SimulationView& pictures_;
  SectionView& section_;
  Samples& samples_;
  SimulateOptions options_;
  ProjectTouches touches_;
  QAction* play_ = nullptr;
  QAction* gradientArrows_ = nullptr;
  QAction* gradientColours_ = nullptr;
  std::vector<QAction*> rangeModes_;
  QAction* model_ = nullptr;
  QAction* simulate_ = nullptr;
  RecordingActions* recording_ = nullptr;
  std::vector<QAction*> onlySimulating_;
};

}  // namespace palpa::gui

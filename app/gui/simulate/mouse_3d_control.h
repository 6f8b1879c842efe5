#pragma once

#include <QObject>
#include <optional>

#include "app/gui/simulate/simulation.h"
#include "app/gui/view/mouse_3d.h"
#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// What a 3-D mouse does: the body follows the cap, as in other programs for modelling. In Simulate
/// mode pushing the cap moves the newest pin of the user's, if there is one; turning it turns the
/// view. The first button shows all, the second one ends the operation of the tool, or all touches.
class Mouse3dControl : public QObject {
  Q_OBJECT

 public:
  Mouse3dControl(const Workspace& workspace, Simulation& simulation, QObject* parent);

 private:
  void move(const Mouse3d::Motion& motion);
  void press(int button);
  bool movePin(const Eigen::Vector3d& push);

  Workspace workspace_;
  Simulation& simulation_;
  Mouse3d mouse_;
  /// The pin that the cap moves, and its value, which snapshots show later.
  struct Pin {
    app::TouchId id = 0;
    Eigen::Vector3d value;
  };
  std::optional<Pin> pin_;
};

}  // namespace palpa::gui

#pragma once

#include <QObject>
#include <map>

#include "app/gui/base/settings.h"
#include "app/gui/simulate/load_marks.h"
#include "app/gui/simulate/simulation.h"
#include "app/gui/view/scene_controller.h"
#include "app/gui/view/viewport_widget.h"

namespace palpa::gui {

/// Drawing of Simulate mode: the deformed surface in colours, arrows with newtons, rings around
/// contacts, balls, the loads, and the undeformed shape as lines. After the mode the scene
/// controller draws again.
class SimulationView : public QObject {
  Q_OBJECT

 public:
  SimulationView(const Editor& editor, Simulation& simulation, const Settings& settings,
                 SceneController& scene, ViewportWidget& widget);

  void setGhostShown(bool shown);
  bool isGhostShown() const { return isGhostShown_; }

  /// Values, colours and contacts shown in place of the state of the simulation; numbers in the
  /// program's units.
  struct Replacement {
    QString name{};                                ///< of the field; empty: of the quantity
    std::vector<double> values{};                  ///< one per point of the body; empty: as usual
    std::optional<std::array<double, 2>> range{};  ///< of the colours
    bool isDiverging = false;                      ///< the sign of the values matters
    std::optional<std::vector<app::TouchState::Contact>> contacts{};
  };
  void setReplacement(std::optional<Replacement> replacement);

 private:
  /// Contents of a frame.
  struct Drawn {
    std::vector<Eigen::Vector3d> positions;
    std::vector<double> values;
    std::array<double, 2> range{};
    std::vector<app::TouchSnapshot::Contact> contacts;
    bool isConverged = true;
  };

  void enterOrLeave(bool active);
  void showBody();
  void showField();
  void showGhost();
  void showFrame();
  void showContacts();
  void showReplacedContacts();
  /// The numbers and the range to be shown.
  const std::vector<double>& values() const;
  std::array<double, 2> range() const;
  /// True if the frame differs visibly from the last one that was drawn; then stores it as drawn.
  bool hasChanged();
  /// Name, unit and colours of the shown quantity.
  view::ScalarField fieldLooks() const;
  Unit fieldUnit() const;
  std::vector<Eigen::Vector3d> ring(const app::TouchSnapshot::Contact& contact,
                                    double radius) const;

  Simulation& simulation_;
  const Settings& settings_;
  SceneController& scene_;
  ViewportWidget& widget_;
  LoadMarks loads_;
  bool isGhostShown_ = true;
  bool hasBody_ = false;
  bool isStale_ = true;  // must be drawn even without a change
  double size_ = 0;      // mm, of the body
  Drawn drawn_;
  std::optional<Replacement> replacement_;
  double fullForce_ = 0;                     // force of the longest arrow, N
  std::map<app::TouchId, bool> isPressing_;  // the tip of the arrow is on the surface
};

}  // namespace palpa::gui

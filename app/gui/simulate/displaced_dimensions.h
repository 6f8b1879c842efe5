#pragma once

#include <QObject>
#include <QTimer>
#include <utility>
#include <vector>

#include "app/gui/simulate/simulation.h"
#include "app/gui/view/dimension_view.h"

namespace palpa::gui {

/// Dimensions of the displaced body in Simulate mode: measured distances between the places where
/// their ends have gone, several times a second.
class DisplacedDimensions : public QObject {
  Q_OBJECT

 public:
  DisplacedDimensions(Simulation& simulation, DimensionView& dimensions);

 private:
  void show();
  std::optional<Eigen::Vector3d> displacement(const Eigen::Vector3d& atRest);

  Simulation& simulation_;
  DimensionView& dimensions_;
  QTimer soon_;
  /// Places of the ends on drawn().
  std::vector<std::pair<Eigen::Vector3d, bem::SurfacePoint>> places_;
};

}  // namespace palpa::gui

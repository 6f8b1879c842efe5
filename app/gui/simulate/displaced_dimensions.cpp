#include "app/gui/simulate/displaced_dimensions.h"

#include "app/gui/document/editor.h"

namespace palpa::gui {
namespace {

constexpr int kInterval = 100;            // ms between two updates
constexpr std::size_t kMaxPlaces = 1000;  // remembered ends

}  // namespace

DisplacedDimensions::DisplacedDimensions(Simulation& simulation, DimensionView& dimensions)
    : QObject(&dimensions), simulation_(simulation), dimensions_(dimensions) {
  soon_.setSingleShot(true);
  soon_.setInterval(kInterval);
  connect(&soon_, &QTimer::timeout, this, &DisplacedDimensions::show);
  connect(&simulation, &Simulation::framed, this, [this] {
    if (!soon_.isActive() && dimensions_.hasAny()) soon_.start();
  });
  connect(&simulation, &Simulation::picturesChanged, &soon_, qOverload<>(&QTimer::start));
  connect(&simulation, &Simulation::bodyChanged, this, [this] { places_.clear(); });
  connect(&simulation, &Simulation::leaving, this, [this] {
    soon_.stop();
    places_.clear();
    dimensions_.setDisplacement({}, 1);
  });
}

void DisplacedDimensions::show() {
  if (!simulation_.isActive() || !simulation_.drawn()) return;
  dimensions_.setDisplacement(
      [this](const Eigen::Vector3d& atRest) { return displacement(atRest); }, simulation_.scale());
}

std::optional<Eigen::Vector3d> DisplacedDimensions::displacement(const Eigen::Vector3d& atRest) {
  if (!simulation_.drawn()) return std::nullopt;
  for (const auto& [at, place] : places_)
    if (at == atRest) return simulation_.displacementAt(place);
  if (places_.size() >= kMaxPlaces) places_.clear();
  places_.emplace_back(
      atRest, bem::nearestSurfacePoint(simulation_.drawn()->model().setup().mesh(), atRest));
  return simulation_.displacementAt(places_.back().second);
}

}  // namespace palpa::gui

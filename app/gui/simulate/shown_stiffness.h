#pragma once

#include <QObject>
#include <memory>
#include <optional>
#include <vector>

#include "app/core/live/stiffness_worker.h"
#include "app/core/results/drawn_body.h"
#include "app/core/results/stiffness_colours.h"

namespace palpa::gui {

/// Stiffness map of the drawn body, computed in the background; the known part grows.
class ShownStiffness : public QObject {
  Q_OBJECT

 public:
  explicit ShownStiffness(QObject* parent = nullptr);

  /// Radius of the fingertip, mm; default: a fingertip for the body. False if it is as before. The
  /// map is the old one until start().
  bool setFingertip(double radius);
  /// Removes the map and computes it from scratch; `drawn` shows the model of `body`.
  void start(std::shared_ptr<const app::TouchableModel> body,
             std::shared_ptr<const app::DrawnBody> drawn);
  /// Ends the computation, which delays the columns of Green's functions. The map stays.
  void stop();
  /// stop() and removes the map.
  void clear();

  /// One per point of the drawn body, N/mm, capped to the range of colours(); NaN where unknown.
  /// Empty before the first result.
  const std::vector<double>& values() const { return values_; }
  const app::StiffnessColours& colours() const { return colours_; }
  /// Share of the surface with known stiffness, 0 … 1.
  double ready() const { return ready_; }

 Q_SIGNALS:
  /// More of the map is known.
  void grown();

 private:
  void receive(const app::StiffnessWorker::Result& result);

  std::shared_ptr<const app::TouchableModel> body_;  // null while nothing is computed
  std::shared_ptr<const app::DrawnBody> drawn_;
  std::optional<double> fingertip_;
  double radius_ = 0;  // of the map that is computed
  std::vector<double> values_;
  app::StiffnessColours colours_;
  double ready_ = 0;
  app::StiffnessWorker worker_;  // destroyed first: its thread calls this object
};

}  // namespace palpa::gui

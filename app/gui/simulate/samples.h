#pragma once

#include <QObject>
#include <QTimer>
#include <memory>
#include <optional>
#include <vector>

#include "app/core/results/point_sample.h"
#include "app/gui/base/settings.h"
#include "app/gui/simulate/section_view.h"
#include "app/gui/simulate/simulation.h"
#include "app/gui/view/viewport_widget.h"

namespace palpa::gui {

/// Samples of Simulate mode: the point under the pointer, pinned points, and the smallest and
/// largest value of the shown field. Pins are places of the body at rest; their numbers follow the
/// touch several times a second.
class Samples : public QObject {
  Q_OBJECT

 public:
  static constexpr int kMaxPins = 30;

  Samples(Simulation& simulation, SectionView& section, const Settings& settings,
          ViewportWidget& widget);

  /// Shows the sample under a pixel, of the surface or of the section; none: nothing is there.
  void hover(const std::optional<Eigen::Vector2d>& pixel);
  /// Pins the sample under a pixel, or selects the pin there. False if nothing is there.
  bool pinAt(const Eigen::Vector2d& pixel);
  struct Pin {
    Eigen::Vector3d at;                        ///< mm, at rest
    std::optional<bem::SurfacePoint> surface;  ///< none: inside
  };
  /// index: 0 … count() - 1.
  const Pin& pin(int index) const { return pins_[static_cast<std::size_t>(index)]; }
  void setPin(int index, const Pin& pin);
  /// Moves a pin to the place under a pixel, on the surface or the section. False and unchanged if
  /// nothing is there.
  bool movePin(int index, const Eigen::Vector2d& pixel);
  void select(int index);
  int selected() const { return selected_; }
  /// Removes the selected pin; without one the last.
  void removeSelected();
  void clear();
  /// The pixel of the last hover(), if there is one.
  const std::optional<Eigen::Vector2d>& pointer() const { return pointer_; }
  int count() const { return static_cast<int>(pins_.size()); }
  /// One per pin, in the order of pinning.
  const std::vector<app::PointSample>& values() const { return values_; }

  void setExtremesShown(bool shown);
  bool areExtremesShown() const { return areExtremesShown_; }

 Q_SIGNALS:
  /// Pins, the selection or values() changed.
  void changed();

 private:
  std::optional<Pin> placeAt(const Eigen::Vector2d& pixel) const;
  std::optional<bem::SurfacePoint> surfacePlaceAt(const Eigen::Vector2d& pixel,
                                                  Eigen::Vector3d& drawn) const;
  Eigen::Vector3d drawn(std::size_t pin) const;
  void follow();
  void evaluate();
  void showLabels();
  void addExtremes(std::vector<view::SampleLabel>& labels) const;

  Simulation& simulation_;
  SectionView& section_;
  const Settings& settings_;
  ViewportWidget& widget_;
  std::vector<Pin> pins_;
  std::vector<app::PointSample> values_;
  std::unique_ptr<bem::InteriorEvaluator> inside_;  // of the pins inside; null: to be made
  int selected_ = -1;
  std::optional<view::SampleLabel> hovered_;
  std::optional<Eigen::Vector2d> pointer_;
  bool areExtremesShown_ = false;
  std::vector<view::SampleLabel> shown_;
  QTimer soon_;
};

}  // namespace palpa::gui

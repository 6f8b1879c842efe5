#pragma once

#include <QObject>
#include <functional>
#include <optional>
#include <vector>

#include "app/gui/base/settings.h"
#include "app/gui/document/editor.h"
#include "app/gui/view/viewport_widget.h"
#include "modeling/measure/measured_body.h"

namespace palpa::gui {

/// Draws the measurements of the project as dimensions in the view.
class DimensionView : public QObject {
  Q_OBJECT

 public:
  /// Displacement of a surface point at rest, mm; nothing if it is unknown.
  using Displacement = std::function<std::optional<Eigen::Vector3d>(const Eigen::Vector3d& atRest)>;

  DimensionView(Editor& editor, const Settings& settings, ViewportWidget& widget);

  /// A dimension that a tool is about to make; none to remove it.
  void setPreview(const std::optional<view::Dimension>& preview);
  /// The dimension for a value, with its number.
  view::Dimension dimensionOf(const modeling::Measurement& measurement,
                              const modeling::MeasuredValue& value) const;
  /// Shows distances and wall thicknesses between the displaced points, with the value at rest
  /// beside them, and no other kinds; without a function everything at rest. `scale`: factor of the
  /// drawn displacements.
  void setDisplacement(Displacement displacement, double scale);
  /// As drawn, in the order of the measurements that have a value; last the preview, if any.
  const std::vector<view::Dimension>& drawn() const { return drawn_; }
  /// True if the project has measurements.
  bool hasAny() const { return !editor_.project().measurements.empty(); }
  /// Draws again, after the measurements or the displacements have changed.
  void show();
  /// Selects the measurement whose number is under a pixel. False if there is none.
  bool selectAt(const Eigen::Vector2d& pixel);

 private:
  std::optional<view::Dimension> displaced(const modeling::Measurement& measurement,
                                           const modeling::MeasuredValue& value) const;

  Editor& editor_;
  const Settings& settings_;
  ViewportWidget& widget_;
  std::optional<view::Dimension> preview_;
  Displacement displacement_;
  double scale_ = 1;
  std::vector<view::Dimension> drawn_;
  std::vector<std::string> shown_;  // names of the first of drawn_
};

}  // namespace palpa::gui

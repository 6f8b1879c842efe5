#pragma once

#include <array>
#include <optional>
#include <vector>

#include "app/gui/tools/measure_picker.h"
#include "app/gui/tools/surface_tool.h"

namespace palpa::gui {

/// Measures the body: each click takes a point, an edge or a face, and the last one adds the
/// measurement to the project, where it stays as a dimension.
class MeasureTool : public SurfaceTool {
  Q_OBJECT

 public:
  MeasureTool(Settings& settings, Editor& editor, SceneController& scene, ViewportWidget& widget);

  void deactivate() override;
  bool press(const PointerEvent& event) override;
  bool move(const PointerEvent& event) override;
  void leave() override;
  bool key(QKeyEvent* event) override;
  bool wantsKey(const QKeyEvent& event) const override;
  bool followsPointer() const override { return !places_.empty(); }
  bool cancel() override;
  QCursor cursor() const override { return Qt::CrossCursor; }
  QString hint() const override;
  QWidget* makeOptions(QWidget* parent) override;

  modeling::MeasurementKind kind() const { return kind_; }
  void setKind(modeling::MeasurementKind kind);
  /// Whole edges and faces instead of points, for distances and angles.
  bool takesWhole() const;
  void setTakesWhole(bool whole);
  bool hasChoice() const;
  /// Value under the pointer, or what to do; for the options.
  const QString& readout() const { return readout_; }

  /// Measures the selected patches or edges.
  void measureSelection();
  bool canMeasureSelection() const;

 Q_SIGNALS:
  void readoutChanged();

 private:
  std::vector<KeyHelp::Row> keyRows() const override;
  MeasureWish wish() const;
  std::size_t placeCount() const;
  void hover();
  void clear();
  void setReadout(const QString& text);
  std::optional<modeling::Measurement> fromSelection() const;
  bool add(std::vector<modeling::MeasuredPlace> places);
  std::optional<MeasureTarget> targetAt(const Eigen::Vector2d& pixel);

  modeling::MeasurementKind kind_ = modeling::MeasurementKind::kDistance;
  std::array<bool, 2> takesWhole_{false, true};  // distance, angle
  std::vector<MeasureTarget> places_;            // taken so far
  std::optional<Eigen::Vector2d> last_;          // pixel
  bool isOther_ = false;                         // Ctrl is pressed
  QString readout_;
};

/// Options of the tool for the Properties panel.
QWidget* makeMeasureOptions(MeasureTool& tool, Editor& editor, QWidget* parent);

}  // namespace palpa::gui

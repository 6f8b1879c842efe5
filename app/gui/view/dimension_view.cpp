#include "app/gui/view/dimension_view.h"

#include "app/gui/document/measurement_words.h"
#include "app/gui/document/measurements.h"

namespace palpa::gui {

using modeling::MeasurementKind;

DimensionView::DimensionView(Editor& editor, const Settings& settings, ViewportWidget& widget)
    : QObject(&widget), editor_(editor), settings_(settings), widget_(widget) {
  connect(&editor.measurements(), &Measurements::changed, this, &DimensionView::show);
  connect(&editor, &Editor::selectionChanged, this, &DimensionView::show);
  connect(&settings, &Settings::changed, this, &DimensionView::show);
  show();
}

view::Dimension DimensionView::dimensionOf(const modeling::Measurement& measurement,
                                           const modeling::MeasuredValue& value) const {
  using Kind = view::Dimension::Kind;
  view::Dimension dimension;
  switch (measurement.kind) {
    case MeasurementKind::kDistance:
    case MeasurementKind::kThickness:
      dimension.kind = Kind::kLinear;
      break;
    case MeasurementKind::kLength:
      dimension.kind = Kind::kCurve;
      break;
    case MeasurementKind::kAngle:
      dimension.kind = Kind::kAngle;
      break;
    case MeasurementKind::kRadius:
      dimension.kind = Kind::kRadius;
      break;
  }
  dimension.points = value.points;
  dimension.text = dimensionText(measurement.kind, value, settings_.units()).toStdString();
  return dimension;
}

std::optional<view::Dimension> DimensionView::displaced(
    const modeling::Measurement& measurement, const modeling::MeasuredValue& value) const {
  if (measurement.kind != MeasurementKind::kDistance &&
      measurement.kind != MeasurementKind::kThickness)
    return std::nullopt;
  const Eigen::Vector3d &a = value.points[0], &b = value.points[1];
  const auto ofA = displacement_(a), ofB = displacement_(b);
  if (!ofA || !ofB) return std::nullopt;
  view::Dimension dimension = dimensionOf(measurement, value);
  dimension.points = {a + scale_ * *ofA, b + scale_ * *ofB};
  const auto text = [&](double length) {
    return shown(length, Quantity::kLength, settings_.units(), 4);
  };
  dimension.text = tr("%1 (at rest %2)")
                       .arg(text((b + *ofB - a - *ofA).norm()), text(value.value))
                       .toStdString();
  return dimension;
}

void DimensionView::show() {
  drawn_.clear();
  shown_.clear();
  const auto& list = editor_.project().measurements;
  if (!list.empty()) {
    const auto& results = editor_.measurements().results();
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (!results[i].value) continue;
      auto dimension = displacement_ ? displaced(list[i], *results[i].value)
                                     : std::optional(dimensionOf(list[i], *results[i].value));
      if (!dimension) continue;
      if (editor_.selection().named ==
          Selection::Named{Selection::Kind::kMeasurement, list[i].name})
        dimension->state = view::Dimension::State::kSelected;
      drawn_.push_back(std::move(*dimension));
      shown_.push_back(list[i].name);
    }
  }
  if (preview_) drawn_.push_back(*preview_);
  widget_.viewport().setDimensions(drawn_);
  widget_.update();
}

void DimensionView::setPreview(const std::optional<view::Dimension>& preview) {
  if (!preview && !preview_) return;
  preview_ = preview;
  if (preview_) preview_->state = view::Dimension::State::kPreview;
  show();
}

void DimensionView::setDisplacement(Displacement displacement, double scale) {
  if (!displacement && !displacement_) return;
  displacement_ = std::move(displacement);
  scale_ = scale;
  show();
}

bool DimensionView::selectAt(const Eigen::Vector2d& pixel) {
  const auto index = widget_.viewport().dimensionAt(pixel);
  if (!index || *index >= static_cast<int>(shown_.size())) return false;
  editor_.select(
      Selection::of(Selection::Kind::kMeasurement, shown_[static_cast<std::size_t>(*index)]));
  return true;
}

}  // namespace palpa::gui

#include "app/gui/tools/measure_tool.h"

#include <algorithm>

#include "app/gui/document/measurement_words.h"
#include "app/gui/document/measurements.h"
#include "modeling/error.h"

namespace palpa::gui {
namespace {

using modeling::MeasuredPlace;
using modeling::MeasurementKind;
using Style = view::ToolDrawing::Style;
using What = MeasuredPlace::What;

std::string stemOf(MeasurementKind kind) {
  return kindText(kind).toLower().toStdString();
}

}  // namespace

MeasureTool::MeasureTool(Settings& settings, Editor& editor, SceneController& scene,
                         ViewportWidget& widget)
    : SurfaceTool(settings, editor, scene, widget) {
  // Places that were taken belong to the shape before.
  connect(&editor, &Editor::projectChanged, this, [this](const modeling::Change& change) {
    if (change.body()) cancel();
  });
  connect(&editor, &Editor::selectionChanged, this, &Tool::changed);
}

void MeasureTool::deactivate() {
  clear();
  SurfaceTool::deactivate();
}

bool MeasureTool::hasChoice() const {
  return kind_ == MeasurementKind::kDistance || kind_ == MeasurementKind::kAngle;
}

bool MeasureTool::takesWhole() const {
  return hasChoice() && takesWhole_[kind_ == MeasurementKind::kAngle ? 1 : 0];
}

void MeasureTool::setTakesWhole(bool whole) {
  if (!hasChoice() || whole == takesWhole()) return;
  takesWhole_[kind_ == MeasurementKind::kAngle ? 1 : 0] = whole;
  if (kind_ == MeasurementKind::kAngle) places_.clear();  // two or three places
  hover();
  Q_EMIT changed();
}

void MeasureTool::setKind(MeasurementKind kind) {
  if (kind == kind_) return;
  kind_ = kind;
  places_.clear();
  hover();
  Q_EMIT changed();
}

MeasureWish MeasureTool::wish() const {
  switch (kind_) {
    case MeasurementKind::kLength:
      return MeasureWish::kEdge;
    case MeasurementKind::kRadius:
      return MeasureWish::kEdgeOrPoint;
    case MeasurementKind::kThickness:
      return MeasureWish::kPoint;
    case MeasurementKind::kAngle:  // its places are of one sort
      return takesWhole() ? MeasureWish::kEdgeOrFace : MeasureWish::kPoint;
    case MeasurementKind::kDistance:
      break;
  }
  return takesWhole() != isOther_ ? MeasureWish::kEdgeOrFace : MeasureWish::kPoint;
}

std::size_t MeasureTool::placeCount() const {
  if (kind_ == MeasurementKind::kAngle) return takesWhole() ? 2 : 3;
  return modeling::infoOf(kind_).mostPlaces;
}

std::optional<MeasureTarget> MeasureTool::targetAt(const Eigen::Vector2d& pixel) {
  try {
    return measureTargetAt(pixel, wish(), scene_, widget_, editor_.measurements().body());
  } catch (const modeling::ModelingError& error) {
    setReadout(QString::fromStdString(error.what()));
    return std::nullopt;
  }
}

void MeasureTool::hover() {
  view::ToolDrawing drawing;
  const auto mark = [&](const MeasureTarget& target, Style style) {
    if (target.place.what == What::kEdge) drawing.lines.push_back({target.line, style, false});
    if (target.place.what != What::kEdge || kind_ == MeasurementKind::kRadius)
      drawing.dots.push_back({target.at, style});
  };
  for (const MeasureTarget& each : places_) mark(each, Style::kSelected);
  const auto target = last_ ? targetAt(*last_) : std::nullopt;
  std::optional<view::Dimension> preview;
  QString text;
  if (target) {
    mark(*target, Style::kHovered);
    if (target->snap != MeasureTarget::Snap::kNone && target->place.what == What::kPoint)
      drawing.lines.push_back({target->line, Style::kGuide, false});
    if (places_.size() + 1 == placeCount()) {
      modeling::Measurement measurement{"", kind_, {}};
      for (const MeasureTarget& each : places_) measurement.places.push_back(each.place);
      measurement.places.push_back(target->place);
      const Measurements::Result result = editor_.measurements().measure(measurement);
      if (result.value) {
        preview = scene_.dimensions().dimensionOf(measurement, *result.value);
        QStringList lines;
        for (const auto& [label, fact] : factsOf(measurement, *result.value, settings_.units()))
          lines << (lines.empty() ? fact : tr("%1: %2").arg(label, fact));
        text = lines.join('\n');
      } else {
        text = result.problem;
      }
    }
  }
  scene_.setHoveredPatch(target && target->place.what == What::kFace ? std::optional(target->patch)
                                                                     : std::nullopt);
  draw(drawing);
  scene_.dimensions().setPreview(preview);
  setReadout(text);
}

void MeasureTool::setReadout(const QString& text) {
  if (text == readout_) return;
  readout_ = text;
  Q_EMIT readoutChanged();
}

bool MeasureTool::move(const PointerEvent& event) {
  last_ = event.pixel;
  isOther_ = (event.modifiers & Qt::ControlModifier) != 0;
  if (event.buttons == Qt::NoButton) hover();
  return false;
}

void MeasureTool::leave() {
  last_.reset();
  hover();
}

bool MeasureTool::press(const PointerEvent& event) {
  if (event.button != Qt::LeftButton) return false;
  last_ = event.pixel;
  isOther_ = (event.modifiers & Qt::ControlModifier) != 0;
  const auto target = targetAt(event.pixel);
  if (!target) return false;  // a drag beside the body turns the view
  places_.push_back(*target);
  if (places_.size() < placeCount()) {
    hover();
    Q_EMIT changed();
    return true;
  }
  std::vector<MeasuredPlace> places;
  for (const MeasureTarget& each : places_) places.push_back(each.place);
  if (add(std::move(places)))
    places_.clear();
  else
    places_.pop_back();
  // The preview would lie on the new dimension until the pointer moves.
  last_.reset();
  hover();
  Q_EMIT changed();
  return true;
}

bool MeasureTool::add(std::vector<MeasuredPlace> places) {
  modeling::Measurement measurement{freeName(stemOf(kind_), editor_.project().measurements), kind_,
                                    std::move(places)};
  const Measurements::Result result = editor_.measurements().measure(measurement);
  if (!result.value) {
    Q_EMIT editor_.refused(result.problem);
    return false;
  }
  if (!editor_.perform(modeling::AddMeasurement{measurement})) return false;
  editor_.select(Selection::of(Selection::Kind::kMeasurement, measurement.name));
  return true;
}

std::optional<modeling::Measurement> MeasureTool::fromSelection() const {
  const Selection& selection = editor_.selection();
  modeling::Measurement measurement{"", kind_, {}};
  if (const modeling::Solid* solid = editor_.solid()) {
    for (const int edge : selection.edges) {
      const modeling::PatchEdge& use = solid->edges()[static_cast<std::size_t>(edge)].uses[0];
      measurement.places.push_back(
          {What::kEdge, patchName(use.patch), Eigen::Vector2d(0.5, 0.5), use.side});
    }
  }
  const bool isPoint = kind_ == MeasurementKind::kThickness || kind_ == MeasurementKind::kRadius;
  for (const int patch : selection.patches) {
    MeasuredPlace place{isPoint ? What::kPoint : What::kFace, patchName(patch)};
    if (!editor_.solid()) {
      const ShownSurface surface = scene_.surface();
      for (std::size_t t = 0; t < surface.triangles.size(); ++t)
        if (surface.patchOfTriangle[t] == patch) {
          place.at = surface.middle(t);
          break;
        }
    }
    measurement.places.push_back(std::move(place));
  }
  try {
    modeling::checkMeasurement(measurement, "");
  } catch (const modeling::ModelingError&) {
    return std::nullopt;
  }
  return measurement;
}

bool MeasureTool::canMeasureSelection() const {
  return fromSelection().has_value();
}

void MeasureTool::measureSelection() {
  if (auto measurement = fromSelection()) {
    add(std::move(measurement->places));
    return;
  }
  Q_EMIT editor_.refused(
      tr("%1: the selection does not fit; select %2 in the view or in the Model panel.")
          .arg(kindText(kind_), kind_ == MeasurementKind::kLength      ? tr("one edge")
                                : kind_ == MeasurementKind::kThickness ? tr("one patch")
                                : kind_ == MeasurementKind::kRadius
                                    ? tr("one patch or edge")
                                    : tr("two patches or two edges")));
}

void MeasureTool::clear() {
  places_.clear();
  scene_.dimensions().setPreview(std::nullopt);
  setReadout({});
}

bool MeasureTool::cancel() {
  if (places_.empty()) return false;
  clear();
  hideHover();
  Q_EMIT changed();
  return true;
}

QWidget* MeasureTool::makeOptions(QWidget* parent) {
  return makeMeasureOptions(*this, editor_, parent);
}

}  // namespace palpa::gui

#include "app/gui/tools/remove_knot_tool.h"

#include "app/gui/widgets/form_row.h"
#include "app/gui/widgets/quantity_edit.h"
#include "modeling/error.h"
#include "modeling/solid/isoparametric_line.h"

namespace palpa::gui {
namespace {

constexpr double kReach = 14;              // logical pixels from a knot line
constexpr double kToleranceShare = 0.002;  // of the body's size
constexpr double kAnyDeviation = 1e30;     // mm

}  // namespace

RemoveKnotTool::RemoveKnotTool(Settings& settings, Editor& editor, SceneController& scene,
                               ViewportWidget& widget)
    : SurfaceTool(settings, editor, scene, widget) {
  const auto forget = [this] { hovered_.reset(); };  // its deviation belongs to the previous shape
  connect(&editor, &Editor::projectChanged, this, forget);
  connect(&editor, &Editor::projectReplaced, this, forget);
}

double RemoveKnotTool::tolerance() const {
  return tolerance_.value_or(kToleranceShare * bodySize());
}

void RemoveKnotTool::setTolerance(double tolerance) {
  tolerance_ = tolerance;
  Q_EMIT changed();
}

std::optional<RemoveKnotTool::Knot> RemoveKnotTool::knotAt(const Eigen::Vector2d& pixel) const {
  const auto place = scene_.placeAt(pixel);
  if (!place || !place->parameters) return std::nullopt;
  std::optional<Knot> nearest;
  double least = kReach * widget_.devicePixelRatioF();
  for (int direction : {0, 1}) {
    const modeling::PatchDirection at{place->patch, direction};
    for (double knot : modeling::innerKnots(*editor_.solid(), at)) {
      Eigen::Vector2d parameters = *place->parameters;
      parameters[direction] = knot;
      const Eigen::Vector3d there =
          modeling::surfacePoint(*editor_.solid(), place->patch, parameters.x(), parameters.y());
      const double distance = (widget_.viewport().toPixel(there) - pixel).norm();
      if (distance < least) {
        least = distance;
        nearest = Knot{at, knot};
      }
    }
  }
  return nearest;
}

void RemoveKnotTool::findConsequence() {
  deviation_.reset();
  refusal_.clear();
  try {
    deviation_ =
        modeling::removeKnot(*editor_.solid(), hovered_->at, hovered_->parameter, 1, kAnyDeviation)
            .deviation;
    if (*deviation_ > tolerance())
      refusal_ = tr("The surface would move by %1, more than the %2 allowed in the options")
                     .arg(shownLength(*deviation_), shownLength(tolerance()));
  } catch (const modeling::ModelingError& error) {
    refusal_ = QString::fromStdString(error.what());
  }
}

void RemoveKnotTool::hover(const Eigen::Vector2d& pixel) {
  const auto knot = knotAt(pixel);
  if (knot && knot != hovered_) {
    hovered_ = knot;
    findConsequence();
  }
  hovered_ = knot;
  view::ToolDrawing drawing;
  if (knot) {
    const auto place = scene_.placeAt(pixel);
    for (auto& line : modeling::knotLinesOf(*editor_.solid(), knot->at, knot->parameter))
      drawing.lines.push_back({std::move(line), view::ToolDrawing::Style::kHovered, true});
    const QString name = tr("%1 = %2 on patch %3")
                             .arg(knot->at.direction == 0 ? "u" : "v")
                             .arg(knot->parameter, 0, 'g', 4)
                             .arg(QString::fromStdString(patchName(knot->at.patch)));
    const QString consequence = deviation_
                                    ? tr("moves the surface by %1").arg(shownLength(*deviation_))
                                    : tr("cannot be removed");
    drawing.labels.push_back({place->position, (name + ": " + consequence).toStdString()});
  }
  draw(drawing);
}

bool RemoveKnotTool::move(const PointerEvent& event) {
  hover(event.pixel);
  return false;
}

void RemoveKnotTool::leave() {
  hovered_.reset();
  hideHover();
}

bool RemoveKnotTool::press(const PointerEvent& event) {
  if (event.button != Qt::LeftButton) return false;
  if (!editor_.solid()) {
    Q_EMIT editor_.said(tr("A mesh body has no knots. Only solids made of patches have."));
    return true;
  }
  hovered_.reset();  // the tolerance may have changed
  hover(event.pixel);
  if (!hovered_) {
    Q_EMIT editor_.said(tr("There is no knot line here; patches of a single span have none."));
    return true;
  }
  if (!refusal_.isEmpty()) {
    Q_EMIT editor_.refused(tr("The knot stays: %1").arg(refusal_));
    return true;
  }
  editor_.perform(modeling::RemoveKnot{patchName(hovered_->at.patch), hovered_->at.direction,
                                       hovered_->parameter, 1, tolerance()});
  hover(event.pixel);
  return true;
}

QString RemoveKnotTool::hint() const {
  return tr("Click a knot line to remove it; the surface may move by up to %1")
      .arg(shownLength(tolerance()));
}

QWidget* RemoveKnotTool::makeOptions(QWidget* parent) {
  auto* options = new QWidget(parent);
  auto* form = new QFormLayout(options);
  form->setContentsMargins(0, 0, 0, 0);
  auto* tolerance = new QuantityEdit(Quantity::kLength, settings_, options);
  tolerance->setRange(0, 1e9);
  tolerance->setValue(this->tolerance());
  addFormRow(form, tr("Surface may &move by"), tolerance, "knotTolerance",
             tr("A knot whose removal moves the surface farther stays"));
  connect(tolerance, &QuantityEdit::edited, this, &RemoveKnotTool::setTolerance);
  connect(&editor_, &Editor::projectReplaced, tolerance,
          [this, tolerance] { tolerance->setValue(this->tolerance()); });
  return options;
}

}  // namespace palpa::gui

#include "app/gui/compare/comparison_view.h"

#include <algorithm>
#include <cmath>

namespace palpa::gui {
namespace {

using app::SurfaceQuantity;

/// Smallest range of a difference, over the range of the field: less are rounding errors.
constexpr double kMinDifference = 1e-4;

view::ViewportBody viewportBody(const app::DrawnBody& body,
                                const std::vector<Eigen::Vector3d>& positions,
                                const std::vector<Eigen::Vector3d>& normals) {
  return {positions,
          normals,
          body.mesh().triangles,
          body.mesh().patchOfTriangle,
          view::linesBetween(body.borders()),
          {}};
}

double largestOf(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values)
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  return largest;
}

bool hasValues(SurfaceQuantity quantity) {
  return app::isOfField(quantity);
}

}  // namespace

ComparisonView::ComparisonView(VariantComparison& comparison, Simulation& simulation,
                               SimulationView& pictures, const Settings& settings,
                               ViewportWidget& widget)
    : QObject(&widget),
      comparison_(comparison),
      simulation_(simulation),
      pictures_(pictures),
      settings_(settings),
      widget_(widget) {
  connect(&comparison, &VariantComparison::compared, this, &ComparisonView::update);
  for (auto signal : {&Simulation::picturesChanged, &Simulation::bodyChanged})
    connect(&simulation, signal, this, &ComparisonView::update);
  connect(&simulation, &Simulation::activeChanged, this, &ComparisonView::update);
  connect(&simulation, &Simulation::framed, this, &ComparisonView::drawFrame);
  connect(&settings, &Settings::changed, this, &ComparisonView::update);
}

void ComparisonView::setShown(Shown shown) {
  if (shown == shown_) return;
  shown_ = shown;
  update();
  Q_EMIT changed();
}

void ComparisonView::setCommonColours(bool common) {
  if (common == hasCommonColours_) return;
  hasCommonColours_ = common;
  update();
  Q_EMIT changed();
}

void ComparisonView::setDeformed(bool deformed) {
  if (deformed == isDeformed_) return;
  isDeformed_ = deformed;
  update();
  Q_EMIT changed();
}

bool ComparisonView::isSimulating() const {
  return simulation_.isActive() && simulation_.drawn();
}

ComparisonView::Shown ComparisonView::drawable() {
  note_.clear();
  if (shown_ == Shown::kA || !result_) return Shown::kA;
  if (!isSimulating()) {
    note_ = tr("Fields are shown in Simulate mode (F5).");
    return Shown::kA;
  }
  if (!result_->comparison || result_->drawnA != simulation_.sharedDrawn()) return Shown::kA;
  if (simulation_.quantity() != SurfaceQuantity::kNone && !app::isOfField(simulation_.quantity())) {
    note_ =
        tr("Stiffness belongs to A alone: choose another field in Simulate > Colour "
           "by.");
    return Shown::kA;
  }
  if (shown_ == Shown::kB) return Shown::kB;
  if (simulation_.quantity() == SurfaceQuantity::kNone) {
    note_ = tr("A difference needs a field: choose one in Simulate > Colour by.");
    return Shown::kA;
  }
  const double share = result_->surfaces->share();
  const QString reach =
      gui::shown(result_->surfaces->reach(), Quantity::kLength, settings_.units(), 2);
  const QString percent = QString::number(100 * share, 'f', 0);
  if (share < kMinShare) {
    note_ = tr("Only %1 % of the surface of A has a point of B within %2, so a difference would "
               "compare different places. The field of A is shown.")
                .arg(percent, reach);
    return Shown::kA;
  }
  note_ =
      tr("The difference at each point of A is taken to the nearest point of B that faces the "
         "same side.");
  if (share < 0.995)
    note_ += " " + tr("It has no colour where that point is more than %2 away: %1 % of the surface "
                      "has one.")
                       .arg(percent, reach);
  return Shown::kDifference;
}

void ComparisonView::clear() {
  view::Viewport& viewport = widget_.viewport();
  if (ghostOf_) viewport.setCompared(std::nullopt);
  if (standInOf_) viewport.setStandIn(std::nullopt);
  ghostOf_.reset();
  standInOf_.reset();
  viewport.setCaption({});
  pictures_.setReplacement(std::nullopt);
  simulation_.setLargestBeside(0);
  result_.reset();
  drawn_ = Shown::kA;
  note_.clear();
  widget_.update();
}

void ComparisonView::computeValues() {
  const SurfaceQuantity quantity = simulation_.quantity();
  valuesOf_ = quantity;
  valuesB_.clear();
  difference_.clear();
  largestB_ = 0;
  if (!result_->comparison || !hasValues(quantity)) return;
  const auto& states = result_->comparison->states;
  valuesB_ = result_->drawnB->values(quantity, states[1].state.field);
  largestB_ = largestOf(valuesB_);
  if (drawn_ != Shown::kDifference) return;
  difference_ = result_->surfaces->carried(valuesB_);
  const std::vector<double> ofA = result_->drawnA->values(quantity, states[0].state.field);
  for (std::size_t k = 0; k < difference_.size(); ++k) difference_[k] -= ofA[k];
}

void ComparisonView::update() {
  // setReplacement() draws a frame of the simulation, which may come back here.
  if (isDrawing_) return;
  const auto result = comparison_.result();
  const QString former = note_;
  if (!result || !result->drawnB) {
    if (result_ || ghostOf_) clear();
    if (former != note_) Q_EMIT changed();
    return;
  }
  isDrawing_ = true;
  const bool isNew = result != result_;
  result_ = result;
  const Shown before = drawn_;
  drawn_ = drawable();
  if (before != drawn_) ghostOf_.reset();
  if (isNew || before != drawn_ || valuesOf_ != simulation_.quantity()) computeValues();
  const bool isCommon = hasCommonColours_ && isSimulating() && drawn_ != Shown::kDifference;
  simulation_.setLargestBeside(isCommon ? largestB_ : 0);
  std::optional<SimulationView::Replacement> replacement;
  const app::SurfaceQuantityInfo& info = app::infoOf(simulation_.quantity());
  if (drawn_ == Shown::kB) {
    replacement.emplace();
    replacement->contacts = result_->comparison->states[1].state.contacts;
    if (!isCommon && largestB_ > 0)
      replacement->range = ColourRange::roundRange(largestB_, info.isSigned);
  } else if (drawn_ == Shown::kDifference) {
    replacement.emplace();
    replacement->name = tr("B − A: %1").arg(tr(info.label));
    replacement->values = difference_;
    replacement->isDiverging = true;
    const double least = kMinDifference * std::max(largestB_, simulation_.range()[1]);
    const double largest = std::max(largestOf(difference_), least);
    replacement->range = ColourRange::roundRange(largest > 0 ? largest : 1, true);
  }
  pictures_.setReplacement(std::move(replacement));
  drawShapes();
  explain();
  isDrawing_ = false;
  widget_.update();
  if (former != note_) Q_EMIT changed();
}

void ComparisonView::drawFrame() {
  // A has moved, or the range has changed.
  if (result_ && !isDrawing_ && drawn_ == Shown::kB && result_->drawnA == simulation_.sharedDrawn())
    drawShapes();
}

void ComparisonView::drawShapes() {
  view::Viewport& viewport = widget_.viewport();
  const app::DrawnBody& b = *result_->drawnB;
  if (isDeformed_ && isSimulating() && result_->comparison) {
    b.deform(result_->comparison->states[1].state.field.u.col(0), simulation_.scale(), shapeB_);
  } else {
    shapeB_.positions = b.mesh().positions;
    shapeB_.normals = b.mesh().normals;
  }
  const bool isB = drawn_ == Shown::kB;
  const auto& ghost = isB ? simulation_.sharedDrawn() : result_->drawnB;
  const auto& positions = isB ? simulation_.shape().positions : shapeB_.positions;
  const auto& normals = isB ? simulation_.shape().normals : shapeB_.normals;
  if (ghostOf_ != ghost) {
    view::ViewportBody body = viewportBody(*ghost, positions, normals);
    if (drawn_ == Shown::kDifference) {
      // Only lines: a tint would change the colours of the difference.
      body.triangles.clear();
      body.patchOfTriangle.clear();
    }
    viewport.setCompared(body);
    ghostOf_ = ghost;
  } else {
    viewport.moveCompared(positions, normals);
  }
  if (!isB) {
    if (standInOf_) viewport.setStandIn(std::nullopt);
    standInOf_.reset();
    return;
  }
  if (standInOf_ != result_->drawnB) {
    viewport.setStandIn(viewportBody(b, shapeB_.positions, shapeB_.normals));
    standInOf_ = result_->drawnB;
  }
  const double factor =
      shownUnit(app::infoOf(simulation_.quantity()).unit, settings_.units()).factor;
  std::vector<double> values = valuesB_;
  for (double& value : values) value /= factor;
  values.resize(shapeB_.positions.size(), std::nan(""));
  // As for the body: without contacts and loads no colours.
  if (largestB_ == 0) std::fill(values.begin(), values.end(), std::nan(""));
  viewport.moveStandIn(shapeB_.positions, shapeB_.normals, values);
}

QString ComparisonView::colouredText(const QString& name) const {
  const bool hasField = isSimulating() && simulation_.quantity() != SurfaceQuantity::kNone;
  return hasField ? tr("%1, in colours").arg(name) : name;
}

void ComparisonView::explain() {
  const QString a = tr("A: %1").arg(comparison_.nameOfA()),
                b = tr("B: %1").arg(comparison_.nameOfB());
  view::Caption caption;
  caption.compared = (drawn_ == Shown::kB ? a : b).toStdString();
  if (drawn_ == Shown::kDifference)
    caption.lines = {tr("%1, coloured by the difference B − A").arg(a).toStdString()};
  else
    caption.lines = {colouredText(drawn_ == Shown::kB ? b : a).toStdString()};
  widget_.viewport().setCaption(caption);
}

}  // namespace palpa::gui

#include "app/gui/simulate/simulate_options.h"

#include <QFormLayout>

#include "app/core/model/contact_kind.h"
#include "app/core/results/touch.h"
#include "app/gui/widgets/form_row.h"
#include "app/gui/widgets/quantity_edit.h"
#include "base/round_number.h"

namespace palpa::gui {
namespace {

constexpr int kRadiusDigits = 2;  // of the default, which is shown in a field

}  // namespace

double SimulateOptions::radius(const app::DrawnBody& body) const {
  return radius_.value_or(
      roundedToDigits(app::defaultTouchRadius(body.model().setup().mesh()), kRadiusDigits));
}

void SimulateOptions::setRadius(double radius) {
  radius_ = radius;
  Q_EMIT changed();
}

void SimulateOptions::setFriction(double friction) {
  friction_ = friction;
  Q_EMIT changed();
}

QWidget* SimulateOptions::makeFields(Kind kind, Settings& settings, Simulation& simulation,
                                     QWidget* parent) {
  auto* fields = new QWidget(parent);
  auto* form = new QFormLayout(fields);
  form->setContentsMargins(0, 0, 0, 0);
  auto* radius = new QuantityEdit(Quantity::kLength, settings, fields);
  radius->setRange(1e-6, 1e6);
  const auto showRadius = [this, &simulation, radius] {
    if (simulation.drawn()) radius->setValue(this->radius(*simulation.drawn()));
    radius->setEnabled(simulation.drawn() != nullptr);
  };
  showRadius();
  const bool isBall = app::infoOf(kind).isBall;
  addFormRow(form, isBall ? tr("&Radius of the ball") : tr("&Radius of the fingertip"), radius,
             "contactRadius",
             isBall ? tr("The ball is rigid; its contact grows with depth")
                    : tr("The contact presses on a disc of this radius"));
  connect(radius, &QuantityEdit::edited, this, &SimulateOptions::setRadius);
  connect(&simulation, &Simulation::bodyChanged, radius, showRadius);
  if (!bem::ContactTool{kind}.presses()) return fields;
  auto* friction = new QuantityEdit(Quantity::kNumber, settings, fields);
  friction->setRange(0, modeling::kMaxFriction);
  friction->setValue(friction_);
  addFormRow(form, tr("&Friction"), friction, "contactFriction",
             tr("Coulomb's coefficient; 0 slides freely"));
  connect(friction, &QuantityEdit::edited, this, &SimulateOptions::setFriction);
  return fields;
}

}  // namespace palpa::gui

#include "app/gui/simulate/hand_options.h"

#include <QFormLayout>

#include "app/core/touch.h"
#include "app/gui/tools/condition_options.h"
#include "app/gui/widgets/quantity_edit.h"

namespace palpa::gui {
namespace {

constexpr double kMostFriction = 10;

}  // namespace

double HandOptions::radius(const app::DrawnBody& body) const {
  return radius_.value_or(app::defaultTouchRadius(body.model().setup().mesh()));
}

void HandOptions::setRadius(double radius) {
  radius_ = radius;
  Q_EMIT changed();
}

void HandOptions::setFriction(double friction) {
  friction_ = friction;
  Q_EMIT changed();
}

QWidget* HandOptions::makeFields(Kind kind, Settings& settings, Simulation& simulation,
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
  const bool isBall = kind == Kind::kProbe;
  addRow(form, isBall ? tr("&Radius of the ball") : tr("&Radius of the fingertip"), radius,
         "handRadius",
         isBall ? tr("The ball is rigid; its contact grows with depth")
                : tr("The contact presses on a disc of this radius"));
  connect(radius, &QuantityEdit::edited, this, &HandOptions::setRadius);
  connect(&simulation, &Simulation::bodyChanged, radius, showRadius);
  if (!isPushing(kind)) return fields;
  auto* friction = new QuantityEdit(Quantity::kNumber, settings, fields);
  friction->setRange(0, kMostFriction);
  friction->setValue(friction_);
  addRow(form, tr("&Friction"), friction, "handFriction",
         tr("Coulomb's coefficient; 0: it slides freely"));
  connect(friction, &QuantityEdit::edited, this, &HandOptions::setFriction);
  return fields;
}

}  // namespace palpa::gui

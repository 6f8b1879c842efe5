#include "app/gui/simulate/exact_touch_options.h"

#include <QGridLayout>

#include "app/gui/widgets/form_row.h"

namespace palpa::gui {
namespace {

constexpr const char* kTipProperty =
    "tip";  // property of a button: its tool tip while it is enabled

}  // namespace

using Direction = ExactTouch::Direction;

ExactTouchOptions::ExactTouchOptions(ExactTouch& touch, Settings& settings,
                                     const std::function<void()>& sweep, QWidget* parent)
    : QWidget(parent),
      touch_(touch),
      form_(new QFormLayout(this)),
      kind_(new QComboBox(this)),
      place_(new VectorEdit(Quantity::kLength, settings, this)),
      direction_(new QComboBox(this)),
      vector_(new VectorEdit(Quantity::kNumber, settings, this)),
      depth_(new QuantityEdit(Quantity::kLength, settings, this)),
      force_(new QuantityEdit(Quantity::kForce, settings, this)),
      radius_(new QuantityEdit(Quantity::kLength, settings, this)),
      friction_(new QuantityEdit(Quantity::kNumber, settings, this)),
      apply_(new QPushButton(tr("&Apply"), this)),
      keep_(new QPushButton(tr("Keep as &pin"), this)),
      store_(new QPushButton(tr("&Store in project"), this)),
      sweep_(new QPushButton(tr("Force–depth &curve …"), this)) {
  form_->setContentsMargins(0, 0, 0, 0);
  makeFields();
  makeButtons(sweep);
  connect(&touch, &ExactTouch::changed, this, &ExactTouchOptions::refresh);
  refresh();
}

void ExactTouchOptions::makeFields() {
  for (const modeling::TouchKindInfo& info : modeling::kTouchKinds)
    kind_->addItem(tr(info.label), static_cast<int>(info.kind));
  addFormRow(form_, tr("&Kind"), kind_, "exactKind",
             tr("A grab moves the place; a fingertip and a ball press, but do not pull, and slide;"
                " a force pulls or presses; a pin holds the place"));
  connect(kind_, &QComboBox::activated, this, [this] {
    touch_.setKind(static_cast<modeling::TouchKind>(kind_->currentData().toInt()));
  });
  addFormRow(form_, tr("P&lace"), place_, "exactPlace",
             tr("On the undeformed surface; a click on the solid sets it"));
  connect(place_, &VectorEdit::edited, &touch_, &ExactTouch::setPlace);
  direction_->addItems({tr("Into the surface"), tr("Out of the surface"), tr("+x"), tr("−x"),
                        tr("+y"), tr("−y"), tr("+z"), tr("−z"), tr("Vector")});
  addFormRow(form_, tr("&Direction"), direction_, "exactDirection",
             tr("Direction of the displacement or force"));
  connect(direction_, &QComboBox::activated, this,
          [this](int index) { touch_.setDirection(static_cast<Direction>(index)); });
  addFormRow(form_, tr("&Vector"), vector_, "exactVector", tr("Direction, of any length"));
  connect(vector_, &VectorEdit::edited, &touch_, &ExactTouch::setVector);
  depth_->setRange(0, 1e6);
  addFormRow(form_, tr("D&epth"), depth_, "exactDepth",
             tr("Displacement along the direction: of a fingertip or ball from first contact, of "
                "a grab from the unloaded shape, of a pin from the present place"));
  connect(depth_, &QuantityEdit::edited, &touch_, &ExactTouch::setDepth);
  force_->setRange(0, 1e9);
  addFormRow(form_, tr("F&orce"), force_, "exactForce", tr("Force along the direction"));
  connect(force_, &QuantityEdit::edited, &touch_, &ExactTouch::setForce);
  radius_->setRange(1e-6, 1e6);
  addFormRow(form_, tr("&Radius"), radius_, "exactRadius",
             tr("Radius of the ball or of the touched disc"));
  connect(radius_, &QuantityEdit::edited, &touch_.options(), &SimulateOptions::setRadius);
  friction_->setRange(0, modeling::kMaxFriction);
  addFormRow(form_, tr("&Friction"), friction_, "exactFriction",
             tr("Coulomb's coefficient; 0 slides freely"));
  connect(friction_, &QuantityEdit::edited, &touch_.options(), &SimulateOptions::setFriction);
}

void ExactTouchOptions::makeButtons(const std::function<void()>& sweep) {
  auto* grid = new QGridLayout;
  const auto add = [&](QPushButton* button, const char* name, const QString& tip, int row,
                       int column) {
    button->setObjectName(name);
    button->setProperty(kTipProperty, tip);
    grid->addWidget(button, row, column);
  };
  add(apply_, "exactApply", tr("Touch the solid with these numbers, instead of the touch before"),
      0, 0);
  add(keep_, "exactKeep", tr("The touch stays while the next one is applied"), 0, 1);
  add(store_, "exactStore", tr("Add the touch to the touches of the project; it can be undone"), 1,
      0);
  add(sweep_, "exactSweep",
      tr("Forces in steps from zero to this depth or force, as a curve and a table"), 1, 1);
  form_->addRow(grid);
  connect(apply_, &QPushButton::clicked, &touch_, &ExactTouch::apply);
  connect(keep_, &QPushButton::clicked, &touch_, &ExactTouch::keep);
  connect(store_, &QPushButton::clicked, &touch_, &ExactTouch::store);
  connect(sweep_, &QPushButton::clicked, this, [sweep] { sweep(); });
}

void ExactTouchOptions::refresh() {
  const modeling::TouchKindInfo& info = modeling::infoOf(touch_.kind());
  kind_->setCurrentIndex(kind_->findData(static_cast<int>(touch_.kind())));
  place_->setValue(touch_.place().value_or(Eigen::Vector3d::Zero()));
  direction_->setCurrentIndex(static_cast<int>(touch_.direction()));
  vector_->setValue(touch_.vector());
  depth_->setValue(touch_.depth());
  force_->setValue(touch_.force());
  radius_->setValue(touch_.radius());
  friction_->setValue(touch_.friction());
  setFormRowVisible(form_, vector_, touch_.direction() == Direction::kVector);
  setFormRowVisible(form_, depth_, !info.isForce);
  setFormRowVisible(form_, force_, info.isForce);
  setFormRowVisible(form_, friction_, info.presses);
  for (QPushButton* button : {apply_, keep_, store_, sweep_}) {
    button->setEnabled(touch_.isComplete());
    button->setToolTip(touch_.isComplete()
                           ? button->property(kTipProperty).toString()
                           : tr("Choose a place first: click the solid, or type its coordinates"));
  }
  if ((info.isForce ? touch_.force() : touch_.depth()) == 0) sweep_->setEnabled(false);
}

}  // namespace palpa::gui

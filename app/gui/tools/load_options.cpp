#include "app/gui/tools/load_options.h"

#include "app/gui/widgets/form_row.h"

namespace palpa::gui {
namespace {

using LoadKind = LoadTool::LoadKind;

}  // namespace

LoadOptions::LoadOptions(LoadTool& tool, Editor& editor, const Settings& settings, QWidget* parent)
    : QWidget(parent),
      tool_(tool),
      editor_(editor),
      settings_(settings),
      form_(new QFormLayout(this)),
      kind_(new QComboBox(this)),
      load_(new ConditionChoice(editor, Selection::Kind::kLoad, tr("New load"), this)),
      strength_(new QuantityEdit(Quantity::kStress, settings, this)),
      traction_(new VectorEdit(Quantity::kStress, settings, this)),
      radius_(new QuantityEdit(Quantity::kLength, settings, this)),
      share_(new QLabel(this)) {
  form_->setContentsMargins(0, 0, 0, 0);
  kind_->addItems({tr("Pressure"), tr("Uniform traction"), tr("Bump")});
  share_->setWordWrap(true);
  addFormRow(
      form_, tr("&Kind"), kind_, "loadKind",
      tr("Pressure acts along the normal, a traction in one direction, a bump around a point"));
  addFormRow(form_, tr("&Load"), load_, "placedLoad", tr("Which load gets the patches"));
  addFormRow(form_, tr("&Strength"), strength_, "loadStrength",
             tr("Positive presses into the body; the peak of a bump"));
  addFormRow(form_, tr("&Traction"), traction_, "loadTraction", tr("Force per area"));
  addFormRow(form_, tr("&Radius"), radius_, "bumpRadius",
             tr("Distance from its middle at which the bump ends"));
  form_->addRow(share_);
  connect(kind_, &QComboBox::activated, this,
          [this](int index) { tool_.setKind(static_cast<LoadKind>(index)); });
  connect(strength_, &QuantityEdit::edited, this, [this](double v) { tool_.setStrength(v); });
  connect(traction_, &VectorEdit::edited, this,
          [this](const Eigen::Vector3d& v) { tool_.setTraction(v); });
  connect(radius_, &QuantityEdit::edited, this, [this](double v) { tool_.setRadius(v); });
  radius_->setRange(1e-9, 1e9);
  connect(&tool, &Tool::changed, this, &LoadOptions::refresh);
  connect(&editor, &Editor::projectReplaced, this, &LoadOptions::refresh);
  connect(&editor, &Editor::projectChanged, this, &LoadOptions::refresh);
  connect(&editor, &Editor::selectionChanged, this, &LoadOptions::refresh);
  refresh();
}

void LoadOptions::refresh() {
  const LoadKind kind = tool_.kind();
  kind_->setCurrentIndex(static_cast<int>(kind));
  load_->refresh(static_cast<std::size_t>(kind));
  strength_->setValue(tool_.strength());
  traction_->setValue(tool_.traction());
  radius_->setValue(tool_.radius());
  setFormRowVisible(form_, strength_, kind != LoadKind::kTraction);
  setFormRowVisible(form_, traction_, kind == LoadKind::kTraction);
  setFormRowVisible(form_, radius_, kind == LoadKind::kBump);
  const double modulus = editor_.project().material.youngsModulus;
  const double most = kind == LoadKind::kTraction ? tool_.traction().norm() : tool_.strength();
  share_->setText(tr("%1 % of Young's modulus (%2)")
                      .arg(100.0 * most / modulus, 0, 'g', 3)
                      .arg(shown(modulus, Quantity::kStress, settings_.units(), 3)));
}

}  // namespace palpa::gui

#include "app/gui/tools/load_options.h"

#include "app/gui/base/appearance.h"
#include "app/gui/widgets/form_row.h"

namespace palpa::gui {

LoadOptions::LoadOptions(LoadTool& tool, Editor& editor, const Settings& settings, QWidget* parent)
    : QWidget(parent),
      tool_(tool),
      editor_(editor),
      settings_(settings),
      form_(new QFormLayout(this)),
      kind_(new QComboBox(this)),
      load_(new ConditionChoice(editor, Selection::Kind::kLoad, tr("New load"), this)),
      strength_(new QuantityEdit(Quantity::kStress, settings, this)),
      radius_(new QuantityEdit(Quantity::kLength, settings, this)),
      earth_(new QPushButton(tr("Earth, −&Z"), this)),
      addGravity_(new QPushButton(tr("&Add gravity"), this)),
      share_(new QLabel(this)) {
  form_->setContentsMargins(0, 0, 0, 0);
  for (const LoadKindInfo& info : loadKinds()) {
    kind_->addItem(icon(info.icon), info.title());
    kind_->setItemData(kind_->count() - 1, info.tip, Qt::ToolTipRole);
  }
  share_->setWordWrap(true);
  addFormRow(form_, tr("&Kind"), kind_, "loadKind",
             tr("Forces per area, forces and moments on patches, a bump around a point, or the "
                "weight of the body"));
  addFormRow(form_, tr("&Load"), load_, "placedLoad", tr("Which load gets the patches"));
  addFormRow(form_, tr("&Strength"), strength_, "loadStrength",
             tr("Positive presses into the body; the peak of a bump"));
  static const std::array<const char*, kLoadKindCount> names{
      "", "loadTraction", "", "loadForce", "loadMoment", "loadAcceleration"};
  for (std::size_t k = 0; k < kLoadKindCount; ++k) {
    const LoadKindInfo& info = loadKinds()[k];
    if (info.vector.isEmpty()) continue;
    vectors_[k] = new VectorEdit(info.quantity, settings, this);
    addFormRow(form_, info.vector, vectors_[k], names[k], info.tip);
    connect(vectors_[k], &VectorEdit::edited, this,
            [this](const Eigen::Vector3d& v) { tool_.setVector(v); });
  }
  addFormRow(form_, tr("&Radius"), radius_, "bumpRadius",
             tr("Distance from its middle at which the bump ends"));
  earth_->setObjectName("earthGravity");
  earth_->setToolTip(tr("Set the acceleration on the Earth's surface, along −z"));
  addGravity_->setObjectName("addGravity");
  addGravity_->setIcon(icon("load-gravity"));
  addGravity_->setToolTip(tr("Give the body its weight"));
  for (QPushButton* button : {earth_, addGravity_}) {
    button->setAutoDefault(false);
    form_->addRow(button);
  }
  form_->addRow(share_);
  connect(kind_, &QComboBox::activated, this,
          [this](int index) { tool_.setKind(static_cast<LoadKind>(index)); });
  connect(strength_, &QuantityEdit::edited, this, [this](double v) { tool_.setStrength(v); });
  connect(radius_, &QuantityEdit::edited, this, [this](double v) { tool_.setRadius(v); });
  connect(earth_, &QPushButton::clicked, this,
          [this] { tool_.setVector(modeling::Gravity{}.accelerationMPerS2); });
  connect(addGravity_, &QPushButton::clicked, this, [this] { tool_.placeGravity(); });
  radius_->setRange(1e-9, 1e9);
  connect(&tool, &Tool::changed, this, &LoadOptions::refresh);
  connect(&editor, &Editor::projectReplaced, this, &LoadOptions::refresh);
  connect(&editor, &Editor::projectChanged, this, &LoadOptions::refresh);
  connect(&editor, &Editor::selectionChanged, this, [this] {
    tool_.followSelection();
    refresh();
  });
  connect(&settings, &Settings::changed, this, &LoadOptions::refresh);
  refresh();
}

void LoadOptions::refresh() {
  const LoadKind kind = tool_.kind();
  const bool isGravity = kind == LoadKind::kGravity;
  kind_->setCurrentIndex(static_cast<int>(kind));
  load_->refresh(static_cast<std::size_t>(kind));
  strength_->setValue(tool_.strength());
  radius_->setValue(tool_.radius());
  for (std::size_t k = 0; k < kLoadKindCount; ++k) {
    if (!vectors_[k]) continue;
    const bool isShown = k == static_cast<std::size_t>(kind);
    setFormRowVisible(form_, vectors_[k], isShown);
    if (isShown) vectors_[k]->setValue(tool_.vector());
  }
  const bool isStress = infoOf(kind).quantity == Quantity::kStress;
  setFormRowVisible(form_, strength_, isStress && kind != LoadKind::kTraction);
  setFormRowVisible(form_, radius_, kind == LoadKind::kBump);
  earth_->setVisible(isGravity);
  addGravity_->setVisible(isGravity && !tool_.target());
  share_->setVisible(isStress);
  if (!isStress) return;
  const double modulus = editor_.project().material.youngsModulus;
  const double most = kind == LoadKind::kTraction ? tool_.vector().norm() : tool_.strength();
  share_->setText(tr("%1 % of Young's modulus (%2)")
                      .arg(100.0 * most / modulus, 0, 'g', 3)
                      .arg(shown(modulus, Quantity::kStress, settings_.units(), 3)));
}

}  // namespace palpa::gui

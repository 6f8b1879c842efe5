#include "app/gui/tools/support_options.h"

#include "app/gui/widgets/form_row.h"

namespace palpa::gui {

SupportOptions::SupportOptions(SupportTool& tool, Editor& editor, const Settings& settings,
                               QWidget* parent)
    : QWidget(parent),
      tool_(tool),
      brush_(new QComboBox(this)),
      support_(new ConditionChoice(editor, Selection::Kind::kSupport, tr("New support"), this)),
      kind_(new QComboBox(this)),
      radius_(new QuantityEdit(Quantity::kLength, settings, this)) {
  auto* form = new QFormLayout(this);
  form->setContentsMargins(0, 0, 0, 0);
  brush_->addItems({tr("Patches"), tr("Brush")});
  kind_->addItems({tr("Fixed"), tr("Roller")});
  addFormRow(form, tr("Paint &with"), brush_, "paintWay",
             tr("Whole patches, or a round brush for any part of the surface"));
  addFormRow(form, tr("&Support"), support_, "paintedSupport", tr("Which support is painted"));
  addFormRow(form, tr("&Kind"), kind_, "supportKind",
             tr("Fixed: no displacement; roller: the surface slides along itself"));
  addFormRow(form, tr("Brush &radius"), radius_, "brushRadius",
             tr("Distance from the pointer up to which the surface is painted ([ and ])"));
  connect(brush_, &QComboBox::activated, this,
          [this](int index) { tool_.setBrush(static_cast<SupportTool::Brush>(index)); });
  connect(kind_, &QComboBox::activated, this,
          [this](int index) { tool_.setKind(static_cast<modeling::Support::Kind>(index)); });
  connect(radius_, &QuantityEdit::edited, this, [this](double radius) { tool_.setRadius(radius); });
  connect(&tool, &Tool::changed, this, &SupportOptions::refresh);
  connect(&editor, &Editor::projectReplaced, this, &SupportOptions::refresh);
  connect(&editor, &Editor::projectChanged, this, &SupportOptions::refresh);
  connect(&editor, &Editor::selectionChanged, this, &SupportOptions::refresh);
  refresh();
}

void SupportOptions::refresh() {
  brush_->setCurrentIndex(static_cast<int>(tool_.brush()));
  support_->refresh();
  kind_->setCurrentIndex(static_cast<int>(tool_.kind()));
  radius_->setRange(1e-9, 1e9);
  if (!radius_->hasFocus()) radius_->setValue(tool_.radius());
  radius_->setEnabled(tool_.brush() == SupportTool::Brush::kRound);
}

}  // namespace palpa::gui

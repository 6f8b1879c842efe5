#include <QFormLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QVBoxLayout>
#include <cmath>

#include "app/gui/dialogs/profile_dialog.h"
#include "app/gui/widgets/form_row.h"
#include "modeling/shapes/shape_parameters.h"

// The list of sections and the numbers beside the plane of ProfileDialog.

namespace palpa::gui {

using Eigen::Vector2d;
using modeling::ProfileSketch;
using modeling::SketchUse;

QWidget* ProfileDialog::makeSections() {
  auto* box = new QWidget(this);
  auto* layout = new QVBoxLayout(box);
  layout->setContentsMargins(0, 0, 0, 0);
  sections_ = new QTableWidget(0, 2, box);
  sections_->setObjectName("sections");
  sections_->setAccessibleName(tr("Sections"));
  sections_->setHorizontalHeaderLabels({tr("Section"), tr("Height")});
  sections_->verticalHeader()->hide();
  sections_->horizontalHeader()->setStretchLastSection(true);
  sections_->setSelectionBehavior(QAbstractItemView::SelectRows);
  sections_->setSelectionMode(QAbstractItemView::SingleSelection);
  sections_->setTabKeyNavigation(false);
  sections_->setMinimumHeight(120);
  sections_->setMaximumHeight(170);
  layout->addWidget(sections_);
  auto* row = new QHBoxLayout;
  auto* add = new QPushButton(tr("&Add section"), box);
  removeSection_ = new QPushButton(tr("&Remove section"), box);
  add->setObjectName("addSection");
  removeSection_->setObjectName("removeSection");
  for (QPushButton* button : {add, removeSection_}) {
    button->setAutoDefault(false);
    row->addWidget(button);
  }
  layout->addLayout(row);
  connect(add, &QPushButton::clicked, this, [this] { editor_.addSection(); });
  connect(removeSection_, &QPushButton::clicked, this, [this] { editor_.removeSection(); });
  connect(sections_, &QTableWidget::currentCellChanged, this, [this](int section) {
    if (!isRefreshing_ && section >= 0) editor_.setSection(section);
  });
  connect(sections_, &QTableWidget::itemChanged, this, [this](QTableWidgetItem* item) {
    if (isRefreshing_ || item->column() != 1) return;
    const auto height = parsed(item->text(), Quantity::kLength, settings_.units());
    if (height && std::abs(*height) <= modeling::kMaxLength)
      editor_.setHeight(item->row(), *height);
    else
      refreshSections();
  });
  return box;
}

QWidget* ProfileDialog::makeNumbers() {
  const bool isRevolve = editor_.use() == SketchUse::kRevolve;
  auto* box = new QWidget(this);
  auto* form = new QFormLayout(box);
  form->setContentsMargins(0, 0, 0, 0);
  selected_->setObjectName("selected");
  form->addRow(selected_);
  const std::array<QString, 2> names{isRevolve ? tr("r:") : tr("x:"),
                                     isRevolve ? tr("z:") : tr("y:")};
  for (int axis : {0, 1}) {
    coordinates_[axis] = new QuantityEdit(Quantity::kLength, settings_, box);
    coordinates_[axis]->setRange(-modeling::kMaxLength, modeling::kMaxLength);
    addFormRow(form, names[axis], coordinates_[axis], axis == 0 ? "x" : "y",
               tr("Coordinate of the selected points"));
    connect(coordinates_[axis], &QuantityEdit::edited, this,
            [this, axis](double value) { setCoordinate(axis, value); });
  }
  corner_->setObjectName("corner");
  corner_->setToolTip(
      tr("The curve passes through a corner and may bend there (C); a smooth point "
         "attracts it. A double click on a point changes it."));
  form->addRow(QString(), corner_);
  connect(corner_, &QCheckBox::clicked, this, [this] { editor_.toggleCorners(); });
  auto* toggle = new QAction(this);
  toggle->setShortcut(Qt::Key_C);
  connect(toggle, &QAction::triggered, this, [this] { editor_.toggleCorners(); });
  addAction(toggle);
  const std::array<QString, 2> sizes{isRevolve ? tr("Outer radius:") : tr("Curve width:"),
                                     isRevolve ? tr("Height:") : tr("Curve depth:")};
  for (int axis : {0, 1}) {
    extents_[axis] = new QuantityEdit(Quantity::kLength, settings_, box);
    extents_[axis]->setRange(modeling::kMinLength, modeling::kMaxLength);
    extents_[axis]->setNarrow();
    addFormRow(form, sizes[axis], extents_[axis], axis == 0 ? "width" : "depth",
               tr("Size of the whole curve; a new one stretches it"));
    connect(extents_[axis], &QuantityEdit::edited, this,
            [this, axis](double value) { editor_.setExtent(axis, value); });
  }
  box->setMaximumWidth(340);
  return box;
}

void ProfileDialog::setCoordinate(int axis, double value) {
  editor_.edit(tr("Move points"), [&](ProfileSketch& sketch) {
    for (int point : editor_.selection()) {
      Vector2d by = Vector2d::Zero();
      by[axis] = value - sketch.points()[point].at[axis];
      sketch.move({point}, by);
    }
  });
}

void ProfileDialog::refreshSections() {
  if (!sections_) return;
  isRefreshing_ = true;
  const auto& sections = editor_.sections();
  sections_->setRowCount(static_cast<int>(sections.size()));
  for (int i = 0; i < sections_->rowCount(); ++i) {
    const QString name = tr("Section %1").arg(i + 1);
    const QString height =
        shown(sections[static_cast<std::size_t>(i)].z, Quantity::kLength, settings_.units(), 8);
    for (int column : {0, 1}) {
      QTableWidgetItem* item = sections_->item(i, column);
      if (!item) {
        item = new QTableWidgetItem;
        if (column == 0) item->setFlags(item->flags() & ~Qt::ItemIsEditable);
        sections_->setItem(i, column, item);
      }
      item->setText(column == 0 ? name : height);
    }
  }
  if (sections_->currentRow() != editor_.sectionIndex())
    sections_->setCurrentCell(editor_.sectionIndex(), std::max(0, sections_->currentColumn()));
  removeSection_->setEnabled(sections.size() > 2);
  isRefreshing_ = false;
}

}  // namespace palpa::gui

#include "app/gui/docks/samples_dock.h"

#include <QApplication>
#include <QClipboard>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QMessageBox>
#include <QScrollBar>
#include <QVBoxLayout>

#include "app/core/results/section_file.h"
#include "app/gui/simulate/sample_words.h"
#include "base/atomic_file.h"
#include "modeling/error.h"

namespace palpa::gui {
namespace {

constexpr int kButtonMargin = 16;  // px, left and right of the text

}  // namespace

SamplesDock::SamplesDock(Samples& samples, SectionView& section, Settings& settings,
                         QWidget* parent)
    : QDockWidget(tr("Samples"), parent),
      samples_(samples),
      section_(section),
      settings_(settings),
      table_(new QTableWidget(this)),
      hint_(new QLabel(
          tr("No samples. In Simulate mode (F5), choose Sample (I) and click on the body or the "
             "section: their fields appear here."),
          this)),
      copy_(new QPushButton(tr("&Copy"), this)),
      save_(new QPushButton(tr("&Save …"), this)),
      remove_(new QPushButton(tr("&Remove"), this)),
      saveSection_(new QPushButton(tr("Save sec&tion …"), this)) {
  setObjectName("samples");
  table_->setObjectName("samplesTable");
  table_->setAccessibleName(tr("Fields at the pinned samples"));
  // The number of a sample stays in view while its column is scrolled to.
  table_->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  table_->verticalHeader()->setHighlightSections(false);  // bold names are wider
  table_->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setSelectionBehavior(QAbstractItemView::SelectColumns);
  table_->setSelectionMode(QAbstractItemView::SingleSelection);
  table_->installEventFilter(this);
  copy_->setObjectName("copySamples");
  copy_->setToolTip(tr("Copy the table as comma-separated values"));
  save_->setObjectName("saveSamples");
  save_->setToolTip(tr("Write the table as a .csv file"));
  remove_->setObjectName("removeSample");
  remove_->setToolTip(tr("Remove the selected sample (Delete)"));
  saveSection_->setObjectName("saveSection");
  saveSection_->setToolTip(tr("Write the fields of the section as a table or mesh"));
  auto* buttons = new QHBoxLayout;
  for (QPushButton* button : {copy_, save_, remove_, saveSection_}) {
    // Four in a narrow panel: each as wide as its text needs.
    button->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    buttons->addWidget(button,
                       button->fontMetrics().horizontalAdvance(button->text()) + kButtonMargin);
  }
  hint_->setObjectName("samplesHint");
  hint_->setWordWrap(true);
  hint_->setAlignment(Qt::AlignCenter);
  hint_->setForegroundRole(QPalette::PlaceholderText);
  auto* content = new QWidget(this);
  auto* layout = new QVBoxLayout(content);
  layout->setContentsMargins(4, 4, 4, 4);
  layout->addWidget(table_);
  layout->addWidget(hint_, 1);
  layout->addLayout(buttons);
  setWidget(content);
  connect(copy_, &QPushButton::clicked, this, &SamplesDock::copy);
  connect(save_, &QPushButton::clicked, this, &SamplesDock::save);
  connect(remove_, &QPushButton::clicked, &samples_, &Samples::removeSelected);
  connect(saveSection_, &QPushButton::clicked, this, &SamplesDock::saveSection);
  connect(table_, &QTableWidget::itemSelectionChanged, this, [this] {
    if (!isFilling_) samples_.select(table_->currentColumn());
  });
  connect(&samples, &Samples::changed, this, &SamplesDock::showSamples);
  connect(&section, &SectionView::updated, this, &SamplesDock::showSamples);
  connect(&section, &SectionView::changed, this, &SamplesDock::showSamples);
  showSamples();
}

void SamplesDock::showSamples() {
  isFilling_ = true;
  const std::vector<app::PointSample>& values = samples_.values();
  table_->setColumnCount(static_cast<int>(values.size()));
  for (std::size_t column = 0; column < values.size(); ++column) {
    const std::vector<SampleRow> rows = sampleRows(values[column], settings_.units());
    if (table_->rowCount() != static_cast<int>(rows.size()))
      table_->setRowCount(static_cast<int>(rows.size()));
    for (std::size_t row = 0; row < rows.size(); ++row) {
      const int r = static_cast<int>(row), c = static_cast<int>(column);
      if (!table_->verticalHeaderItem(r) || table_->verticalHeaderItem(r)->text() != rows[row].name)
        table_->setVerticalHeaderItem(r, new QTableWidgetItem(rows[row].name));
      if (!table_->item(r, c)) table_->setItem(r, c, new QTableWidgetItem);
      if (table_->item(r, c)->text() != rows[row].value)
        table_->item(r, c)->setText(rows[row].value);
    }
  }
  if (values.empty()) table_->setRowCount(0);
  table_->setHidden(values.empty());
  hint_->setVisible(values.empty());
  table_->resizeColumnsToContents();
  table_->verticalHeader()->setDefaultSectionSize(table_->fontMetrics().height() + 6);
  if (samples_.selected() >= 0 && samples_.selected() < table_->columnCount())
    showSelected();
  else
    table_->clearSelection();
  for (QPushButton* button : {copy_, save_, remove_}) button->setEnabled(!values.empty());
  saveSection_->setEnabled(section_.isShown() && !section_.states().empty());
  isFilling_ = false;
}

void SamplesDock::showSelected() {
  const int column = samples_.selected();
  if (table_->currentColumn() == column && table_->selectionModel()->isColumnSelected(column, {}))
    return;
  table_->selectColumn(column);
  // A column wider than the panel shows its beginning.
  table_->horizontalScrollBar()->setValue(table_->horizontalHeader()->sectionPosition(column));
}

void SamplesDock::copy() const {
  QApplication::clipboard()->setText(sampleTable(samples_.values()));
}

void SamplesDock::save() {
  const QString table = sampleTable(samples_.values());
  const QString file = QFileDialog::getSaveFileName(
      this, tr("Save samples"), settings_.lastFolder() + "/samples.csv", tr("Tables (*.csv)"));
  if (file.isEmpty()) return;
  try {
    replaceFile(table.toStdString(), file.toStdString());
  } catch (const FileError& error) {
    QMessageBox::warning(this, tr("Save samples"), QString::fromStdString(error.what()));
  }
}

void SamplesDock::saveSection() {
  const auto section = section_.section();
  const std::vector<bem::InteriorState> states = section_.states();
  if (!section) return;
  const QString file = QFileDialog::getSaveFileName(
      this, tr("Save section"), settings_.lastFolder() + "/section.csv",
      tr("Tables (*.csv);;Meshes with fields (*.vtp)"));
  if (file.isEmpty()) return;
  try {
    app::writeSection(*section, states, file.toStdString());
  } catch (const Error& error) {
    QMessageBox::warning(this, tr("Save section"), QString::fromStdString(error.what()));
  }
}

bool SamplesDock::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::KeyPress) return QDockWidget::eventFilter(watched, event);
  const auto* key = static_cast<QKeyEvent*>(event);
  if (key->key() == Qt::Key_Delete) {
    samples_.removeSelected();
    return true;
  }
  if (key->matches(QKeySequence::Copy)) {
    copy();
    return true;
  }
  return QDockWidget::eventFilter(watched, event);
}

}  // namespace palpa::gui

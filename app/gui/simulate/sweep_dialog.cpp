#include "app/gui/simulate/sweep_dialog.h"

#include <QClipboard>
#include <QFileInfo>
#include <QFormLayout>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QSplitter>
#include <QVBoxLayout>
#include <cmath>
#include <sstream>

#include "app/core/results/state_series.h"
#include "app/core/system/priority.h"
#include "app/gui/base/appearance.h"
#include "app/gui/base/background_job.h"
#include "app/gui/dialogs/file_dialogs.h"
#include "app/gui/document/editor.h"
#include "app/gui/document/force_words.h"
#include "app/gui/widgets/form_row.h"
#include "base/atomic_file.h"
#include "bem/base/error.h"

namespace palpa::gui {
namespace {

constexpr int kSteps = 20;  // at first
constexpr int kTableDigits = 4;
constexpr int kColumns = 6;
constexpr int kWidth = 640, kHeight = 640;  // px
constexpr int kPlotHeight = 270, kTableHeight = 230;

}  // namespace

SweepDialog::SweepDialog(const Workspace& workspace, std::shared_ptr<const app::TouchModel> model,
                         modeling::Touch touch)
    : QDialog(&workspace.window),
      workspace_(workspace),
      model_(std::move(model)),
      touch_(std::move(touch)),
      most_(new QuantityEdit(
          modeling::infoOf(touch_.kind).isForce ? Quantity::kForce : Quantity::kLength,
          workspace.settings, this)),
      steps_(new QSpinBox(this)),
      start_(new QPushButton(tr("&Compute"), this)),
      progress_(new QProgressBar(this)),
      plot_(new PlotWidget(this)),
      table_(new QTableWidget(0, kColumns, this)),
      message_(new QLabel(this)),
      copy_(new QPushButton(tr("C&opy table"), this)),
      save_(new QPushButton(tr("&Export …"), this)),
      worker_(app::lowerThreadPriority) {
  const modeling::TouchKindInfo& info = modeling::infoOf(touch_.kind);
  setWindowTitle(tr("Force–depth curve: %1").arg(tr(info.label)));
  setObjectName("sweep");
  resize(kWidth, kHeight);
  auto* form = new QFormLayout;
  most_->setRange(1e-9, 1e9);
  most_->setValue(touch_.vector.norm());
  addFormRow(form, info.isForce ? tr("From zero to &force:") : tr("From zero to &depth:"), most_,
             "sweepMost");
  steps_->setRange(1, app::kMaxSweepSteps);
  steps_->setValue(kSteps);
  addFormRow(form, tr("&Steps:"), steps_, "sweepSteps",
             tr("Each state is a separate touch from first contact on, so the curve is one of "
                "loading"));
  auto* controls = new QHBoxLayout;
  start_->setObjectName("sweepStart");
  start_->setDefault(true);
  progress_->setObjectName("sweepProgress");
  progress_->setAccessibleName(tr("Progress of the curve"));
  progress_->setRange(0, 1000);
  progress_->setTextVisible(false);
  controls->addWidget(start_);
  controls->addWidget(progress_, 1);
  plot_->setPlaceholder(tr("Compute draws the force over the depth here."));
  table_->setObjectName("sweepTable");
  table_->setAccessibleName(tr("States of the curve"));
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->verticalHeader()->hide();
  table_->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  message_->setObjectName("sweepMessage");
  message_->setWordWrap(true);
  message_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  message_->hide();
  copy_->setObjectName("sweepCopy");
  save_->setObjectName("sweepExport");
  copy_->setToolTip(tr("Copy the table for a spreadsheet"));
  save_->setToolTip(tr("Write all figures as a table, or the states as meshes for ParaView"));
  auto* close = new QPushButton(tr("Close"), this);
  for (QPushButton* button : {copy_, save_, close}) button->setAutoDefault(false);
  auto* buttons = new QHBoxLayout;
  buttons->addWidget(copy_);
  buttons->addWidget(save_);
  buttons->addStretch();
  buttons->addWidget(close);
  auto* splitter = new QSplitter(Qt::Vertical, this);
  splitter->addWidget(plot_);
  splitter->addWidget(table_);
  splitter->setChildrenCollapsible(false);
  splitter->setSizes({kPlotHeight, kTableHeight});
  auto* column = new QVBoxLayout(this);
  column->addLayout(form);
  column->addLayout(controls);
  column->addWidget(message_);
  column->addWidget(splitter, 1);
  column->addLayout(buttons);
  connect(start_, &QPushButton::clicked, this, [this] { isRunning_ ? stop() : run(); });
  connect(copy_, &QPushButton::clicked, this, &SweepDialog::copy);
  connect(save_, &QPushButton::clicked, this, &SweepDialog::save);
  connect(close, &QPushButton::clicked, this, [this] {
    stop();
    QDialog::reject();
  });
  connect(&workspace_.settings, &Settings::changed, this, &SweepDialog::showUnits);
  showUnits();
  showButtons();
}

SweepDialog::~SweepDialog() {
  worker_.cancel();
  worker_.waitUntilIdle();
}

void SweepDialog::reject() {
  if (isRunning_)
    stop();
  else
    QDialog::reject();
}

QString SweepDialog::stoppedText() {
  return tr("Stopped. The states so far are listed.");
}

void SweepDialog::run() {
  rows_.clear();
  table_->setRowCount(0);
  message_->hide();
  progress_->setValue(0);
  isRunning_ = true;
  const std::uint64_t number = ++run_;
  modeling::Touch touch = touch_;
  touch.vector = most_->value() * touch_.vector.stableNormalized();
  worker_.replace([this, number, touch, steps = steps_->value(),
                   model = model_](const std::stop_token& stopped) {
    // Reports of earlier runs arrive after the next one has begun.
    const auto report = [this, number](auto act) {
      QMetaObject::invokeMethod(
          this,
          [this, number, act = std::move(act)] {
            if (number == run_) act();
          },
          Qt::QueuedConnection);
    };
    Job job;
    job.stop = stopped;
    job.progress = [&](Phase, double done) {
      report([this, done] { progress_->setValue(static_cast<int>(1000 * done)); });
    };
    QString message;
    try {
      app::sweepTouches(*model, std::span(&touch, 1), steps, 0, job, [&](app::SweepRow row) {
        report([this, row = std::move(row)] { add(row); });
      });
    } catch (const Cancelled&) {
      message = stoppedText();
    } catch (const bem::SolverError& error) {
      message = QString::fromStdString(error.what());
      message[0] = message[0].toUpper();
    } catch (const std::bad_alloc&) {
      message = tr("There is not enough memory for the curve. Close other programs.");
    }
    report([this, message] { finish(message); });
  });
  showButtons();
}

void SweepDialog::stop() {
  // A run that the thread has not begun yet is dropped without a report: this one comes always.
  worker_.replace([this, number = run_](const std::stop_token&) {
    QMetaObject::invokeMethod(
        this,
        [this, number] {
          if (number == run_ && isRunning_) finish(stoppedText());
        },
        Qt::QueuedConnection);
  });
}

void SweepDialog::add(const app::SweepRow& row) {
  rows_.push_back(row);
  table_->setRowCount(static_cast<int>(rows_.size()));
  showRow(static_cast<int>(rows_.size()) - 1);
  showPlot();
  showButtons();
}

void SweepDialog::finish(const QString& message) {
  isRunning_ = false;
  message_->setText(message);
  message_->setVisible(!message.isEmpty());
  if (message.isEmpty()) progress_->setValue(progress_->maximum());
  showButtons();
}

double SweepDialog::given(const app::SweepRow& row) const {
  const bool isForce = modeling::infoOf(touch_.kind).isForce;
  const auto quantity = isForce ? Quantity::kForce : Quantity::kLength;
  return row.touches.front().vector.norm() / workspace_.settings.units().of(quantity).factor;
}

void SweepDialog::showUnits() {
  const Unit& length = workspace_.settings.units().of(Quantity::kLength);
  const Unit& force = workspace_.settings.units().of(Quantity::kForce);
  const bool isForce = modeling::infoOf(touch_.kind).isForce;
  table_->setHorizontalHeaderLabels(
      {isForce ? tr("Given, %1").arg(force.symbol) : tr("Depth, %1").arg(length.symbol),
       tr("Force, %1").arg(force.symbol), tr("Normal force, %1").arg(force.symbol),
       tr("Deflection, %1").arg(length.symbol),
       tr("Stiffness, %1/%2").arg(force.symbol, length.symbol), tr("State")});
  plot_->setHorizontalTitle((isForce ? tr("given force, %1") : tr("depth, %1"))
                                .arg(isForce ? force.symbol : length.symbol));
  for (int k = 0; k < static_cast<int>(rows_.size()); ++k) showRow(k);
  showPlot();
}

void SweepDialog::showRow(int index) {
  const app::SweepRow& row = rows_[static_cast<std::size_t>(index)];
  const app::TouchState::Contact& contact = row.contacts.front();
  const Unit& length = workspace_.settings.units().of(Quantity::kLength);
  const Unit& force = workspace_.settings.units().of(Quantity::kForce);
  const auto number = [](double value) {
    return QString::number(std::abs(value) < 1e-12 ? 0.0 : value, 'g', kTableDigits);
  };
  const std::array<QString, kColumns> texts{
      number(given(row)),
      number(contact.force.norm() / force.factor),
      number(contact.normalForce() / force.factor),
      number(contact.deflection.norm() / length.factor),
      contact.stiffness > 0 ? number(contact.stiffness * length.factor / force.factor)
                            : QString("–"),
      statusText(contact.status)};
  for (int column = 0; column < kColumns; ++column) {
    auto* item = new QTableWidgetItem(texts[static_cast<std::size_t>(column)]);
    item->setTextAlignment((column + 1 < kColumns ? Qt::AlignRight : Qt::AlignLeft) |
                           Qt::AlignVCenter);
    table_->setItem(index, column, item);
  }
}

void SweepDialog::showPlot() {
  const Unit& force = workspace_.settings.units().of(Quantity::kForce);
  view::ForcePlot::Curve all{"force", 0, {}, {}}, normal{"normal force", 1, {}, {}};
  for (const app::SweepRow& row : rows_) {
    all.times.push_back(given(row));
    all.forces.push_back(row.contacts.front().force.norm() / force.factor);
    normal.times.push_back(all.times.back());
    normal.forces.push_back(std::max(0.0, row.contacts.front().normalForce() / force.factor));
  }
  const Quantity quantity =
      modeling::infoOf(touch_.kind).isForce ? Quantity::kForce : Quantity::kLength;
  const double end = most_->value() / workspace_.settings.units().of(quantity).factor;
  const bool hasTwo = touch_.friction > 0;
  plot_->setLegendShown(hasTwo);
  plot_->setCurves(hasTwo ? std::vector{all, normal} : std::vector{all}, 0, end,
                   force.symbol.toStdString());
}

void SweepDialog::showButtons() {
  start_->setText(isRunning_ ? tr("&Stop") : tr("&Compute"));
  most_->setEnabled(!isRunning_);
  steps_->setEnabled(!isRunning_);
  copy_->setEnabled(!rows_.empty());
  save_->setEnabled(!rows_.empty() && !isRunning_);
}

void SweepDialog::copy() {
  QStringList lines;
  QStringList header;
  for (int column = 0; column < table_->columnCount(); ++column)
    header << table_->horizontalHeaderItem(column)->text();
  lines << header.join('\t');
  for (int row = 0; row < table_->rowCount(); ++row) {
    QStringList cells;
    for (int column = 0; column < table_->columnCount(); ++column)
      cells << table_->item(row, column)->text();
    lines << cells.join('\t');
  }
  QGuiApplication::clipboard()->setText(lines.join('\n') + '\n');
}

void SweepDialog::save() {
  const QString file = askFileToWrite(
      workspace_, tr("Export the curve"),
      {{tr("Tables (*.csv)"), ".csv"}, {tr("Series of meshes for ParaView (*.pvd)"), ".pvd"}});
  if (file.isEmpty()) return;
  try {
    if (file.endsWith(".pvd", Qt::CaseInsensitive)) {
      const bool isDone = runWorkInBackground(
          *this, tr("Exporting %1").arg(QFileInfo(file).fileName()), [&](const Job& job) {
            app::writeSweepSeries(*model_, rows_, 0, file.toStdString(), job);
          });
      if (!isDone) return;
    } else {
      std::ostringstream text;
      app::writeSweep(rows_, text);
      replaceFile(text.str(), file.toStdString());
    }
    Q_EMIT workspace_.editor.said(tr("Curve exported to %1").arg(file));
  } catch (const Error& error) {
    finish(QString::fromStdString(error.what()));
  }
}

}  // namespace palpa::gui

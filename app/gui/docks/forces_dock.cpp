#include "app/gui/docks/forces_dock.h"

#include <Eigen/Geometry>
#include <QHeaderView>
#include <QKeyEvent>
#include <QMenu>
#include <QSplitter>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <map>

#include "app/core/results/error_estimate.h"
#include "app/gui/docks/accuracy_panel.h"
#include "app/gui/document/accuracy_words.h"
#include "app/gui/document/force_words.h"
#include "app/gui/document/rebuild_words.h"

namespace palpa::gui {
namespace {

constexpr int kTableInterval = 80;  // ms between two updates: faster changes cannot be read
constexpr int kFewDigits = 3;       // in narrow columns
constexpr int kColumns = 4;
constexpr int kContactRole = Qt::UserRole, kCurveRole = Qt::UserRole + 1;
constexpr int kSwatch = 10;          // px, colour sample of a curve
constexpr int kMinRows = 3;          // of contacts, with two lines each
constexpr int kMinPlotHeight = 120;  // px: fewer leave no room for the curves between the axes
/// Motion by loads and other contacts, over the whole motion, that the panel mentions.
constexpr double kOtherMotion = 0.02;
constexpr double kNoEnergy = 1e-12;   // mJ: less is a rounding error
constexpr double kLargeMotion = 0.1;  // of the body's size: limit of the linear model

using Status = app::TouchSnapshot::Status;

/// Diagonal of the body's box, mm.
double sizeOf(const app::DrawnBody& body) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& place : body.mesh().positions) box.extend(place);
  return box.diagonal().norm();
}

/// Square in the colour of a curve.
QIcon swatch(int curve) {
  const auto [red, green, blue] = view::ForcePlot::colour(curve);
  QPixmap spot(kSwatch, kSwatch);
  spot.fill(QColor(red, green, blue));
  return spot;
}

}  // namespace

ForcesDock::ForcesDock(Simulation& simulation, Editor& editor, Settings& settings, QWidget* parent)
    : QDockWidget(tr("Forces"), parent),
      simulation_(simulation),
      editor_(editor),
      settings_(settings),
      list_(new QTreeWidget(this)),
      summary_(new QLabel(this)),
      plot_(new PlotWidget(this)),
      accuracy_(new AccuracyPanel(editor, "forcesAccuracy", true, this)) {
  setObjectName("forces");
  list_->setObjectName("contacts");
  list_->setAccessibleName(tr("Forces of contacts and supports"));
  list_->setRootIsDecorated(false);
  list_->setUniformRowHeights(true);
  list_->setItemsExpandable(false);
  list_->setIndentation(12);
  list_->setSelectionMode(QAbstractItemView::SingleSelection);
  list_->setHeaderLabels({tr("Contact"), tr("Force"), tr("Deflection"), tr("Stiffness")});
  QTreeWidgetItem* header = list_->headerItem();
  const std::array<QString, kColumns> tips{
      tr("Contacts, loads and supports; Delete ends the selected contact"),
      tr("Force on the body: its magnitude; the line below has its components"),
      tr("How far the force of this contact alone moves its place: without loads and the forces "
         "of other contacts, which can move it farther"),
      tr("Force divided by deflection")};
  for (int column = 0; column < kColumns; ++column) header->setToolTip(column, tips[column]);
  // Columns fit the panel; components have a separate line.
  list_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  list_->header()->setStretchLastSection(false);
  list_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  list_->header()->setMinimumSectionSize(20);
  for (int column = 1; column < kColumns; ++column)
    list_->headerItem()->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
  list_->setIconSize({kSwatch, kSwatch});
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list_->setMinimumHeight(kMinRows * 2 * list_->fontMetrics().lineSpacing());
  list_->installEventFilter(this);
  list_->setContextMenuPolicy(Qt::CustomContextMenu);
  list_->setToolTip(tr("Delete ends the selected contact"));
  connect(list_, &QWidget::customContextMenuRequested, this, &ForcesDock::showMenu);
  plot_->setPlaceholder(tr("Touch the solid: the force of each contact over the last %1 seconds is "
                           "drawn here.")
                            .arg(ForceHistory::kSeconds));
  summary_->setObjectName("forcesSummary");
  summary_->setWordWrap(true);
  summary_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  summary_->setToolTip(tr(
      "Balance: the sum of all forces on the body, over the largest; an estimate of the error, as "
      "the exact sum is zero."));
  auto* content = new QWidget(this);
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins(0, 0, 0, 6);
  auto* splitter = new QSplitter(Qt::Vertical, content);
  splitter->setObjectName("forcesSplitter");
  splitter->addWidget(list_);
  splitter->addWidget(plot_);
  splitter->setStretchFactor(0, 3);
  splitter->setStretchFactor(1, 1);
  splitter->setCollapsible(0, false);
  plot_->setMinimumHeight(kMinPlotHeight);
  splitter->restoreState(settings.forcesSplitter());
  connect(splitter, &QSplitter::splitterMoved, this,
          [this, splitter, &settings] { settings.setForcesSplitter(splitter->saveState()); });
  column->addWidget(splitter, 1);
  column->addWidget(summary_);
  column->addWidget(accuracy_);
  summary_->setContentsMargins(10, 0, 10, 0);
  accuracy_->setContentsMargins(10, 0, 10, 0);
  setWidget(content);
  soon_.setSingleShot(true);
  soon_.setInterval(kTableInterval);
  connect(&soon_, &QTimer::timeout, this, &ForcesDock::showForces);
  const auto showSoon = [this] {
    if (!soon_.isActive()) soon_.start();
  };
  connect(&simulation, &Simulation::framed, this, [this, showSoon] {
    history_.add(simulation_.snapshot());
    showSoon();
  });
  connect(&simulation, &Simulation::activeChanged, this, [this, showSoon] {
    history_.clear();
    numbers_.clear();
    showSoon();
  });
  connect(&simulation, &Simulation::bodyChanged, this,
          [this] { bodySize_ = simulation_.drawn() ? sizeOf(*simulation_.drawn()) : 0; });
  connect(&simulation, &Simulation::waitingChanged, this, showSoon);
  connect(&settings, &Settings::changed, this, showSoon);
  showForces();
}

int ForcesDock::numberOf(app::TouchId contact) {
  if (const auto known = numbers_.find(contact); known != numbers_.end()) return known->second;
  int highest = 0;
  for (const auto& [id, number] : numbers_) highest = std::max(highest, number);
  return numbers_[contact] = highest + 1;
}

QString ForcesDock::text(int row, int column) const {
  const QTreeWidgetItem* item = list_->topLevelItem(row);
  return item ? item->text(column) : QString();
}

QString ForcesDock::details(int row) const {
  const QTreeWidgetItem* item = list_->topLevelItem(row);
  return item && item->childCount() > 0 ? item->child(0)->text(0) : QString();
}

void ForcesDock::fillRow(int row, const Row& filled) {
  while (list_->topLevelItemCount() <= row) {
    auto* item = new QTreeWidgetItem(list_);
    for (int column = 1; column < kColumns; ++column)
      item->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
    auto* below = new QTreeWidgetItem(item);
    below->setFlags(Qt::ItemIsEnabled);
    below->setFirstColumnSpanned(true);
    below->setForeground(0, palette().color(QPalette::PlaceholderText));
    item->setExpanded(true);
  }
  QTreeWidgetItem* item = list_->topLevelItem(row);
  const auto set = [](QTreeWidgetItem* of, int column, const QString& text) {
    if (of->text(column) == text) return;
    of->setText(column, text);
    of->setToolTip(column, text);  // for narrow columns
  };
  for (int column = 0; column < filled.cells.size(); ++column)
    set(item, column, filled.cells[column]);
  set(item->child(0), 0, filled.details);
  item->child(0)->setHidden(filled.details.isEmpty());
  if (item->data(0, kCurveRole) != filled.curve) {
    item->setData(0, kCurveRole, filled.curve);
    item->setIcon(0, filled.curve < 0 ? QIcon() : swatch(filled.curve));
  }
  item->setData(0, kContactRole, QVariant::fromValue<qulonglong>(filled.contact));
  item->setFlags(filled.contact ? Qt::ItemIsEnabled | Qt::ItemIsSelectable : Qt::ItemIsEnabled);
}

void ForcesDock::endSelected() {
  for (const QTreeWidgetItem* item : list_->selectedItems()) {
    const auto contact = item->data(0, kContactRole).toULongLong();
    if (contact) simulation_.end(contact);
  }
  list_->clearSelection();
}

bool ForcesDock::eventFilter(QObject* watched, QEvent* event) {
  const bool isKey = event->type() == QEvent::KeyPress || event->type() == QEvent::ShortcutOverride;
  if (watched != list_ || !isKey || list_->selectedItems().isEmpty() ||
      !static_cast<QKeyEvent*>(event)->matches(QKeySequence::Delete))
    return QDockWidget::eventFilter(watched, event);
  // Before Edit > Delete, which acts on the project.
  if (event->type() == QEvent::KeyPress) endSelected();
  event->accept();
  return true;
}

void ForcesDock::showMenu(const QPoint& at) {
  QTreeWidgetItem* item = list_->itemAt(at);
  if (item && item->parent()) item = item->parent();
  if (!simulation_.isActive() || !item || !item->data(0, kContactRole).toULongLong()) return;
  list_->setCurrentItem(item);
  auto* menu = new QMenu(list_);
  menu->setAttribute(Qt::WA_DeleteOnClose);
  menu->addAction(tr("&Release"), QKeySequence(QKeySequence::Delete), this,
                  &ForcesDock::endSelected);
  menu->addAction(tr("Release &all"), &simulation_, &Simulation::endAll);
  menu->popup(list_->viewport()->mapToGlobal(at));
}

void ForcesDock::showPlot() {
  plot_->setVisible(simulation_.isActive());
  const auto& samples = history_.samples();
  if (!plot_->isVisible() || samples.empty()) return;
  std::map<app::TouchId, view::ForcePlot::Curve> curves;
  const Unit& unit = settings_.units().of(Quantity::kForce);
  for (const ForceHistory::Sample& sample : samples)
    for (const auto& [id, force] : sample.forces) {
      curves[id].times.push_back(sample.time);
      curves[id].forces.push_back(force / unit.factor);
    }
  std::vector<view::ForcePlot::Curve> shownCurves;
  for (auto& [id, curve] : curves) {
    curve.number = numberOf(id) - 1;
    curve.name = std::to_string(numberOf(id));
    shownCurves.push_back(std::move(curve));
  }
  std::erase_if(numbers_, [&](const auto& known) { return !curves.contains(known.first); });
  const double end = std::max(samples.back().time, ForceHistory::kSeconds / 3);
  plot_->setCurves(shownCurves, std::max(0.0, end - ForceHistory::kSeconds), end,
                   unit.symbol.toStdString());
}

void ForcesDock::showForces() {
  showPlot();
  const auto rows = [this](int count) {
    while (list_->topLevelItemCount() > count) delete list_->takeTopLevelItem(count);
  };
  if (!simulation_.isActive()) {
    rows(0);
    summary_->setText(tr("Switch to Simulate (F5) to touch the solid and read its forces."));
    return;
  }
  if (!simulation_.drawn()) {
    rows(0);
    summary_->setText(waitingText(editor_.rebuildStatus()));
    return;
  }
  const app::TouchSnapshot& snapshot = simulation_.snapshot();
  int row = 0;
  QStringList nearSupport;
  const Unit& length = settings_.units().of(Quantity::kLength);
  const Unit& force = settings_.units().of(Quantity::kForce);
  const auto forceText = [this](const Eigen::Vector3d& vector) {
    return shown(vector.norm(), Quantity::kForce, settings_.units(), kForceDigits);
  };
  for (const auto& contact : snapshot.touched()) {
    const bool hasForce = contact.status != Status::kWaiting && contact.status != Status::kFixed;
    const double stiffness = contact.stiffness * length.factor / force.factor;
    Row filled;
    filled.contact = contact.id;
    filled.curve = numberOf(contact.id) - 1;
    filled.cells = {
        tr("%1 %2").arg(kindText(contact.tool.kind)).arg(numberOf(contact.id)),
        hasForce ? forceText(contact.force) : tr("–"),
        hasForce
            ? shown(contact.deflection.norm(), Quantity::kLength, settings_.units(), kFewDigits)
            : QString(),
        hasForce && stiffness > 0
            ? tr("%L1 %2/%3").arg(stiffness, 0, 'g', kFewDigits).arg(force.symbol, length.symbol)
            : QString()};
    filled.details = statusText(contact.status);
    if (hasForce) filled.details += ": " + vectorText(contact.force, force);
    // Loads and other contacts also move the place.
    if ((contact.displacement - contact.deflection).norm() >
        kOtherMotion * contact.displacement.norm())
      filled.details += " · " + tr("moved %1")
                                    .arg(shown(contact.displacement.norm(), Quantity::kLength,
                                               settings_.units(), kFewDigits));
    if (hasForce && app::isNearSupport(simulation_.drawn()->model().setup(), contact.point.position,
                                       contact.tool.radius))
      nearSupport << QString::number(numberOf(contact.id));
    fillRow(row++, filled);
  }
  accuracy_->setNote(nearSupport.isEmpty()
                         ? QString()
                         : tr("Contact %1 reaches a support, where forces are less accurate.")
                               .arg(nearSupport.join(", ")));
  QString words;
  if (const auto state = simulation_.describe()) {
    for (const auto& load : simulation_.drawn()->model().setup().loads)
      fillRow(row++, {{tr("Load %1").arg(QString::fromStdString(load.name)),
                       forceText(load.resultant.force), QString(), QString()},
                      tr("acts with") + ": " + vectorText(load.resultant.force, force),
                      0});
    for (const auto& support : state->supports)
      fillRow(row++, {{tr("Support %1").arg(QString::fromStdString(support.name)),
                       forceText(support.resultant.force), QString(), QString()},
                      tr("holds with") + ": " + vectorText(support.resultant.force, force),
                      0});
    words = tr("Energy %L1 mJ · balance %2")
                .arg(state->energy < kNoEnergy ? 0.0 : state->energy, 0, 'g', kForceDigits)
                .arg(percentText(state->relativeBalance));
  }
  rows(row);
  if (!snapshot.isConverged)
    words +=
        "\n" + tr("The laws of contact cannot be met here, as where two touches share one place; "
                  "these forces are a compromise. Move back a little.");
  const app::TouchWorker::Status status = simulation_.columns();
  if (!status.error.empty())
    words += "\n" + QString::fromStdString(status.error);
  else if (snapshot.columnsReady < 1)
    words += "\n" + tr("%L1 % of the surface responds without delay")
                        .arg(100 * snapshot.columnsReady, 0, 'f', 0);
  double moved = 0;
  for (const auto& contact : snapshot.touched())
    moved = std::max(moved, contact.displacement.norm());
  if (moved > kLargeMotion * bodySize_)
    words += "\n" + tr("Large deformation: the linear model only hints at these forces.");
  const std::vector<bool>& supported = simulation_.drawn()->isSupported();
  if (std::find(supported.begin(), supported.end(), false) == supported.end())
    words +=
        "\n" + tr("The supports fix the whole surface, so touches have no force. Erase a part of a "
                  "support, or remove one.");
  if (snapshot.contactCount == 0)
    words += "\n" + (editor_.project().touches.empty()
                         ? tr("Nothing is touched.")
                         : tr("Nothing is touched. T plays the touches of the project."));
  summary_->setText(words.trimmed());
}

}  // namespace palpa::gui

#include "app/gui/docks/search_panel.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "app/gui/base/appearance.h"
#include "app/gui/base/measures.h"
#include "app/gui/document/design_words.h"
#include "app/gui/widgets/scroll_column.h"

namespace palpa::gui {
namespace {

using modeling::DesignTarget;

constexpr int kSearchPlotHeight = 136;  // px
constexpr int kNumberColumns = 4;
constexpr int kRowMargin = 6;   // px
constexpr double kMinAxis = 3;  // of the horizontal axis

/// The newest shape that the search has kept.
const app::ShapeStep* latestOf(const std::vector<app::ShapeStep>& steps) {
  for (auto step = steps.rbegin(); step != steps.rend(); ++step)
    if (step->isAccepted) return &*step;
  return nullptr;
}

bool haveOneKind(const std::vector<DesignTarget>& targets) {
  return std::all_of(targets.begin(), targets.end(), [&](const DesignTarget& target) {
    return target.kind == targets.front().kind;
  });
}

QString volumeChangeText(double before, double after) {
  const double change = 100 * (after / before - 1);
  return QStringLiteral("%1%2 %").arg(change < 0 ? "−" : "+").arg(std::abs(change), 0, 'f', 1);
}

QString volumeRuleText(modeling::Design::Volume rule) {
  switch (rule) {
    case modeling::Design::Volume::kKept:
      return SearchPanel::tr("kept");
    case modeling::Design::Volume::kNotLarger:
      return SearchPanel::tr("not larger");
    case modeling::Design::Volume::kMinimised:
      return SearchPanel::tr("small");
    case modeling::Design::Volume::kFree:
      break;
  }
  return {};
}

}  // namespace

SearchPanel::SearchPanel(ShapeFinder& finder, const Settings& settings, QWidget* parent)
    : QWidget(parent),
      finder_(finder),
      settings_(settings),
      state_(new QLabel(this)),
      details_(new QLabel(this)),
      progress_(new QProgressBar(this)),
      plot_(new PlotWidget(this)),
      numbers_(new QTableWidget(0, kNumberColumns, this)),
      stop_(new QPushButton(icon("cancel"), tr("Stop"), this)),
      accept_(new QPushButton(icon("ok"), tr("Accept"), this)),
      discard_(new QPushButton(tr("Discard"), this)) {
  state_->setObjectName("searchState");
  state_->setWordWrap(true);
  QFont bold = font();
  bold.setWeight(QFont::DemiBold);
  state_->setFont(bold);
  details_->setObjectName("searchDetails");
  details_->setWordWrap(true);
  details_->setTextFormat(Qt::PlainText);
  details_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  progress_->setObjectName("searchProgress");
  progress_->setAccessibleName(tr("Progress of the search"));
  progress_->setRange(0, 100);
  plot_->setObjectName("searchPlot");
  plot_->setAccessibleName(tr("Values of the targets over the steps"));
  plot_->setPlaceholder(tr("Values of the targets over the steps appear here."));
  plot_->setHorizontalTitle(tr("step"));
  plot_->setFitted(true);
  plot_->setCounting(true);
  plot_->setFixedHeight(kSearchPlotHeight);
  plot_->setToolTip(tr("Values over the steps of the search; dashed: what is wanted"));
  numbers_->setObjectName("searchNumbers");
  numbers_->setAccessibleName(tr("Numbers before and after"));
  numbers_->setHorizontalHeaderLabels({{}, tr("Before"), tr("After"), tr("Wanted")});
  numbers_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  numbers_->setSelectionMode(QAbstractItemView::NoSelection);
  numbers_->setFocusPolicy(Qt::NoFocus);
  numbers_->setShowGrid(false);
  numbers_->verticalHeader()->hide();
  numbers_->verticalHeader()->setDefaultSectionSize(fontMetrics().height() + kRowMargin);
  numbers_->setWordWrap(false);
  numbers_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  numbers_->horizontalHeader()->setSectionResizeMode(0, QHeaderView::Stretch);
  numbers_->horizontalHeader()->setMinimumSectionSize(20);
  numbers_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  numbers_->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  stop_->setObjectName("searchStop");
  stop_->setToolTip(tr("End the search (Escape); the project stays as it is"));
  accept_->setObjectName("searchAccept");
  discard_->setObjectName("searchDiscard");
  discard_->setToolTip(tr("Drop the found shape; the project stays as it is"));
  auto* content = new QWidget(this);
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins(12, 8, 12, 8);
  column->addWidget(state_);
  column->addWidget(progress_);
  column->addWidget(details_);
  column->addWidget(plot_);
  column->addWidget(numbers_);
  column->addStretch();
  auto* buttons = new QHBoxLayout;
  buttons->setContentsMargins(12, 6, 12, 8);
  buttons->addWidget(stop_);
  buttons->addWidget(accept_);
  buttons->addWidget(discard_);
  buttons->addStretch();
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->setSpacing(0);
  all->addWidget(scrollColumn(content, this), 1);
  all->addLayout(buttons);
  connect(stop_, &QPushButton::clicked, &finder, &ShapeFinder::cancel);
  connect(accept_, &QPushButton::clicked, &finder, &ShapeFinder::accept);
  connect(discard_, &QPushButton::clicked, &finder, &ShapeFinder::discard);
  connect(&finder, &ShapeFinder::changed, this, &SearchPanel::update);
  connect(&settings, &Settings::changed, this, &SearchPanel::update);
  update();
}

QString SearchPanel::text(int row, int column) const {
  const QTableWidgetItem* item = numbers_->item(row, column);
  return item ? item->text() : QString();
}

void SearchPanel::update() {
  if (finder_.state() == ShapeFinder::State::kIdle) return;  // not shown
  showState();
  showPlot();
  showNumbers();
}

QString SearchPanel::stateText() const {
  if (finder_.state() == ShapeFinder::State::kStopping) return tr("Stopping …");
  if (finder_.state() == ShapeFinder::State::kFound)
    return finder_.result().isReached ? tr("All targets are met")
                                      : tr("Not all targets can be met");
  const auto& steps = finder_.steps();
  if (steps.empty()) return tr("Solving the present shape …");
  return tr("Step %1 of at most %2 …").arg(steps.back().number + 1).arg(finder_.design().steps);
}

void SearchPanel::showState() {
  const bool isFound = finder_.state() == ShapeFinder::State::kFound;
  state_->setText(stateText());
  progress_->setVisible(!isFound);
  progress_->setValue(static_cast<int>(std::lround(100 * finder_.progress())));
  QStringList details;
  if (isFound && !finder_.result().isReached)
    details << tr("This is the nearest shape that keeps the limits. What limits it: %1.")
                   .arg(limitsText(finder_.result().limits));
  if (isFound && finder_.isOutdated())
    details << tr(
        "The project was changed after this search began, so the shape does not fit it. "
        "Undo the change, or discard the shape and find again.");
  if (isFound && details.isEmpty())
    details << tr(
        "The ghost in the view is the found shape. Accept makes it the present one; undo "
        "goes back.");
  if (!isFound && !finder_.steps().empty() && !finder_.steps().back().problem.empty())
    details << tr("The last shape was taken back: %1")
                   .arg(QString::fromStdString(finder_.steps().back().problem));
  details_->setText(details.join("\n"));
  details_->setVisible(!details.isEmpty());
  // A hidden button passes its focus to the button that replaces it.
  const bool hadFocus = stop_->hasFocus() && isFound;
  stop_->setVisible(!isFound);
  stop_->setEnabled(finder_.state() == ShapeFinder::State::kSearching);
  accept_->setVisible(isFound);
  discard_->setVisible(isFound);
  accept_->setEnabled(isFound && !finder_.isOutdated());
  accept_->setToolTip(!isFound || !finder_.isOutdated()
                          ? tr("Make the found shape the present one, as one step of undo")
                          : tr("The project was changed after this search began"));
  if (hadFocus) (accept_->isEnabled() ? accept_ : discard_)->setFocus();
}

void SearchPanel::showPlot() {
  const std::vector<DesignTarget>& targets = finder_.design().targets;
  const std::vector<app::ShapeStep>& steps = finder_.steps();
  const bool isAbsolute = haveOneKind(targets);
  const Unit unit = isAbsolute ? targetUnit(targets.front().kind, settings_.units())
                               : Unit{QStringLiteral("%"), 1};
  const double end = std::max(kMinAxis, steps.empty() ? 0.0 : double(steps.back().number));
  std::vector<view::ForcePlot::Curve> curves;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const double scale = isAbsolute ? 1 / unit.factor : 100 / targets[i].value;
    const int number = static_cast<int>(i);
    view::ForcePlot::Curve curve{targets[i].touch, number, {}, {}, false};
    for (const app::ShapeStep& step : steps) {
      if (!step.isAccepted) continue;
      curve.times.push_back(step.number);
      curve.forces.push_back(scale * step.values[i]);
    }
    // With the first value a point on the axis; a line needs two.
    if (curve.times.size() == 1) {
      curve.times.push_back(curve.times.front() + 1e-3);
      curve.forces.push_back(curve.forces.front());
    }
    curves.push_back(std::move(curve));
    const double wanted = scale * targets[i].value;
    // In per cent all targets share one line.
    if (isAbsolute || i == 0)
      curves.push_back({"wanted", number, {0, end}, {wanted, wanted}, true});
  }
  plot_->setCurves(curves, 0, end,
                   isAbsolute ? unit.symbol.toStdString() : tr("% of wanted").toStdString());
}

void SearchPanel::showNumbers() {
  const std::vector<app::ShapeStep>& steps = finder_.steps();
  const bool isFound = finder_.state() == ShapeFinder::State::kFound;
  const app::ShapeStep* first = steps.empty() ? nullptr : &steps.front();
  const app::ShapeStep* last = isFound ? &finder_.result().final : latestOf(steps);
  const ShownUnits units = settings_.units();
  numbers_->horizontalHeaderItem(2)->setText(isFound ? tr("After") : tr("Now"));
  std::vector<QStringList> rows;
  const std::vector<DesignTarget>& targets = finder_.design().targets;
  const QString unknown = QStringLiteral("…");
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const DesignTarget::Kind kind = targets[i].kind;
    rows.push_back({QString::fromStdString(targets[i].touch),
                    first ? targetNumberText(kind, first->values[i], units) : unknown,
                    last ? targetNumberText(kind, last->values[i], units) : unknown,
                    wantedText(targets[i], units)});
  }
  if (first && last) {
    const auto length = [&](double value) { return shown(value, Quantity::kLength, units, 4); };
    rows.push_back({tr("Volume"), shownVolume(first->volume, units),
                    shownVolume(last->volume, units), volumeRuleText(finder_.design().volume)});
    rows.push_back({tr("Change"), {}, volumeChangeText(first->volume, last->volume), {}});
    if (first->thinnest && last->thinnest)
      rows.push_back({tr("Thinnest"), length(*first->thinnest), length(*last->thinnest),
                      tr("≥ %1").arg(length(*finder_.design().smallestThickness))});
    rows.push_back({tr("Moved by"), {}, length(last->largestMovement), {}});
    if (isFound)
      rows.push_back({tr("Points"), {}, QString::number(finder_.result().movedPoints), {}});
  }
  numbers_->setRowCount(static_cast<int>(rows.size()));
  int height = numbers_->horizontalHeader()->sizeHint().height() + 2 * numbers_->frameWidth();
  for (int row = 0; row < numbers_->rowCount(); ++row) {
    for (int column = 0; column < kNumberColumns; ++column) {
      const QString& text = rows[static_cast<std::size_t>(row)][column];
      auto* item = new QTableWidgetItem(text);
      item->setTextAlignment((column == 0 ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
      item->setToolTip(text);  // for narrow columns
      numbers_->setItem(row, column, item);
    }
    height += numbers_->rowHeight(row);
  }
  numbers_->setFixedHeight(height);
}

}  // namespace palpa::gui

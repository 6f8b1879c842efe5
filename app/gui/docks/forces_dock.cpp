#include "app/gui/docks/forces_dock.h"

#include <Eigen/Geometry>
#include <QSplitter>
#include <QVBoxLayout>
#include <algorithm>
#include <map>
#include <set>

#include "app/core/results/ball_error.h"
#include "app/core/results/press_error.h"
#include "app/gui/docks/accuracy_panel.h"
#include "app/gui/document/accuracy_words.h"
#include "app/gui/document/force_words.h"
#include "app/gui/document/rebuild_words.h"
#include "base/number_with_error.h"

namespace palpa::gui {
namespace {

constexpr int kTableInterval = 80;   // ms between two updates: faster changes cannot be read
constexpr int kFewDigits = 3;        // in narrow columns
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

bool hasForce(const app::TouchSnapshot::Contact& contact) {
  return contact.status != Status::kWaiting && contact.status != Status::kFixed;
}

}  // namespace

ForcesDock::ForcesDock(Simulation& simulation, Editor& editor, Settings& settings, QWidget* parent)
    : QDockWidget(tr("Forces"), parent),
      simulation_(simulation),
      editor_(editor),
      settings_(settings),
      table_(new ForceTable(simulation, this)),
      summary_(new QLabel(this)),
      plot_(new PlotWidget(this)),
      accuracy_(new AccuracyPanel(editor, "forcesAccuracy", true, this)) {
  setObjectName("forces");
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
  splitter->addWidget(table_);
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
    showSoon();
  });
  connect(&simulation, &Simulation::bodyChanged, this,
          [this] { bodySize_ = simulation_.drawn() ? sizeOf(*simulation_.drawn()) : 0; });
  connect(&simulation, &Simulation::waitingChanged, this, showSoon);
  connect(&settings, &Settings::changed, this, showSoon);
  showForces();
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
    curve.number = simulation_.numberOf(id) - 1;
    curve.name = std::to_string(simulation_.numberOf(id));
    shownCurves.push_back(std::move(curve));
  }
  std::set<app::TouchId> kept;
  for (const auto& [id, curve] : curves) kept.insert(id);
  for (const auto& contact : simulation_.snapshot().touched()) kept.insert(contact.id);
  simulation_.keepNumbers(kept);
  const double end = std::max(samples.back().time, ForceHistory::kSeconds / 3);
  plot_->setCurves(shownCurves, std::max(0.0, end - ForceHistory::kSeconds), end,
                   unit.symbol.toStdString());
}

ForceTable::Row ForcesDock::rowOf(const app::TouchSnapshot::Contact& contact) {
  const ShownUnits units = settings_.units();
  const Unit &length = units.of(Quantity::kLength), &force = units.of(Quantity::kForce);
  const bool isLoaded = hasForce(contact);
  const double stiffness = contact.stiffness * length.factor / force.factor;
  ForceTable::Row row;
  row.contact = contact.id;
  row.curve = simulation_.numberOf(contact.id) - 1;
  const double error = errorOf(contact);
  const bool isGiven = contact.tool.kind == bem::ContactTool::Kind::kForce;
  const double ofForce = isGiven ? 0 : error;
  const auto digits = [error](double value) {
    return error > 0 ? std::clamp(digitsFor(value, error * value), 1, kFewDigits) : kFewDigits;
  };
  const double deflection = contact.deflection.norm();
  row.cells = {
      tr("%1 %2").arg(kindText(contact.tool.kind)).arg(simulation_.numberOf(contact.id)),
      isLoaded ? forceWithError(contact.force.norm(), force, ofForce) : tr("–"),
      isLoaded ? shown(deflection, Quantity::kLength, units, digits(deflection)) : QString(),
      isLoaded && stiffness > 0 ? tr("%L1 %2/%3")
                                      .arg(stiffness, 0, 'g', digits(stiffness))
                                      .arg(force.symbol, length.symbol)
                                : QString()};
  row.details = statusText(contact.status);
  if (isLoaded) row.details += ": " + vectorText(contact.force, force, ofForce);
  // Loads and other contacts also move the place.
  if ((contact.displacement - contact.deflection).norm() >
      kOtherMotion * contact.displacement.norm())
    row.details +=
        " · " + tr("moved %1")
                    .arg(shown(contact.displacement.norm(), Quantity::kLength, units, kFewDigits));
  return row;
}

ForceTable::Row ForcesDock::rowOf(const QString& name, const QString& verb,
                                  const Eigen::Vector3d& vector, Quantity quantity,
                                  double error) const {
  const Unit& unit = settings_.units().of(quantity);
  return {{name, forceWithError(vector.norm(), unit, error), QString(), QString()},
          verb + ": " + vectorText(vector, unit, error)};
}

double ForcesDock::errorOf(const app::TouchSnapshot::Contact& contact) const {
  // The live forces have about the error of a fingertip on this model.
  const double ofFingertip = editor_.rebuildStatus().touchError;
  const app::DrawnBody* drawn = simulation_.drawn();
  const auto masks = simulation_.snapshot().pressed(contact);
  if (!(ofFingertip > 0) || !drawn || contact.tool.kind != bem::ContactTool::Kind::kBall ||
      masks.empty() || !hasForce(contact))
    return ofFingertip;
  const app::BoundarySetup& setup = drawn->model().setup();
  const auto widest = std::max_element(
      masks.begin(), masks.end(), [](const auto& a, const auto& b) { return a.radius < b.radius; });
  return ofFingertip +
         app::ballPressureError(
             setup, {contact.point.position, setup.mesh().normal(contact.point.triangle),
                     contact.tool.radius, widest->radius, contact.force.norm(),
                     contact.deflection.norm(), masks.size()});
}

double ForcesDock::errorOfReactions() const {
  double error = editor_.rebuildStatus().touchError;
  for (const auto& contact : simulation_.snapshot().touched())
    error = std::max(error, errorOf(contact));
  return error;
}

void ForcesDock::showForces() {
  showPlot();
  if (!simulation_.drawn()) {
    table_->showRows({});
    summary_->setText(simulation_.isActive()
                          ? waitingText(editor_.rebuildStatus())
                          : tr("Switch to Simulate (F5) to touch the solid and read its forces."));
    return;
  }
  const app::BoundarySetup& setup = simulation_.drawn()->model().setup();
  std::vector<ForceTable::Row> rows;
  QStringList nearSupport;
  for (const auto& contact : simulation_.snapshot().touched()) {
    rows.push_back(rowOf(contact));
    if (hasForce(contact) && app::isNearSupport(setup, contact.point.position, contact.tool.radius))
      nearSupport << QString::number(simulation_.numberOf(contact.id));
  }
  accuracy_->setNote(nearSupport.isEmpty()
                         ? QString()
                         : tr("Contact %1 reaches a support, where forces are less accurate.")
                               .arg(nearSupport.join(", ")));
  QString words;
  if (const auto state = simulation_.describe()) {
    for (const auto& load : setup.loads) {
      const QString name = tr("Load %1").arg(QString::fromStdString(load.name));
      // A moment has no force, and is the same about every point.
      rows.push_back(load.couple > 0
                         ? rowOf(name, tr("turns with"), load.resultant.moment, Quantity::kMoment)
                         : rowOf(name, tr("acts with"), load.resultant.force, Quantity::kForce));
    }
    for (const auto& support : state->supports)
      rows.push_back(rowOf(tr("Support %1").arg(QString::fromStdString(support.name)),
                           tr("holds with"), support.resultant.force, Quantity::kForce,
                           errorOfReactions()));
    words = tr("Energy %L1 mJ · balance %2")
                .arg(state->energy < kNoEnergy ? 0.0 : state->energy, 0, 'g', kForceDigits)
                .arg(percentText(state->relativeBalance));
  }
  table_->showRows(rows);
  summary_->setText((words + notes()).trimmed());
}

QString ForcesDock::notes() const {
  const app::TouchSnapshot& snapshot = simulation_.snapshot();
  QString words;
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
  return words;
}

}  // namespace palpa::gui

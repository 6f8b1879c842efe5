#include "app/gui/simulate/gradient_view.h"

#include <algorithm>

#include "app/core/design/live_rule.h"
#include "app/gui/document/force_words.h"
#include "app/gui/document/gradient_words.h"
#include "app/view/scene/gradient_arrows.h"

namespace palpa::gui {
namespace {

constexpr double kUnseenShare = 1e-5;  // of the body's coordinates: a smaller motion is not drawn

bool isSameDrawing(const view::GradientDrawing& a, const view::GradientDrawing& b) {
  return a.isOutdated == b.isOutdated && a.legend == b.legend &&
         std::ranges::equal(a.arrows.arrows, b.arrows.arrows,
                            [](const view::ForceArrow& one, const view::ForceArrow& other) {
                              return one.label == other.label &&
                                     one.force.isApprox(other.force, 1e-12) &&
                                     (one.at - other.at).norm() <= kUnseenShare * one.at.norm();
                            });
}

}  // namespace

GradientView::GradientView(Editor& editor, Simulation& simulation, const Settings& settings,
                           ViewportWidget& widget)
    : QObject(&widget),
      editor_(editor),
      simulation_(simulation),
      settings_(settings),
      widget_(widget) {
  connect(&simulation, &Simulation::framed, this, &GradientView::followTouch);
  connect(&simulation, &Simulation::framed, this, &GradientView::draw);
  connect(&simulation, &Simulation::quantityChanged, this, [this] {
    editor_.gradient().setColoursShown(simulation_.isActive() &&
                                       simulation_.quantity() ==
                                           app::SurfaceQuantity::kStiffnessGradient);
  });
  connect(&simulation, &Simulation::activeChanged, this, [this](bool active) {
    editor_.gradient().setColoursShown(active && simulation_.quantity() ==
                                                     app::SurfaceQuantity::kStiffnessGradient);
    nearest_.clear();
    foundOn_.reset();
    values_.clear();
    contact_ = 0;
    draw();
  });
  connect(&simulation, &Simulation::leaving, this, [this] { editor_.gradient().leaveView(); });
  connect(&simulation, &Simulation::bodyChanged, this, &GradientView::colour);
  connect(&editor.gradient(), &TouchGradient::changed, this, [this] {
    colour();
    draw();
  });
  connect(&editor, &Editor::projectChanged, this, &GradientView::draw);
  connect(&editor, &Editor::projectReplaced, this, &GradientView::draw);
  connect(&settings, &Settings::changed, this, &GradientView::draw);  // units
}

void GradientView::chooseContact() {
  std::map<app::TouchId, Eigen::Vector3d> values;
  for (const auto& contact : simulation_.snapshot().touched()) {
    values[contact.id] = contact.value;
    const auto before = values_.find(contact.id);
    if (before == values_.end() || before->second != contact.value) contact_ = contact.id;
  }
  if (!values.contains(contact_)) contact_ = values.empty() ? 0 : values.rbegin()->first;
  values_ = std::move(values);
}

void GradientView::followTouch() {
  if (!simulation_.isActive() || !simulation_.drawn()) return;
  chooseContact();
  TouchGradient& gradient = editor_.gradient();
  const bool hasColours = simulation_.quantity() == app::SurfaceQuantity::kStiffnessGradient;
  if (!gradient.areArrowsShown() && !hasColours) return;
  const auto* contact = simulation_.snapshot().find(contact_);
  if (!contact || simulation_.hasEnded(contact_)) return;
  const QString name =
      tr("%1 %2").arg(kindText(contact->tool.kind)).arg(simulation_.numberOf(contact_));
  auto rule = app::liveRule(simulation_.snapshot(), *contact, simulation_.body()->surface(),
                            name.toStdString());
  if (rule) gradient.follow(std::move(*rule), simulation_.sharedDrawn());
}

void GradientView::colour() {
  const auto& known = editor_.gradient().known();
  const bool isOfBody = known && known->drawn && known->drawn == simulation_.sharedDrawn();
  simulation_.setGradientColours(isOfBody ? known->surface : std::vector<double>(),
                                 editor_.gradient().name(), editor_.gradient().isOutdated());
}

std::vector<Eigen::Vector3d> GradientView::places(const Eigen::Matrix3Xd& gradient) {
  const auto count = static_cast<std::size_t>(gradient.cols());
  if (!simulation_.isActive() || !simulation_.drawn()) {
    if (!editor_.solid() || editor_.solid()->controlPoints().size() != count) return {};
    return editor_.solid()->controlPoints();
  }
  const auto* solid = std::get_if<modeling::Solid>(&simulation_.drawn()->model().body());
  if (!solid || solid->controlPoints().size() != count) return {};
  if (foundOn_ != simulation_.sharedDrawn()) {
    foundOn_ = simulation_.sharedDrawn();
    nearest_.clear();
  }
  std::vector<Eigen::Vector3d> places = solid->controlPoints();
  for (const int point : view::pointsWithArrows(gradient)) {
    Eigen::Vector3d& place = places[static_cast<std::size_t>(point)];
    auto known = nearest_.find(point);
    if (known == nearest_.end())
      known = nearest_.emplace(point, simulation_.body()->surface().tree().nearest(place)).first;
    place += simulation_.scale() * simulation_.displacementAt(known->second);
  }
  return places;
}

void GradientView::draw() {
  const TouchGradient& gradient = editor_.gradient();
  view::GradientDrawing drawing;
  if (gradient.areArrowsShown()) {
    for (const QString& line : gradientLegend(gradient, simulation_.isActive(), settings_.units()))
      drawing.legend.push_back(line.toStdString());
    if (gradient.known()) {
      const Eigen::Matrix3Xd& values = gradient.known()->gradient;
      const std::vector<Eigen::Vector3d> at = places(values);
      if (!at.empty())
        drawing.arrows = view::gradientArrows(values, at, [this](double value) {
          return gradientNumber(value, settings_.units()).toStdString();
        });
      drawing.isOutdated = gradient.isOutdated();
    }
  }
  if (isSameDrawing(drawing, drawing_)) return;
  drawing_ = std::move(drawing);
  widget_.viewport().setGradient(drawing_);
  widget_.updateQuickly();
}

}  // namespace palpa::gui

#include "app/gui/simulate/samples.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "app/gui/simulate/sample_words.h"

namespace palpa::gui {
namespace {

constexpr int kInterval = 150;       // ms between two evaluations
constexpr double kSampleReach = 10;  // logical pixels

}  // namespace

Samples::Samples(Simulation& simulation, SectionView& section, const Settings& settings,
                 ViewportWidget& widget)
    : QObject(&widget),
      simulation_(simulation),
      section_(section),
      settings_(settings),
      widget_(widget) {
  soon_.setSingleShot(true);
  soon_.setInterval(kInterval);
  connect(&soon_, &QTimer::timeout, this, &Samples::evaluate);
  connect(&simulation, &Simulation::framed, this, [this] {
    showLabels();
    if (!soon_.isActive() && (!pins_.empty() || pointer_)) soon_.start();
  });
  connect(&simulation, &Simulation::bodyChanged, this, &Samples::follow);
  connect(&simulation, &Simulation::picturesChanged, this, &Samples::showLabels);
  connect(&section, &SectionView::updated, this, &Samples::showLabels);
  connect(&settings, &Settings::changed, this, &Samples::evaluate);
  connect(&simulation, &Simulation::leaving, this, [this] {
    hover(std::nullopt);
    inside_.reset();
    shown_.clear();
    widget_.viewport().setSampleLabels({});
  });
  // Another project: its body has nothing to do with the pins.
  connect(&simulation, &Simulation::projectLeft, this, &Samples::clear);
}

std::optional<bem::SurfacePoint> Samples::surfacePlaceAt(const Eigen::Vector2d& pixel,
                                                         Eigen::Vector3d& drawn) const {
  const app::DrawnBody* body = simulation_.drawn();
  if (!body) return std::nullopt;
  const auto hit = widget_.viewport().surfaceAt(pixel);
  if (!hit) return std::nullopt;
  drawn = hit->position;
  const auto& corners = body->mesh().triangles[static_cast<std::size_t>(hit->triangle)];
  std::array<Eigen::Vector3d, 3> moved;
  for (std::size_t k = 0; k < 3; ++k)
    moved[k] = simulation_.shape().positions[static_cast<std::size_t>(corners[k])];
  const Eigen::Vector3d p = moved[1] - moved[0], q = moved[2] - moved[0],
                        r = hit->position - moved[0], area = p.cross(q);
  const double s = r.cross(q).dot(area) / area.squaredNorm(),
               t = p.cross(r).dot(area) / area.squaredNorm();
  // Weights in the boundary triangle that this one divides.
  const int triangle = body->mesh().boundaryTriangle[static_cast<std::size_t>(hit->triangle)];
  const bem::BoundaryMesh& mesh = body->model().setup().mesh();
  const auto& rest = body->mesh().positions;
  const Eigen::Vector3d at = (1 - s - t) * rest[static_cast<std::size_t>(corners[0])] +
                             s * rest[static_cast<std::size_t>(corners[1])] +
                             t * rest[static_cast<std::size_t>(corners[2])];
  bem::SurfacePoint place = bem::nearestOnTriangle(mesh, triangle, at);
  place.position = at;
  return place;
}

void Samples::hover(const std::optional<Eigen::Vector2d>& pixel) {
  pointer_ = pixel;
  hovered_.reset();
  if (pixel && simulation_.drawn()) {
    if (const auto inside = section_.sampleAt(*pixel)) {
      hovered_ = view::SampleLabel{inside->drawn,
                                   plateText(inside->values, settings_.units()).toStdString(),
                                   view::SampleLabel::Kind::kPointer};
    } else {
      Eigen::Vector3d drawn;
      const auto place = surfacePlaceAt(*pixel, drawn);
      const bem::BoundaryField* field = place ? simulation_.field() : nullptr;
      if (field) {
        const app::TouchModel& model = simulation_.drawn()->model();
        const app::BoundarySetup& setup = model.setup();
        const app::PointSample sample = app::sampleSurface(
            model, *field,
            setup.discretisation->surfaceStress(field->u.col(0), field->p.col(0), setup.material),
            *place);
        hovered_ = view::SampleLabel{drawn, plateText(sample, settings_.units()).toStdString(),
                                     view::SampleLabel::Kind::kPointer};
      }
    }
  }
  showLabels();
}

bool Samples::pinAt(const Eigen::Vector2d& pixel) {
  const double reach = kSampleReach * widget_.devicePixelRatioF();
  for (std::size_t k = 0; k < values_.size(); ++k)
    if ((widget_.viewport().toPixel(drawn(k)) - pixel).norm() <= reach) {
      select(static_cast<int>(k));
      return true;
    }
  if (count() >= kMaxPins) return false;
  const auto pin = placeAt(pixel);
  if (!pin) return false;
  pins_.push_back(*pin);
  inside_.reset();
  selected_ = count() - 1;
  evaluate();
  return true;
}

std::optional<Samples::Pin> Samples::placeAt(const Eigen::Vector2d& pixel) const {
  if (const auto inside = section_.sampleAt(pixel)) return Pin{inside->values.at, std::nullopt};
  Eigen::Vector3d drawn;
  const auto place = surfacePlaceAt(pixel, drawn);
  if (!place) return std::nullopt;
  return Pin{place->position, place};
}

void Samples::setPin(int index, const Pin& pin) {
  pins_[static_cast<std::size_t>(index)] = pin;
  inside_.reset();
  evaluate();
}

bool Samples::movePin(int index, const Eigen::Vector2d& pixel) {
  const auto pin = placeAt(pixel);
  if (pin) setPin(index, *pin);
  return pin.has_value();
}

void Samples::select(int index) {
  selected_ = index >= 0 && index < count() ? index : -1;
  showLabels();
  Q_EMIT changed();
}

void Samples::removeSelected() {
  if (pins_.empty()) return;
  const int index = selected_ >= 0 ? selected_ : count() - 1;
  pins_.erase(pins_.begin() + index);
  inside_.reset();
  selected_ = -1;
  evaluate();
}

void Samples::clear() {
  pins_.clear();
  inside_.reset();
  selected_ = -1;
  evaluate();
}

void Samples::setExtremesShown(bool shown) {
  areExtremesShown_ = shown;
  showLabels();
}

/// Finds the places of the pins on a new body.
void Samples::follow() {
  inside_.reset();
  const auto body = simulation_.body();
  if (!body) return;
  for (Pin& pin : pins_)
    if (pin.surface) pin.surface = body->surface().tree().nearest(pin.at);
  evaluate();
}

void Samples::evaluate() {
  values_.clear();
  const bem::BoundaryField* field =
      simulation_.drawn() && !pins_.empty() ? simulation_.field() : nullptr;
  if (field) {
    const app::TouchModel& model = simulation_.drawn()->model();
    const app::BoundarySetup& setup = model.setup();
    const Eigen::VectorXd u = field->u.col(0), p = field->p.col(0);
    const auto stress = setup.discretisation->surfaceStress(u, p, setup.material);
    Job job;
    job.threads = 1;
    if (!inside_) {
      std::vector<Eigen::Vector3d> points;
      for (const Pin& pin : pins_)
        if (!pin.surface) points.push_back(pin.at);
      inside_ = setup.discretisation->makeInteriorEvaluator(points, setup.bulk(), job);
    }
    std::vector<bem::InteriorState> states;
    if (inside_->pointCount() > 0) states = inside_->evaluate(u, p, job);
    std::size_t next = 0;
    for (const Pin& pin : pins_)
      values_.push_back(pin.surface ? app::sampleSurface(model, *field, stress, *pin.surface)
                                    : app::sampleInside(model, pin.at, states[next++]));
  }
  if (pointer_)
    hover(pointer_);
  else
    showLabels();
  Q_EMIT changed();
}

Eigen::Vector3d Samples::drawn(std::size_t pin) const {
  // Surface points move with every frame, points inside with the last evaluation.
  const Eigen::Vector3d moved = pins_[pin].surface ? simulation_.displacementAt(*pins_[pin].surface)
                                                   : values_[pin].displacement;
  return values_[pin].at + simulation_.scale() * moved;
}

void Samples::showLabels() {
  if (!simulation_.isActive()) return;
  std::vector<view::SampleLabel> labels;
  if (simulation_.drawn()) {
    for (std::size_t k = 0; k < std::min(values_.size(), pins_.size()); ++k) {
      const app::PointSample& sample = values_[k];
      const ShownUnits units = settings_.units();
      const QString text = tr("%1:  |u| %2,  von Mises %3")
                               .arg(k + 1)
                               .arg(shown(sample.displacement.norm(), Quantity::kLength, units, 3),
                                    shown(sample.numbers.vonMises, Quantity::kStress, units, 3));
      labels.push_back({drawn(k), text.toStdString(),
                        static_cast<int>(k) == selected_ ? view::SampleLabel::Kind::kSelected
                                                         : view::SampleLabel::Kind::kPinned});
    }
    if (areExtremesShown_) addExtremes(labels);
    if (hovered_) labels.push_back(*hovered_);
  }
  // Without motion the picture stays the same.
  const auto isSame = [](const view::SampleLabel& a, const view::SampleLabel& b) {
    return a.text == b.text && a.kind == b.kind && (a.at - b.at).norm() <= 1e-4 * a.at.norm();
  };
  if (std::ranges::equal(labels, shown_, isSame)) return;
  shown_ = labels;
  widget_.viewport().setSampleLabels(labels);
  widget_.updateQuickly();
}

void Samples::addExtremes(std::vector<view::SampleLabel>& labels) const {
  const std::vector<double>& values = simulation_.values();
  const auto& places = simulation_.shape().positions;
  if (values.size() != places.size() || values.empty()) return;
  // Of everything that is drawn: the surface behind a section, and the section.
  std::optional<std::pair<double, Eigen::Vector3d>> least, most;
  const auto look = [&](double value, const Eigen::Vector3d& at) {
    if (!std::isfinite(value)) return;
    if (!least || value < least->first) least = {value, at};
    if (!most || value > most->first) most = {value, at};
  };
  const auto section = section_.section();
  for (std::size_t k = 0; k < values.size(); ++k)
    if (!section || section->distances()[k] <= 0) look(values[k], places[k]);
  if (section && app::hasSectionValues(simulation_.quantity()) && least)
    for (std::size_t k = 0; k < section_.states().size(); ++k)
      look(app::sectionValue(simulation_.quantity(), section_.states()[k], section->plane()),
           section->mesh().positions[k] + simulation_.scale() * section_.states()[k].displacement);
  if (!least) return;
  const Unit unit = shownUnit(app::infoOf(simulation_.quantity()).unit, settings_.units());
  const auto add = [&](const std::pair<double, Eigen::Vector3d>& place, const QString& name,
                       view::SampleLabel::Kind kind) {
    labels.push_back(
        {place.second,
         (name + " " + QString::number(place.first / unit.factor, 'g', 3) + " " + unit.symbol)
             .toStdString(),
         kind});
  };
  add(*least, tr("min"), view::SampleLabel::Kind::kMinimum);
  add(*most, tr("max"), view::SampleLabel::Kind::kMaximum);
}

}  // namespace palpa::gui

#include "app/gui/simulate/section_view.h"

#include <Eigen/Geometry>
#include <QMetaObject>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace palpa::gui {
namespace {

constexpr double kCoarse = 2.5;       // size of triangles while the plane moves
constexpr double kUnchanged = 1e-5;   // of the largest value of a field
constexpr double kOffsetStep = 1e-3;  // of the power of ten below the body's reach

Eigen::AlignedBox3d boxOf(const app::DrawnBody& body) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& x : body.mesh().positions) box.extend(x);
  return box;
}

bool isSamePlane(const modeling::Plane& a, const modeling::Plane& b) {
  return a.normal == b.normal && a.offset == b.offset;
}

}  // namespace

SectionView::SectionView(Simulation& simulation, const Settings& settings, ViewportWidget& widget)
    : QObject(&widget), simulation_(simulation), settings_(settings), widget_(widget) {
  connect(&simulation, &Simulation::bodyChanged, this, [this] {
    forget();
    if (isShown_) request();
  });
  connect(&simulation, &Simulation::framed, this, [this] {
    if (!isShown_) return;
    showShape();
    request();
  });
  connect(&simulation, &Simulation::picturesChanged, this, [this] {
    if (isDrawn_) showShape();
  });
  connect(&simulation, &Simulation::leaving, this, [this] {
    worker_.cancel();
    worker_.waitUntilIdle();
    isBusy_ = false;
    if (isDrawn_) widget_.viewport().setSection(std::nullopt);
    forget();
    hasPlane_ = false;
  });
}

SectionView::~SectionView() = default;

void SectionView::forget() {
  ++generation_;
  field_.reset();
  states_.clear();
  requested_ = {};
  isDrawn_ = false;
  simulation_.setLargestInside(0);
}

std::shared_ptr<const app::BodySection> SectionView::section() const {
  return field_ ? field_->sharedSection() : nullptr;
}

std::array<double, 2> SectionView::offsets() const {
  if (!simulation_.drawn()) return {-1e6, 1e6};
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const Eigen::Vector3d& x : simulation_.drawn()->mesh().positions) {
    least = std::min(least, plane_.normal.dot(x));
    most = std::max(most, plane_.normal.dot(x));
  }
  return {least, most};
}

Eigen::Vector3d SectionView::middle() const {
  if (!simulation_.drawn()) return plane_.offset * plane_.normal;
  const Eigen::Vector3d centre = boxOf(*simulation_.drawn()).center();
  return centre - plane_.distance(centre) * plane_.normal;
}

double SectionView::reach() const {
  return simulation_.drawn() ? 0.5 * boxOf(*simulation_.drawn()).diagonal().norm() : 1;
}

double SectionView::rounded(double offset) const {
  const double step = kOffsetStep * std::pow(10, std::floor(std::log10(reach())));
  return step * std::round(offset / step);
}

void SectionView::setShown(bool shown) {
  if (shown == isShown_) return;
  isShown_ = shown;
  if (!shown) {
    ++generation_;
    if (isDrawn_) widget_.viewport().setSection(std::nullopt);
    field_.reset();
    states_.clear();
    requested_ = {};
    isDrawn_ = false;
    simulation_.setLargestInside(0);
    widget_.update();
  } else {
    request();
  }
  Q_EMIT changed();
}

void SectionView::setPlane(const modeling::Plane& plane, bool isMoving) {
  plane_ = plane;
  hasPlane_ = true;
  isMoving_ = isMoving;
  const auto [least, most] = offsets();
  plane_.offset = std::clamp(plane_.offset, least, most);
  if (isShown_) request();
  Q_EMIT changed();
}

void SectionView::setNormal(const Eigen::Vector3d& normal) {
  const Eigen::Vector3d unit = normal.normalized();
  setPlane({unit, rounded(unit.dot(middle()))});
}

void SectionView::flip() {
  setPlane({-plane_.normal, -plane_.offset});
}

bool SectionView::hasFieldChanged(const bem::BoundaryField& field) {
  if (requested_.u.size() != field.u.size() || requested_.p.size() != field.p.size()) return true;
  const auto differ = [](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    return (a - b).lpNorm<Eigen::Infinity>() > kUnchanged * b.lpNorm<Eigen::Infinity>();
  };
  return differ(requested_.u, field.u) || differ(requested_.p, field.p);
}

void SectionView::request() {
  if (!isShown_ || isBusy_ || !simulation_.drawn()) return;
  if (!hasPlane_) {
    // Facing the eye: the axis that points most towards it.
    const Eigen::Vector3d towards = -widget_.viewport().camera().direction;
    Eigen::Index axis = 0;
    towards.cwiseAbs().maxCoeff(&axis);
    if (axis == 2 && towards.head<2>().norm() > 0.4 * towards.norm())
      towards.head<2>().cwiseAbs().maxCoeff(&axis);
    plane_.normal = (towards[axis] < 0 ? -1 : 1) * Eigen::Vector3d::Unit(axis);
    plane_.offset = rounded(plane_.normal.dot(boxOf(*simulation_.drawn()).center()));
    hasPlane_ = true;
    Q_EMIT changed();
  }
  const bem::BoundaryField* field = simulation_.field();
  if (!field) return;
  const bool isSame = isDrawn_ && isSamePlane(plane_, shownPlane_) && (isFine_ || isMoving_);
  if (!hasFieldChanged(*field) && isSame) return;
  isBusy_ = true;
  requested_ = *field;
  const double edge = isMoving_ ? kCoarse : 1;
  worker_.post([this, generation = generation_, body = simulation_.sharedDrawn(), plane = plane_,
                known = isSame ? field_ : nullptr, state = *field, edge,
                isFine = !isMoving_](const std::stop_token& stop) {
    Job job;
    job.stop = stop;
    job.threads = 1;
    Result result{known, nullptr, {}, plane, isFine};
    try {
      if (!result.field) {
        const auto section = std::make_shared<const app::BodySection>(body, plane, job, edge);
        if (!section->isEmpty())
          result.field = std::make_shared<const app::SectionField>(section, job);
        else
          result.empty = section;
      }
      if (result.field) result.states = result.field->states(state, job);
    } catch (const Cancelled&) {
      return;  // the mode was left
    }
    QMetaObject::invokeMethod(
        this, [this, generation, result] { receive(generation, result); }, Qt::QueuedConnection);
  });
}

void SectionView::receive(std::uint64_t generation, Result result) {
  isBusy_ = false;
  if (generation == generation_ && isShown_) {
    const bool isNew = !isDrawn_ || result.field != field_ || !result.field;
    field_ = std::move(result.field);
    states_ = std::move(result.states);
    shownPlane_ = result.plane;
    isFine_ = result.isFine;
    if (isNew) showSection(result.empty);
    double largest = 0;
    if (app::hasSectionValues(simulation_.quantity()))
      for (const bem::InteriorState& state : states_)
        largest = std::max(largest,
                           std::abs(app::sectionValue(simulation_.quantity(), state, shownPlane_)));
    simulation_.setLargestInside(largest);
    showShape();
    widget_.updateQuickly();
    Q_EMIT updated();
  }
  request();
}

void SectionView::showSection(const std::shared_ptr<const app::BodySection>& empty) {
  const app::BodySection& section = field_ ? field_->section() : *empty;
  view::SectionDrawing drawing;
  drawing.distances = section.distances();
  const modeling::PlaneSection& mesh = section.mesh();
  drawing.face = {mesh.positions,
                  std::vector<Eigen::Vector3d>(mesh.positions.size(), section.plane().normal),
                  mesh.triangles,
                  std::vector<int>(mesh.triangles.size(), 0),
                  view::linesBetween(mesh.edges),
                  {}};
  widget_.viewport().setSection(drawing);
  isDrawn_ = true;
}

void SectionView::showShape() {
  if (!isDrawn_ || !field_) return;
  const app::BodySection& section = field_->section();
  std::vector<Eigen::Vector3d> moved;
  moved.reserve(states_.size());
  for (const bem::InteriorState& state : states_) moved.push_back(state.displacement);
  app::BodySection::Shape shape = section.deformed(moved, simulation_.scale());
  // The outline is on the surface, which may have moved since.
  const std::vector<Eigen::Vector3d> outline = section.onOutline(simulation_.shape().positions);
  std::copy(outline.begin(), outline.end(), shape.positions.begin());
  widget_.viewport().moveSection(shape.positions, shape.normals);
  showValues();
}

void SectionView::showValues() {
  const app::SurfaceQuantity quantity = simulation_.quantity();
  if (quantity == app::SurfaceQuantity::kNone) return;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> values(states_.size(), kNone);
  if (app::hasSectionValues(quantity)) {
    const double factor = shownUnit(app::infoOf(quantity).unit, settings_.units()).factor;
    double largest = 0;
    for (std::size_t k = 0; k < states_.size(); ++k) {
      values[k] = app::sectionValue(quantity, states_[k], shownPlane_) / factor;
      largest = std::max(largest, std::abs(values[k]));
    }
    // As on the surface: without contacts and loads no colours.
    if (largest == 0) std::fill(values.begin(), values.end(), kNone);
  }
  widget_.viewport().setSectionValues(values);
}

std::optional<SectionView::Sample> SectionView::sampleAt(const Eigen::Vector2d& pixel) const {
  if (!isDrawn_ || !field_ || states_.empty()) return std::nullopt;
  const auto hit = widget_.viewport().sectionAt(pixel);
  if (!hit) return std::nullopt;
  const modeling::PlaneSection& mesh = field_->section().mesh();
  const auto& triangle = mesh.triangles[static_cast<std::size_t>(hit->triangle)];
  std::array<Eigen::Vector3d, 3> drawn;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto point = static_cast<std::size_t>(triangle[k]);
    drawn[k] = mesh.positions[point] + simulation_.scale() * states_[point].displacement;
  }
  const Eigen::Vector3d p = drawn[1] - drawn[0], q = drawn[2] - drawn[0],
                        r = hit->position - drawn[0], area = p.cross(q);
  const double s = r.cross(q).dot(area) / area.squaredNorm(),
               t = p.cross(r).dot(area) / area.squaredNorm();
  const std::array<double, 3> weights{1 - s - t, s, t};
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  bem::InteriorState state{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto point = static_cast<std::size_t>(triangle[k]);
    at += weights[k] * mesh.positions[point];
    state.displacement += weights[k] * states_[point].displacement;
    state.stress += weights[k] * states_[point].stress;
  }
  return Sample{app::sampleInside(simulation_.drawn()->model(), at, state), hit->position};
}

}  // namespace palpa::gui

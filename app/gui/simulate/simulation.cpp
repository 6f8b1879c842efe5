#include "app/gui/simulate/simulation.h"

#include <Eigen/Geometry>
#include <QMetaObject>
#include <algorithm>
#include <cmath>
#include <limits>

#include "app/core/design/surface_gradient.h"
#include "app/core/device/device_server.h"
#include "app/core/system/destroy_in_background.h"
#include "app/core/system/priority.h"

namespace palpa::gui {
namespace {

constexpr int kFrame = 16;  // ms between two frames
/// Number of triangles that are drawn in time without a graphics card; a finer mesh has more.
constexpr double kTriangles = 8000;
constexpr int kMaxPieces = 8;  // of an edge of the mesh

/// Smallest range of colours, as a share of the body's size or of Young's modulus.
constexpr double kMinShare = 0.005;

}  // namespace

Simulation::Simulation(Editor& editor, QObject* parent) : QObject(parent), editor_(editor) {
  timer_.setInterval(kFrame);
  timer_.setTimerType(Qt::PreciseTimer);
  connect(&timer_, &QTimer::timeout, this, &Simulation::frame);
  connect(&editor, &Editor::rebuildChanged, this, [this] {
    followModel();
    if (isActive() && !drawn_) Q_EMIT waitingChanged();
  });
  connect(&stiffness_, &ShownStiffness::grown, this, [this] {
    isDirty_ = true;
    Q_EMIT picturesChanged();
  });
  // Another project opens in Model mode: body, curves and contacts of this one end at once.
  connect(&editor, &Editor::aboutToReplace, this, [this] {
    setActive(false);
    Q_EMIT projectLeft();
  });
}

Simulation::~Simulation() = default;

modeling::DisplaySettings Simulation::displaySettings(const app::TouchModel& model) {
  modeling::DisplaySettings settings;
  const double perTriangle = kTriangles / std::max(model.report().triangles, 1);
  settings.mostPieces = std::clamp(static_cast<int>(std::sqrt(perTriangle)), 1, kMaxPieces);
  settings.leastPieces = std::min(settings.leastPieces, settings.mostPieces);
  return settings;
}

void Simulation::setActive(bool active) {
  if (active == isActive()) return;
  if (active) {
    if (!loop_) loop_ = std::make_unique<app::TouchLoop>();
    app::lowerPriorityOfRasteriser();
    timer_.start();
    followModel();
  } else {
    Q_EMIT leaving();
    timer_.stop();
    isLive_ = true;
    endAll();
    loop_->setModel(nullptr);
    maker_.cancel();  // adopt() drops what comes all the same
    stiffness_.stop();
    model_.reset();
    drawn_.reset();
    field_.reset();
    drawnNumber_ = wantedNumber_ = lastStep_ = 0;
    snapshot_ = {};
    gradient_.clear();
    own_.clear();
  }
  numbers_.clear();
  Q_EMIT activeChanged(active);
}

void Simulation::followModel() {
  if (!isActive() || editor_.model() == model_) return;
  model_ = editor_.model();
  loop_->setModel(model_);
}

std::optional<app::TouchId> Simulation::begin(const bem::ContactTool& tool,
                                              const Eigen::Vector3d& at,
                                              const Eigen::Vector3d& value) {
  try {
    const app::TouchId id = loop_->begin(tool, at, value);
    own_.insert(id);
    return id;
  } catch (const app::TouchRefused& refused) {
    Q_EMIT editor_.refused(QString::fromStdString(refused.what()));
    return std::nullopt;
  }
}

void Simulation::end(app::TouchId id) {
  loop_->end(id);
  ended_.insert(id);
}

void Simulation::listen(const std::filesystem::path& socket, const bem::ContactTool& tool) {
  deviceTarget_ = std::make_unique<app::LoopTarget>(*loop_);
  device_ = std::make_unique<app::DeviceServer>(*deviceTarget_, tool, socket, [this] {
    QMetaObject::invokeMethod(this, &Simulation::deviceChanged, Qt::QueuedConnection);
  });
}

void Simulation::stopListening() {
  device_.reset();
}

void Simulation::setDeviceTool(const bem::ContactTool& tool) {
  if (device_) device_->setTool(tool);
}

void Simulation::endAll() {
  for (const auto& contact : snapshot_.touched()) end(contact.id);
}

int Simulation::numberOf(app::TouchId contact) {
  if (const auto known = numbers_.find(contact); known != numbers_.end()) return known->second;
  int highest = 0;
  for (const auto& [id, number] : numbers_) highest = std::max(highest, number);
  return numbers_[contact] = highest + 1;
}

void Simulation::keepNumbers(const std::set<app::TouchId>& contacts) {
  std::erase_if(numbers_, [&](const auto& known) { return !contacts.contains(known.first); });
}

void Simulation::setQuantity(app::SurfaceQuantity quantity) {
  if (quantity == quantity_) return;
  quantity_ = quantity;
  range_.startField();
  isDirty_ = true;
  computeStiffness();
  Q_EMIT quantityChanged();
  Q_EMIT picturesChanged();
}

void Simulation::setRangeMode(RangeMode mode, const std::array<double, 2>& manual) {
  range_.setMode(mode, manual);
  isDirty_ = true;
  Q_EMIT picturesChanged();
}

void Simulation::setLargestBeside(double largest) {
  if (largest == range_.largestBeside()) return;
  range_.setLargestBeside(largest);
  isDirty_ = true;
}

const bem::BoundaryField* Simulation::field() {
  return field_ && snapshot_.model == drawnNumber_ ? &field_->field(snapshot_) : nullptr;
}

void Simulation::setFingertip(double radius) {
  if (stiffness_.setFingertip(radius)) computeStiffness();
}

/// Restarts the stiffness map. It is computed only while it is shown, since it delays the columns.
void Simulation::computeStiffness() {
  isDirty_ = true;
  if (quantity_ == app::SurfaceQuantity::kStiffness && field_)
    stiffness_.start(field_->model(), drawn_);
  else
    stiffness_.clear();
}

void Simulation::setGradientColours(std::vector<double> values, const QString& touch,
                                    bool isOutdated) {
  QString name = tr(app::infoOf(app::SurfaceQuantity::kStiffnessGradient).label);
  if (!touch.isEmpty()) name += ": " + touch;
  if (isOutdated) name += tr(" (updating …)");
  if (values == gradient_ && name == gradientName_) return;
  gradientName_ = name;
  gradient_ = std::move(values);
  gradientEnd_ = app::surfaceGradientEnd(gradient_);
  isGradientCapped_ = false;
  for (double& value : gradient_) {
    isGradientCapped_ = isGradientCapped_ || std::abs(value) > gradientEnd_;
    value = std::clamp(value, -gradientEnd_, gradientEnd_);
  }
  isDirty_ = true;
  if (isActive() && quantity_ == app::SurfaceQuantity::kStiffnessGradient) Q_EMIT picturesChanged();
}

void Simulation::setScale(double scale) {
  if (scale == scale_) return;
  scale_ = scale;
  isDirty_ = true;
  Q_EMIT picturesChanged();
}

bool Simulation::isBehind() const {
  const app::RebuildStatus status = editor_.rebuildStatus();
  return status.modelRevision != status.revision || snapshot_.model != loop_->status().newest;
}

std::shared_ptr<const app::TouchableModel> Simulation::body() const {
  return field_ ? field_->model() : nullptr;
}

std::optional<app::TouchState> Simulation::describe() {
  if (!field_ || snapshot_.model != drawnNumber_) return std::nullopt;
  return field_->describe(snapshot_);
}

Eigen::Vector3d Simulation::displacementAt(const bem::SurfacePoint& point) const {
  if (!drawn_ || displacements_.size() == 0) return Eigen::Vector3d::Zero();
  return drawn_->model().setup().discretisation->interpolate(point, displacements_);
}

void Simulation::show(const app::TouchSnapshot& snapshot) {
  if (!drawn_) return;
  snapshot_ = snapshot;
  evaluate();
  Q_EMIT framed();
}

void Simulation::showLive() {
  isLive_ = true;
  isDirty_ = true;
}

void Simulation::frame() {
  if (!isLive_) return;
  loop_->read(incoming_);
  if (incoming_.model != drawnNumber_) {
    // Keep picture and snapshot until the new body is drawn: the places of the snapshot refer to
    // the triangles of drawn().
    if (incoming_.model != 0 && incoming_.model != wantedNumber_) makeDrawn(incoming_.model);
    return;
  }
  snapshot_ = incoming_;
  std::erase_if(ended_, [this](app::TouchId id) {
    if (snapshot_.find(id)) return false;
    own_.erase(id);
    return true;
  });
  const bool isTouched = snapshot_.contactCount > 0;
  if (!drawn_ || (!isDirty_ && !isTouched && !wasTouched_)) return;
  if (!isDirty_ && snapshot_.step == lastStep_) return;
  isDirty_ = false;
  wasTouched_ = isTouched;
  lastStep_ = snapshot_.step;
  evaluate();
  Q_EMIT framed();
}

void Simulation::makeDrawn(std::uint64_t number) {
  const auto body = loop_->model(number);
  if (!body) return;  // a newer one follows
  wantedNumber_ = number;
  maker_.replace([this, number, body](const std::stop_token& stop) {
    Job job;
    job.stop = stop;
    try {
      auto drawn = std::make_shared<const app::DrawnBody>(body->sharedModel(),
                                                          displaySettings(body->model()), job);
      auto field = std::make_shared<std::unique_ptr<app::TouchField>>(
          std::make_unique<app::TouchField>(body));
      QMetaObject::invokeMethod(
          this, [this, number, drawn, field] { adopt(number, drawn, std::move(*field)); },
          Qt::QueuedConnection);
    } catch (const Cancelled&) {
      // The mode was left, or a newer body arrived.
    }
  });
}

void Simulation::adopt(std::uint64_t number, std::shared_ptr<const app::DrawnBody> drawn,
                       std::unique_ptr<app::TouchField> field) {
  if (!isActive() || number != wantedNumber_) return;
  loop_->read(incoming_);
  if (!isLive_ || incoming_.model != number) {
    wantedNumber_ = 0;  // make it again, or the next one
    return;
  }
  stiffness_.stop();  // it shares the body that is to be destroyed in the background
  if (field_) app::destroyInBackground(std::shared_ptr<app::TouchField>(std::move(field_)));
  if (drawn_) app::destroyInBackground(std::move(drawn_));
  field_ = std::move(field);
  drawn_ = std::move(drawn);
  drawnNumber_ = number;
  range_.restart();
  gradient_.clear();  // of the former points
  snapshot_ = incoming_;
  computeStiffness();
  evaluate();
  Q_EMIT bodyChanged();
  Q_EMIT framed();
}

void Simulation::evaluate() {
  const bool needsTractions = quantity_ == app::SurfaceQuantity::kNormalTraction ||
                              quantity_ == app::SurfaceQuantity::kVonMises;
  const bem::BoundaryField* field = needsTractions ? &field_->field(snapshot_) : nullptr;
  displacements_ = field ? field->u.col(0) : field_->displacements(snapshot_).col(0);
  drawn_->deform(displacements_, scale_, shape_);
  values_.clear();
  if (field) values_ = drawn_->values(quantity_, *field);
  if (quantity_ == app::SurfaceQuantity::kDisplacement) values_ = shape_.sizes;
  if (quantity_ == app::SurfaceQuantity::kStiffness) {
    values_ = stiffness_.values();
    // No colour where the stiffness is unknown.
    values_.resize(drawn_->mesh().positions.size(), std::numeric_limits<double>::quiet_NaN());
  }
  if (quantity_ == app::SurfaceQuantity::kStiffnessGradient) {
    values_ = gradient_;
    values_.resize(drawn_->mesh().positions.size(), std::numeric_limits<double>::quiet_NaN());
  }
  updateRange();
}

double Simulation::leastRange() const {
  if (quantity_ != app::SurfaceQuantity::kDisplacement)
    return kMinShare * drawn_->model().setup().material.youngsModulus;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& node : drawn_->model().setup().mesh().nodes) box.extend(node);
  return kMinShare * box.diagonal().norm();
}

void Simulation::updateRange() {
  if (values_.empty()) return;
  if (quantity_ == app::SurfaceQuantity::kStiffness) {
    range_.setEnds(stiffness_.colours().range);
    return;
  }
  if (quantity_ == app::SurfaceQuantity::kStiffnessGradient) {
    range_.setEnds({-gradientEnd_, gradientEnd_});
    return;
  }
  double largest = 0;
  for (const double value : values_) largest = std::max(largest, std::abs(value));
  if (largest == 0) {
    // Without contacts and loads show no colours, instead of one colour for zero.
    std::fill(values_.begin(), values_.end(), std::numeric_limits<double>::quiet_NaN());
  }
  range_.update(largest, leastRange(), app::infoOf(quantity_).isSigned);
}

}  // namespace palpa::gui

#include "app/core/results/touch_batch.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "app/core/model/contact_kind.h"
#include "app/core/results/field_sample.h"
#include "app/core/results/tool_trajectory.h"
#include "app/core/results/touch.h"
#include "base/parallel.h"
#include "base/scratch_pool.h"
#include "bem/base/error.h"
#include "bem/contact/contact_compliance.h"
#include "bem/contact/contact_mask.h"

namespace palpa::app {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Touches per task of a thread: tens of microseconds each.
constexpr Index kTask = 16;
/// Above this number of touches per free node all columns are computed at once.
constexpr std::size_t kTouchesPerNode = 4;

class Batch {
 public:
  Batch(const TouchableModel& model, std::span<const modeling::Touch> touches, int steps,
        const Job& job)
      : model_(model), touches_(touches), steps_(steps), job_(job), quiet_(job), pool_([this] {
          auto compliance = std::make_unique<bem::ContactCompliance>(
              model_.surface(), *model_.columns(), model_.base());
          compliance->resize(1);
          return compliance;
        }) {
    quiet_.progress = nullptr;
    const auto count = static_cast<Index>(touches.size());
    result_.places.resize(3, count);
    for (auto* each :
         {&result_.normals, &result_.forces, &result_.displacements, &result_.deflections})
      each->setZero(3, count);
    result_.stiffness.setZero(count);
    result_.statuses.resize(touches.size(), TouchBatch::Status::kGrabbed);
    result_.patches.resize(touches.size());
  }

  TouchBatch run() {
    bem::GreensColumns& columns = *model_.columns();
    if (kTouchesPerNode * touches_.size() > static_cast<std::size_t>(columns.nodeCount()))
      columns.compute(columns.nodesNear(model_.surface().places(), touches_.front().at), job_);
    const auto count = static_cast<Index>(touches_.size());
    parallelFor((count + kTask - 1) / kTask, job_, Phase::kTouch, [&](Index task) {
      std::unique_ptr<bem::ContactCompliance> compliance = pool_.take();
      const Index last = std::min(count, (task + 1) * kTask);
      for (Index k = task * kTask; k < last; ++k) touch(k, *compliance);
      pool_.giveBack(std::move(compliance));
    });
    return std::move(result_);
  }

 private:
  /// Names the touch by its number, because touches of a batch have no names.
  void touch(Index index, bem::ContactCompliance& compliance) {
    try {
      evaluate(index, compliance);
    } catch (const bem::SolverError& error) {
      throw bem::SolverError(error.kind(), "touch " + std::to_string(index) + ": " + error.what());
    }
  }

  void evaluate(Index index, bem::ContactCompliance& compliance) {
    const modeling::Touch& touch = touches_[static_cast<std::size_t>(index)];
    const bem::ContactSurface& surface = model_.surface();
    const bem::SurfacePoint place = surface.nearest(touch.at);
    const double size = surface.mesh().boundingSize();
    // The exact check looks at every triangle.
    if (place.distance > 0.02 * size) checkNearSurface(surface.mesh(), touch.at, "the place");
    result_.places.col(index) = place.position;
    result_.normals.col(index) = surface.normal(place);
    const bem::ContactTool tool{contactKindOf(touch.kind),
                                touch.radius.value_or(defaultTouchRadius(surface.mesh())),
                                touch.friction};
    if (tool.presses())
      press(index, touch, tool);
    else
      hold(index, touch, place, tool.radius, compliance);
  }

  /// A grab, a force or a pin.
  void hold(Index index, const modeling::Touch& touch, const bem::SurfacePoint& place,
            double radius, bem::ContactCompliance& compliance) {
    if (!compliance.place(0, place, radius))
      bem::makeContactMask(model_.surface(), place.position, radius);  // throws
    while (!compliance.missing().empty()) {
      model_.columns()->computeAround(compliance.missing(), model_.surface().places(), quiet_);
      compliance.forgetMissing();
      compliance.place(0, place, radius);
    }
    compliance.update();
    const Matrix3d own = compliance.compliance();
    const Vector3d free = compliance.freeDisplacements();
    Vector3d force = touch.vector;
    if (!modeling::infoOf(touch.kind).isForce) {
      const bool isPin = touch.kind == modeling::TouchKind::kPin;
      force = own.ldlt().solve(isPin ? touch.vector : Vector3d(touch.vector - free));
    }
    const Vector3d deflection = own * force;
    result_.forces.col(index) = force;
    result_.deflections.col(index) = deflection;
    result_.displacements.col(index) = free + deflection;
    const double length = deflection.norm();
    result_.stiffness[index] = length > 0 ? force.norm() / length : 0;
    result_.patches[static_cast<std::size_t>(index)] = {{place, radius, force}};
  }

  /// A push or a ball.
  void press(Index index, const modeling::Touch& touch, const bem::ContactTool& tool) {
    const MovingTool moving{tool, touch.at, touch.vector};
    const ToolsAtRest rest = moveTools(model_.model(), model_.surface(), *model_.columns(), {},
                                       {&moving, 1}, model_.base(), steps_, quiet_);
    const bem::ContactSimulation::Contact& contact = rest.contacts.front();
    const auto k = static_cast<std::size_t>(index);
    result_.forces.col(index) = contact.force;
    result_.displacements.col(index) = contact.displacement;
    result_.deflections.col(index) = contact.deflection;
    result_.stiffness[index] = contact.stiffness;
    result_.statuses[k] = contact.status;
    result_.patches[k] = contact.patch;
  }

  const TouchableModel& model_;
  std::span<const modeling::Touch> touches_;
  const int steps_;
  const Job& job_;
  Job quiet_;
  ScratchPool<std::unique_ptr<bem::ContactCompliance>> pool_;
  TouchBatch result_;
};

}  // namespace

TouchBatch touchOneByOne(const TouchableModel& model, std::span<const modeling::Touch> touches,
                         int steps, const Job& job) {
  if (touches.empty()) return {};
  return Batch(model, touches, steps, job).run();
}

}  // namespace palpa::app

#include "app/core/results/touch_batch.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "app/core/model/contact_kind.h"
#include "app/core/results/field_sample.h"
#include "app/core/results/tool_trajectory.h"
#include "app/core/results/touch.h"
#include "base/parallel.h"
#include "base/scratch_pool.h"
#include "bem/base/error.h"
#include "bem/contact/contact_mask.h"

namespace palpa::app {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Touches per task of a thread: tens of microseconds each.
constexpr std::size_t kTask = 16;
/// Above this number of touches per free node all columns are computed at once.
constexpr std::size_t kTouchesPerNode = 4;

/// A mask, and the memory for making masks.
struct PlacedMask {
  std::unique_ptr<bem::ContactSurface::Workspace> workspace;
  bem::ContactMask mask;

  /// D = Ψ^T Xi Φ of the mask, mm/N, symmetrised. bem::ContactCompliance computes the same for many
  /// masks, with the field of each at hand; here every column is reduced at once, which costs half.
  /// The columns of the mask must be available.
  Matrix3d compliance(const bem::GreensColumns& columns, const bem::DegreesOfFreedom& dofs) const;
};

Matrix3d PlacedMask::compliance(const bem::GreensColumns& columns,
                                const bem::DegreesOfFreedom& dofs) const {
  const std::size_t measured = mask.measureNodes.size();
  Matrix3d sum = Matrix3d::Zero();
  for (std::size_t k = 0; k < mask.nodes.size(); ++k) {
    const float* x = columns.column(mask.nodes[k], 0);
    const float* y = columns.column(mask.nodes[k], 1);
    const float* z = columns.column(mask.nodes[k], 2);
    Eigen::Matrix3f means = Eigen::Matrix3f::Zero();
    for (std::size_t i = 0; i < measured; ++i) {
      const int node = mask.measureNodes[i];
      const auto weight = static_cast<float>(mask.measure[i]);
      const Index row = 3 * static_cast<Index>(node);
      if (dofs.isFree(node)) {
        means.col(0) += weight * Eigen::Vector3f::Map(x + row);
        means.col(1) += weight * Eigen::Vector3f::Map(y + row);
        means.col(2) += weight * Eigen::Vector3f::Map(z + row);
        continue;
      }
      // In the fixed directions the unknowns are tractions; the displacements are zero.
      const Eigen::Matrix3f frame = dofs.frame(node).cast<float>();
      for (int axis = dofs.constrained(node); axis < 3; ++axis)
        means += weight * frame.col(axis) *
                 Eigen::RowVector3f(x[row + axis], y[row + axis], z[row + axis]);
    }
    sum += mask.traction[k] / dofs.tractionScale() * means.cast<double>();
  }
  return 0.5 * (sum + sum.transpose());
}

class Batch {
 public:
  Batch(const TouchableModel& model, std::span<const modeling::Touch> touches, int steps,
        const Job& job)
      : model_(model),
        touches_(touches),
        steps_(steps),
        job_(job),
        quiet_(job),
        size_(model.surface().mesh().boundingSize()),
        defaultRadius_(defaultTouchRadius(model.surface().mesh())),
        pool_([this] {
          auto placed = std::make_unique<PlacedMask>();
          placed->workspace = model_.surface().makeWorkspace();
          return placed;
        }) {
    quiet_.progress = nullptr;
    places_.resize(touches.size());
    order_.resize(touches.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
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
    forEach(std::nullopt, [&](std::size_t k, PlacedMask&) { find(k); });
    // Touches of one place after the other read the same columns, which then are in the cache.
    std::sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
      const int first = places_[a].triangle, second = places_[b].triangle;
      return first != second ? first < second : a < b;
    });
    forEach(Phase::kTouch, [&](std::size_t k, PlacedMask& placed) { evaluate(k, placed); });
    return std::move(result_);
  }

 private:
  /// Calls `body` for every touch in the order of order_, on the job's threads. Names the touch in
  /// errors by its number, because touches of a batch have no names.
  template <class Body>
  void forEach(std::optional<Phase> phase, const Body& body) {
    const std::size_t tasks = (order_.size() + kTask - 1) / kTask;
    parallelFor(static_cast<std::ptrdiff_t>(tasks), job_, phase, [&](std::ptrdiff_t task) {
      std::unique_ptr<PlacedMask> placed = pool_.take();
      const std::size_t first = static_cast<std::size_t>(task) * kTask;
      const std::size_t last = std::min(order_.size(), first + kTask);
      for (std::size_t k = first; k < last; ++k) {
        try {
          body(order_[k], *placed);
        } catch (const bem::SolverError& error) {
          throw bem::SolverError(error.kind(),
                                 "touch " + std::to_string(order_[k]) + ": " + error.what());
        }
      }
      pool_.giveBack(std::move(placed));
    });
  }

  /// The place on the surface.
  void find(std::size_t k) {
    const bem::ContactSurface& surface = model_.surface();
    places_[k] = surface.nearest(touches_[k].at);
    // The exact check looks at every triangle.
    if (places_[k].distance > 0.02 * size_)
      checkNearSurface(surface.mesh(), touches_[k].at, "the place");
    result_.places.col(static_cast<Index>(k)) = places_[k].position;
    result_.normals.col(static_cast<Index>(k)) = surface.normal(places_[k]);
  }

  void evaluate(std::size_t k, PlacedMask& placed) {
    const modeling::Touch& touch = touches_[k];
    const bem::ContactTool tool{contactKindOf(touch.kind), touch.radius.value_or(defaultRadius_),
                                touch.friction};
    if (tool.presses())
      press(static_cast<Index>(k), touch, tool);
    else
      hold(static_cast<Index>(k), touch, places_[k], tool.radius, placed);
  }

  /// A grab, a force or a pin.
  void hold(Index index, const modeling::Touch& touch, const bem::SurfacePoint& place,
            double radius, PlacedMask& placed) {
    if (!model_.surface().makeMask(place, radius, *placed.workspace, placed.mask))
      bem::makeContactMask(model_.surface(), place.position, radius);  // throws
    while (!model_.columns()->hasAll(placed.mask.nodes))
      model_.columns()->computeAround(placed.mask.nodes, model_.surface().places(), quiet_);
    const Matrix3d own = placed.compliance(*model_.columns(), model_.surface().dofs());
    const Vector3d free = placed.mask.displacement(model_.base().u);
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
    result_.places.col(index) = contact.point.position;
    result_.normals.col(index) = model_.surface().normal(contact.point);
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
  const double size_;           // of the body, mm
  const double defaultRadius_;  // mm
  std::vector<bem::SurfacePoint> places_;
  std::vector<std::size_t> order_;
  ScratchPool<std::unique_ptr<PlacedMask>> pool_;
  TouchBatch result_;
};

}  // namespace

TouchBatch touchOneByOne(const TouchableModel& model, std::span<const modeling::Touch> touches,
                         int steps, const Job& job) {
  if (touches.empty()) return {};
  return Batch(model, touches, steps, job).run();
}

}  // namespace palpa::app

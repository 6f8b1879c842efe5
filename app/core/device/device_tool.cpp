#include "app/core/device/device_tool.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>

namespace palpa::app {
namespace {

using Eigen::Vector3d;
using Kind = bem::ContactTool::Kind;
using Status = TouchSnapshot::Status;

/// Edge length of the mapped workspace per edge length of the body.
constexpr double kAroundBody = 1.5;
/// A contact begins this many radii before the tool reaches the undeformed surface, and ends at
/// twice the distance if the tool is free.
constexpr double kReach = 2;

Eigen::AlignedBox3d boxOf(const TouchableModel& model) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& position : model.surface().mesh().nodes) box.extend(position);
  return box;
}

}  // namespace

DeviceTool::DeviceTool(DeviceTarget& target, const bem::ContactTool& tool, const DeviceHello& hello)
    : target_(target),
      tool_(tool),
      limits_{hello.maxStiffness > 0 ? hello.maxStiffness : HandleLimits::kUsualStiffness,
              hello.maxForce} {
  follow();
  if (hello.workspace.isZero(0) || !model_) return;
  const Eigen::AlignedBox3d box = boxOf(*model_);
  origin_ = box.center();
  scale_ = kAroundBody * box.sizes().maxCoeff() / hello.workspace.minCoeff();
}

DeviceTool::~DeviceTool() {
  lift();
}

void DeviceTool::lift() {
  if (contact_ != 0) target_.end(contact_);
  contact_ = 0;
  wasOutside_ = false;
  force_.reset();
}

Vector3d DeviceTool::tipFor(const DevicePosition& position) {
  const Vector3d moved = scale_ * position.position;
  if ((position.buttons & DevicePosition::kClutch) != 0) {
    if (!clutched_) {
      lift();
      clutched_ = origin_ + moved;
    }
    return *clutched_;
  }
  if (clutched_) {
    origin_ = *clutched_ - moved;
    clutched_.reset();
  }
  return origin_ + moved;
}

void DeviceTool::follow() {
  target_.read(snapshot_);
  if (snapshot_.model != number_) {
    number_ = snapshot_.model;
    model_ = number_ != 0 ? target_.model(number_) : nullptr;
  }
  if (contact_ == 0) return;
  if (snapshot_.find(contact_))
    isKnown_ = true;
  else if (isKnown_ || !model_)
    lift();
}

DeviceTool::Place DeviceTool::placeOf(const Vector3d& tip) const {
  const bem::SurfacePoint nearest = model_->surface().tree().nearest(tip);
  const Vector3d away = tip - nearest.position;
  const bem::SurfacePoint facing = model_->surface().facing(nearest, away);
  double distance = away.norm();
  if (model_->surface().normal(facing).dot(away) < 0) distance = -distance;
  if (tool_.kind == Kind::kBall) distance -= tool_.radius;
  return {distance, nearest.position};
}

void DeviceTool::beginOrEnd(const Vector3d& tip, DeviceReply& reply) {
  const Place place = placeOf(tip);
  if (place.distance > 0) wasOutside_ = true;
  if (contact_ != 0) {
    const auto* contact = snapshot_.find(contact_);
    const bool isFree = !contact || contact->force.isZero(0);
    if (isFree && place.distance > 2 * kReach * tool_.radius) {
      target_.end(contact_);
      contact_ = 0;
    }
    return;
  }
  if (!wasOutside_) {
    reply.status |= DeviceReply::kLifted;
    return;
  }
  target_.expect(place.at);
  if (place.distance > kReach * tool_.radius) return;
  try {
    contact_ = target_.begin(tool_, place.at, tip);
    isKnown_ = false;
  } catch (const TouchRefused&) {
    reply.status |= DeviceReply::kRefused;
  }
}

std::optional<SolvedContact> DeviceTool::solved(DeviceReply& reply) const {
  const auto* contact = contact_ != 0 ? snapshot_.find(contact_) : nullptr;
  if (!contact) return std::nullopt;
  if (contact->status == Status::kWaiting) reply.status |= DeviceReply::kWaiting;
  SolvedContact result;
  result.tool = (contact->value - origin_) / scale_;
  if (const double force = contact->force.norm(); force > 0) {
    reply.status |= DeviceReply::kTouching;
    result.normal = -contact->force / force;
    result.pressure = force;
    result.stiffness = scale_ * contact->stiffness;
    result.isSticking = contact->status == Status::kSticking && tool_.friction > 0;
  } else if (contact->normalCompliance > 0) {
    const bem::ContactSurface& surface = model_->surface();
    const Vector3d place = surface.smoothPosition(contact->point) + contact->displacement;
    result.normal = surface.normal(contact->point);
    result.stiffness = scale_ / contact->normalCompliance;
    double gap = result.normal.dot(contact->value - place);
    if (tool_.kind == Kind::kBall) gap -= tool_.radius;
    result.pressure = -std::max(gap, 0.0) / contact->normalCompliance;
  } else {
    return std::nullopt;
  }
  reply.stiffness = result.stiffness;
  return result;
}

DeviceReply DeviceTool::update(const DevicePosition& position, Time now) {
  DeviceReply reply;
  reply.sequence = position.sequence;
  follow();
  const Vector3d tip = tipFor(position);
  reply.model = static_cast<std::uint32_t>(number_);
  if (clutched_) {
    reply.status |= DeviceReply::kClutched;
    return reply;
  }
  if (!model_) {
    reply.status |= DeviceReply::kNoModel;
    lift();
    return reply;
  }
  beginOrEnd(tip, reply);
  // The clock of the device also counts while this thread does not run.
  const double seconds = position.time > 0
                             ? position.time
                             : std::chrono::duration<double>(now.time_since_epoch()).count();
  reply.force = force_.update(position.position, seconds, solved(reply), limits_);
  if (contact_ != 0) target_.set(contact_, origin_ + scale_ * force_.tool());
  if (force_.isLimited()) reply.status |= DeviceReply::kLimited;
  reply.ageMs = std::chrono::duration<double, std::milli>(now - snapshot_.time).count();
  return reply;
}

}  // namespace palpa::app

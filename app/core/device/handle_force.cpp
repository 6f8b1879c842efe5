#include "app/core/device/handle_force.h"

#include <algorithm>
#include <cmath>

namespace palpa::app {
namespace {

using Eigen::Vector3d;

constexpr double kMinPeriod = 0.2e-3, kMaxPeriod = 20e-3;  // s, of the estimate
constexpr double kPeriodShare = 0.05;                      // of a new period in the estimate
constexpr double kVelocityShare = 0.5;                     // of a new difference in the velocity
/// Below this velocity along the force the handle counts as resting: its force is the body's.
constexpr double kRestVelocity = 20;  // mm/s
/// Factor of the hardness at each step that gives energy which was not stored, its lower limit, and
/// the time in which it grows again.
constexpr double kSoftening = 0.8, kMinHardness = 0.05;
constexpr double kRecovery = 2;  // s
constexpr double kRefill = 2;    // mJ/s, of the store of a pressed contact
/// Time in which the largest elastic energy of a contact is forgotten.
constexpr double kForgetting = 1;  // s
/// Times between positions are this much shorter than the time after which the device lets go.
constexpr double kAgeTolerance = 0.5e-3;  // s
/// Share of the change of energy between two forces that counts as given if the time at which the
/// second one replaced the first matters (the worst share), and how long it does.
constexpr double kTimingShare = 0.5, kUnsettled = 50e-3;  // s
constexpr double kMinMass = 0.05;                         // kg, of a handle
constexpr double kPerKilogram = 1e3;                      // mm/s^2 kg/N
/// A handle that has stayed within this distance for this time is held: it has received next to no
/// energy, however its forces changed. What it gets when it begins to move adds up to this credit.
constexpr double kHeldDistance = 0.005, kHeldTime = 0.1, kHeldCredit = 0.1;  // mm, s, mJ
/// The next motion is predicted from the velocity with this factor.
constexpr double kMargin = 1.2;
/// The force rises at most so many times as fast as the spring is compressed,
constexpr double kRise = 1.5;
/// and to the body's force in this time if the handle rests.
constexpr double kRiseTime = 20e-3;  // s

}  // namespace

/// The solver's force at another position.
Vector3d HandleForce::extrapolated(const Vector3d& position) const {
  const Vector3d& n = solved_.normal;
  const Vector3d back = solved_.stiffness * (solved_.tool - position);
  const double pressure = solved_.pressure + n.dot(back);
  if (pressure <= 0) return Vector3d::Zero();
  Vector3d force = pressure * n;
  if (solved_.isSticking) force += back - n * n.dot(back);
  return force;
}

/// Counts the energy of the last motion and follows the velocity.
HandleForce::Step HandleForce::follow(const Vector3d& position, double seconds) {
  Step step{period_, Vector3d::Zero()};
  if (isFollowed_) {
    step.elapsed = std::clamp(seconds - seconds_, kMinPeriod, kMaxPeriod);
    step.moved = position - position_;
    period_ += kPeriodShare * (step.elapsed - period_);
    velocity_ += kVelocityShare * (step.moved / step.elapsed - velocity_);
    double given = 0.5 * (force_ + before_).dot(step.moved);
    // After a silence forces change fast, so that the time at which they change matters.
    if (seconds < settled_) given += kTimingShare * std::abs((force_ - before_).dot(step.moved));
    // A device that has let go applies nothing until the next force arrives; or nobody knows: only
    // what it may have given counts.
    if (wasSilent_) given = std::max(given, 0.5 * force_.dot(step.moved));
    if ((position - anchor_).norm() > kHeldDistance) {
      anchor_ = position;
      since_ = seconds;
    }
    if (isHeld_) heldGiven_ = std::max(0.0, heldGiven_ + given);
    if (stored_ >= 0) heldGiven_ = 0;
    isHeld_ = seconds - since_ > kHeldTime && heldGiven_ < kHeldCredit;
    wasSilent_ = !isHeld_ && seconds - seconds_ > kMaxAge - kAgeTolerance;
    if (wasSilent_) {
      given = std::max(given, mostGivenInSilence());
      settled_ = seconds + kUnsettled;
    }
    stored_ -= given;
    received_ -= given;
    hardness_ += (1 - hardness_) * step.elapsed / kRecovery;
    if (stored_ < 0 && given > 0) hardness_ = std::max(kSoftening * hardness_, kMinHardness);
  }
  if (!isFollowed_) {
    anchor_ = position;
    since_ = seconds;
  }
  isFollowed_ = true;
  seconds_ = seconds;
  position_ = position;
  return step;
}

/// The most energy that the last forces can have given in kMaxAge to a light handle that nobody
/// held, mJ.
double HandleForce::mostGivenInSilence() const {
  double most = 0;
  for (const Vector3d& force : {before_, force_}) {
    const double size = force.norm();
    if (size == 0) continue;
    const double along = std::max(0.0, force.dot(velocity_) / size);
    most =
        std::max(most, size * kMaxAge * (along + 0.5 * kPerKilogram * size / kMinMass * kMaxAge));
  }
  return most;
}

/// The body's force with damping along it: at most as large as the pressure, so that a contact
/// begins without a jump and does not pull.
Vector3d HandleForce::damped(const Vector3d& force, const Vector3d& body, double stiffness) const {
  const Vector3d n = body.normalized();
  const double pressure = std::max(0.0, n.dot(force));
  const double damping = std::min(1.5 * stiffness * period_, kMaxDamping);
  const double braking = std::clamp(-damping * n.dot(velocity_), -pressure, pressure);
  return force + (std::max(0.0, pressure + braking) - n.dot(force)) * n;
}

/// Fills the store of energy, up to twice the largest elastic energy of the contact; `elastic`: the
/// present one, mJ.
void HandleForce::refill(double elastic, double elapsed) {
  peak_ = std::max(peak_ * std::exp(-elapsed / kForgetting), elastic);
  if (stored_ < elastic) stored_ += std::clamp(received_ - stored_, 0.0, kRefill * elapsed);
}

/// The largest force in the direction of a wanted one, `asked` N, that neither rises too fast nor
/// gives energy that is not stored.
double HandleForce::largest(const Vector3d& direction, double asked, double stiffness,
                            const Step& step) const {
  if (isHeld_) return std::min(asked, force_.norm() + asked * step.elapsed / kHeldTime);
  const double along = direction.dot(velocity_);
  const double energy = std::max(0.0, stored_);
  // Not faster than the spring would be compressed: a contact that was noticed late begins softly.
  const double pushed = std::max(0.0, -direction.dot(step.moved));
  double most = std::min(
      asked, force_.norm() + kRise * stiffness * pushed + asked * step.elapsed / kRiseTime);
  if (along > 0) {
    const double spring = std::min(most, std::sqrt(2 * stiffness * energy));
    most += std::min(along / kRestVelocity, 1.0) * (spring - most);
    most = std::min(most, energy / (kMargin * along * period_));
  }
  return seconds_ < settled_ ? std::min(most, harmless(direction, along, step)) : most;
}

/// The largest force that gives a light handle no energy that is not stored, even if nobody holds
/// it until the next force arrives: f (v t + f t^2 / 2 m) <= E, with the last or the usual velocity
/// v.
double HandleForce::harmless(const Vector3d& direction, double along, const Step& step) const {
  const double until = 2 * period_;
  const double byForce = 0.5 * kPerKilogram / kMinMass * until * until;
  const double byVelocity = std::max(along, direction.dot(step.moved) / step.elapsed) * until;
  const double energy = std::max(0.0, stored_);
  return (std::sqrt(byVelocity * byVelocity + 4 * byForce * energy) - byVelocity) / (2 * byForce);
}

Vector3d HandleForce::update(const Vector3d& position, double seconds,
                             const std::optional<SolvedContact>& solved,
                             const HandleLimits& limits) {
  const Step step = follow(position, seconds);
  // A new result continues from the force of the old one.
  const Vector3d old = share_ * extrapolated(position);
  solved_ = solved.value_or(SolvedContact());
  const Vector3d rigid = extrapolated(position);
  const double limit = hardness_ * limits.stiffness;
  share_ = solved_.stiffness > limit ? limit / solved_.stiffness : 1;
  const Vector3d body = share_ * rigid;
  tool_ = position;
  if (share_ < 1) tool_ += (1 - share_) / solved_.stiffness * rigid;
  correction_ = std::exp(-step.elapsed / kSettling) * (correction_ + old - body);
  Vector3d force = body + correction_;
  const double stiffness = share_ * solved_.stiffness;
  if (body.isZero(0) || stiffness <= 0) {
    // Without contact nothing is stored; a debt remains.
    correction_.setZero();
    force.setZero();
    stored_ = std::min(stored_, 0.0);
    peak_ = 0;
  } else {
    force = damped(force, body, stiffness);
  }
  isLimited_ = false;
  if (limits.force > 0 && force.norm() > limits.force) {
    force *= limits.force / force.norm();
    isLimited_ = true;
  }
  if (stiffness > 0) refill(body.squaredNorm() / (2 * stiffness), step.elapsed);
  stored_ = std::min(stored_, 2 * peak_);
  if (const double asked = force.norm(); asked > 0) {
    const double most = largest(force / asked, asked, stiffness, step);
    if (most < asked) force *= most / asked;
    isLimited_ = isLimited_ || most < 0.99 * asked;
  }
  before_ = force_;
  force_ = force;
  return force;
}

}  // namespace palpa::app

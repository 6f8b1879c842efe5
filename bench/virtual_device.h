#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace palpa::bench {

/// Handle of a simulated haptic device: a mass with friction, held by a hand, whose position is
/// read in steps. Lengths in mm, forces in N, time in s.
class VirtualDevice {
 public:
  struct Mechanics {
    double mass = 0.08;     ///< kg, apparent mass of a desktop device
    double damping = 1e-3;  ///< N s/mm, of the mechanism
    double quantum = 0.01;  ///< mm, resolution of the position
  };
  VirtualDevice(const Mechanics& mechanics, const Eigen::Vector3d& position)
      : mechanics_(mechanics), position_(position) {}

  /// What the encoders read.
  Eigen::Vector3d measured() const {
    return (position_ / mechanics_.quantum).array().round().matrix() * mechanics_.quantum;
  }
  const Eigen::Vector3d& position() const { return position_; }
  const Eigen::Vector3d& velocity() const { return velocity_; }

  /// Motion under constant forces of device and user for a time of any length; takes
  /// steps of at most 20 µs.
  void advance(const Eigen::Vector3d& device, const Eigen::Vector3d& hand, double seconds) {
    constexpr double kStep = 20e-6;
    const int steps = std::max(1, static_cast<int>(std::ceil(seconds / kStep)));
    const double h = seconds / steps;
    for (int k = 0; k < steps; ++k) {
      // kg mm/s^2 = mN
      const Eigen::Vector3d force = device + hand - mechanics_.damping * velocity_;
      const Eigen::Vector3d before = velocity_;
      velocity_ += 1e3 * h / mechanics_.mass * force;
      const Eigen::Vector3d moved = 0.5 * h * (before + velocity_);
      position_ += moved;
      fromDevice_ += device.dot(moved);
      fromHand_ += hand.dot(moved);
    }
  }

  /// Energy that the device's force has given to the handle so far, mJ. A passive body never gives
  /// more than it has received: this number stays below zero.
  double energyFromDevice() const { return fromDevice_; }
  double energyFromHand() const { return fromHand_; }
  double kineticEnergy() const { return 0.5e-3 * mechanics_.mass * velocity_.squaredNorm(); }

 private:
  Mechanics mechanics_;
  Eigen::Vector3d position_, velocity_ = Eigen::Vector3d::Zero();
  double fromDevice_ = 0, fromHand_ = 0;
};

}  // namespace palpa::bench

#pragma once

#include <Eigen/Core>
#include <optional>

namespace palpa::app {

/// The newest result of the solver for the tool of a device, in the coordinates of the device, as a
/// plane spring: at the position x the tool is pressed with pressure + stiffness * normal . (tool -
/// x), if that is positive.
struct SolvedContact {
  Eigen::Vector3d tool = Eigen::Vector3d::Zero();    ///< mm, position that was solved
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, direction of the force on the tool
  double pressure = 0;      ///< N along the normal; negative before the tool touches
  double stiffness = 0;     ///< N/mm
  bool isSticking = false;  ///< with friction, and not sliding
};

/// What a device can do.
struct HandleLimits {
  static constexpr double kUsualStiffness = 3;  ///< N/mm, of a device that does not state it
  double stiffness = kUsualStiffness;           ///< N/mm, > 0
  double force = 0;                             ///< N; 0: unlimited
};

/// Force on the handle of a device between two results of the solver, such that the handle receives
/// no energy from sampling and delay: the body is passive.
///
/// The solver's result is some milliseconds old. So the force at the present position is taken from
/// its plane spring (SolvedContact; a sticking tool has the stiffness in all directions), which is
/// known before the tool touches: the delay of the solver does not act as a delay of the force. New
/// results change the force gradually, by a correction that decays within kSettling.
///
/// A sampled spring k with period T generates energy like a negative damper k T / 2 (J. E. Colgate,
/// J. M. Brown, "Factors affecting the Z-width of a haptic display", ICRA 1994); a delay of up to
/// one period adds k T. Damping of 3/2 k T along n compensates this, as far as kMaxDamping. A body
/// that is stiffer than the device can be is felt with the device's stiffness: the tool stays
/// nearer to the surface than the handle.
///
/// Energy is counted in addition (B. Hannaford, J.-H. Ryu, "Time-domain passivity control of haptic
/// interfaces", IEEE Trans. Robot. Autom. 18, 2002): a store E holds what the handle has given, at
/// most twice the largest elastic energy |f|^2 / (2 k) of this contact. While the handle moves
/// along the force, the force is at most the force of a spring with this energy, sqrt(2 k E), and
/// too small to exceed it in the next step. Steps that exceed it nevertheless reduce the stiffness
/// for some seconds. The mean of the last two forces counts, because the device applies a force
/// after an unknown part of the period. After a silence longer than kMaxAge the last forces may
/// have pushed the handle out before the device let go, and the user may have pushed it back: the
/// largest such energy counts as given. A handle that rests within some thousandths of a millimetre
/// is held by the user and gets the body's force, whatever is stored: on a stalled machine, too.
/// When it begins to move, it may get 0.1 mJ in this way until something is stored again.
/// The store of a pressed contact also fills by 2 mJ/s from what the handle has given in total
/// (damping keeps most of it), so that a resting handle gets the body's whole force back. So
/// neither the body, a change of the model, another touch nor a stalled machine drives the handle
/// with more energy than the handle has given.
///
/// Not thread-safe; without a clock.
class HandleForce {
 public:
  static constexpr double kSettling = 3e-3;     ///< s
  static constexpr double kMaxDamping = 20e-3;  ///< N s/mm
  static constexpr double kMaxAge = 3e-3;       ///< s; devices let go of older forces

  /// Force on the handle, N, for its position (mm, of the device) at time `seconds`, which does
  /// not decrease. `solved`: none without contact.
  Eigen::Vector3d update(const Eigen::Vector3d& position, double seconds,
                         const std::optional<SolvedContact>& solved, const HandleLimits& limits);
  /// Position of the tool, mm: of the handle, or nearer to the surface if the body is stiffer than
  /// the device can be. At rest the handle has the body's force for this position.
  const Eigen::Vector3d& tool() const { return tool_; }
  /// Forgets everything: the handle was not followed for a while.
  void reset() { *this = HandleForce(); }

  /// True if the last force is below the extrapolated one.
  bool isLimited() const { return isLimited_; }

 private:
  /// Since the last position.
  struct Step {
    double elapsed;         ///< s
    Eigen::Vector3d moved;  ///< mm
  };
  Step follow(const Eigen::Vector3d& position, double seconds);
  double mostGivenInSilence() const;
  Eigen::Vector3d extrapolated(const Eigen::Vector3d& position) const;
  Eigen::Vector3d damped(const Eigen::Vector3d& force, const Eigen::Vector3d& body,
                         double stiffness) const;
  void refill(double elastic, double elapsed);
  double largest(const Eigen::Vector3d& direction, double asked, double stiffness,
                 const Step& step) const;
  double harmless(const Eigen::Vector3d& direction, double along, const Step& step) const;

  SolvedContact solved_;
  bool isFollowed_ = false;  // there is a last position
  double seconds_ = 0, period_ = 1e-3;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero(), tool_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();    // mm/s
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();       // the last
  Eigen::Vector3d before_ = Eigen::Vector3d::Zero();      // the one before
  Eigen::Vector3d correction_ = Eigen::Vector3d::Zero();  // decays
  double stored_ = 0, peak_ = 0;                          // mJ
  double received_ = 0;                                   // mJ, from the handle in total
  double share_ = 1;                                      // of the body's stiffness
  double hardness_ = 1;                                   // share of the device's stiffness in use
  bool wasSilent_ = false;                                // before the last position
  double settled_ = 0;  // s, end of the fast changes after the last silence
  Eigen::Vector3d anchor_ = Eigen::Vector3d::Zero();  // position near which the handle stays
  double since_ = 0;                                  // s, from when on
  bool isHeld_ = false;
  double heldGiven_ = 0;  // mJ, while it was held, since the store was last filled
  bool isLimited_ = false;
};

}  // namespace palpa::app

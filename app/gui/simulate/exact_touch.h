#pragma once

#include <Eigen/Core>
#include <optional>

#include "app/gui/simulate/simulate_options.h"
#include "app/gui/simulate/touch_motion.h"
#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// A touch given by numbers: kind, place, direction, depth or force, radius and friction. It is
/// applied as one contact, which can be kept as a pin, and can be stored in the project.
class ExactTouch : public QObject {
  Q_OBJECT

 public:
  enum class Direction { kInwards, kOutwards, kX, kMinusX, kY, kMinusY, kZ, kMinusZ, kVector };

  ExactTouch(const Workspace& workspace, Simulation& simulation, SimulateOptions& options);

  modeling::TouchKind kind() const { return kind_; }
  void setKind(modeling::TouchKind kind);
  /// mm, on the unloaded shape; none until it is picked or typed.
  const std::optional<Eigen::Vector3d>& place() const { return place_; }
  void setPlace(const Eigen::Vector3d& place);
  Direction direction() const { return direction_; }
  void setDirection(Direction direction);
  /// Of Direction::kVector, of any length.
  const Eigen::Vector3d& vector() const { return vector_; }
  void setVector(const Eigen::Vector3d& vector);
  double depth() const;  ///< mm
  void setDepth(double depth);
  double force() const;  ///< N
  void setForce(double force);
  double radius() const;
  double friction() const { return options_.friction(); }
  SimulateOptions& options() { return options_; }

  /// True if a place is chosen and the model is ready.
  bool isComplete() const { return place_ && simulation_.drawn(); }
  /// Unit vector of the direction, at the place.
  Eigen::Vector3d unit() const;
  /// As a touch of a project. Requires isComplete().
  modeling::Touch touch() const;

  bool isApplied() const;
  /// Applies the touch instead of the one applied before. False if it is refused
  /// (Editor::refused has the reason).
  bool apply();
  /// Applies the touch if it is not, and leaves it as a pin.
  void keep();
  /// Ends the applied contact; false without one.
  bool release();
  /// Adds the touch to the project.
  void store();

 Q_SIGNALS:
  /// A number, or isApplied(), changed.
  void changed();

 private:
  bool checkPlace() const;
  bool begin();

  Workspace workspace_;
  Simulation& simulation_;
  SimulateOptions& options_;
  TouchMotion motion_;
  modeling::TouchKind kind_ = modeling::TouchKind::kBall;
  std::optional<Eigen::Vector3d> place_;
  Direction direction_ = Direction::kInwards;
  Eigen::Vector3d vector_{0, 0, -1};
  std::optional<double> depth_, force_;
  app::TouchId applied_ = 0;
  /// Contact that has ended and still deforms the drawn body; applied_ begins without it. Zero:
  /// none.
  app::TouchId leaving_ = 0;
  bool isKeptLater_ = false;  ///< keep() while a contact is leaving
};

}  // namespace palpa::gui

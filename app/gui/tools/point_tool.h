#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "app/gui/tools/point_picker.h"
#include "app/gui/view/tool.h"
#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// What the tools that change control points have in common: selecting; and one motion at a time,
/// begun by a drag of what is selected or of a handle, or by the keys G, X, Y, Z. While it lasts
/// X, Y, Z and N hold it to an axis or the normal (the same key again frees it), digits give its
/// size, the wheel changes the falloff; Enter, a click or letting go ends it, Escape or the right
/// button takes it back. It is one step of undo.
class PointTool : public Tool {
 public:
  PointTool(const Workspace& workspace, PointOptions& options);

  void activate() override;
  void deactivate() override;
  bool press(const PointerEvent& event) override;
  bool move(const PointerEvent& event) override;
  bool release(const PointerEvent& event) override;
  bool doubleClick(const PointerEvent& event) override;
  bool wheel(const PointerEvent& event, double notches) override;
  void leave() override;
  bool key(QKeyEvent* event) override;
  bool wantsKey(const QKeyEvent& event) const override;
  bool cancel() override;
  QCursor cursor() const override;
  QWidget* makeOptions(QWidget* parent) override;

 protected:
  /// How much was done, as the tool reads it: a displacement (mm), degrees in x, or factors.
  using Amount = Eigen::Vector3d;

  struct Motion {
    view::GizmoAxis axis = view::GizmoAxis::kAll;
    Eigen::Vector3d centre;  ///< middle of the points at the start
    Eigen::Vector3d place;   ///< what the pointer holds: a point or the centre
    Eigen::Vector3d normal;  ///< mean outward one of the points at the start; zero: none
    Eigen::Vector2d from;    ///< the pointer at the start and now
    Eigen::Vector2d pixel;
    double turned = 0;  ///< degrees that the pointer went around the centre
    modeling::PointSelection points;
    modeling::Reach reach;
    std::vector<Eigen::Vector3d> before;  ///< all control points
    Amount amount = Amount::Zero();       ///< in force
    bool isByKeys = false;                ///< without a button held
    QString typed;
  };

  virtual view::GizmoKind kind() const = 0;
  virtual bool allows(view::GizmoAxis axis) const = 0;
  virtual Amount neutral() const = 0;
  /// From the pointer; nothing where it says nothing. `snap`: to round steps.
  virtual std::optional<Amount> pointed(const Motion& motion, bool snap) const = 0;
  virtual std::optional<Amount> entered(const Motion& motion, const QString& text) const = 0;
  /// What leads from one amount to another; nothing when that cannot be said.
  virtual std::optional<Amount> between(const Amount& from, const Amount& to) const = 0;
  virtual modeling::Command command(const Motion& motion, const Amount& amount) const = 0;
  /// "x 5 mm", beside the points.
  virtual QString describe(const Motion& motion) const = 0;

  /// Of an axis, or towards the eye for kAll; the normal for kNormal.
  Eigen::Vector3d directionOf(const Motion& motion) const;
  /// Unit vectors to the right and up on the screen.
  std::array<Eigen::Vector3d, 2> screenAxes() const;
  QString axisName(const Motion& motion) const;
  /// A round length, about a hundredth of the body's size.
  double lengthStep() const;
  ShownUnits units() const;
  bool isMoving() const { return motion_.has_value(); }

  const Workspace workspace_;
  PointOptions& options_;

 private:
  std::set<int> movedPoints() const;
  void begin(view::GizmoAxis axis, const Eigen::Vector2d& pixel, bool isByKeys);
  void follow(bool snap);
  void constrain(view::GizmoAxis axis);
  void type(const QString& text);
  void apply(const Amount& amount, bool anew);
  void finish();
  void abandon();
  bool motionKey(const QKeyEvent& event);
  bool nudge(const QKeyEvent& event);
  void refresh();
  void draw();
  void drawMotion(view::ToolDrawing& drawing) const;

  PointPicker picker_;
  std::optional<Motion> motion_;
  std::optional<Eigen::Vector2d> pressed_;  // on what can be dragged, until it is
  std::optional<Eigen::Vector3d> held_;     // the point pressed
  view::GizmoAxis pressedAxis_ = view::GizmoAxis::kNone;
  Eigen::Vector2d pointer_ = Eigen::Vector2d::Zero();
  bool isActive_ = false;
  bool isApplying_ = false;
};

}  // namespace palpa::gui

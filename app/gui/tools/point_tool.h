#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "app/gui/tools/point_picker.h"
#include "app/gui/tools/snap_places.h"
#include "app/gui/view/tool.h"
#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// Base of the tools that change control points: selection, and one motion at a time. A drag of the
/// selection or of a handle begins a motion, or a key G, X, Y, Z. During a motion X, Y, Z and N
/// restrict it to an axis or the normal, and K to the gradient of a touch's stiffness (the same key
/// again removes the restriction), digits set its size, and the wheel changes the falloff. Enter, a
/// click or a release confirms, Escape or the right button cancels. A motion is one undo step.
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
  KeyHelp keyHelp() const override;
  QWidget* makeOptions(QWidget* parent) override;

 protected:
  /// Size of a motion, depending on the tool: a displacement (mm), degrees in x, or factors.
  using Amount = Eigen::Vector3d;

  struct Motion {
    view::GizmoAxis axis = view::GizmoAxis::kAll;
    Eigen::Vector3d centre;  ///< mean of the points at the start
    Eigen::Vector3d place;   ///< dragged place: a point or the centre
    Eigen::Vector3d normal;  ///< mean outward normal at the start; zero: none
    /// Unit, at the start: makes the touch of TouchGradient stiffer; zero: none.
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    std::optional<double> stiffness{};  ///< of that touch at the start, N/mm
    Eigen::Vector2d from;               ///< pointer at the start; now: pixel
    Eigen::Vector2d pixel;
    double turned = 0;  ///< angle of the pointer's path around the centre, degrees
    modeling::PointSelection points;
    modeling::Reach reach;
    std::vector<Eigen::Vector3d> before;  ///< all control points at the start
    Amount amount = Amount::Zero();       ///< applied
    bool isByKeys = false;                ///< begun by a key, without a pressed button
    bool snaps = false;                   ///< at the last motion of the pointer
    SnapPlaces snapPlaces;
    std::optional<SnapTarget> target;  ///< under the pointer, while it snaps
    QString typed;
  };

  virtual view::GizmoKind kind() const = 0;
  virtual bool allows(view::GizmoAxis axis) const = 0;
  virtual Amount neutral() const = 0;
  /// Amount from the pointer; nothing if undefined. `snap`: rounds to steps.
  virtual std::optional<Amount> pointed(const Motion& motion, bool snap) const = 0;
  virtual std::optional<Amount> entered(const Motion& motion, const QString& text) const = 0;
  /// Amount that leads from one amount to another; nothing if undefined.
  virtual std::optional<Amount> between(const Amount& from, const Amount& to) const = 0;
  virtual modeling::Command command(const Motion& motion, const Amount& amount) const = 0;
  /// Label beside the points: "x 5 mm".
  virtual QString describe(const Motion& motion) const = 0;

  /// Direction of the axis; towards the eye for kAll, the normal for kNormal, the gradient for
  /// kGradient.
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
  void follow();
  void setSnapping(bool isReversed);
  void constrain(view::GizmoAxis axis);
  void type(const QString& text);
  /// Performs the command for the amount: as a step added to the previous ones, or `fromStart`.
  void apply(const Amount& amount, bool fromStart);
  void finish();
  void abandon();
  bool motionKey(const QKeyEvent& event);
  bool nudge(const QKeyEvent& event);
  void refresh();
  void draw();
  void drawMotion(view::ToolDrawing& drawing) const;

  PointPicker picker_;
  std::optional<Motion> motion_;
  std::optional<Eigen::Vector2d> pressed_;       // press on a draggable item, until the drag begins
  std::optional<Eigen::Vector3d> pressedPoint_;  // mm
  view::GizmoAxis pressedAxis_ = view::GizmoAxis::kNone;
  Eigen::Vector2d pointer_ = Eigen::Vector2d::Zero();
  bool isActive_ = false;
  bool isApplying_ = false;
};

}  // namespace palpa::gui

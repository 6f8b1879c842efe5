#pragma once

#include "app/gui/tools/surface_tool.h"

namespace palpa::gui {

/// Paints the region of a support: patch by patch, or with a round brush. Paints the selected
/// support or a new one. A drag is one undo step.
class SupportTool : public SurfaceTool {
  Q_OBJECT

 public:
  enum class Brush { kPatch, kRound };

  using SurfaceTool::SurfaceTool;

  bool press(const PointerEvent& event) override;
  bool move(const PointerEvent& event) override;
  bool release(const PointerEvent& event) override;
  bool key(QKeyEvent* event) override;
  bool wantsKey(const QKeyEvent& event) const override;
  bool cancel() override;
  QCursor cursor() const override { return Qt::CrossCursor; }
  QString hint() const override;
  QWidget* makeOptions(QWidget* parent) override;

  Brush brush() const { return brush_; }
  void setBrush(Brush brush);
  /// Radius of the brush, mm.
  double radius() const;
  void setRadius(double radius);
  /// Kind of the painted support, or of new ones.
  modeling::Support::Kind kind() const;
  void setKind(modeling::Support::Kind kind);

 private:
  std::vector<KeyHelp::Row> keyRows() const override;
  /// The painted support; without parts if it does not exist yet.
  modeling::Support painted() const;
  bool put(modeling::Support support);
  void paintPatch(int patch);
  void paintAt(const Eigen::Vector3d& position);
  void eraseAt(const SurfacePlace& place);
  /// Removes the points of strokes among the parts that are nearer than the radius.
  void eraseStrokes(std::vector<modeling::RegionPart>& parts,
                    const Eigen::Vector3d& position) const;
  /// Continues the present stroke, the last of the parts, or begins another one.
  void extend(std::vector<modeling::RegionPart>& parts, const Eigen::Vector3d& position) const;
  void paintAlong(const Eigen::Vector2d& pixel);
  void hover(const Eigen::Vector2d& pixel);

  Brush brush_ = Brush::kPatch;
  modeling::Support::Kind newKind_ = modeling::Support::Kind::kFixed;
  std::optional<double> radius_;  // mm; default: a share of the body's size
  bool isPainting_ = false;
  bool erases_ = false;
  bool hasBegunStroke_ = false;  // the last part (or exception) is the present stroke
  Eigen::Vector2d last_ = Eigen::Vector2d::Zero();  // pixel
};

}  // namespace palpa::gui

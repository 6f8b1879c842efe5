#pragma once

#include <QObject>
#include <QTimer>
#include <array>
#include <memory>
#include <optional>
#include <set>
#include <thread>

#include "app/core/live/stiffness_worker.h"
#include "app/core/live/touch_field.h"
#include "app/core/live/touch_loop.h"
#include "app/core/results/drawn_body.h"
#include "app/core/results/stiffness_colours.h"
#include "app/gui/document/editor.h"

namespace palpa::gui {

/// Simulate mode without its pictures: the touch loop on the newest model, what it says, and the
/// body as its forces deform it. Follows the editor: after an edit the old model is touched until
/// the new one is ready.
class Simulation : public QObject {
  Q_OBJECT

 public:
  explicit Simulation(Editor& editor, QObject* parent = nullptr);
  ~Simulation() override;

  bool isActive() const { return timer_.isActive(); }
  /// Leaving lets go of everything.
  void setActive(bool active);

  // The hand. Places are on the unloaded shape, values as for bem::ContactSimulation::begin().
  /// Nothing when it is refused; Editor::refused says why.
  std::optional<app::TouchId> begin(const bem::ContactTool& tool, const Eigen::Vector3d& at,
                                    const Eigen::Vector3d& value);
  void move(app::TouchId id, const Eigen::Vector3d& value) { loop_->set(id, value); }
  void letGo(app::TouchId id);
  /// Was it let go, though the snapshot still has it?
  bool isOver(app::TouchId id) const { return over_.contains(id); }
  void letGoOfAll();
  /// Where the pointer is, mm on the unloaded shape: columns are computed around it.
  void expect(const Eigen::Vector3d& at) { loop_->expect(at); }

  // What is drawn.
  void setQuantity(app::SurfaceQuantity quantity);
  app::SurfaceQuantity quantity() const { return quantity_; }
  /// mm, of the fingertip whose stiffness colours the surface; a fingertip's for the body when none
  /// was set.
  void setFingertip(double radius);
  /// How much of the surface has its stiffness, 0 … 1.
  double stiffnessReady() const { return stiffnessReady_; }
  /// Its colours.
  const app::StiffnessColours& stiffnessColours() const { return stiffnessColours_; }
  /// Factor of the displacements in the picture, 0 … 1000; forces do not know of it.
  void setScale(double scale);
  double scale() const { return scale_; }

  /// The state of the last frame; its places are on the triangles of drawn().
  const app::TouchSnapshot& snapshot() const { return snapshot_; }
  /// Null until the first model is there.
  const app::DrawnBody* drawn() const { return drawn_.get(); }
  const app::DrawnBody::Shape& shape() const { return shape_; }
  /// One number per point of drawn(), with the ends of the colours: round and steady.
  const std::vector<double>& values() const { return values_; }
  const std::array<double, 2>& range() const { return range_; }
  /// Reactions, energy and balance of the last frame; some milliseconds.
  std::optional<app::TouchState> describe();
  /// Is an older model touched than the project has?
  bool isBehind() const;
  app::TouchWorker::Status columns() const { return loop_->status(); }
  app::TouchLoop& loop() { return *loop_; }
  /// The body whose pictures are drawn; null before the first.
  std::shared_ptr<const app::TouchableModel> body() const;

  /// Keeps body() and the picture as they are, whatever the loop says, until showLive().
  void freeze() { isLive_ = false; }
  void showLive();
  /// Draws a snapshot of body(), as of a replay; the picture must be frozen.
  void show(const app::TouchSnapshot& snapshot);

  /// Displacement of a surface point of drawn() in the last frame, mm.
  Eigen::Vector3d displacementAt(const bem::SurfacePoint& point) const;

 Q_SIGNALS:
  void activeChanged(bool active);
  /// The mode is being left; everything is still there.
  void leaving();
  /// drawn() is another one; framed() follows.
  void bodyChanged();
  /// shape(), values() and snapshot() are new.
  void framed();
  /// quantity(), scale() or the state of the stiffness map changed.
  void picturesChanged();

 private:
  void followModel();
  void frame();
  void makeDrawn(std::uint64_t number);
  void adopt(std::uint64_t number, std::shared_ptr<const app::DrawnBody> drawn,
             std::unique_ptr<app::TouchField> field);
  void evaluate();
  void updateRange();
  double leastRange() const;
  void computeStiffness();
  void receiveStiffness(const app::StiffnessWorker::Result& result);

  Editor& editor_;
  std::unique_ptr<app::TouchLoop> loop_;
  std::shared_ptr<const app::TouchModel> model_;  // that the loop was given last
  QTimer timer_;
  app::TouchSnapshot incoming_, snapshot_;  // as the loop says it now; of drawn()
  std::set<app::TouchId> over_;
  std::uint64_t lastStep_ = 0;
  bool wasTouched_ = false, isDirty_ = false;
  bool isLive_ = true;
  std::uint64_t drawnNumber_ = 0, wantedNumber_ = 0;
  std::shared_ptr<const app::DrawnBody> drawn_;
  std::unique_ptr<app::TouchField> field_;
  Eigen::VectorXd displacements_;
  app::DrawnBody::Shape shape_;
  std::vector<double> values_;
  std::array<double, 2> range_{0, 1};
  app::SurfaceQuantity quantity_ = app::SurfaceQuantity::kDisplacement;
  double scale_ = 1;
  std::optional<double> fingertip_;
  std::vector<double> stiffnesses_;  // one per point, in the range of the colours
  app::StiffnessColours stiffnessColours_;
  double stiffnessReady_ = 0;
  std::jthread maker_;  // of drawn bodies
  app::StiffnessWorker stiffnessWorker_;
};

}  // namespace palpa::gui

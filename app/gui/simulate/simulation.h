#pragma once

#include <QObject>
#include <QTimer>
#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "app/core/live/touch_field.h"
#include "app/core/live/touch_loop.h"
#include "app/core/results/drawn_body.h"
#include "app/core/system/priority.h"
#include "app/gui/document/editor.h"
#include "app/gui/document/rebuild_words.h"
#include "app/gui/simulate/colour_range.h"
#include "app/gui/simulate/shown_stiffness.h"
#include "base/worker_thread.h"

namespace palpa::app {
class DeviceServer;
class LoopTarget;
}  // namespace palpa::app

namespace palpa::gui {

/// Simulate mode without its drawing: the touch loop on the newest model, its snapshots, and the
/// deformed body. After an edit, touches act on the old model until the new one is ready.
class Simulation : public QObject {
  Q_OBJECT

 public:
  explicit Simulation(Editor& editor, QObject* parent = nullptr);
  ~Simulation() override;

  /// How finely a model is drawn.
  static modeling::DisplaySettings displaySettings(const app::TouchModel& model);

  bool isActive() const { return timer_.isActive(); }
  /// Leaving the mode ends all contacts.
  void setActive(bool active);

  // Contacts. Places are on the unloaded shape, values as for bem::ContactSimulation::begin().
  /// Nothing if refused; Editor::refused states the reason.
  std::optional<app::TouchId> begin(const bem::ContactTool& tool, const Eigen::Vector3d& at,
                                    const Eigen::Vector3d& value);
  void move(app::TouchId id, const Eigen::Vector3d& value) { loop_->set(id, value); }
  void end(app::TouchId id);
  /// True if the contact has ended, even if the snapshot still contains it.
  bool hasEnded(app::TouchId id) const { return ended_.contains(id); }
  void endAll();
  /// True if begin() began this contact, which only this thread may move.
  bool isOwn(app::TouchId id) const { return own_.contains(id) && !hasEnded(id); }
  /// Pointer position on the unloaded shape, mm: columns near it are computed first.
  void expect(const Eigen::Vector3d& at) { loop_->expect(at); }

  /// Listens for haptic devices, which touch the body while the mode is active; from the first
  /// setActive(true) on. Throws DeviceError.
  void listen(const std::filesystem::path& socket, const bem::ContactTool& tool);
  void stopListening();
  /// Null while it does not listen.
  const app::DeviceServer* device() const { return device_.get(); }
  /// The tool of devices that connect from now on.
  void setDeviceTool(const bem::ContactTool& tool);

  /// Number of a contact in texts, from 1 on; constant until keepNumbers() drops it.
  int numberOf(app::TouchId contact);
  /// Numbers of other contacts become free: those without a visible curve.
  void keepNumbers(const std::set<app::TouchId>& contacts);

  // Display.
  void setQuantity(app::SurfaceQuantity quantity);
  app::SurfaceQuantity quantity() const { return quantity_; }
  /// Radius of the fingertip of the stiffness colours, mm; default: a fingertip for the body.
  void setFingertip(double radius);
  /// Share of the surface with known stiffness, 0 … 1.
  double stiffnessReady() const { return stiffness_.ready(); }
  /// Colours of the stiffness.
  const app::StiffnessColours& stiffnessColours() const { return stiffness_.colours(); }
  /// Colours of the stiffness gradient: one number per point of drawn(), N/mm per cm³, or empty
  /// while unknown; the touch they belong to; true if that touch has moved since.
  void setGradientColours(std::vector<double> values, const QString& touch, bool isOutdated);
  /// Name of the colours of the stiffness gradient.
  const QString& gradientName() const { return gradientName_; }
  /// True if it exceeds the range of its colours.
  bool isGradientCapped() const { return isGradientCapped_; }
  /// Factor of the drawn displacements, 0 … 1000; forces do not depend on it.
  void setScale(double scale);
  double scale() const { return scale_; }

  /// State of the last frame; its places refer to the triangles of drawn().
  const app::TouchSnapshot& snapshot() const { return snapshot_; }
  /// Null until the first model is ready.
  const app::DrawnBody* drawn() const { return drawn_.get(); }
  const app::DrawnBody::Shape& shape() const { return shape_; }
  /// One number per point of drawn(); the range of the colours has round ends and changes rarely.
  const std::vector<double>& values() const { return values_; }
  const std::array<double, 2>& range() const { return range_.ends(); }
  /// How the ends of the colours follow the values. Stiffness has its own.
  using RangeMode = ColourRange::Mode;
  /// `manual` in the program's unit, first < second; only for kManual.
  void setRangeMode(RangeMode mode, const std::array<double, 2>& manual = {0, 1});
  RangeMode rangeMode() const { return range_.mode(); }
  /// Largest absolute value on a section: the range encloses it, too.
  void setLargestInside(double largest) { range_.setLargestInside(largest); }
  /// The same for another body beside this one.
  void setLargestBeside(double largest);
  /// The whole field of the last frame; null before the first body. Costs some milliseconds.
  const bem::BoundaryField* field();
  const std::shared_ptr<const app::DrawnBody>& sharedDrawn() const { return drawn_; }
  /// Reactions, energy and balance of the last frame; costs some milliseconds.
  std::optional<app::TouchState> describe();
  /// Why there is no drawn() yet, in a few words.
  QString waitingHint() const { return gui::waitingHint(editor_.rebuildStatus()); }
  /// True if touches act on an older model than the project's.
  bool isBehind() const;
  app::TouchWorker::Status columns() const { return loop_->status(); }
  app::TouchLoop& loop() { return *loop_; }
  /// The drawn body; null before the first.
  std::shared_ptr<const app::TouchableModel> body() const;

  /// Ignores the loop: keeps body() and the picture until showLive().
  void freeze() { isLive_ = false; }
  void showLive();
  /// Draws a snapshot of body(), for example of a replay. Requires freeze().
  void show(const app::TouchSnapshot& snapshot);

  /// Displacement of a surface point of drawn() in the last frame, mm.
  Eigen::Vector3d displacementAt(const bem::SurfacePoint& point) const;

 Q_SIGNALS:
  void activeChanged(bool active);
  /// The status of device() changed.
  void deviceChanged();
  /// Emitted before the mode is left, while the contacts still exist.
  void leaving();
  void quantityChanged();
  /// Another project replaces this one.
  void projectLeft();
  /// The state of the rebuild changed while there is no drawn() yet.
  void waitingChanged();
  /// drawn() was replaced; framed() follows.
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

  Editor& editor_;
  std::unique_ptr<app::TouchLoop> loop_;
  std::unique_ptr<app::LoopTarget> deviceTarget_;
  std::unique_ptr<app::DeviceServer> device_;     // uses the two above
  std::shared_ptr<const app::TouchModel> model_;  // last model given to the loop
  QTimer timer_;
  app::TouchSnapshot incoming_, snapshot_;  // latest of the loop; of drawn()
  std::set<app::TouchId> ended_, own_;
  std::uint64_t lastStep_ = 0;
  bool wasTouched_ = false, isDirty_ = false;
  bool isLive_ = true;
  std::uint64_t drawnNumber_ = 0, wantedNumber_ = 0;
  std::shared_ptr<const app::DrawnBody> drawn_;
  std::unique_ptr<app::TouchField> field_;
  Eigen::VectorXd displacements_;
  app::DrawnBody::Shape shape_;
  std::vector<double> values_;
  ColourRange range_;
  app::SurfaceQuantity quantity_ = app::SurfaceQuantity::kDisplacement;
  double scale_ = 1;
  ShownStiffness stiffness_;
  std::vector<double> gradient_;  // colours of the stiffness gradient, within gradientEnd_
  double gradientEnd_ = 1;
  bool isGradientCapped_ = false;
  QString gradientName_;
  std::map<app::TouchId, int> numbers_;
  WorkerThread maker_{app::lowerThreadPriority};  // of drawn bodies
};

}  // namespace palpa::gui

#pragma once

#include <QObject>
#include <memory>
#include <optional>
#include <vector>

#include "app/core/results/body_section.h"
#include "app/core/results/point_sample.h"
#include "app/core/system/priority.h"
#include "app/gui/base/settings.h"
#include "app/gui/simulate/simulation.h"
#include "app/gui/view/viewport_widget.h"
#include "base/worker_thread.h"

namespace palpa::gui {

/// Section plane of Simulate mode: cuts the body at rest and colours the section with the field
/// inside. Sections and fields are computed in the background, one at a time and always for the
/// newest plane and touch; a moving plane has a coarser mesh.
class SectionView : public QObject {
  Q_OBJECT

 public:
  SectionView(Simulation& simulation, const Settings& settings, ViewportWidget& widget);
  ~SectionView() override;

  bool isShown() const { return isShown_; }
  /// The first plane goes through the middle of the body and faces the eye.
  void setShown(bool shown);
  const modeling::Plane& plane() const { return plane_; }
  /// `isMoving`: more planes follow soon. Offsets are limited to the body.
  void setPlane(const modeling::Plane& plane, bool isMoving = false);
  /// Normal along an axis that faces the eye most, or along the view; through the same middle.
  void setNormal(const Eigen::Vector3d& normal);
  void flip();
  /// Smallest and largest offset at which the plane cuts the body, mm.
  std::array<double, 2> offsets() const;
  /// Middle of the body's box, moved into the plane; mm, at rest.
  Eigen::Vector3d middle() const;
  /// Half the diagonal of the body's box, mm.
  double reach() const;
  /// The offset rounded to a step far below a pixel, so that it reads "1.82 mm".
  double rounded(double offset) const;

  /// All fields at the point of the section under a pixel, and where it is drawn.
  struct Sample {
    app::PointSample values;
    Eigen::Vector3d drawn;
  };
  std::optional<Sample> sampleAt(const Eigen::Vector2d& pixel) const;
  /// The section with its latest states; null before the first.
  std::shared_ptr<const app::BodySection> section() const;
  const std::vector<bem::InteriorState>& states() const { return states_; }
  /// True while the shown section or its field is older than the plane or the touch.
  bool isComputing() const { return isBusy_; }

 Q_SIGNALS:
  /// isShown() or plane() changed.
  void changed();
  /// section() or states() are new.
  void updated();

 private:
  struct Result {
    std::shared_ptr<const app::SectionField> field;  ///< null if the plane misses the body
    std::shared_ptr<const app::BodySection> empty;   ///< then
    std::vector<bem::InteriorState> states;
    modeling::Plane plane;
    bool isFine;
  };
  void forget();
  void request();
  void receive(std::uint64_t generation, Result result);
  void showSection(const std::shared_ptr<const app::BodySection>& empty);
  void showShape();
  void showValues();
  bool hasFieldChanged(const bem::BoundaryField& field);

  Simulation& simulation_;
  const Settings& settings_;
  ViewportWidget& widget_;
  bool isShown_ = false, hasPlane_ = false, isMoving_ = false;
  modeling::Plane plane_;
  // Shown:
  std::shared_ptr<const app::SectionField> field_;
  std::vector<bem::InteriorState> states_;
  modeling::Plane shownPlane_;
  bool isFine_ = false, isDrawn_ = false;
  // Requested:
  bool isBusy_ = false;
  std::uint64_t generation_ = 0;  // counts bodies; results of earlier ones are dropped
  bem::BoundaryField requested_;
  WorkerThread worker_{app::lowerThreadPriority};  // the last member
};

}  // namespace palpa::gui

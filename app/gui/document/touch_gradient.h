#pragma once

#include <QObject>
#include <QString>
#include <chrono>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/core/design/gradient_worker.h"

namespace palpa::gui {

class Editor;

/// Gradient of the stiffness of one touch by the control points of the project, computed in the
/// background while it is shown. In Simulate mode it follows the touch; afterwards the touch stays
/// at its place on the body, and the gradient follows the edits. Until a newer gradient is known
/// the former one is kept and isOutdated(). A running computation is completed if only the same
/// touch has moved, so that gradients also arrive during a long motion.
class TouchGradient : public QObject {
  Q_OBJECT

 public:
  explicit TouchGradient(Editor& editor);

  /// Why the project has no gradients, as a sentence; empty if it has.
  QString obstacle() const;

  // What is shown.
  bool areArrowsShown() const { return hasArrows_; }
  void setArrowsShown(bool shown);
  void setColoursShown(bool shown);

  // The touch.
  /// Follows a touch in the view; `drawn`: of the model that is touched.
  void follow(app::StiffnessRule rule, std::shared_ptr<const app::DrawnBody> drawn);
  /// The touch in the view has ended, or the mode: it stays at its place on the body.
  void leaveView();
  /// True if there is a touch, even if its gradient is not known yet.
  bool hasTouch() const { return rule_.has_value(); }
  QString name() const { return rule_ ? QString::fromStdString(rule_->name) : QString(); }

  // The result.
  struct Known {
    app::StiffnessRule rule;
    double stiffness = 0;         ///< N/mm
    Eigen::Matrix3Xd gradient;    ///< N/mm per mm, one column per control point
    std::vector<double> surface;  ///< N/mm per cm³, per point of `drawn`; empty without colours
    std::shared_ptr<const app::DrawnBody> drawn;
    std::shared_ptr<const app::TouchModel> model;
    double seconds = 0;  ///< of the computation
  };
  const std::optional<Known>& known() const { return known_; }
  /// True if known() belongs to another touch or shape than the present ones.
  bool isOutdated() const;
  bool isComputing() const { return flight_.has_value(); }
  /// True if a newer result is to be expected: it is computed, or its model is built.
  bool isUpdating() const { return isComputing() || isBuilding_; }
  /// Why the present touch has no gradient; empty: nothing wrong.
  const QString& problem() const { return problem_; }

  /// Stiffness of the touch on the present shape.
  struct Stiffness {
    double value = 0;          ///< N/mm
    bool isPredicted = false;  ///< by the gradient, until a model of this shape is ready
  };
  /// None until it is known for the place and direction at which the touch came to rest.
  std::optional<Stiffness> stiffness() const;
  /// Unit direction in which the one point of `points` makes the touch stiffer; none for several
  /// points, and where no arrow is drawn.
  std::optional<Eigen::Vector3d> directionOf(const std::set<int>& points) const;

 Q_SIGNALS:
  /// Any of the above changed, except stiffness() by a motion of control points.
  void changed();

 private:
  /// Present project with its model; no model while it has none.
  struct Present {
    std::shared_ptr<const modeling::Project> project;
    std::shared_ptr<const app::TouchModel> model;
    std::shared_ptr<const modeling::Solid> solid;
  };
  struct Measured {
    std::shared_ptr<const app::TouchModel> model;
    double stiffness = 0;  // N/mm
  };
  struct Flight {
    std::uint64_t number = 0;
    app::GradientWorker::Request request;
  };
  void followModel();
  void update();
  bool isUpToDate() const;
  void receive(const app::GradientWorker::Result& result);
  void forget();
  /// False if there was no present model.
  bool leavePresent();
  void stop();
  void releaseResults();

  Editor& editor_;
  bool hasArrows_ = false, hasColours_ = false;
  bool isBuilding_ = false;  // the model of the present project
  Present present_;
  std::optional<app::StiffnessRule> rule_;
  std::shared_ptr<const modeling::Solid> ruleSolid_;  // that the rule is on
  std::chrono::steady_clock::time_point moved_;       // when the touch moved last
  std::shared_ptr<const app::DrawnBody> drawn_;       // null outside Simulate mode
  std::optional<Known> known_;
  std::optional<Measured> measured_;
  std::optional<Flight> flight_, failed_;
  QString problem_;
  app::GradientWorker worker_;  // destroyed first: its thread calls this object
};

}  // namespace palpa::gui

#pragma once

#include <QDateTime>
#include <QFileSystemWatcher>
#include <QObject>
#include <QTimer>
#include <map>
#include <memory>

#include "app/core/results/comparison.h"
#include "app/core/results/surface_correspondence.h"
#include "app/core/session/rebuild_pipeline.h"
#include "app/gui/document/editor.h"
#include "app/gui/simulate/simulation.h"
#include "base/worker_thread.h"

namespace palpa::gui {

/// Comparison of the open project (A) with another variant (B): builds B's model in the background
/// and plays the touches of A on both, again after every change of A. The touches are the contacts
/// in the view, or the touches of the project if there are none.
class VariantComparison : public QObject {
  Q_OBJECT

 public:
  VariantComparison(Editor& editor, Simulation& simulation, const Settings& settings,
                    QObject* parent);
  ~VariantComparison() override;

  /// Compares with this project, instead of with an earlier one. `name`: for users. `file`: where
  /// it was read; its changes are reported. Empty for a state of the history.
  void start(const modeling::Project& other, const QString& name, const QString& file = {});
  void end();
  bool isActive() const { return pipeline_ != nullptr; }

  /// Name of the open project, and of the other variant.
  QString nameOfA() const;
  const QString& nameOfB() const { return name_; }
  const QString& file() const { return file_; }
  /// Message if the file was changed or removed since it was read; otherwise empty.
  const QString& fileNotice() const { return notice_; }

  /// State of B's model. Requires isActive().
  app::RebuildStatus otherStatus() const { return pipeline_->status(); }
  void cancelBuild() {
    if (pipeline_) pipeline_->cancel();
  }
  /// Repeats a stopped or failed build.
  void buildAgain() {
    if (pipeline_) pipeline_->submit(*other_);
  }

  struct Result {
    std::shared_ptr<const app::DrawnBody> drawnA, drawnB;  ///< A: null while it has no model
    std::optional<app::Comparison> comparison;             ///< none: see `problem`
    /// From drawnA to drawnB; null without drawnA.
    std::shared_ptr<const app::SurfaceCorrespondence> surfaces;
    QString problem;        ///< why there is no comparison; empty: nothing wrong
    bool isOfView = false;  ///< the touches are the contacts in the view
  };
  /// Null before the first.
  std::shared_ptr<const Result> result() const { return result_; }
  /// True while result() is older than the touches or the models.
  bool isComputing() const { return isBusy_; }

 Q_SIGNALS:
  /// Begun, ended, progress of the build, or fileNotice().
  void changed();
  /// result() is new.
  void compared();

 private:
  struct Input {
    std::shared_ptr<const app::DrawnBody> drawnA;
    std::shared_ptr<const app::TouchModel> a, b;
    std::optional<double> densityA, densityB;
    std::vector<app::LiveContact> contacts;
    std::vector<modeling::Touch> touches;
    bool operator==(const Input& other) const;
  };
  std::shared_ptr<const app::TouchModel> modelA() const;
  Input input();
  void request();
  void compute(const Input& input, const Job& job, Result& result);
  void receive(std::uint64_t generation, std::shared_ptr<const Result> result);
  void estimate();
  void watchFile();
  void checkFile();
  void leave();

  Editor& editor_;
  Simulation& simulation_;
  const Settings& settings_;
  QString name_, file_, notice_;
  std::shared_ptr<const modeling::Project> other_;  // with the touches of A
  QFileSystemWatcher watcher_;
  QTimer fileTimer_, soon_, quiet_;
  QDateTime fileTime_;
  qint64 fileSize_ = 0;
  std::unique_ptr<app::RebuildPipeline> pipeline_;
  std::map<app::TouchId, Eigen::Vector3d> began_;  // places where contacts began, mm
  std::uint64_t generation_ = 0;                   // results of earlier ones are dropped
  bool isBusy_ = false, isEstimating_ = false;
  Input requested_;
  std::shared_ptr<const Result> result_;
  // Only the worker's tasks use them.
  std::unique_ptr<app::VariantPlayer> playerA_, playerB_;
  std::shared_ptr<const app::SurfaceCorrespondence> surfaces_;
  WorkerThread worker_;  // last: it uses all of the above
};

}  // namespace palpa::gui

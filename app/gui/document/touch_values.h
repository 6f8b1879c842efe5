#pragma once

#include <QObject>
#include <QString>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/core/model/touch_model.h"
#include "base/worker_thread.h"
#include "modeling/project/project.h"

namespace palpa::gui {

class Editor;

/// What the touches of the project feel like at present: stiffness and force of each, and the
/// values of the design's targets. Computed in the background whenever the model is new, while
/// shown.
class TouchValues : public QObject {
  Q_OBJECT

 public:
  explicit TouchValues(Editor& editor);
  ~TouchValues() override;

  /// Nothing is computed while it is false.
  void setShown(bool shown);

  /// Present value of a target, N/mm or N; none before it is known, and for a touch without force.
  std::optional<double> of(const modeling::DesignTarget& target) const;
  /// Why nothing is known, as a sentence; empty: nothing wrong.
  const QString& problem() const { return problem_; }

 Q_SIGNALS:
  void changed();

 private:
  struct Input {
    std::shared_ptr<const app::TouchModel> model;
    std::vector<modeling::Touch> touches;
    std::vector<modeling::DesignTarget> targets;
    bool operator==(const Input&) const = default;
  };
  struct Value {
    modeling::DesignTarget target;
    double value = 0;
  };
  Input present() const;
  void update();
  void receive(std::uint64_t number, std::vector<Value> values, const QString& problem);
  void forget();

  Editor& editor_;
  bool isShown_ = false;
  Input asked_;
  std::uint64_t number_ = 0;  // of the last request
  std::vector<Value> values_;
  QString problem_;
  WorkerThread worker_;  // last: its tasks call this object
};

}  // namespace palpa::gui

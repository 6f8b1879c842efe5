#pragma once

#include <QObject>
#include <QString>
#include <QTimer>
#include <memory>
#include <optional>
#include <vector>

#include "modeling/editing/change.h"
#include "modeling/measure/measured_body.h"

namespace palpa::gui {

class Editor;

/// Values of the project's measurements. They follow every edit: evaluated by results(), and
/// announced a little later, so that a drag stays fluent.
class Measurements : public QObject {
  Q_OBJECT

 public:
  struct Result {
    std::optional<modeling::MeasuredValue> value;
    QString problem;  ///< why there is no value
  };

  /// To be made before the other receivers of the editor's signals.
  explicit Measurements(Editor& editor);

  /// Results in the order of Project::measurements.
  const std::vector<Result>& results();
  /// Result of the measurement with this name; without one an empty result.
  Result resultOf(const std::string& name);

  /// Value of a measurement that need not be in the project.
  Result measure(const modeling::Measurement& measurement);

  /// The present body. Throws ModelingError if it cannot be evaluated.
  const modeling::MeasuredBody& body();

 Q_SIGNALS:
  /// results() may differ.
  void changed();

 private:
  void follow(const modeling::Change& change);

  Editor& editor_;
  std::unique_ptr<modeling::MeasuredBody> body_;
  std::optional<std::vector<Result>> results_;
  QTimer soon_;
  double cost_ = 0;  // ms, of the last evaluation of all
};

/// Copies name and value of the selected measurement to the clipboard.
void copyMeasurement(Editor& editor);

}  // namespace palpa::gui

#pragma once

#include <QObject>
#include <QTimer>
#include <memory>
#include <optional>

#include "modeling/shapes/primitive.h"

namespace palpa::gui {

/// Measures the distance between the solid of a primitive and the exact shape, on another thread,
/// since it may take a second. Only the newest request is answered.
class FitMeasurement : public QObject {
  Q_OBJECT

 public:
  explicit FitMeasurement(QObject* parent);

  void ask(const modeling::Primitive& primitive);
  /// Drops pending requests: `measured` is not emitted any more.
  void forget();

 Q_SIGNALS:
  /// mm
  void measured(double deviation);

 private:
  struct Answer;
  void look();

  std::shared_ptr<Answer> answer_;
  std::optional<modeling::Primitive> waiting_;
  bool isWanted_ = false;  // the running measurement belongs to the newest request
  QTimer timer_;
};

}  // namespace palpa::gui

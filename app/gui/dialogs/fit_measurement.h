#pragma once

#include <QObject>
#include <QTimer>
#include <memory>
#include <optional>

#include "modeling/shapes/primitive.h"

namespace palpa::gui {

/// How far the solid of a primitive is from the exact shape, measured on another thread: it may
/// take a second. Only the newest question is answered.
class FitMeasurement : public QObject {
  Q_OBJECT

 public:
  explicit FitMeasurement(QObject* parent);

  void ask(const modeling::Primitive& primitive);
  /// No answer comes any more.
  void forget();

 Q_SIGNALS:
  /// mm
  void measured(double deviation);

 private:
  struct Answer;
  void look();

  std::shared_ptr<Answer> answer_;
  std::optional<modeling::Primitive> waiting_;
  bool isWanted_ = false;  // is what is being measured still asked for?
  QTimer timer_;
};

}  // namespace palpa::gui

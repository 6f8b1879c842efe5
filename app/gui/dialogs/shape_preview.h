#pragma once

#include <QLabel>
#include <QTimer>
#include <memory>
#include <optional>

#include "app/gui/view/viewport_widget.h"
#include "modeling/shapes/primitive.h"
#include "modeling/solid/solid.h"

namespace palpa::gui {

/// View of the solid that a primitive gives, under a veil while it gives none.
class ShapePreview : public ViewportWidget {
  Q_OBJECT

 public:
  /// `whyStale` is the text of the veil.
  ShapePreview(const QString& whyStale, QWidget* parent);

  /// Draws no control net.
  void hideNet() { showsNet_ = false; }

  void showSolid(const modeling::Solid& solid);
  /// Veils the last solid.
  void setStale(bool isStale);
  /// Resets the camera for the next solid.
  void lookAgain() { isFresh_ = true; }

  /// Makes the solid on another thread and shows it; of several requests only the newest counts.
  void ask(const modeling::Primitive& primitive);
  /// Drops requests without an answer.
  void forget();

 Q_SIGNALS:
  /// The answer to ask(): empty, or the message of modeling.
  void answered(const QString& problem);

 private:
  struct Answer;
  void look();

  QLabel* veil_;
  bool isFresh_ = true;
  bool showsNet_ = true;
  std::shared_ptr<Answer> answer_;
  std::optional<modeling::Primitive> waiting_;
  bool isWanted_ = false;  // the running request is the newest
  QTimer timer_;
};

}  // namespace palpa::gui

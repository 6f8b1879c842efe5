#pragma once

#include <QLabel>
#include <QPushButton>
#include <QWidget>

#include "app/gui/document/editor.h"

namespace palpa::gui {

/// Requested and reached accuracy of the model, the reason of a difference, and the button that
/// refines the mesh of the project.
class AccuracyPanel : public QWidget {
  Q_OBJECT

 public:
  /// `name`: prefix of the object names of label and button. `showsNumbers`: false where rows
  /// beside it have the requested and the reached accuracy; then the button is always visible.
  AccuracyPanel(Editor& editor, const QString& name, bool showsNumbers, QWidget* parent);

  /// One more reason why forces are less accurate than stated; empty: none.
  void setNote(const QString& note);

 private:
  void showStatus();
  void refine();

  Editor& editor_;
  const bool showsNumbers_;
  QLabel* text_;
  QPushButton* refine_;
  QString note_;
};

}  // namespace palpa::gui

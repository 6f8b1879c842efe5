#pragma once

#include <QComboBox>
#include <QDialog>
#include <QFormLayout>
#include <QLabel>

#include "app/gui/document/editor.h"
#include "app/gui/widgets/vector_edit.h"

namespace palpa::gui {

/// Moves, rotates, scales or mirrors the whole body by exact numbers. After an error the dialog
/// stays open and shows it.
class TransformDialog : public QDialog {
  Q_OBJECT

 public:
  TransformDialog(Editor& editor, const Settings& settings, QWidget* parent);

  void accept() override;

 private:
  enum Kind { kTranslate, kRotate, kScale, kMirror };
  void showKind();
  modeling::TransformSolid command() const;

  Editor& editor_;
  QFormLayout* form_;
  QComboBox* kind_;
  VectorEdit* vector_;
  VectorEdit* axis_;
  QuantityEdit* angle_;
  VectorEdit* factors_;
  VectorEdit* normal_;
  VectorEdit* centre_;
  QLabel* problem_;
};

}  // namespace palpa::gui

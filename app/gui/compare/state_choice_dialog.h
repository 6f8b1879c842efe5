#pragma once

#include <QDialog>
#include <QListWidget>

#include "modeling/editing/document.h"

namespace palpa::gui {

/// Asks for a step of the history, or for the saved version of a project.
class StateChoiceDialog : public QDialog {
  Q_OBJECT

 public:
  /// `file`: of the project; empty: it was never saved. There must be a step or a file.
  StateChoiceDialog(const modeling::Document::History& history, const QString& file,
                    QWidget* parent);

  /// Number of the chosen step, 1 or more; 0: the saved version.
  std::size_t step() const;

 private:
  QListWidget* list_;
};

}  // namespace palpa::gui

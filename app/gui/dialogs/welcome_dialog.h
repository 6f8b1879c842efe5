#pragma once

#include <QDialog>

#include "app/gui/base/settings.h"

namespace palpa::gui {

/// Choice of a recent file, an example, a new solid or a file to begin with, and a short
/// introduction.
class WelcomeDialog : public QDialog {
  Q_OBJECT

 public:
  enum class Choice { kNothing, kExample, kNewSolid, kOpen, kRecent };

  WelcomeDialog(Settings& settings, QWidget* parent);

  Choice choice() const { return choice_; }
  /// Name of the chosen example, or the chosen recent file.
  QString chosen() const { return chosen_; }

 private:
  QLayout* makeGrid();
  void choose(Choice choice, const QString& chosen = {});

  Choice choice_ = Choice::kNothing;
  QString chosen_;
};

}  // namespace palpa::gui

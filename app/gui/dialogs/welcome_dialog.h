#pragma once

#include <QDialog>

namespace palpa::gui {

/// Choice of an example, a new solid or a file to begin with, and a short introduction.
class WelcomeDialog : public QDialog {
  Q_OBJECT

 public:
  enum class Choice { kNothing, kExample, kNewSolid, kOpen };

  explicit WelcomeDialog(QWidget* parent);

  Choice choice() const { return choice_; }
  /// Name of the chosen example.
  QString example() const { return example_; }

 private:
  void choose(Choice choice, const QString& example = {});

  Choice choice_ = Choice::kNothing;
  QString example_;
};

}  // namespace palpa::gui

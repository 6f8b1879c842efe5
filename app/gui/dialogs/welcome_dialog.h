#pragma once

#include <QDialog>

namespace palpa::gui {

/// Where to begin: an example, a new solid, a file; and how to look around.
class WelcomeDialog : public QDialog {
  Q_OBJECT

 public:
  enum class Choice { kNothing, kExample, kNewSolid, kOpen };

  explicit WelcomeDialog(QWidget* parent);

  Choice choice() const { return choice_; }
  /// Name of the example that was chosen.
  QString example() const { return example_; }

 private:
  void choose(Choice choice, const QString& example = {});

  Choice choice_ = Choice::kNothing;
  QString example_;
};

}  // namespace palpa::gui

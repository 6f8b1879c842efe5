#pragma once

#include <QDialog>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>

namespace palpa::gui {

/// Progress of a background job, with a button to stop it. Cancelling emits rejected() and leaves
/// the dialog open until the job has ended.
class ProgressDialog : public QDialog {
  Q_OBJECT

 public:
  ProgressDialog(const QString& title, QWidget* parent);

  void showProgress(const QString& phase, double fraction, bool isStopping);

 public Q_SLOTS:
  void reject() override;

 private:
  QLabel* phase_;
  QProgressBar* bar_;
  QPushButton* cancel_;
};

}  // namespace palpa::gui

#include "app/gui/dialogs/recovery_dialog.h"

#include <QApplication>
#include <QDateTime>
#include <QDialogButtonBox>
#include <QHeaderView>
#include <QLabel>
#include <QMessageBox>
#include <QThread>
#include <QTimer>
#include <QVBoxLayout>
#include <chrono>

#include "app/gui/base/background_job.h"

namespace palpa::gui {
namespace {

constexpr int kUntilNextLook = 100;  // ms
constexpr std::chrono::hours kKeptThoughOutdated(30 * 24);

/// Calls `act` as soon as no dialog is open and no job is running.
void whenFree(QWidget& window, const std::function<void()>& act) {
  if (!isBackgroundJobRunning() && !QApplication::activeModalWidget() &&
      !QApplication::activePopupWidget() && QApplication::mouseButtons() == Qt::NoButton)
    act();
  else
    QTimer::singleShot(kUntilNextLook, &window, [&window, act] { whenFree(window, act); });
}

}  // namespace

RecoveryDialog::RecoveryDialog(Editor& editor, std::vector<modeling::Snapshot> snapshots,
                               std::function<bool()> mayReplace, QWidget* parent)
    : QDialog(parent),
      editor_(editor),
      snapshots_(std::move(snapshots)),
      mayReplace_(std::move(mayReplace)),
      list_(new QTreeWidget(this)) {
  setObjectName("recovery");
  setWindowTitle(tr("Recover projects"));
  auto* what =
      new QLabel(tr("Palpa ended unexpectedly. These edits were kept and were never saved:"), this);
  what->setWordWrap(true);
  list_->setObjectName("snapshots");
  list_->setAccessibleName(tr("Snapshots"));
  list_->setRootIsDecorated(false);
  list_->setHeaderLabels({tr("Project"), tr("Time"), tr("File")});
  list_->setTextElideMode(Qt::ElideMiddle);  // names of files are at the end of their paths
  for (std::size_t i = 0; i < snapshots_.size(); ++i) {
    const modeling::Snapshot& each = snapshots_[i];
    const auto seconds =
        std::chrono::duration_cast<std::chrono::seconds>(each.time.time_since_epoch()).count();
    auto* item = new QTreeWidgetItem(
        list_, {QString::fromStdString(each.projectName),
                QLocale().toString(QDateTime::fromSecsSinceEpoch(seconds), QLocale::ShortFormat),
                each.original.empty() ? tr("never saved")
                                      : QString::fromStdString(each.original.string())});
    item->setData(0, Qt::UserRole, static_cast<int>(i));
    item->setToolTip(2, item->text(2));
  }
  list_->setCurrentItem(list_->topLevelItem(0));
  list_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  auto* buttons = new QDialogButtonBox(this);
  auto* recover = buttons->addButton(tr("&Recover"), QDialogButtonBox::AcceptRole);
  auto* discard = buttons->addButton(tr("&Discard …"), QDialogButtonBox::DestructiveRole);
  auto* later = buttons->addButton(tr("&Later"), QDialogButtonBox::RejectRole);
  recover->setObjectName("recover");
  discard->setObjectName("discard");
  later->setObjectName("later");
  recover->setDefault(true);
  connect(recover, &QPushButton::clicked, this, &RecoveryDialog::recover);
  connect(discard, &QPushButton::clicked, this, &RecoveryDialog::discard);
  connect(later, &QPushButton::clicked, this, &QDialog::reject);
  connect(list_, &QTreeWidget::itemActivated, this, &RecoveryDialog::recover);
  auto* column = new QVBoxLayout(this);
  column->addWidget(what);
  column->addWidget(list_, 1);
  column->addWidget(buttons);
  resize(680, 300);
}

const modeling::Snapshot* RecoveryDialog::chosen() const {
  const QTreeWidgetItem* item = list_->currentItem();
  return item ? &snapshots_[item->data(0, Qt::UserRole).toUInt()] : nullptr;
}

void RecoveryDialog::recover() {
  const modeling::Snapshot* snapshot = chosen();
  if (!snapshot || !mayReplace_()) return;
  accept();
  if (editor_.recover(*snapshot) && list_->topLevelItemCount() > 1)
    Q_EMIT editor_.said(tr("The other projects are still kept: File > Recover …"));
}

void RecoveryDialog::discard() {
  const modeling::Snapshot* snapshot = chosen();
  if (!snapshot) return;
  if (QMessageBox::question(this, tr("Discard"),
                            tr("Discard the edits of \"%1\" for good?")
                                .arg(QString::fromStdString(snapshot->projectName))) !=
      QMessageBox::Yes)
    return;
  try {
    modeling::discard(*snapshot);
    delete list_->currentItem();
  } catch (const std::exception& error) {
    Q_EMIT editor_.refused(QString::fromStdString(error.what()));
  }
  if (list_->topLevelItemCount() == 0) accept();
}

void offerRecovery(Editor& editor, QWidget& window, const std::function<bool()>& mayReplace,
                   const std::function<void(bool any)>& done) {
  auto found = std::make_shared<modeling::RecoveryList>();
  QThread* search = QThread::create([found] {
    try {
      *found = modeling::findRecoverable(modeling::defaultAutosaveFolder());
      // The projects of outdated snapshots were saved later. The snapshots are still kept for a
      // while, since another program may have written those files.
      const auto now = std::chrono::system_clock::now();
      for (const modeling::Snapshot& old : found->outdated)
        if (now - old.time > kKeptThoughOutdated) modeling::discard(old);
    } catch (const std::exception& error) {
      found->problems.emplace_back(error.what());
    }
  });
  search->setParent(&window);
  QObject::connect(&window, &QObject::destroyed, search, [search] { search->wait(); });
  QObject::connect(search, &QThread::finished, search, &QObject::deleteLater);
  QObject::connect(search, &QThread::finished, &window, [=, &editor, &window] {
    for (const std::string& problem : found->problems)
      Q_EMIT editor.refused(RecoveryDialog::tr("What was kept for recovery cannot be used: %1")
                                .arg(QString::fromStdString(problem)));
    whenFree(window, [=, &editor, &window] {
      const bool any = !found->snapshots.empty();
      if (any) RecoveryDialog(editor, std::move(found->snapshots), mayReplace, &window).exec();
      done(any);
    });
  });
  search->start();
}

}  // namespace palpa::gui

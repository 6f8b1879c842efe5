#include "app/gui/dialogs/guide_window.h"

#include <QDir>
#include <QFile>
#include <QHeaderView>
#include <QLineEdit>
#include <QPushButton>
#include <QRegularExpression>
#include <QSplitter>
#include <QTextCursor>
#include <QTreeWidget>
#include <QUrl>
#include <QVBoxLayout>

#include "app/gui/dialogs/guide_reader.h"

namespace palpa::gui {

GuideWindow::GuideWindow(const QString& folder, QWidget* parent) : QDialog(parent) {
  setObjectName("guide");
  setWindowTitle(tr("User guide"));
  setWindowFlag(Qt::WindowMaximizeButtonHint);
  auto* back = new QPushButton(tr("&Back"), this);
  auto* forward = new QPushButton(tr("&Forward"), this);
  for (QPushButton* button : {back, forward}) {
    button->setAutoDefault(false);
    button->setEnabled(false);
  }
  searchText_ = new QLineEdit(this);
  searchText_->setObjectName("find");
  searchText_->setPlaceholderText(tr("Find on this page, Enter for the next"));
  searchText_->setClearButtonEnabled(true);
  contents_ = new QTreeWidget(this);
  contents_->setObjectName("contents");
  contents_->setAccessibleName(tr("Contents"));
  contents_->setHeaderHidden(true);
  contents_->setRootIsDecorated(false);
  reader_ = new GuideReader(this);
  reader_->setAccessibleName(windowTitle());

  auto* line = new QHBoxLayout;
  line->addWidget(back);
  line->addWidget(forward);
  line->addStretch(1);
  line->addWidget(searchText_, 2);
  auto* splitter = new QSplitter(this);
  splitter->addWidget(contents_);
  splitter->addWidget(reader_);
  splitter->setSizes({210, 850});
  splitter->setStretchFactor(1, 1);
  auto* column = new QVBoxLayout(this);
  column->addLayout(line);
  column->addWidget(splitter, 1);
  resize(1080, 800);
  ensurePolished();
  column->activate();  // pictures need the width of the page

  connect(back, &QPushButton::clicked, reader_, &GuideReader::backward);
  connect(forward, &QPushButton::clicked, reader_, &GuideReader::forward);
  connect(reader_, &GuideReader::backwardAvailable, back, &QPushButton::setEnabled);
  connect(reader_, &GuideReader::forwardAvailable, forward, &QPushButton::setEnabled);
  connect(reader_, &GuideReader::sourceChanged, this, &GuideWindow::chooseShown);
  connect(searchText_, &QLineEdit::returnPressed, this, &GuideWindow::find);
  connect(contents_, &QTreeWidget::currentItemChanged, this, [this](QTreeWidgetItem* item) {
    if (item) reader_->setSource(item->data(0, Qt::UserRole).toUrl());
  });
  fillContents(folder);
  contents_->setCurrentItem(contents_->topLevelItem(0));
  reader_->setFocus();
}

void GuideWindow::fillContents(const QString& folder) {
  const QString first = QDir(folder).filePath("README.md");
  const auto add = [&](const QString& title, const QUrl& page) {
    auto* item = new QTreeWidgetItem(contents_, {title});
    item->setData(0, Qt::UserRole, page);
  };
  const QUrl base = QUrl::fromLocalFile(first);
  add(tr("Begin here"), base);
  QFile file(first);
  if (!file.open(QIODevice::ReadOnly)) return;
  // Each page is a line of the list of contents: "- [Title](page.md): description".
  static const QRegularExpression kEntry("^- \\[([^\\]]+)\\]\\(([^)#]+\\.md)\\)",
                                         QRegularExpression::MultilineOption);
  const QString text = QString::fromUtf8(file.readAll());
  for (auto entries = kEntry.globalMatch(text); entries.hasNext();) {
    const QRegularExpressionMatch entry = entries.next();
    add(entry.captured(1), base.resolved(QUrl(entry.captured(2))));
  }
}

void GuideWindow::chooseShown(const QUrl& place) {
  const QUrl page = place.adjusted(QUrl::RemoveFragment);
  const QSignalBlocker blocker(contents_);
  contents_->setCurrentItem(nullptr);
  for (int i = 0; i < contents_->topLevelItemCount(); ++i)
    if (contents_->topLevelItem(i)->data(0, Qt::UserRole).toUrl() == page)
      contents_->setCurrentItem(contents_->topLevelItem(i));
}

void GuideWindow::find() {
  if (reader_->find(searchText_->text())) return;
  reader_->moveCursor(QTextCursor::Start);  // search again from the top
  reader_->find(searchText_->text());
}

}  // namespace palpa::gui

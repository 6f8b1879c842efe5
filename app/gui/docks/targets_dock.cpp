#include "app/gui/docks/targets_dock.h"

#include <QApplication>
#include <QHBoxLayout>
#include <algorithm>

#include "app/gui/base/appearance.h"
#include "app/gui/document/design_edit.h"
#include "app/gui/document/editor.h"
#include "app/gui/properties/design_rows.h"
#include "app/gui/view/viewport_widget.h"
#include "app/gui/widgets/field_input.h"
#include "app/gui/widgets/scroll_column.h"

namespace palpa::gui {
namespace {

constexpr int kRefreshDelay = 30;  // ms between two refreshes during a drag
constexpr int kCheckDelay = 250;   // ms of rest before points are looked up

}  // namespace

TargetsDock::TargetsDock(const Workspace& workspace, ShapeFinder& finder, QWidget* parent)
    : QDockWidget(tr("Targets"), parent),
      workspace_(workspace),
      finder_(finder),
      values_(new TouchValues(workspace.editor)),
      stack_(new QStackedWidget(this)),
      search_(new SearchPanel(finder, workspace.settings, this)) {
  setObjectName("targetsPanel");
  stack_->addWidget(makeWish());
  stack_->addWidget(search_);
  setWidget(stack_);
  soon_.setSingleShot(true);
  soon_.setInterval(kRefreshDelay);
  later_.setSingleShot(true);
  later_.setInterval(kCheckDelay);
  connect(&soon_, &QTimer::timeout, this, &TargetsDock::update);
  connect(&later_, &QTimer::timeout, this, [this] {
    pointsProblem_ = finder_.obstacleOfPoints();
    showObstacle();
  });
  const Editor& editor = workspace.editor;
  connect(&editor, &Editor::projectChanged, this, [this](const modeling::Change& change) {
    later_.start();
    const bool isMotion = !change.movedPoints.empty() && !change.topology;
    if (!isMotion)
      update();
    else if (!soon_.isActive())
      soon_.start();
  });
  connect(&editor, &Editor::projectReplaced, this, [this] {
    pointsProblem_.clear();
    later_.start();
    update();
  });
  connect(&workspace.settings, &Settings::changed, this, &TargetsDock::update);
  connect(values_, &TouchValues::changed, this, &TargetsDock::update);
  connect(&finder, &ShapeFinder::changed, this, &TargetsDock::update);
  connect(table_, &TargetsTable::chosenChanged, this, &TargetsDock::updatePages);
  connect(table_, &TargetsTable::removalAsked, this, &TargetsDock::removeTarget);
  connect(this, &QDockWidget::visibilityChanged, values_, &TouchValues::setShown);
  later_.start();
  update();
}

TargetsDock::~TargetsDock() {
  if (targetPage_) targetPage_->retire();
  if (motionPage_) motionPage_->retire();
}

QWidget* TargetsDock::makeWish() {
  auto* wish = new QWidget(this);
  auto* content = new QWidget(wish);
  content->setObjectName("targetsContent");
  column_ = new QVBoxLayout(content);
  column_->setContentsMargins(0, 0, 0, 0);
  column_->setSpacing(0);
  auto* words =
      new QLabel(tr("Say what a touch should feel like; Find looks for the shape."), wish);
  words->setWordWrap(true);
  words->setForegroundRole(QPalette::PlaceholderText);
  words->setContentsMargins(12, 8, 12, 6);
  table_ = new TargetsTable(workspace_.editor, *values_, content);
  add_ = new QPushButton(icon("add"), tr("Add target"), content);
  add_->setObjectName("addTarget");
  remove_ = new QPushButton(icon("delete"), tr("Remove"), content);
  remove_->setObjectName("removeTarget");
  remove_->setToolTip(tr("Remove the chosen target (Delete)"));
  auto* buttons = new QHBoxLayout;
  buttons->setContentsMargins(12, 6, 12, 4);
  buttons->addWidget(add_);
  buttons->addWidget(remove_);
  buttons->addStretch();
  column_->addWidget(words);
  column_->addWidget(table_);
  column_->addLayout(buttons);
  column_->addStretch();
  QScrollArea* scroll = scrollColumn(content, wish);
  scroll->setMinimumSize(250, 120);
  message_ = new QLabel(wish);
  message_->setObjectName("searchMessage");
  message_->setWordWrap(true);
  message_->setTextFormat(Qt::PlainText);
  message_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  find_ = new QPushButton(icon("find-shape"), tr("Find a shape"), wish);
  find_->setObjectName("findShape");
  auto* bottom = new QVBoxLayout;
  bottom->setContentsMargins(12, 6, 12, 8);
  bottom->addWidget(message_);
  bottom->addWidget(find_, 0, Qt::AlignLeft);
  auto* all = new QVBoxLayout(wish);
  all->setContentsMargins(0, 0, 0, 0);
  all->setSpacing(0);
  all->addWidget(scroll, 1);
  all->addLayout(bottom);
  connect(add_, &QPushButton::clicked, this, &TargetsDock::addTarget);
  connect(remove_, &QPushButton::clicked, this, &TargetsDock::removeTarget);
  connect(find_, &QPushButton::clicked, this, &TargetsDock::find);
  return wish;
}

void TargetsDock::update() {
  table_->showTargets();
  updatePages();
  const bool isSolid = workspace_.editor.solid() != nullptr;
  const bool hasTouches = !workspace_.editor.project().touches.empty();
  add_->setEnabled(isSolid && hasTouches);
  add_->setToolTip(!isSolid      ? tr("A mesh body has no control points that could move")
                   : !hasTouches ? tr("The project has no touches yet: Place touch (T) adds one")
                                 : tr("Add a touch with what it feels like at present; then enter "
                                      "what it should feel like"));
  showObstacle();
  const int page = finder_.state() == ShapeFinder::State::kIdle ? 0 : 1;
  if (stack_->currentIndex() == page) return;
  const QWidget* focus = QApplication::focusWidget();
  const bool hadFocus = focus && stack_->isAncestorOf(focus);
  stack_->setCurrentIndex(page);
  if (!hadFocus) return;
  QWidget* next =
      page == 0 ? static_cast<QWidget*>(find_) : search_->findChild<QPushButton*>("searchStop");
  if (next->isEnabled()) next->setFocus();
}

void TargetsDock::showObstacle() {
  QString reason = finder_.obstacle();
  if (reason.isEmpty()) reason = pointsProblem_;
  find_->setEnabled(reason.isEmpty());
  find_->setToolTip(reason.isEmpty() ? tr("Search for a shape that meets all targets; the project "
                                          "changes only when it is accepted")
                                     : reason);
  QStringList texts;
  if (!finder_.message().isEmpty()) texts << finder_.message();
  if (!reason.isEmpty()) texts << reason;
  if (texts.isEmpty() && !values_->problem().isEmpty()) texts << values_->problem();
  message_->setText(texts.join("\n"));
  message_->setVisible(!texts.isEmpty());
}

void TargetsDock::updatePage(PropertyPage*& page, QString& key, const QString& wanted,
                             const std::function<void(PropertyPage&)>& fill) {
  if (page && key == wanted) {
    page->refresh();
    return;
  }
  QString focused;
  if (page) {
    const QWidget* focus = QApplication::focusWidget();
    if (focus && page->isAncestorOf(focus)) {
      focused = focus->objectName();
      workspace_.view.setFocus();
    }
    page->retire();
    column_->removeWidget(page);
    page->hide();
    page->deleteLater();  // the signal may come from one of its fields
    page = nullptr;
  }
  key = wanted;
  if (wanted.isEmpty()) return;
  page = new PropertyPage(workspace_);
  fill(*page);
  leaveLettersToMenus(*page);
  page->refresh();
  const bool isTarget = &page == &targetPage_;
  column_->insertWidget(isTarget || !targetPage_ ? 3 : 4, page);
  page->setEnabled(workspace_.editor.solid() != nullptr);
  page->show();  // now, not with the next event: its fields may be used immediately
  orderKeys();
  if (auto* field = focused.isEmpty() ? nullptr : page->findChild<QWidget*>(focused))
    field->setFocus();
}

void TargetsDock::orderKeys() {
  // New fields would come last, behind Find.
  QWidget* last = remove_;
  setTabOrder(table_, add_);
  setTabOrder(add_, remove_);
  for (const PropertyPage* page : {targetPage_, motionPage_}) {
    if (!page) continue;
    for (QWidget* field : page->findChildren<QWidget*>()) {
      // The lists of combo boxes are windows.
      if (!(field->focusPolicy() & Qt::TabFocus) || field->window() != window()) continue;
      setTabOrder(last, field);
      last = field;
    }
  }
  setTabOrder(last, find_);
}

void TargetsDock::takeKeys() {
  if (stack_->currentIndex() != 0) return;
  if (table_->topLevelItemCount() > 0)
    table_->setFocus();
  else
    add_->setFocus();
}

void TargetsDock::updatePages() {
  Editor& editor = workspace_.editor;
  const int chosen = table_->chosen();
  remove_->setEnabled(chosen >= 0);
  updatePage(targetPage_, targetKey_, targetKey(editor, chosen),
             [this, chosen](PropertyPage& page) { addTargetRows(page, chosen, *values_); });
  updatePage(motionPage_, motionKey_, motionKey(editor) + (editor.solid() ? " " : " mesh"),
             [](PropertyPage& page) { addMotionRows(page); });
}

void TargetsDock::addTarget() {
  Editor& editor = workspace_.editor;
  const auto& touches = editor.project().touches;
  if (touches.empty()) return;
  const modeling::Design design = designOf(editor.project());
  // The first touch without a target; further targets of a touch may have other depths.
  const auto isFree = [&](const modeling::Touch& touch) {
    return std::none_of(design.targets.begin(), design.targets.end(),
                        [&](const auto& target) { return target.touch == touch.name; });
  };
  const auto& selected = editor.selection().named;
  auto touch = std::find_if(touches.begin(), touches.end(), [&](const modeling::Touch& each) {
    return selected && selected->kind == Selection::Kind::kTouch && selected->name == each.name;
  });
  if (touch == touches.end()) touch = std::find_if(touches.begin(), touches.end(), isFree);
  if (touch == touches.end()) touch = touches.begin();
  modeling::DesignTarget target = targetFor(touch->name, 0);
  target = targetFor(touch->name, values_->of(target).value_or(0));
  if (!editDesign(editor, [&](modeling::Design& changed) { changed.targets.push_back(target); }))
    return;
  table_->choose(table_->topLevelItemCount() - 1);
  if (auto* field = targetPage_ ? targetPage_->findChild<QuantityEdit*>("targetValue") : nullptr) {
    field->setFocus();
    field->selectAll();
  }
}

void TargetsDock::removeTarget() {
  const int chosen = table_->chosen();
  if (chosen < 0) return;
  editDesign(workspace_.editor, [&](modeling::Design& design) {
    if (chosen < static_cast<int>(design.targets.size()))
      design.targets.erase(design.targets.begin() + chosen);
  });
}

void TargetsDock::find() {
  finishInput(workspace_.window);
  finder_.start();
}

}  // namespace palpa::gui

#include <QDockWidget>
#include <QLineEdit>
#include <QMenu>
#include <QMessageBox>
#include <QPushButton>
#include <QSignalSpy>
#include <QTreeView>
#include <algorithm>

#include "app/gui/docks/model_tree.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

using RowKind = ModelTree::RowKind;

class ModelDock : public WindowTest {
 protected:
  ModelDock() { EXPECT_TRUE(window_->openFile(kSphere)); }

  QTreeView& tree() { return *window_->findChild<QDockWidget*>("model")->findChild<QTreeView*>(); }
  const ModelTree& rows() { return *static_cast<const ModelTree*>(tree().model()); }
  QModelIndex row(RowKind group, int i) { return rows().index(i, 0, rows().indexOf(group)); }
  void click(const QModelIndex& index, Qt::KeyboardModifiers modifiers = {}) {
    tree().scrollTo(index);
    QTest::mouseClick(tree().viewport(), Qt::LeftButton, modifiers,
                      tree().visualRect(index).center());
    QApplication::processEvents();
  }
  /// Opens the field for a name and types into it.
  QLineEdit* typeName(const QModelIndex& index, const QString& name) {
    click(index);
    tree().setFocus();
    QTest::keyClick(&tree(), Qt::Key_F2);
    auto* edit = qobject_cast<QLineEdit*>(QApplication::focusWidget());
    if (!edit || !tree().isAncestorOf(edit)) throw std::runtime_error("no field for the name");
    edit->selectAll();
    QTest::keyClicks(edit, name);
    return edit;
  }
  void rename(const QModelIndex& index, const QString& name) {
    QTest::keyClick(typeName(index, name), Qt::Key_Return);
    QApplication::processEvents();  // the tree applies the name after the key event
  }
  std::string nameOf(int support) { return editor().project().supports[support].name; }
};

TEST_F(ModelDock, ListsWhatTheProjectHolds) {
  const modeling::Solid& solid = *editor().solid();
  EXPECT_EQ(rows().rowCount(rows().indexOf(RowKind::kPatches)),
            static_cast<int>(solid.patches().size()));
  EXPECT_EQ(rows().rowCount(rows().indexOf(RowKind::kEdges)),
            static_cast<int>(solid.edges().size()));
  EXPECT_EQ(row(RowKind::kSupports, 0).data().toString().toStdString(), nameOf(0));
  EXPECT_FALSE(tree().isExpanded(rows().indexOf(RowKind::kPatches)));
  EXPECT_FALSE(tree().isExpanded(rows().indexOf(RowKind::kEdges)));
  // All other rows are visible without scrolling.
  EXPECT_LE(tree().visualRect(rows().indexOf(RowKind::kMesh)).bottom(),
            tree().viewport()->height());
  keepPicture("model-dock");
}

TEST_F(ModelDock, ARowUnderThePointerShowsItsPatch) {
  editor().select(Selection::ofPatches({4}));  // opens the list
  editor().select({});
  QApplication::processEvents();
  const auto picture = [this] { return view().grab().toImage(); };
  const QImage before = picture();
  const auto showsAPatch = [&] {
    for (const int patch : {1, 4, 5}) {  // some are on the far side
      const QModelIndex index = row(RowKind::kPatches, patch);
      tree().scrollTo(index);
      QTest::mouseMove(tree().viewport(), tree().visualRect(index).center());
      QApplication::processEvents();
      if (picture() != before) return true;
    }
    return false;
  };
  EXPECT_TRUE(QTest::qWaitFor(showsAPatch));  // the window manager may delay the pointer
  QEvent leave(QEvent::Leave);
  QApplication::sendEvent(tree().viewport(), &leave);
  EXPECT_EQ(picture(), before);
}

TEST_F(ModelDock, ChosenRowsAreSelectedAndBack) {
  click(row(RowKind::kPatches, 1));
  EXPECT_EQ(editor().selection(), Selection::ofPatches({1}));
  click(row(RowKind::kPatches, 3), Qt::ControlModifier);
  EXPECT_EQ(editor().selection(), Selection::ofPatches({1, 3}));
  click(row(RowKind::kSupports, 0), Qt::ControlModifier);  // another kind is selected alone
  EXPECT_EQ(editor().selection(), Selection::of(Selection::Kind::kSupport, nameOf(0)));
  EXPECT_EQ(tree().selectionModel()->selectedRows(), QModelIndexList{row(RowKind::kSupports, 0)});
  editor().select(Selection::ofEdges({2}));
  EXPECT_EQ(tree().selectionModel()->selectedRows(), QModelIndexList{row(RowKind::kEdges, 2)});
  EXPECT_TRUE(tree().isExpanded(rows().indexOf(RowKind::kEdges)));
  editor().select(Selection::ofPoints({0}));
  EXPECT_TRUE(tree().selectionModel()->selectedRows().empty());
  click(rows().indexOf(RowKind::kMaterial));
  EXPECT_TRUE(editor().selection().empty());
  EXPECT_TRUE(tree().selectionModel()->isSelected(rows().indexOf(RowKind::kMaterial)));
}

TEST_F(ModelDock, NamesAreEditedInTheTree) {
  rename(row(RowKind::kPatches, 0), "lid");
  EXPECT_EQ(editor().solid()->patches()[0].name, "lid");
  EXPECT_EQ(editor().selection(), Selection::ofPatches({0}));
  rename(row(RowKind::kSupports, 0), "foot");
  EXPECT_EQ(nameOf(0), "foot");
  EXPECT_EQ(editor().selection(), Selection::of(Selection::Kind::kSupport, "foot"));
  rename(rows().indexOf(RowKind::kProject), "My ball");
  EXPECT_EQ(editor().project().name, "My ball");
}

TEST_F(ModelDock, ANameBeingTypedCountsWhenTheWindowIsClosedAndNeverAfterwards) {
  typeName(row(RowKind::kSupports, 0), "foot");
  withDialog<QMessageBox>([this] { window_->close(); },
                          [](QMessageBox& box) { box.button(QMessageBox::Cancel)->click(); });
  EXPECT_EQ(nameOf(0), "foot");
  typeName(row(RowKind::kSupports, 0), "base");
  window_.reset();  // must not rename in a destroyed project
}

TEST_F(ModelDock, TakenAndEmptyNamesAreRefusedInWords) {
  const std::string before = text();
  QSignalSpy refused(&editor(), &Editor::refused);
  rename(row(RowKind::kPatches, 0), QString::fromStdString(editor().solid()->patches()[1].name));
  ASSERT_EQ(refused.count(), 1);
  EXPECT_TRUE(refused[0][0].toString().contains("already a patch named"));
  rename(row(RowKind::kSupports, 0), " ");
  EXPECT_EQ(refused.count(), 2);
  EXPECT_EQ(text(), before);
}

TEST_F(ModelDock, DeletesWhatCanBeDeletedAndSaysWhyOthersStay) {
  const std::size_t supports = editor().project().supports.size();
  QSignalSpy refused(&editor(), &Editor::refused);
  editor().select(Selection::ofPoints({0}));
  view().setFocus();
  QTest::keyClick(&view(), Qt::Key_Delete);
  ASSERT_EQ(refused.count(), 1);
  EXPECT_TRUE(refused[0][0].toString().contains("Control points cannot be deleted"));
  // A key with two actions would be ambiguous.
  const auto actions = window_->findChildren<QAction*>();
  EXPECT_EQ(std::count_if(actions.begin(), actions.end(),
                          [](const QAction* each) {
                            return each->shortcuts().contains(QKeySequence(Qt::Key_Delete));
                          }),
            1);
  editor().select(Selection::of(Selection::Kind::kSupport, nameOf(0)));
  QTest::keyClick(&view(), Qt::Key_Delete);
  EXPECT_EQ(editor().project().supports.size(), supports - 1);
  editor().undo();
  click(row(RowKind::kSupports, 0));
  QTest::keyClick(&tree(), Qt::Key_Delete);
  EXPECT_EQ(editor().project().supports.size(), supports - 1);
  EXPECT_TRUE(editor().selection().empty());
  EXPECT_FALSE(action("Delete")->isEnabled());
  editor().undo();
  EXPECT_EQ(rows().rowCount(rows().indexOf(RowKind::kSupports)), static_cast<int>(supports));
}

TEST_F(ModelDock, TheMenuOfARowDuplicatesAndSelectsPoints) {
  const auto choose = [&](const QModelIndex& index, const QString& what) {
    click(index);
    Q_EMIT tree().customContextMenuRequested(tree().visualRect(index).center());
    auto* menu = window_->findChild<QMenu*>("modelMenu");
    ASSERT_TRUE(menu);
    auto* found = menu->findChild<QAction*>(what);
    ASSERT_TRUE(found);
    found->trigger();
    menu->close();
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  };
  const std::size_t supports = editor().project().supports.size();
  const std::string name = nameOf(0);
  choose(row(RowKind::kSupports, 0), "Duplicate");
  ASSERT_EQ(editor().project().supports.size(), supports + 1);
  EXPECT_EQ(editor().selection(), Selection::of(Selection::Kind::kSupport, name + " 2"));
  choose(row(RowKind::kPatches, 0), "Zoom to");
  choose(row(RowKind::kPatches, 0), "Select points");
  const auto& net = editor().solid()->patches()[0].net;
  EXPECT_EQ(editor().selection().points.size(), net.size() * net[0].size());
}

TEST_F(ModelDock, NamesAreNotCutForALongDetail) {
  ASSERT_TRUE(window_->openFile(PALPA_PROJECTS "/gripper-finger.json"));
  ASSERT_GT(editor().project().material.name.size(), 15u);
  window_->resize(1280, 800);
  tree().expandAll();
  QTest::qWait(50);
  for (int i = 0; i < rows().rowCount(rows().indexOf(RowKind::kEdges)); ++i) {
    const QModelIndex edge = row(RowKind::kEdges, i);
    EXPECT_GE(tree().visualRect(edge).width(), tree().sizeHintForIndex(edge).width())
        << edge.data().toString().toStdString();
    EXPECT_GE(tree().visualRect(edge).width(),
              tree().fontMetrics().horizontalAdvance(edge.data().toString()));
  }
  // A long name leaves room for the details.
  editor().perform(modeling::RenameProject{std::string(200, 'n')});
  QTest::qWait(50);
  EXPECT_LT(tree().columnWidth(0), 0.8 * tree().viewport()->width());
}

TEST_F(ModelDock, TheLayoutIsRememberedAndReset) {
  auto* dock = find<QDockWidget>("properties");
  EXPECT_GE(view().width(), window_->width() * 6 / 10);
  dock->hide();
  window_->close();
  restart();
  EXPECT_FALSE(find<QDockWidget>("properties")->isVisible());
  action("Reset layout")->trigger();
  EXPECT_TRUE(find<QDockWidget>("properties")->isVisible());
  EXPECT_GE(view().width(), window_->width() * 6 / 10);
}

}  // namespace
}  // namespace palpa::gui

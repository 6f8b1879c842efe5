#include <QInputDialog>
#include <QJsonDocument>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QTreeWidget>

#include "app/gui/dialogs/selection_sets_dialog.h"
#include "app/gui/document/point_groups.h"
#include "app/gui/document/selection_set.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

class SelectionSets : public WindowTest {
 protected:
  SelectionSets() { EXPECT_TRUE(window_->openFile(kSphere)); }

  void name(const QString& name) {
    withDialog<QInputDialog>([this] { action("Name selection")->trigger(); },
                             [&](QInputDialog& dialog) {
                               dialog.setTextValue(name);
                               QTest::keyClick(&dialog, Qt::Key_Return);
                             });
  }
  /// Chooses an entry of the menu.
  void choose(const QString& name) {
    auto* menu = window_->findChild<QMenu*>("namedSelections");
    Q_EMIT menu->aboutToShow();
    auto* entry = menu->findChild<QAction*>(name);
    ASSERT_TRUE(entry) << name.toStdString();
    entry->trigger();
  }
  const modeling::Solid& solid() { return *editor().solid(); }
};

TEST_F(SelectionSets, ANamedSelectionIsChosenAgainAfterSavingAndOpening) {
  const Selection points = Selection::ofPoints({3, 7, 12});
  editor().select(points);
  name("rim");
  EXPECT_TRUE(editor().session().isModified());
  editor().select(Selection::ofPatches({0, 2}));
  name("sides");
  editor().select(Selection::ofEdges({1}));
  name("seam");
  const QString file = folder_.filePath("ball.json");
  ASSERT_TRUE(editor().saveAs(file));
  EXPECT_FALSE(editor().session().isModified());
  ASSERT_TRUE(window_->openFile(PALPA_PROJECTS "/box.json"));
  EXPECT_FALSE(action("Manage named selections")->isEnabled());
  ASSERT_TRUE(window_->openFile(file));
  choose("rim");
  EXPECT_EQ(editor().selection(), points);
  choose("sides");
  EXPECT_EQ(editor().selection(), Selection::ofPatches({0, 2}));
  choose("seam");
  EXPECT_EQ(editor().selection(), Selection::ofEdges({1}));
  EXPECT_FALSE(editor().session().isModified());
}

TEST_F(SelectionSets, SurvivesMotionsRefinementsAndRenamedPatches) {
  const modeling::Patch patch = solid().patches()[0];
  // Two neighbouring lines of the net.
  std::set<int> lines;
  for (const int i : {1, 2}) lines.insert(patch.net[i].begin(), patch.net[i].end());
  editor().select(Selection::ofPoints(lines));
  name("band");
  ASSERT_TRUE(editor().perform(modeling::MovePoints{
      modeling::PointSelection::of({*lines.begin()}), modeling::MoveBy{{0, 0, 3}}, {}}));
  choose("band");
  EXPECT_EQ(editor().selection().points, lines);
  // A knot between both lines: the new line between them belongs to the band.
  const double between = 0.5 * (patch.knots[0][patch.degree[0]] + patch.knots[0].back());
  ASSERT_TRUE(editor().perform(modeling::InsertKnot{patch.name, 0, between}));
  const std::size_t across = solid().patches()[0].net.front().size();
  ASSERT_GT(solid().patches()[0].net.size(), patch.net.size());
  choose("band");
  EXPECT_GE(editor().selection().points.size(), lines.size());
  EXPECT_LE(editor().selection().points.size(), lines.size() + across);
  const std::set<int> refined = editor().selection().points;
  ASSERT_TRUE(editor().perform(modeling::RenamePatch{patch.name, "other"}));
  choose("band");
  EXPECT_EQ(editor().selection().points, refined);
  editor().undo();
  editor().undo();
  choose("band");
  EXPECT_EQ(editor().selection().points, lines);
}

TEST_F(SelectionSets, OfAWholePatchContainsAllPointsOfTheRefinedPatch) {
  const std::string patch = solid().patches()[1].name;
  editor().select(Selection::ofPoints(pointsOfPatch(solid(), 1)));
  name("all");
  ASSERT_TRUE(editor().perform(modeling::InsertKnot{patch, 0, 0.3}));
  ASSERT_TRUE(editor().perform(modeling::InsertKnot{patch, 1, 0.6}));
  choose("all");
  EXPECT_EQ(editor().selection().points, pointsOfPatch(solid(), 1));
}

TEST_F(SelectionSets, TheDialogRenamesReplacesAndDeletes) {
  for (const int patch : {0, 1, 2}) {
    editor().select(Selection::ofPatches({patch}));
    name(QString("set %1").arg(patch));
  }
  editor().select(Selection::ofPatches({0, 1, 2}));
  withDialog<SelectionSetsDialog>([&] { action("Manage named selections")->trigger(); },
                                  [&](SelectionSetsDialog& dialog) {
                                    auto* list = dialog.findChild<QTreeWidget*>("sets");
                                    ASSERT_EQ(list->topLevelItemCount(), 3);
                                    const auto renameFirst = [&](const QString& to) {
                                      list->setCurrentItem(list->topLevelItem(0));
                                      QTest::keyClick(list, Qt::Key_F2);
                                      auto* edit = list->findChild<QLineEdit*>();
                                      ASSERT_TRUE(edit);
                                      edit->setText(to);
                                      QTest::keyClick(edit, Qt::Key_Return);
                                      QTest::qWait(20);
                                    };
                                    renameFirst("first");
                                    EXPECT_EQ(list->topLevelItem(0)->text(0), "first");
                                    renameFirst("set 2");  // in use
                                    EXPECT_EQ(list->topLevelItem(0)->text(0), "first");
                                    list->setCurrentItem(list->topLevelItem(1));
                                    dialog.findChild<QPushButton*>("replace")->click();
                                    QTest::qWait(20);
                                    EXPECT_EQ(list->topLevelItem(1)->text(1), "3 patches");
                                    keepPicture("named-selections", &dialog);
                                    list->setCurrentItem(list->topLevelItem(2));
                                    list->setFocus();
                                    QTest::keyClick(list, Qt::Key_Delete);
                                    QTest::qWait(20);
                                    ASSERT_EQ(list->topLevelItemCount(), 2);
                                    list->setCurrentItem(list->topLevelItem(0));
                                    QTest::keyClick(&dialog, Qt::Key_Return);
                                  });
  EXPECT_EQ(editor().selection(), Selection::ofPatches({0}));
  choose("set 1");
  EXPECT_EQ(editor().selection(), Selection::ofPatches({0, 1, 2}));
}

TEST_F(SelectionSets, DamagedEntriesAreLeftOut) {
  for (const char* text :
       {R"({})", R"({"name":""})", R"({"name":"a","points":[{"patch":"x","u":[1,0],"v":[0]}]})",
        R"({"name":"a","points":[{"patch":"x","u":[0],"v":[0],"at":[[0,1]]}]})"})
    EXPECT_FALSE(selectionSetFromJson(QJsonDocument::fromJson(text).object())) << text;
  const SelectionSet set = makeSet("s", Selection::ofPoints({1, 5}), editor().project().body);
  EXPECT_EQ(selectionSetFromJson(toJson(set)), set);
}

}  // namespace
}  // namespace palpa::gui

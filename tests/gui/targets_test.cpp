#include <QAction>
#include <QComboBox>
#include <QLabel>
#include <QPushButton>

#include "app/core/design/target_values.h"
#include "app/gui/docks/targets_dock.h"
#include "app/gui/widgets/quantity_edit.h"
#include "modeling/exchange/cad_import.h"
#include "modeling/project/project_file.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

using modeling::Design;
using modeling::DesignTarget;
using State = ShapeFinder::State;

class Targets : public WindowTest {
 protected:
  static inline const QString kBox = PALPA_PROJECTS "/box.json";
  static inline const QString kPad = PALPA_PROJECTS "/design/two-stiffness-pad.json";

  void open(const QString& file) {
    ASSERT_TRUE(window_->openFile(file));
    waitForModel();
    action("Find a shape")->trigger();
    ASSERT_TRUE(QTest::qWaitFor([&] { return find<TargetsTable>("targets")->isVisible(); }, 5000));
  }
  TargetsTable& table() { return *find<TargetsTable>("targets"); }
  SearchPanel& panel() { return dock().searchPanel(); }
  TargetsDock& dock() { return *window_->findChild<TargetsDock*>(); }
  ShapeFinder& finder() { return window_->shapeFinder(); }
  Design design() { return editor().project().design.value_or(Design{}); }
  QPushButton& button(const QString& name) { return *find<QPushButton>(name); }
  void click(const QString& name) {
    ASSERT_TRUE(button(name).isEnabled()) << name.toStdString();
    QTest::mouseClick(&button(name), Qt::LeftButton);
  }
  QString message() { return find<QLabel>("searchMessage")->text(); }
  void type(const QString& field, const QString& text) {
    auto* edit = find<QuantityEdit>(field);
    ASSERT_TRUE(edit) << field.toStdString();
    edit->setFocus();
    edit->selectAll();
    QTest::keyClick(edit, Qt::Key_Backspace);
    QTest::keyClicks(edit, text);
    QTest::keyClick(edit, Qt::Key_Return);
  }
  void choose(const QString& field, const QString& entry) {
    auto* box = find<QComboBox>(field);
    ASSERT_TRUE(box) << field.toStdString();
    const int index = box->findText(entry);
    ASSERT_GE(index, 0) << entry.toStdString();
    box->setCurrentIndex(index);
    Q_EMIT box->activated(index);
    QTest::qWait(20);  // until replaced rows are deleted
  }
  /// A target of the box for its first touch, and how far points may move, all by hand.
  void wish(const QString& stiffness, const QString& movement) {
    click("addTarget");
    type("targetValue", stiffness);
    type("largestMovement", movement);
  }
  bool waitForState(State state) {
    return QTest::qWaitFor([&] { return finder().state() == state; }, 120000);
  }
  bool waitForStep() {
    return QTest::qWaitFor([&] { return !finder().steps().empty(); }, 60000);
  }
  /// Values of the targets on the present model, as a full build has them.
  std::vector<double> valuesOfModel() {
    waitForModel();
    std::vector<double> values;
    for (const app::TargetValue& each :
         app::targetValues(editor().project(), *editor().model(), design().targets))
      values.push_back(each.value);
    return values;
  }
};

TEST_F(Targets, AreAddedChangedAndRemovedAsStepsOfUndo) {
  open(kBox);
  const std::string before = text();
  EXPECT_FALSE(button("findShape").isEnabled());
  EXPECT_TRUE(message().contains("no target")) << message().toStdString();
  EXPECT_FALSE(button("removeTarget").isEnabled());
  // Offered with the present value, once it is known.
  const modeling::Touch& first = editor().project().touches.front();
  const double now =
      app::targetValues(editor().project(), *editor().model(), {{first.name}}).front().value;
  QTest::qWait(2000);
  click("addTarget");
  ASSERT_EQ(design().targets.size(), 1u);
  EXPECT_EQ(design().targets[0].touch, first.name);
  EXPECT_NEAR(design().targets[0].value, now, 1e-3 * now);
  EXPECT_EQ(table().text(0, 0), QString::fromStdString(first.name));
  EXPECT_EQ(table().text(0, 1), QString::number(now, 'g', 4));
  EXPECT_TRUE(button("findShape").isEnabled()) << message().toStdString();
  // The field of the wanted value has the focus.
  auto* value = find<QuantityEdit>("targetValue");
  EXPECT_TRUE(value->hasFocus());
  QTest::keyClicks(value, "1.25");
  QTest::keyClick(value, Qt::Key_Return);
  EXPECT_EQ(design().targets[0].value, 1.25);
  EXPECT_EQ(table().text(0, 2), "1.25 N/mm");
  keepPicture("targets-added");
  editor().undo();
  EXPECT_NEAR(design().targets[0].value, now, 1e-3 * now);
  editor().redo();
  EXPECT_EQ(design().targets[0].value, 1.25);
  table().setFocus();
  QTest::keyClick(&table(), Qt::Key_Delete);
  EXPECT_TRUE(design().targets.empty());
  EXPECT_EQ(text(), before) << "an empty design leaves nothing in the file";
  editor().undo();
  EXPECT_EQ(design().targets.size(), 1u);
}

TEST_F(Targets, FieldsRefuseWhatTheDesignCannotMean) {
  open(kBox);
  click("addTarget");
  const std::string before = text();
  type("targetValue", "-1");
  EXPECT_TRUE(find<QuantityEdit>("targetValue")->property("refused").toBool());
  type("targetValue", "soft");
  type("designTolerance", "50");
  type("smoothness", "-3");
  EXPECT_EQ(text(), before);
  // A mirror plane about which the body is not symmetric.
  type("mirror-x", "3");
  ASSERT_TRUE(QTest::qWaitFor([&] { return !button("findShape").isEnabled(); }, 5000));
  EXPECT_TRUE(message().startsWith("Mirror planes: ")) << message().toStdString();
  EXPECT_FALSE(message().contains("design.")) << message().toStdString();
  editor().undo();
  EXPECT_TRUE(QTest::qWaitFor([&] { return button("findShape").isEnabled(); }, 5000));
}

TEST_F(Targets, EveryFieldIsStoredInTheProject) {
  open(kBox);
  click("addTarget");
  choose("targetKind", "a force at a depth");
  EXPECT_EQ(design().targets[0].kind, DesignTarget::Kind::kForce);
  type("targetValue", "3 N");
  type("targetDepth", "2.5 mm");
  type("targetWeight", "2");
  choose("movesAlong", "one direction");
  EXPECT_EQ(design().along, Design::Along::kDirection);
  ASSERT_TRUE(find<QWidget>("movesDirection")) << "the row of the direction appears";
  choose("movesAlong", "any direction");
  EXPECT_FALSE(find<QWidget>("movesDirection"));
  type("largestMovement", "4");
  type("mirror-y", "0");
  choose("designVolume", "is kept");
  type("smallestThickness", "6");
  type("smoothness", "2");
  type("designTolerance", "1");
  auto* steps = find<QSpinBox>("designSteps");
  steps->setFocus();
  steps->selectAll();
  QTest::keyClicks(steps, "7");
  QTest::keyClick(steps, Qt::Key_Return);
  Design expected;
  expected.targets = {
      {editor().project().touches.front().name, DesignTarget::Kind::kForce, 3.0, 2.5, 2.0}};
  expected.along = Design::Along::kAny;
  expected.largestMovement = 4;
  expected.mirrors = {{{0, 0, 0}, {0, 1, 0}}};
  expected.volume = Design::Volume::kKept;
  expected.smallestThickness = 6;
  expected.smoothness = 2;
  expected.tolerance = 0.01;
  expected.steps = 7;
  EXPECT_EQ(design(), expected);
  EXPECT_EQ(table().text(0, 2), "3 N at 2.5 mm");
  EXPECT_EQ(table().text(0, 3), "2");
  keepPicture("targets-fields");
  // Saved with the project.
  const QString file = folder_.filePath("wish.json");
  ASSERT_TRUE(editor().saveAs(file));
  EXPECT_EQ(modeling::readProject(file.toStdString()).design, expected);
  // Empty fields of optional numbers.
  type("mirror-y", "");
  type("smallestThickness", "");
  type("largestMovement", "");
  type("targetDepth", "");
  EXPECT_TRUE(design().mirrors.empty());
  EXPECT_FALSE(design().smallestThickness || design().largestMovement || design().targets[0].depth);
}

TEST_F(Targets, PointsAreTakenFromTheSelection) {
  open(kBox);
  EXPECT_FALSE(button("moveSelected").isEnabled());
  EXPECT_TRUE(button("moveSelected").toolTip().contains("Select"));
  const int top = *modeling::findPatch(editor().project().body, "top");
  editor().select(Selection::ofPatches({top}));
  click("moveSelected");
  const modeling::PointSelection patch{{modeling::PatchPoints{{"top"}}}};
  EXPECT_EQ(design().points, patch);
  EXPECT_EQ(find<QLabel>("movingPoints")->text(), "Patches top");
  click("keepSelected");
  EXPECT_EQ(design().points, (modeling::PointSelection{{modeling::NoneOf{{patch}}}}));
  EXPECT_EQ(find<QLabel>("movingPoints")->text(), "All but patches top");
  editor().select(Selection::ofPoints({3, 5}));
  click("moveSelected");
  EXPECT_EQ(design().points, modeling::PointSelection::of({3, 5}));
  editor().select({});
  click("selectMoving");
  EXPECT_EQ(editor().selection().points, (std::set<int>{3, 5}));
  click("moveUsual");
  EXPECT_FALSE(editor().project().design);
}

TEST_F(Targets, AFoundShapeIsAcceptedAsOneStepOfUndo) {
  open(kBox);
  wish("1.25", "5");
  const std::string before = text();
  const std::size_t position = editor().session().document().history().position;
  click("findShape");
  EXPECT_TRUE(finder().isSearching());
  ASSERT_TRUE(waitForStep());
  EXPECT_TRUE(button("searchStop").isVisible());
  ASSERT_TRUE(waitForState(State::kFound)) << message().toStdString();
  EXPECT_EQ(text(), before) << "nothing changes before Accept";
  EXPECT_TRUE(window_->foundShapeView().isDrawn());
  EXPECT_TRUE(finder().result().isReached);
  EXPECT_EQ(panel().text(0, 3), "1.25 N/mm");
  EXPECT_NEAR(panel().text(0, 2).toDouble(), 1.25, 0.01);
  EXPECT_NEAR(panel().text(0, 1).toDouble(), 1.16, 0.01);  // of the guide
  keepPicture("targets-found");
  click("searchAccept");
  EXPECT_EQ(finder().state(), State::kIdle);
  EXPECT_FALSE(window_->foundShapeView().isDrawn());
  const auto history = editor().session().document().history();
  ASSERT_EQ(history.position, position + 1);
  EXPECT_EQ(history.labels[history.position], "Find a shape");
  EXPECT_NEAR(valuesOfModel().front(), 1.25, 0.01);
  keepPicture("targets-accepted");
  editor().undo();
  EXPECT_EQ(text(), before);
  editor().redo();
  EXPECT_NE(text(), before);
}

TEST_F(Targets, ADiscardedShapeLeavesTheProject) {
  open(kBox);
  wish("1.2", "5");
  const std::string before = text();
  const auto history = editor().session().document().history();
  click("findShape");
  ASSERT_TRUE(waitForState(State::kFound)) << message().toStdString();
  click("searchDiscard");
  EXPECT_EQ(finder().state(), State::kIdle);
  EXPECT_FALSE(window_->foundShapeView().isDrawn());
  EXPECT_EQ(text(), before);
  EXPECT_EQ(editor().session().document().history().position, history.position);
  EXPECT_TRUE(button("findShape").isVisible());
}

TEST_F(Targets, EscapeAndTheButtonStopASearchAtAnyStep) {
  open(kBox);
  wish("1.25", "5");
  const std::string before = text();
  click("findShape");
  QTest::keyClick(&view(), Qt::Key_Escape);  // before the first shape
  ASSERT_TRUE(waitForState(State::kIdle));
  // Also if the thread has not begun yet.
  for (int i = 0; i < 20; ++i) {
    finder().start();
    finder().cancel();
    ASSERT_TRUE(waitForState(State::kIdle)) << i;
  }
  EXPECT_TRUE(message().contains("stopped")) << message().toStdString();
  click("findShape");
  ASSERT_TRUE(waitForStep());
  click("searchStop");
  ASSERT_TRUE(waitForState(State::kIdle));
  EXPECT_TRUE(message().contains("stopped")) << message().toStdString();
  EXPECT_EQ(text(), before);
  EXPECT_FALSE(window_->foundShapeView().isDrawn());
  // A result that arrives together with the cancellation is dropped; the next search runs.
  click("findShape");
  ASSERT_TRUE(waitForState(State::kFound)) << message().toStdString();
}

TEST_F(Targets, ASearchShowsItsPresentShapeUntilItIsStopped) {
  open(kBox);
  wish("0.9", "8");
  click("findShape");
  EXPECT_FALSE(window_->foundShapeView().isDrawn());
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return window_->foundShapeView().isDrawn() || !finder().isSearching(); }, 60000));
  ASSERT_EQ(finder().state(), State::kSearching) << message().toStdString();
  const auto& present = std::get<modeling::Solid>(editor().project().body);
  EXPECT_NE(window_->foundShapeView().drawn()->controlPoints(), present.controlPoints());
  keepPicture("targets-searching");
  QTest::keyClick(&view(), Qt::Key_Escape);
  EXPECT_FALSE(window_->foundShapeView().isDrawn());
  ASSERT_TRUE(waitForState(State::kIdle));
  EXPECT_FALSE(window_->foundShapeView().isDrawn());
}

TEST_F(Targets, AnEditDuringASearchEndsItAndStays) {
  open(kBox);
  wish("1.25", "5");
  click("findShape");
  ASSERT_TRUE(waitForStep());
  // The window stays usable: a view, a selection and a measurement change nothing.
  editor().select(Selection::ofPoints({1}));
  EXPECT_TRUE(finder().isSearching());
  modeling::Material softer = editor().project().material;
  softer.youngsModulus *= 0.9;
  ASSERT_TRUE(editor().perform(modeling::SetMaterial{softer}));
  ASSERT_TRUE(waitForState(State::kIdle));
  EXPECT_TRUE(message().contains("project was changed")) << message().toStdString();
  EXPECT_EQ(editor().project().material.youngsModulus, softer.youngsModulus);
  EXPECT_EQ(design().targets.size(), 1u);
  editor().undo();
  click("findShape");
  ASSERT_TRUE(waitForState(State::kFound)) << message().toStdString();
}

TEST_F(Targets, AnEditAfterASearchOutdatesTheShapeUntilItIsUndone) {
  open(kBox);
  wish("1.25", "5");
  const std::string before = text();
  click("findShape");
  ASSERT_TRUE(waitForState(State::kFound)) << message().toStdString();
  ASSERT_TRUE(editor().perform(
      modeling::MovePoints{modeling::PointSelection::of({0}), modeling::MoveBy{{0.1, 0, 0}}, {}}));
  EXPECT_TRUE(finder().isOutdated());
  EXPECT_FALSE(button("searchAccept").isEnabled());
  EXPECT_FALSE(finder().accept());
  EXPECT_TRUE(find<QLabel>("searchDetails")->text().contains("Undo"));
  editor().undo();
  EXPECT_FALSE(finder().isOutdated());
  click("searchAccept");
  EXPECT_NEAR(valuesOfModel().front(), 1.25, 0.01);
  editor().undo();
  EXPECT_EQ(text(), before);
}

TEST_F(Targets, AnImpossibleTargetNamesWhatLimitsIt) {
  open(kBox);
  wish("50", "0.5");
  const std::string before = text();
  click("findShape");
  ASSERT_TRUE(waitForState(State::kFound)) << message().toStdString();
  EXPECT_FALSE(finder().result().isReached);
  EXPECT_TRUE(find<QLabel>("searchState")->text().contains("Not all targets"));
  const QString details = find<QLabel>("searchDetails")->text();
  EXPECT_TRUE(details.contains("largest movement of 0.5 mm")) << details.toStdString();
  keepPicture("targets-impossible");
  click("searchDiscard");
  EXPECT_EQ(text(), before);
}

TEST_F(Targets, AreReachedByTheKeyboardAlone) {
  open(kBox);
  const auto press = [](Qt::Key key) { QTest::keyClick(QApplication::focusWidget(), key); };
  ASSERT_TRUE(button("addTarget").hasFocus());
  press(Qt::Key_Space);
  ASSERT_EQ(design().targets.size(), 1u);
  ASSERT_TRUE(find<QuantityEdit>("targetValue")->hasFocus());
  QTest::keyClicks(QApplication::focusWidget(), "1.25");
  press(Qt::Key_Tab);  // applies the entry
  EXPECT_EQ(design().targets[0].value, 1.25);
  EXPECT_TRUE(find<QuantityEdit>("targetWeight")->hasFocus());
  QStringList passed;
  for (int i = 0; i < 40 && !button("findShape").hasFocus(); ++i) {
    passed << QApplication::focusWidget()->objectName();
    press(Qt::Key_Tab);
  }
  ASSERT_TRUE(button("findShape").hasFocus()) << passed.join(' ').toStdString();
  // In the order in which they stand.
  EXPECT_LT(passed.indexOf("largestMovement"), passed.indexOf("designVolume"));
  EXPECT_LT(passed.indexOf("designVolume"), passed.indexOf("designSteps"));
  EXPECT_GE(passed.indexOf("largestMovement"), 0);
  press(Qt::Key_Space);
  ASSERT_TRUE(finder().isSearching());
  EXPECT_TRUE(button("searchStop").hasFocus());
  press(Qt::Key_Escape);
  ASSERT_TRUE(waitForState(State::kIdle));
  EXPECT_TRUE(message().contains("stopped")) << message().toStdString();
}

TEST_F(Targets, OfTheExampleAreMetTogether) {
  open(kPad);
  ASSERT_EQ(table().topLevelItemCount(), 2);
  EXPECT_EQ(table().text(0, 2), "4.5 N/mm");
  EXPECT_EQ(table().text(1, 2), "5.5 N/mm");
  keepPicture("targets-pad");
  click("findShape");
  ASSERT_TRUE(waitForState(State::kFound)) << message().toStdString();
  keepPicture("targets-pad-found");
  ASSERT_TRUE(finder().result().isReached);
  click("searchAccept");
  const std::vector<double> values = valuesOfModel();
  EXPECT_NEAR(values[0], 4.5, 0.045);
  EXPECT_NEAR(values[1], 5.5, 0.055);
}

TEST_F(Targets, AComparisonHasTheGhostFirst) {
  open(kBox);
  wish("1.2", "5");
  click("findShape");
  ASSERT_TRUE(waitForState(State::kFound)) << message().toStdString();
  EXPECT_TRUE(window_->foundShapeView().isDrawn());
  window_->comparisonActions().compareWithStateBefore(1);
  EXPECT_FALSE(window_->foundShapeView().isDrawn());
  window_->comparison().end();
  EXPECT_TRUE(window_->foundShapeView().isDrawn());
}

TEST_F(Targets, AnotherProjectForgetsTheSearch) {
  open(kBox);
  wish("1.25", "5");
  click("findShape");
  ASSERT_TRUE(waitForStep());
  ASSERT_TRUE(editor().saveAs(folder_.filePath("wish.json")));  // so that nobody asks
  ASSERT_TRUE(window_->openFile(kSphere));
  EXPECT_EQ(finder().state(), State::kIdle);
  EXPECT_TRUE(finder().steps().empty());
  QTest::qWait(1500);  // late reports
  EXPECT_EQ(finder().state(), State::kIdle);
  EXPECT_EQ(table().topLevelItemCount(), 0);
}

TEST_F(Targets, ClosingTheWindowEndsTheSearch) {
  open(kBox);
  wish("1.25", "5");
  click("findShape");
  ASSERT_TRUE(waitForStep());
  window_.reset();
}

TEST_F(Targets, OfAMeshBodyAreGreyedOutWithTheReason) {
  open(kBox);
  modeling::Project project = editor().project();
  const QString file = folder_.filePath("body.stl");
  ASSERT_TRUE(editor().exportFile(file, ExportedSurface::kDrawnSurface));
  ASSERT_TRUE(editor().importFile(file, {}));
  ASSERT_FALSE(editor().solid());
  EXPECT_FALSE(button("addTarget").isEnabled());
  EXPECT_TRUE(button("addTarget").toolTip().contains("control points"));
  EXPECT_FALSE(button("findShape").isEnabled());
  EXPECT_TRUE(message().contains("mesh body")) << message().toStdString();
}

}  // namespace
}  // namespace palpa::gui

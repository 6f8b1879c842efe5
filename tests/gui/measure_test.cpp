#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QTreeView>
#include <numbers>

#include "app/core/session/new_project.h"
#include "app/gui/base/appearance.h"
#include "app/gui/docks/model_tree.h"
#include "app/gui/document/measurements.h"
#include "app/gui/document/named_items.h"
#include "app/gui/document/naming.h"
#include "app/gui/tools/measure_tool.h"
#include "app/gui/view/dimension_view.h"
#include "modeling/shapes/make_primitive.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

using Eigen::Vector3d;
using modeling::MeasurementKind;

class Measuring : public WindowTest {
 protected:
  void start(const modeling::Primitive& primitive) {
    modeling::Project project = app::makeProject(modeling::makePrimitive(primitive), "body");
    project.primitive = primitive;
    editor().start(std::move(project));
    QTest::qWait(20);
    begin();
  }
  void begin() {
    view().setFocus();
    QTest::keyClick(&view(), Qt::Key_M);
    ASSERT_EQ(window_->tools().activeTitle(), "Measure");
  }
  MeasureTool& tool() { return dynamic_cast<MeasureTool&>(window_->tools().active()); }
  void choose(MeasurementKind kind) {
    for (int i = 0; i < 5 && tool().kind() != kind; ++i) key(Qt::Key_Tab);
    ASSERT_EQ(tool().kind(), kind);
  }
  void key(Qt::Key code, Qt::KeyboardModifiers modifiers = {}) {
    view().setFocus();
    QTest::keyClick(&view(), code, modifiers);
  }
  void click(const Vector3d& at, Qt::KeyboardModifiers modifiers = {}) {
    const QPoint pixel = pixelOf(at);
    moveTo(pixel, Qt::NoButton, modifiers);
    QTest::mouseClick(&view(), Qt::LeftButton, modifiers, pixel);
  }
  const std::vector<modeling::Measurement>& list() { return editor().project().measurements; }
  double value(std::size_t index) {
    const Measurements::Result result = editor().measurements().results().at(index);
    EXPECT_TRUE(result.value) << result.problem.toStdString();
    return result.value ? result.value->value : 0;
  }
  const std::vector<view::Dimension>& drawn() {
    return window_->findChild<DimensionView*>()->drawn();
  }
  QString readout() { return find<QLabel>("measureReadout")->text(); }
  /// Text of the tree in the row of a measurement.
  QString treeText(int row, int column) {
    auto* tree = find<QTreeView>("tree");
    const auto* model = qobject_cast<ModelTree*>(tree->model());
    return model->index(row, column, model->indexOf(ModelTree::RowKind::kMeasurements))
        .data()
        .toString();
  }
};

// The corners of the box that are seen from the usual view.
const modeling::Primitive kBox{modeling::BoxShape{{40, 30, 20}}};
const Vector3d kNear{20, -15, 20}, kLeft{-20, -15, 20}, kBack{20, 15, 20}, kLow{20, -15, 0};

TEST_F(Measuring, TwoClicksOnCornersMeasureAnEdgeAndStay) {
  start(kBox);
  moveTo(pixelOf(kNear) + QPoint(-3, 2));
  click(kNear + Vector3d(-0.3, 0.2, 0));  // a little beside the corner: it snaps
  EXPECT_TRUE(list().empty());
  moveTo(pixelOf(kLeft) + QPoint(2, 1));
  ASSERT_EQ(drawn().size(), 1u) << "the preview under the pointer";
  EXPECT_EQ(drawn()[0].text, "40 mm");
  EXPECT_TRUE(readout().startsWith("40 mm")) << readout().toStdString();
  keepPicture("measure-preview");
  click(kLeft);
  ASSERT_EQ(list().size(), 1u);
  EXPECT_NEAR(value(0), 40, 1e-8);
  EXPECT_EQ(treeText(0, 0), "distance 1");
  EXPECT_EQ(treeText(0, 1), "40 mm");
  EXPECT_EQ(editor().selection().named,
            (Selection::Named{Selection::Kind::kMeasurement, "distance 1"}));
  ASSERT_EQ(drawn().size(), 1u);
  EXPECT_EQ(drawn()[0].state, view::Dimension::State::kSelected);
  editor().undo();
  EXPECT_TRUE(list().empty());
  EXPECT_TRUE(drawn().empty());
  editor().redo();
  ASSERT_EQ(list().size(), 1u);
  // Saved and opened again.
  const QString file = folder_.filePath("box.json");
  ASSERT_TRUE(editor().saveAs(file));
  ASSERT_TRUE(window_->openFile(file));
  ASSERT_EQ(list().size(), 1u);
  EXPECT_NEAR(value(0), 40, 1e-8);
  EXPECT_EQ(drawn().size(), 1u);
}

TEST_F(Measuring, EscapeDropsThePlacesAndBackspaceTheLast) {
  start(kBox);
  click(kNear);
  EXPECT_TRUE(tool().hint().contains("second"));
  key(Qt::Key_Escape);
  EXPECT_TRUE(tool().hint().contains("first"));
  EXPECT_EQ(window_->tools().activeTitle(), "Measure") << "the tool stays";
  click(kNear);
  key(Qt::Key_Backspace);
  EXPECT_TRUE(tool().hint().contains("first"));
  click(kNear);
  window_->tools().restart();  // as before another project opens
  click(kLeft);
  EXPECT_TRUE(list().empty());
  key(Qt::Key_Escape);
  EXPECT_TRUE(drawn().empty());
}

TEST_F(Measuring, EveryKindIsMeasuredByClicks) {
  start(kBox);
  choose(MeasurementKind::kLength);
  click({20, 0, 20});
  choose(MeasurementKind::kAngle);
  click({3, 2, 20});   // on the top
  click({3, -15, 9});  // on the front
  choose(MeasurementKind::kThickness);
  click({3, 2, 20});
  choose(MeasurementKind::kRadius);
  click({3, 2, 20});
  choose(MeasurementKind::kDistance);
  click({3, 2, 20}, Qt::ControlModifier);   // the whole top
  click({3, -15, 9}, Qt::ControlModifier);  // the whole front: they meet
  ASSERT_EQ(list().size(), 5u);
  EXPECT_NEAR(value(0), 30, 1e-8);
  EXPECT_NEAR(value(1), std::numbers::pi / 2, 1e-9);
  EXPECT_NEAR(value(2), 20, 1e-8);
  EXPECT_TRUE(std::isinf(value(3)));
  EXPECT_NEAR(value(4), 0, 1e-8);
  EXPECT_EQ(treeText(1, 1), "90°");
  EXPECT_EQ(treeText(3, 1), "flat");
  QTest::qWait(50);
  keepPicture("measure-kinds");
  applyTheme(*qApp, Theme::kDark);
  window_->viewport().viewport().setTheme(viewportTheme(Theme::kDark));
  view().update();
  QTest::qWait(50);
  keepPicture("measure-kinds-dark");
  applyTheme(*qApp, Theme::kLight);
}

TEST_F(Measuring, AnglesOfThreePointsHaveTheCornerSecond) {
  start(kBox);
  choose(MeasurementKind::kAngle);
  tool().setTakesWhole(false);
  click(kLeft);
  click(kNear);
  click(kLow);
  ASSERT_EQ(list().size(), 1u);
  EXPECT_NEAR(value(0), std::numbers::pi / 2, 1e-9);
}

TEST_F(Measuring, TheKeyboardAloneMeasuresTheSelection) {
  start(kBox);
  const auto patch = [&](const char* name) {
    return *modeling::findPatch(editor().project().body, name);
  };
  key(Qt::Key_Return);
  EXPECT_TRUE(list().empty()) << "nothing is selected";
  editor().select(Selection::ofPatches({patch("bottom"), patch("top")}));
  EXPECT_TRUE(find<QPushButton>("measureSelection")->isEnabled());
  key(Qt::Key_Return);
  ASSERT_EQ(list().size(), 1u);
  EXPECT_NEAR(value(0), 20, 1e-8);
  EXPECT_FALSE(find<QPushButton>("measureSelection")->isEnabled());
  choose(MeasurementKind::kThickness);
  editor().select(Selection::ofPatches({patch("side_xmin")}));
  key(Qt::Key_Enter);
  ASSERT_EQ(list().size(), 2u);
  EXPECT_NEAR(value(1), 40, 1e-8);
}

TEST_F(Measuring, ValuesFollowTheShapeAndSayWhenThePlaceIsGone) {
  start(kBox);
  click(kNear);
  click(kLow);
  ASSERT_EQ(list().size(), 1u);
  EXPECT_EQ(treeText(0, 1), "20 mm");
  ASSERT_TRUE(editor().perform(modeling::TransformSolid{modeling::Scaling{{1, 1, 1.5}}}));
  ASSERT_TRUE(QTest::qWaitFor([&] { return treeText(0, 1) == "30 mm"; }, 3000));
  EXPECT_EQ(drawn().at(0).text, "30 mm");
  EXPECT_TRUE(find<QLabel>("measuredValue")->text().startsWith("30 mm"));
  ASSERT_TRUE(editor().perform(modeling::MakePrimitive{{modeling::TorusShape{}}}));
  ASSERT_TRUE(QTest::qWaitFor([&] { return treeText(0, 1) == "gone"; }, 3000));
  EXPECT_TRUE(drawn().empty());
  EXPECT_TRUE(find<QLabel>("measuredValue")->text().contains("measure again"));
  editor().undo();
  ASSERT_TRUE(QTest::qWaitFor([&] { return treeText(0, 1) == "30 mm"; }, 3000));
}

TEST_F(Measuring, MeasurementsAreRenamedCopiedSelectedAndDeleted) {
  start(kBox);
  click(kNear);
  click(kLow);
  const Selection::Named first{Selection::Kind::kMeasurement, "distance 1"};
  ASSERT_TRUE(renameNamed(editor(), first, "height"));
  EXPECT_EQ(treeText(0, 0), "height");
  QTest::qWait(20);  // the page of the former name is removed
  find<QPushButton>("copyValue")->click();
  EXPECT_EQ(QApplication::clipboard()->text(), "height\t20 mm");
  duplicate(editor(), *editor().selection().named);
  EXPECT_EQ(list().size(), 2u);
  // A click on the number selects.
  editor().undo();
  editor().select({});
  view().update();
  QTest::qWait(50);
  QPoint number;
  const double ratio = view().devicePixelRatioF();
  for (int y = 0; y < view().height() && number.isNull(); y += 4)
    for (int x = 0; x < view().width() && number.isNull(); x += 4)
      if (view().viewport().dimensionAt({x * ratio, y * ratio})) number = QPoint(x + 2, y + 2);
  ASSERT_FALSE(number.isNull());
  key(Qt::Key_S);  // Select and move
  QTest::mouseClick(&view(), Qt::LeftButton, {}, number);
  EXPECT_EQ(editor().selection().named,
            (Selection::Named{Selection::Kind::kMeasurement, "height"}));
  key(Qt::Key_Delete);
  EXPECT_TRUE(list().empty());
  EXPECT_TRUE(drawn().empty());
}

TEST_F(Measuring, DistancesFollowTheTouch) {
  ASSERT_TRUE(window_->openFile(kSphere));
  begin();
  const Vector3d front = Vector3d(1, -0.5, 0.4).normalized() * 25;
  choose(MeasurementKind::kThickness);
  click(front);
  ASSERT_EQ(list().size(), 1u);
  EXPECT_NEAR(value(0), 50, 0.3) << "a cubic with few points";
  waitForModel();
  action("Simulate")->trigger();
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_->simulation().drawn() != nullptr; }, 20000));
  const QPoint at = pixelOf(front);
  moveTo(at);
  QTest::mousePress(&view(), Qt::LeftButton, {}, at);
  for (int i = 1; i <= 8; ++i) {
    moveTo(at + QPoint(6, -6) * i, Qt::LeftButton);
    QTest::qWait(20);
  }
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        return drawn().size() == 1 && QString::fromStdString(drawn()[0].text).contains("at rest") &&
               (drawn()[0].points[0] - front).norm() > 0.5;
      },
      10000))
      << (drawn().empty() ? "none" : drawn()[0].text);
  keepPicture("measure-simulate");
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, at);
  action("Model")->trigger();
  EXPECT_FALSE(QString::fromStdString(drawn().at(0).text).contains("at rest"));
}

}  // namespace
}  // namespace palpa::gui

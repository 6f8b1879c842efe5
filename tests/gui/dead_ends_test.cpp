#include <QDockWidget>
#include <QLabel>
#include <QPushButton>
#include <QTreeWidget>

#include "app/core/session/new_project.h"
#include "app/gui/docks/forces_dock.h"
#include "app/gui/tools/support_tool.h"
#include "modeling/shapes/primitives.h"
#include "tests/gui/window_fixture.h"

// The way of a newcomer: new solid, paint a support, load, simulate, also in a wrong order. Every
// state without a model says why and offers the next step.
namespace palpa::gui {
namespace {

using State = app::RebuildStatus::State;
using modeling::Support;

/// A new project whose model is built in a moment.
modeling::Project fresh(modeling::Body body, const std::string& name) {
  modeling::Project project = app::makeProject(std::move(body), name);
  project.mesh.engine = modeling::Engine::kTriangles;
  return project;
}

class DeadEnds : public WindowTest {
 protected:
  Simulation& simulation() { return window_->simulation(); }
  bool add(const std::string& name, modeling::Region where,
           const Eigen::Vector3d& displacement = Eigen::Vector3d::Zero()) {
    Support support;
    support.name = name;
    support.where = std::move(where);
    support.displacement = displacement;
    return editor().perform(modeling::AddSupport{support});
  }
  bool waitFor(State state) {
    return QTest::qWaitFor([&] { return editor().rebuildStatus().state == state; }, 60000);
  }
  /// The buttons of the message over the view, as soon as there is one.
  QList<QPushButton*> remedies() {
    QList<QPushButton*> buttons;
    EXPECT_TRUE(QTest::qWaitFor(
        [&] {
          buttons = window_->messages().findChildren<QPushButton*>("remedy");
          return !buttons.isEmpty() && buttons.front()->isVisible();
        },
        10000));
    return buttons;
  }
  /// A sphere with the base of new projects and a painted support on its border that is moved.
  void contradict() {
    ASSERT_TRUE(window_->openFile(kSphere));
    waitForModel();
    const modeling::Stroke disc{{{0, -15, -20}}, 7};
    ASSERT_TRUE(add("hand", {{disc}}, {0, 0, 1}));
    ASSERT_TRUE(waitFor(State::kFailed));
  }
};

TEST_F(DeadEnds, TheFirstPaintedSupportMayOverlapTheBase) {
  editor().start(fresh(modeling::makeSphere(25), "ball"));
  waitForModel();
  action("Paint support")->trigger();
  // Across the border of the base, from the free surface to the lowest tenth.
  view().viewport().lookFrom(view::StandardView::kFront);
  drag(pixelOf({0, -20, -15}), pixelOf({0, -12, -22}));
  ASSERT_EQ(editor().project().supports.size(), 2u);
  waitForModel();
  EXPECT_EQ(editor().rebuildStatus().state, State::kUpToDate);
  EXPECT_TRUE(window_->messages().messages().isEmpty());
}

TEST_F(DeadEnds, AContradictionIsMarkedAndOneClickEndsIt) {
  contradict();
  auto buttons = remedies();
  ASSERT_EQ(buttons.size(), 2);
  EXPECT_EQ(buttons[0]->text(), "Give it to “hand”");
  EXPECT_EQ(buttons[1]->text(), "Give it to “base”");
  const QString said = window_->messages().messages().join(' ');
  EXPECT_TRUE(said.contains("\"base\" and \"hand\" overlap")) << said.toStdString();
  view().viewport().lookFrom(view::StandardView::kFront);
  for (const Theme theme : {Theme::kDark, Theme::kLight}) {
    window_->settings().setTheme(theme);
    QTest::qWait(200);
    keepPicture(theme == Theme::kDark ? "contradiction-dark" : "contradiction");
    // A place in both supports is red, a place in the base alone is not.
    const QImage picture = view().grab().toImage();
    const QColor both = picture.pixelColor(pixelOf({4, -11.18, -22}));
    EXPECT_GT(both.red(), 1.5 * both.blue()) << both.name().toStdString();
    const QColor one = picture.pixelColor(pixelOf({-9, -7.75, -22}));
    EXPECT_LT(one.red(), 1.5 * one.blue()) << one.name().toStdString();
  }
  QTest::mouseClick(buttons[0], Qt::LeftButton);
  ASSERT_TRUE(waitFor(State::kUpToDate)) << editor().rebuildStatus().error;
  QTest::qWait(100);
  keepPicture("contradiction-solved");
  EXPECT_TRUE(window_->messages().messages().isEmpty());
  EXPECT_FALSE(editor().project().supports[0].where.except.empty());
  editor().undo();  // one step
  EXPECT_TRUE(editor().project().supports[0].where.except.empty());
  ASSERT_TRUE(waitFor(State::kFailed));
  QTest::mouseClick(remedies().back(), Qt::LeftButton);
  ASSERT_TRUE(waitFor(State::kUpToDate)) << editor().rebuildStatus().error;
  EXPECT_FALSE(editor().project().supports[1].where.except.empty());
}

TEST_F(DeadEnds, ABodyWithoutSupportIsFixedByOneClickInSimulate) {
  modeling::Project project = fresh(modeling::makeBox({40, 30, 20}), "box");
  project.supports.clear();
  editor().start(project);
  action("Simulate")->trigger();
  ASSERT_TRUE(waitFor(State::kFailed));
  auto buttons = remedies();
  ASSERT_EQ(buttons.size(), 2);
  EXPECT_EQ(buttons[1]->text(), "Paint support");
  auto* summary = find<QLabel>("forcesSummary");
  EXPECT_TRUE(QTest::qWaitFor([&] { return summary->text().contains("cannot be built"); }))
      << summary->text().toStdString();
  EXPECT_TRUE(window_->tools().active().hint().contains("cannot be built"));
  keepPicture("no-support");
  QTest::mouseClick(buttons[0], Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return simulation().drawn() != nullptr; }, 20000));
  EXPECT_EQ(editor().project().supports.at(0).name, "base");
  // The other button leads to the tool, in Model mode.
  editor().undo();
  ASSERT_TRUE(waitFor(State::kFailed));
  QTest::mouseClick(remedies()[1], Qt::LeftButton);
  EXPECT_FALSE(simulation().isActive());
  EXPECT_TRUE(action("Paint support")->isChecked());
}

TEST_F(DeadEnds, ASupportWithoutSurfaceIsRemovedByOneClick) {
  editor().start(fresh(modeling::makeBox({40, 30, 20}), "box"));
  ASSERT_TRUE(add("lost", {{modeling::Stroke{{{0, 0, 90}}, 5}}}));
  ASSERT_TRUE(waitFor(State::kFailed));
  const auto buttons = remedies();
  ASSERT_EQ(buttons.size(), 1);
  EXPECT_EQ(buttons[0]->text(), "Remove “lost”");
  // The Rebuild panel has the same button.
  QTest::mouseClick(find<QPushButton>("rebuildStatus"), Qt::LeftButton);
  auto* panel = find<QDockWidget>("rebuild");
  EXPECT_TRUE(QTest::qWaitFor([&] {
    for (const QPushButton* each : panel->findChildren<QPushButton*>())
      if (each->isVisible() && each->text() == "Remove “lost”") return true;
    return false;
  }));
  QTest::mouseClick(buttons[0], Qt::LeftButton);
  ASSERT_TRUE(waitFor(State::kUpToDate));
  EXPECT_EQ(editor().project().supports.size(), 1u);
}

TEST_F(DeadEnds, AStoppedBuildIsBegunAgainInSimulate) {
  modeling::Project project = fresh(modeling::makeSphere(25), "ball");
  project.mesh.edgeLength = 2;
  editor().start(project);
  editor().cancelRebuild();
  ASSERT_TRUE(waitFor(State::kCancelled));
  action("Simulate")->trigger();
  const auto buttons = remedies();
  ASSERT_EQ(buttons.size(), 1);
  QTest::mouseClick(buttons[0], Qt::LeftButton);
  EXPECT_EQ(editor().rebuildStatus().state, State::kBuilding);
}

TEST_F(DeadEnds, SupportsOverTheWholeSurfaceSayThatTouchesHaveNoForce) {
  modeling::Project project = fresh(modeling::makeBox({40, 30, 20}), "box");
  project.supports[0].where = modeling::Region::below({0, 0, 1}, 100);
  editor().start(project);
  waitForModel();
  action("Simulate")->trigger();
  auto* summary = find<QLabel>("forcesSummary");
  EXPECT_TRUE(QTest::qWaitFor([&] { return summary->text().contains("whole surface"); }, 20000))
      << summary->text().toStdString();
}

TEST_F(DeadEnds, ANewProjectIsShownAtOnceAlsoFromSimulate) {
  ASSERT_TRUE(window_->openFile(kSphere));
  waitForModel();
  action("Simulate")->trigger();
  ASSERT_TRUE(QTest::qWaitFor([&] { return simulation().drawn() != nullptr; }, 20000));
  const QPoint at = pixelOf({15, -15, 13});
  QTest::mousePress(&view(), Qt::LeftButton, {}, at);
  moveTo(at + QPoint(40, -20), Qt::LeftButton);
  auto& list = *find<ForcesDock>("forces")->findChild<QTreeWidget*>("contacts");
  ASSERT_TRUE(QTest::qWaitFor([&] { return list.topLevelItemCount() > 1; }, 20000));
  editor().start(fresh(modeling::makeBox({40, 30, 20}), "box"));
  EXPECT_FALSE(simulation().isActive());
  EXPECT_TRUE(action("Model")->isChecked());
  EXPECT_EQ(window_->tools().mode(), Mode::kModel);
  const auto top = view().viewport().surfaceAt(view().viewport().toPixel({0, 0, 20}));
  ASSERT_TRUE(top);
  EXPECT_NEAR(top->position.norm(), 20, 0.01) << "the sphere is still there";
  EXPECT_TRUE(QTest::qWaitFor([&] { return list.topLevelItemCount() == 0; }, 1000));
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, at);
  waitForModel();
  EXPECT_FALSE(simulation().isActive());
}

TEST_F(DeadEnds, SimulateShowsThePresentBodyWhileItWaits) {
  ASSERT_TRUE(window_->openFile(kSphere));
  waitForModel();
  modeling::Project project = fresh(modeling::makeBox({40, 30, 20}), "box");
  project.mesh.edgeLength = 2;
  editor().start(project);
  action("Simulate")->trigger();
  ASSERT_FALSE(simulation().drawn());
  const auto top = view().viewport().surfaceAt(view().viewport().toPixel({0, 0, 20}));
  ASSERT_TRUE(top);
  EXPECT_NEAR(top->position.norm(), 20, 0.01);
  EXPECT_TRUE(QTest::qWaitFor([&] { return simulation().drawn() != nullptr; }, 60000));
}

TEST_F(DeadEnds, TheBrushErasesPartsOfPatches) {
  editor().start(fresh(modeling::makeBox({40, 30, 20}), "box"));
  waitForModel();
  ASSERT_TRUE(add("lid", modeling::Region::ofPatches({"top"})));
  editor().select(Selection::of(Selection::Kind::kSupport, "lid"));
  view().viewport().lookFrom(view::StandardView::kTop);
  action("Paint support")->trigger();
  auto* tool = dynamic_cast<SupportTool*>(&window_->tools().active());
  ASSERT_TRUE(tool);
  tool->setBrush(SupportTool::Brush::kRound);
  tool->setRadius(4);
  const auto lid = [&] { return editor().project().supports.at(1).where; };
  drag(pixelOf({-8, 0, 20}), pixelOf({8, 0, 20}), Qt::ControlModifier);
  ASSERT_EQ(lid().except.size(), 1u);
  EXPECT_LT(std::get<modeling::Stroke>(lid().except[0]).value({0, 0, 20}), -3.9);
  keepPicture("erased-patch");
  // Painting there again removes the exception.
  drag(pixelOf({-10, 0, 20}), pixelOf({10, 0, 20}));
  EXPECT_TRUE(lid().except.empty());
}

}  // namespace
}  // namespace palpa::gui

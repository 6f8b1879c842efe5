#include <QDir>
#include <QLabel>
#include <QPushButton>
#include <algorithm>

#include "app/gui/base/appearance.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

class RebuildDock : public WindowTest {
 protected:
  RebuildDock() { showDock(); }
  /// The panel is a tab behind Properties.
  void showDock() { QTest::mouseClick(find<QPushButton>("rebuildStatus"), Qt::LeftButton); }
};
using State = app::RebuildStatus::State;

bool waitForState(const Editor& editor, State state) {
  return QTest::qWaitFor([&] { return editor.rebuildStatus().state == state; }, 60000);
}

/// Waits until the panel, updated 30 times a second, shows the present state.
void waitForDock() {
  QTest::qWait(100);
}

/// Sphere with a mesh whose build takes long enough to stop it.
modeling::Project slowSphere(const Editor& editor) {
  modeling::Project project = editor.project();
  project.mesh.edgeLength = 1.9;
  return project;
}

TEST_F(RebuildDock, ShowsStagesAndFactsOfTheModel) {
  useEmptyCache();
  showDock();
  EXPECT_TRUE(find<QLabel>("rebuildState")->isVisible());
  ASSERT_TRUE(window_->openFile(kSphere));
  waitForModel();
  ASSERT_TRUE(QTest::qWaitFor([&] { return editor().rebuildStatus().condition > 0; }, 20000));
  waitForDock();
  EXPECT_EQ(find<QLabel>("rebuildState")->text(), "Up to date");
  for (const char* stage : {"mesh", "check", "setup", "assemble", "factorise", "solve"})
    EXPECT_TRUE(find<QLabel>(QString("stage-") + stage)->text().endsWith("✓")) << stage;
  EXPECT_EQ(find<QLabel>("modelNodes")->text(),
            QString("%L1").arg(editor().model()->report().nodes));
  EXPECT_NE(find<QLabel>("modelCondition")->text(), "…");
  EXPECT_FALSE(find<QPushButton>("stopRebuild")->isVisible());
  EXPECT_FALSE(find<QPushButton>("buildAgain")->isVisible());
  EXPECT_EQ(find<QLabel>("modelTitle")->text(), "Model");
}

TEST_F(RebuildDock, ABuildCanBeStoppedAndBegunAgain) {
  ASSERT_TRUE(window_->openFile(kSphere));
  waitForModel();
  editor().start(slowSphere(editor()));
  auto* stop = find<QPushButton>("stopRebuild");
  ASSERT_TRUE(QTest::qWaitFor([&] { return stop->isVisible(); }));
  keepPicture("rebuild-building");
  ASSERT_TRUE(stop->isVisible());
  QTest::mouseClick(stop, Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !stop->isVisible(); }, 20000));
  EXPECT_EQ(find<QLabel>("rebuildState")->text(), "Stopped");
  auto* again = find<QPushButton>("buildAgain");
  ASSERT_TRUE(again->isVisible());
  EXPECT_FALSE(find<QLabel>("rebuildDetails")->text().isEmpty());
  keepPicture("rebuild-stopped");
  QTest::mouseClick(again, Qt::LeftButton);
  EXPECT_TRUE(waitForState(editor(), State::kUpToDate));
  EXPECT_TRUE(QTest::qWaitFor([&] { return !again->isVisible(); }, 20000));
}

TEST_F(RebuildDock, AMovedShapeCanBeTouchedBeforeItsModelIsComplete) {
  ASSERT_TRUE(window_->openFile(kSphere));
  waitForModel();
  modeling::Project fine = editor().project();
  fine.mesh.edgeLength = 3;
  editor().start(fine);
  ASSERT_TRUE(waitForState(editor(), State::kUpToDate));
  const auto former = editor().model();
  const auto& points = editor().solid()->controlPoints();
  const auto highest = std::max_element(points.begin(), points.end(),
                                        [](const auto& a, const auto& b) { return a.z() < b.z(); });
  EXPECT_TRUE(editor().perform(modeling::MovePoints{
      modeling::PointSelection::of({static_cast<int>(highest - points.begin())}),
      modeling::MoveBy{{0, 0, 3}},
      {}}));
  auto* state = find<QLabel>("rebuildState");
  ASSERT_TRUE(QTest::qWaitFor([&] { return state->text() == "Completing the model"; }, 60000));
  const app::RebuildStatus status = editor().rebuildStatus();
  keepPicture("rebuild-update");
  EXPECT_TRUE(find<QLabel>("rebuildDetails")->text().contains("can be touched"));
  EXPECT_EQ(status.modelRevision, status.revision);
  EXPECT_LT(status.residual.value_or(1), 1e-4);
  EXPECT_NE(editor().model(), former);
  ASSERT_TRUE(waitForState(editor(), State::kUpToDate));
  waitForDock();
  EXPECT_FALSE(find<QLabel>("rebuildDetails")->isVisible());
  EXPECT_TRUE(find<QLabel>("stage-update")->text().endsWith("✓"));
  EXPECT_EQ(find<QLabel>("modelTitle")->text(), "Model");
}

TEST_F(RebuildDock, ASurfaceThatCutsItselfIsSaidAndTheLastModelStays) {
  ASSERT_TRUE(window_->openFile(kSphere));
  waitForModel();
  modeling::Project coarse = editor().project();
  coarse.mesh.edgeLength = 8;
  editor().start(coarse);
  waitForModel();
  const auto good = editor().model();
  const auto& points = editor().solid()->controlPoints();
  const auto highest = std::max_element(points.begin(), points.end(),
                                        [](const auto& a, const auto& b) { return a.z() < b.z(); });
  const int point = static_cast<int>(highest - points.begin());
  EXPECT_TRUE(editor().perform(modeling::MovePoints{
      modeling::PointSelection::of({point}), modeling::MoveBy{{0, 0, -400}}, {}}));
  ASSERT_TRUE(waitForState(editor(), State::kFailed));
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return find<QLabel>("rebuildState")->text() == "Cannot be built"; }, 20000));
  EXPECT_EQ(find<QLabel>("rebuildState")->text(), "Cannot be built");
  const QString words = find<QLabel>("rebuildDetails")->text();
  EXPECT_TRUE(words.contains("mm")) << words.toStdString();  // the place
  EXPECT_TRUE(words.contains("move its control points")) << words.toStdString();
  EXPECT_TRUE(find<QLabel>("stage-check")->text().endsWith("✗"));
  EXPECT_EQ(find<QLabel>("modelTitle")->text(), "Model of the previous shape");
  EXPECT_EQ(editor().model(), good);
  EXPECT_FALSE(editor().rebuildStatus().findings->empty());
  for (const Theme theme : {Theme::kDark, Theme::kLight}) {
    window_->settings().setTheme(theme);
    keepPicture(theme == Theme::kDark ? "rebuild-failed-dark" : "rebuild-failed-light");
  }
  editor().undo();
  ASSERT_TRUE(waitForState(editor(), State::kUpToDate));
  waitForDock();
  EXPECT_TRUE(editor().rebuildStatus().findings->empty());
  EXPECT_FALSE(find<QLabel>("rebuildDetails")->isVisible());
}

TEST_F(RebuildDock, AMemoryLimitThatIsExceededIsSaid) {
  window_->settings().setMemoryLimitGiB(0.01);
  ASSERT_TRUE(window_->openFile(kSphere));
  ASSERT_TRUE(waitForState(editor(), State::kFailed));
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return find<QLabel>("rebuildState")->text() == "Cannot be built"; }, 20000));
  const QString words = find<QLabel>("rebuildDetails")->text();
  EXPECT_TRUE(words.contains("edge length")) << words.toStdString();
  EXPECT_TRUE(words.contains("memory")) << words.toStdString();
  EXPECT_EQ(find<QLabel>("modelTitle")->text(), "No model yet");
  keepPicture("rebuild-memory");
}

TEST_F(RebuildDock, AProjectThatIsOpenedAgainIsRead) {
  useEmptyCache();
  ASSERT_TRUE(window_->openFile(kSphere));
  waitForModel();
  const QDir stored(folder_.filePath("palpa"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !stored.entryList({"*.model"}, QDir::Files).isEmpty(); },
                              20000));
  restart();
  showDock();
  ASSERT_TRUE(window_->openFile(kSphere));
  waitForModel();
  waitForDock();
  EXPECT_TRUE(find<QLabel>("stage-read")->isVisible());
  EXPECT_FALSE(find<QLabel>("stage-assemble")->isVisible());
  keepPicture("rebuild-read");
}

}  // namespace
}  // namespace palpa::gui

// The window on a project that is computed with splines.
#include <QAction>
#include <QComboBox>
#include <QFileDialog>
#include <QLabel>

#include "app/gui/dialogs/export_dialog.h"
#include "app/gui/docks/forces_dock.h"
#include "modeling/project/project_file.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

class Splines : public WindowTest {
 protected:
  void openCylinder() {
    ASSERT_TRUE(window_->openFile(PALPA_PROJECTS "/cylinder.json"));
    waitForModel();
    ASSERT_TRUE(editor().model()->setup().splines);
  }
  QString label(const char* name) { return find<QLabel>(name)->text(); }
};

TEST_F(Splines, TheDockSaysHowManyAndHowAccurate) {
  openCylinder();
  const auto& on = *editor().model()->setup().discretisation;
  EXPECT_EQ(label("modelCoefficients"), QLocale().toString(on.displacementCount()));
  EXPECT_EQ(label("modelElements"), QLocale().toString(on.elementCount()));
  EXPECT_TRUE(QTest::qWaitFor([&] { return label("modelError").startsWith("about"); }, 240000));
  EXPECT_GT(editor().rebuildStatus().touchError, 1e-4);
  EXPECT_LT(editor().rebuildStatus().touchError, 0.2);
  find<QDockWidget>("rebuild")->raise();
  QTest::qWait(50);
  keepPicture("splines-rebuild");
}

TEST_F(Splines, TheEngineIsChosenInTheProperties) {
  openCylinder();
  auto* engine = find<QComboBox>("engine");
  ASSERT_TRUE(engine);
  EXPECT_EQ(engine->currentText(), "Automatic");
  engine->setFocus();
  for (int k = 0; k < 2; ++k) QTest::keyClick(engine, Qt::Key_Down);  // past "Splines"
  ASSERT_EQ(editor().project().mesh.engine, modeling::Engine::kTriangles);
  waitForModel();
  EXPECT_FALSE(editor().model()->setup().splines);
  editor().undo();
  editor().undo();
  EXPECT_EQ(editor().project().mesh.engine, modeling::Engine::kAutomatic);
  waitForModel();
  EXPECT_TRUE(editor().model()->setup().splines);
}

TEST_F(Splines, ThePulledSolidIsExportedAndOpenedAgain) {
  openCylinder();
  Simulation& simulation = window_->simulation();
  action("Simulate")->trigger();
  ASSERT_TRUE(QTest::qWaitFor([&] { return simulation.drawn() != nullptr; }, 20000));
  const Eigen::Vector3d side(20, 0, 40);
  const auto id = simulation.begin({bem::ContactTool::Kind::kGrab, 8}, side, {4, 0, 2});
  ASSERT_TRUE(id);
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        const auto touched = simulation.snapshot().touched();
        return !touched.empty() && touched.front().force.norm() > 0.1;
      },
      20000));
  keepPicture("splines-simulate");
  const QString file = folder_.filePath("pulled.json");
  withDialog<QFileDialog>(
      [&] {
        withDialog<ExportDialog>([&] { action("Export deformed solid")->trigger(); },
                                 [&](ExportDialog& dialog) {
                                   QTest::keyClicks(dialog.findChild<QComboBox*>("format"),
                                                    "Palpa");
                                   keepPicture("splines-export", &dialog);
                                   QTest::keyClick(&dialog, Qt::Key_Return);
                                 });
      },
      [&](QFileDialog& dialog) { chooseFile(dialog, file); });
  const modeling::Project written = modeling::readProject(file.toStdString());
  const auto [low, high] = modeling::boundingBox(written.body);
  EXPECT_GT(high.x(), 22.0);
  EXPECT_TRUE(written.supports.empty());
}

}  // namespace
}  // namespace palpa::gui

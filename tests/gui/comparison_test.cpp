// Comparison of the open project with another variant.
#include <QClipboard>
#include <QComboBox>
#include <QFile>
#include <QLabel>
#include <QListWidget>
#include <QMessageBox>
#include <QPushButton>
#include <QSignalSpy>

#include "app/core/model/build_touch_model.h"
#include "app/gui/compare/state_choice_dialog.h"
#include "app/gui/docks/comparison_dock.h"
#include "app/gui/widgets/message_bar.h"
#include "modeling/project/project_file.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

const QString kBody = "Whole body";

class Comparing : public WindowTest {
 protected:
  VariantComparison& comparison() { return window_->comparison(); }
  ComparisonView& pictures() { return window_->comparisonView(); }
  Simulation& simulation() { return window_->simulation(); }
  ComparisonDock& dock() { return *find<ComparisonDock>("comparison"); }
  QString status() { return find<QLabel>("comparisonStatus")->text(); }
  QPushButton& button(const char* name) { return *find<QPushButton>(name); }

  void SetUp() override {
    ASSERT_TRUE(window_->openFile(kSphere));
    waitForModel();
  }
  /// The open project with Young's modulus and all lengths multiplied, as a file.
  QString variant(const QString& name, double stiffer, double larger = 1) {
    modeling::Project project = editor().project();
    project.material.youngsModulus *= stiffer;
    auto& solid = std::get<modeling::Solid>(project.body);
    std::vector<Eigen::Vector3d> points = solid.controlPoints();
    for (Eigen::Vector3d& point : points) point *= larger;
    solid = solid.withControlPoints(points);
    if (larger != 1) project.primitive.reset();
    const QString file = folder_.filePath(name);
    modeling::writeProject(project, file.toStdString());
    return file;
  }
  bool waitForResult() {
    return QTest::qWaitFor(
        [&] {
          const auto result = comparison().result();
          return result && result->comparison && !comparison().isComputing();
        },
        60000);
  }
  bool compareWith(const QString& file) {
    return window_->comparisonActions().compareWithFile(file) && waitForResult();
  }
  void simulate() {
    action("Simulate")->trigger();
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
          const auto result = comparison().result();
          return simulation().drawn() && result && result->drawnA == simulation().sharedDrawn();
        },
        30000));
  }
  void show(const char* what) {
    auto* box = find<QComboBox>("comparisonShown");
    box->setCurrentIndex(box->findText(what));
    QTest::qWait(50);
  }
  /// Share of the pixels of the view with the colour of the other variant.
  double orangeShare() {
    QTest::qWait(500);  // until the fine picture is drawn
    const QImage image = view().grab().toImage();
    int count = 0;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) {
        const QColor pixel = image.pixelColor(x, y);
        // Neither yellow nor the red of arrows.
        count += pixel.red() - pixel.blue() > 60 && pixel.green() < 0.85 * pixel.red() &&
                 pixel.green() > 0.3 * pixel.red();
      }
    return static_cast<double>(count) / (image.width() * image.height());
  }
  /// Grabs the pole and pulls it aside.
  void grabThePole() {
    const auto id = simulation().begin({bem::ContactTool::Kind::kGrab, 6.0, 0}, {0, 0, 25},
                                       Eigen::Vector3d::Zero());
    ASSERT_TRUE(id.has_value());
    simulation().move(*id, {3, 0, -1});
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
          const auto result = comparison().result();
          return result && result->isOfView && result->comparison && !comparison().isComputing() &&
                 (result->comparison->touches[0].vector - Eigen::Vector3d(3, 0, -1)).norm() < 1e-9;
        },
        30000));
  }
};

TEST_F(Comparing, WithAFileFillsTheTable) {
  const QString file = variant("stiffer.json", 2);
  withDialog<QFileDialog>([&] { action("Compare with")->trigger(); },
                          [&](QFileDialog& dialog) { chooseFile(dialog, file); });
  ASSERT_TRUE(waitForResult());
  EXPECT_TRUE(dock().isVisible());
  // The touch of the project. Forces are in proportion to Young's modulus.
  const QString heading = QString::fromStdString(editor().project().touches[0].name);
  EXPECT_EQ(dock().text(heading, "Force, N", 4), "+100.0");
  EXPECT_EQ(dock().text(heading, "Moved", 3), "0");
  EXPECT_EQ(dock().text(kBody, "Volume", 3), "0");
  const double ofA = dock().text(heading, "Force, N", 1).toDouble();
  EXPECT_GT(ofA, 0.1);
  EXPECT_NEAR(dock().text(heading, "Force, N", 2).toDouble(), 2 * ofA, 2e-2 * ofA);
  // A follows the open project.
  modeling::Material material = editor().project().material;
  material.youngsModulus *= 4;
  editor().perform(modeling::SetMaterial{material});
  EXPECT_TRUE(
      QTest::qWaitFor([&] { return dock().text(heading, "Force, N", 4) == "-50.0"; }, 60000))
      << dock().text(heading, "Force, N", 4).toStdString();
  editor().undo();
  EXPECT_TRUE(
      QTest::qWaitFor([&] { return dock().text(heading, "Force, N", 4) == "+100.0"; }, 60000));
  // The errors follow when nothing changes any more.
  EXPECT_TRUE(
      QTest::qWaitFor([&] { return !dock().text(kBody, "Estimated error", 1).isEmpty(); }, 60000));
  EXPECT_GT(dock().text(kBody, "Estimated error", 2).toDouble(), 0);
  button("comparisonCopy").click();
  const QString copied = QApplication::clipboard()->text();
  EXPECT_TRUE(copied.startsWith("\tA\tB\tB − A\t%\n")) << copied.toStdString();
  EXPECT_TRUE(copied.contains("\t+100.0\n")) << copied.toStdString();
  const QString table = folder_.filePath("table.csv");
  withDialog<QFileDialog>([&] { button("comparisonExport").click(); },
                          [&](QFileDialog& dialog) { chooseFile(dialog, table); });
  QFile written(table);
  ASSERT_TRUE(written.open(QIODevice::ReadOnly));
  EXPECT_TRUE(written.readAll().startsWith("part,name,figure,a,b,"));
  button("comparisonEnd").click();
  EXPECT_FALSE(comparison().isActive());
  EXPECT_TRUE(dock().text(kBody, "Volume", 1).isEmpty());
}

TEST_F(Comparing, DrawsTheOtherShapeAsAGhost) {
  ASSERT_TRUE(compareWith(variant("larger.json", 1, 1.15)));
  const double inModel = orangeShare();
  EXPECT_GT(inModel, 0.005);
  keepPicture("comparison-model");
  simulate();
  grabThePole();
  const double touched = orangeShare();
  EXPECT_GT(touched, 0.005);
  // The ghost follows the touch, and stays at rest on request.
  const QImage deformed = view().grab().toImage();
  find<QCheckBox>("comparisonDeformed")->click();
  QTest::qWait(500);
  EXPECT_NE(view().grab().toImage(), deformed);
  find<QCheckBox>("comparisonDeformed")->click();
  button("comparisonEnd").click();
  EXPECT_LT(orangeShare(), 0.2 * touched);
}

TEST_F(Comparing, ShowsTheContactsOfTheViewAndTheirFields) {
  ASSERT_TRUE(compareWith(variant("stiffer.json", 10)));
  simulate();
  action("von Mises stress")->trigger();
  grabThePole();
  EXPECT_EQ(dock().text("Grab 1", "Force, N", 4), "+900.0");
  // As in the loop: the column of A is the force that the user reads in the Forces panel.
  const double force = simulation().snapshot().touched()[0].force.norm();
  EXPECT_NEAR(dock().text("Grab 1", "Force, N", 1).toDouble(), force, 1e-2 * force);
  // The common range encloses the tenfold stress; without it the colours are of A alone.
  QTest::qWait(300);
  const double common = simulation().range()[1];
  const auto result = comparison().result();
  EXPECT_GE(common, result->comparison->states[1].largestStress);
  find<QCheckBox>("comparisonCommon")->click();
  simulation().setRangeMode(Simulation::RangeMode::kAutomatic);
  QTest::qWait(300);
  EXPECT_LT(simulation().range()[1], common);
  find<QCheckBox>("comparisonCommon")->click();
  keepPicture("comparison-a");
  const QImage a = view().grab().toImage();
  show("B");
  QTest::qWait(500);
  keepPicture("comparison-b");
  const QImage b = view().grab().toImage();
  EXPECT_NE(a, b);
  show("Difference B − A");
  QTest::qWait(500);
  keepPicture("comparison-difference");
  EXPECT_NE(view().grab().toImage(), b);
  EXPECT_TRUE(pictures().note().contains("nearest point of B")) << pictures().note().toStdString();
  // The stiffness map belongs to A alone.
  action("Stiffness")->trigger();
  QTest::qWait(100);
  EXPECT_TRUE(pictures().note().contains("belongs to A alone")) << pictures().note().toStdString();
  EXPECT_TRUE(status().contains("belongs to A alone"));
  action("Plain")->trigger();
  QTest::qWait(100);
  EXPECT_TRUE(pictures().note().contains("needs a field"));
}

TEST_F(Comparing, BodiesThatDoNotCorrespondHaveNoDifference) {
  ASSERT_TRUE(compareWith(PALPA_PROJECTS "/gripper-finger.json"));
  simulate();
  show("Difference B − A");
  EXPECT_TRUE(pictures().note().contains("would compare different places"))
      << pictures().note().toStdString();
  show("B");
  EXPECT_TRUE(pictures().note().isEmpty());
  QTest::qWait(300);
  keepPicture("comparison-other-body");
}

// With B in place of A, tools, sections and samples act on A as before.
TEST_F(Comparing, ToolsWorkWhileTheOtherVariantIsShown) {
  ASSERT_TRUE(compareWith(variant("larger.json", 1, 1.1)));
  simulate();
  show("B");
  const QPoint middle = view().rect().center();
  drag(middle, middle + QPoint(40, 10));
  action("Section")->trigger();
  QTest::qWait(500);
  for (const Qt::Key key : {Qt::Key_I, Qt::Key_K, Qt::Key_B, Qt::Key_X}) {
    QTest::keyClick(&view(), key);
    moveTo(middle);
    drag(middle, middle + QPoint(15, 0));
    QTest::keyClick(&view(), Qt::Key_Escape);
  }
  show("Difference B − A");
  drag(middle, middle + QPoint(30, 0), Qt::ShiftModifier);
  QTest::qWait(300);
  // A pinned contact, and an edit of A behind it.
  action("Model")->trigger();
  QTest::qWait(100);
  EXPECT_TRUE(pictures().note().contains("Simulate mode")) << pictures().note().toStdString();
  action("Simulate")->trigger();
  show("B");
  editor().perform(modeling::TransformSolid{
      modeling::Scaling{Eigen::Vector3d::Constant(1.05), Eigen::Vector3d::Zero()}});
  waitForModel();
  QTest::qWait(300);
  ASSERT_TRUE(waitForResult());
  comparison().end();
  QTest::qWait(200);
  EXPECT_TRUE(comparison().isActive() == false && simulation().isActive());
}

TEST_F(Comparing, TellsWhatHappensToTheFile) {
  const QString file = variant("other.json", 2);
  ASSERT_TRUE(compareWith(file));
  QSignalSpy refused(&editor(), &Editor::refused);
  variant("other.json", 3);
  ASSERT_TRUE(QTest::qWaitFor([&] { return status().contains("has changed on the disk"); }, 10000))
      << status().toStdString();
  const QString heading = QString::fromStdString(editor().project().touches[0].name);
  EXPECT_EQ(dock().text(heading, "Force, N", 4), "+100.0");
  button("comparisonReload").click();
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return dock().text(heading, "Force, N", 4) == "+200.0"; }, 60000));
  EXPECT_FALSE(status().contains("has changed"));
  // A broken file, and one that vanished: the comparison stays as it was.
  QFile broken(file);
  ASSERT_TRUE(broken.open(QIODevice::WriteOnly));
  broken.write("{ not json");
  broken.close();
  button("comparisonReload").click();
  EXPECT_EQ(refused.size(), 1);
  EXPECT_EQ(dock().text(heading, "Force, N", 4), "+200.0");
  QFile::remove(file);
  ASSERT_TRUE(QTest::qWaitFor([&] { return status().contains("not there any more"); }, 10000))
      << status().toStdString();
  button("comparisonReload").click();
  EXPECT_EQ(refused.size(), 2);
  EXPECT_EQ(dock().text(heading, "Force, N", 4), "+200.0");
  EXPECT_FALSE(editor().session().isModified());
}

TEST_F(Comparing, RefusesWhatIsNoProject) {
  QSignalSpy refused(&editor(), &Editor::refused);
  QFile text(folder_.filePath("text.json"));
  ASSERT_TRUE(text.open(QIODevice::WriteOnly));
  text.write("hello");
  text.close();
  for (const QString& file : {text.fileName(), folder_.filePath("absent.json"), folder_.path()})
    EXPECT_FALSE(window_->comparisonActions().compareWithFile(file)) << file.toStdString();
  EXPECT_EQ(refused.size(), 3);
  EXPECT_FALSE(comparison().isActive());
  withDialog<QFileDialog>([&] { action("Compare with")->trigger(); },
                          [](QFileDialog& dialog) { QTest::keyClick(&dialog, Qt::Key_Escape); });
  EXPECT_FALSE(comparison().isActive());
}

TEST_F(Comparing, ABodyThatCannotBeBuiltIsExplained) {
  modeling::Project free = editor().project();
  free.supports.clear();
  const QString file = folder_.filePath("free.json");
  modeling::writeProject(free, file.toStdString());
  ASSERT_TRUE(window_->comparisonActions().compareWithFile(file));
  ASSERT_TRUE(QTest::qWaitFor([&] { return status().contains("B cannot be built"); }, 30000));
  EXPECT_TRUE(button("comparisonAgain").isVisible());
  button("comparisonEnd").click();
  EXPECT_FALSE(comparison().isActive());
}

TEST_F(Comparing, TouchesThatBCannotPlayAreExplained) {
  modeling::Project other = editor().project();
  other.supports[0].where = {{modeling::Stroke{{{0, 0, 25}}, 12}}};
  const QString file = folder_.filePath("fixed.json");
  modeling::writeProject(other, file.toStdString());
  ASSERT_TRUE(window_->comparisonActions().compareWithFile(file));
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        const auto result = comparison().result();
        return result && !result->problem.isEmpty();
      },
      60000));
  EXPECT_TRUE(status().contains("cannot be compared. B: ")) << status().toStdString();
}

TEST_F(Comparing, WithAnEarlierState) {
  EXPECT_TRUE(action("Compare with the state before")->isEnabled()) << "the saved version";
  editor().perform(modeling::TransformSolid{
      modeling::Scaling{Eigen::Vector3d::Constant(1.1), Eigen::Vector3d::Zero()}});
  waitForModel();
  withDialog<StateChoiceDialog>([&] { action("Compare with the state before")->trigger(); },
                                [](StateChoiceDialog& dialog) {
                                  EXPECT_EQ(dialog.findChild<QListWidget*>("states")->count(), 2);
                                  QTest::keyClick(&dialog, Qt::Key_Escape);
                                });
  EXPECT_FALSE(comparison().isActive());
  withDialog<StateChoiceDialog>([&] { action("Compare with the state before")->trigger(); },
                                [](StateChoiceDialog& dialog) {
                                  QTest::keyClick(dialog.findChild<QListWidget*>("states"),
                                                  Qt::Key_Return);
                                });
  ASSERT_TRUE(waitForResult());
  // B is the smaller body: 1 / 1.1^3 - 1.
  EXPECT_EQ(dock().text(kBody, "Volume", 4), "-24.9");
  editor().undo();
  EXPECT_TRUE(QTest::qWaitFor([&] { return dock().text(kBody, "Volume", 3) == "0"; }, 60000));
  // The saved version is the file.
  withDialog<StateChoiceDialog>([&] { action("Compare with the state before")->trigger(); },
                                [](StateChoiceDialog& dialog) {
                                  dialog.findChild<QListWidget*>("states")->setCurrentRow(
                                      dialog.findChild<QListWidget*>("states")->count() - 1);
                                  dialog.accept();
                                });
  ASSERT_TRUE(waitForResult());
  EXPECT_TRUE(comparison().nameOfB().contains("as saved"));
}

TEST_F(Comparing, EndsWithTheProjectAndTheWindow) {
  const QString file = variant("larger.json", 1, 1.1);
  ASSERT_TRUE(compareWith(file));
  simulate();
  show("B");
  ASSERT_TRUE(window_->openFile(PALPA_PROJECTS "/sphere.json"));
  EXPECT_FALSE(comparison().isActive());
  EXPECT_TRUE(window_->messages().messages().join(' ').contains("has ended"));
  waitForModel();
  // Stopped while it is being built, built again, and closed in the middle.
  ASSERT_TRUE(window_->comparisonActions().compareWithFile(variant("again.json", 5)));
  if (button("comparisonCancel").isVisible()) {
    button("comparisonCancel").click();
    EXPECT_TRUE(QTest::qWaitFor(
        [&] {
          using State = app::RebuildStatus::State;
          const auto state = comparison().otherStatus().state;
          return state == State::kCancelled || state == State::kUpToDate;
        },
        30000));
  }
  if (comparison().otherStatus().state == app::RebuildStatus::State::kCancelled) {
    ASSERT_TRUE(QTest::qWaitFor([&] { return button("comparisonAgain").isVisible(); }, 5000));
    button("comparisonAgain").click();
  }
  ASSERT_TRUE(waitForResult());
  ASSERT_TRUE(window_->comparisonActions().compareWithFile(variant("third.json", 7)));
  window_->close();
  restart();
}

}  // namespace
}  // namespace palpa::gui

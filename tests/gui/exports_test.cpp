#include <QAction>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QPushButton>
#include <QSignalSpy>
#include <clocale>
#include <cstdlib>

#include "app/core/live/touch_recording_file.h"
#include "app/core/results/deformed_solid.h"
#include "app/core/results/error_estimate.h"
#include "app/core/results/touch.h"
#include "app/gui/base/background_job.h"
#include "app/gui/base/progress_dialog.h"
#include "app/gui/dialogs/export_dialog.h"
#include "app/gui/dialogs/picture_dialog.h"
#include "app/report/numbers.h"
#include "base/worker_thread.h"
#include "modeling/project/project_file.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

/// Files that the window writes, and the ends of writing them.
class Exports : public WindowTest {
 protected:
  using Kind = bem::ContactTool::Kind;

  Exports() { QDir(folder_.path()).mkdir("exported"); }

  QString exported(const QString& name) { return folder_.filePath("exported/" + name); }
  QStringList exportedFiles() {
    return QDir(exported("")).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot);
  }

  void simulateSphere(modeling::Engine engine = modeling::Engine::kTriangles) {
    ASSERT_TRUE(window_->openFile(kSphere));
    modeling::Project project = editor().project();
    project.mesh.engine = engine;
    project.mesh.accuracy = 0.05;
    editor().start(project);
    waitForModel();
    action("Simulate")->trigger();
    ASSERT_TRUE(QTest::qWaitFor([&] { return window_->simulation().drawn() != nullptr; }, 20000));
  }

  /// Opens a recording of a pull that lasts `steps` milliseconds.
  void openRecording(std::uint64_t steps) {
    app::RecordingFile file;
    file.model = app::recordedModelOf(window_->simulation().body()->model(), "sphere");
    file.recording.steps = steps;
    file.recording.entries.push_back(
        {0, {app::TouchCommand::Kind::kBegin, 1, {Kind::kGrab, 8, 0}, {0, 0, 25}, {0, 0, -1}}});
    const QString path = folder_.filePath("recorded.json");
    app::writeRecording(file, path.toStdString());
    withDialog<QFileDialog>([&] { action("Open recording")->trigger(); },
                            [&](QFileDialog& dialog) { chooseFile(dialog, path); });
    ASSERT_TRUE(action("Export forces")->isEnabled());
  }

  void exportReport(const QString& file) {
    withDialog<QFileDialog>([&] { action("Export report")->trigger(); },
                            [&](QFileDialog& dialog) { chooseFile(dialog, file); });
  }

  /// Calls `cancel` as soon as the progress of what `act` begins is shown.
  static void cancelWhile(const std::function<void()>& act,
                          const std::function<void(ProgressDialog&)>& cancel) {
    bool isCancelled = false;
    QTimer poll;
    QObject::connect(&poll, &QTimer::timeout, [&] {
      auto* dialog = qobject_cast<ProgressDialog*>(QApplication::activeModalWidget());
      if (!dialog || isCancelled) return;
      isCancelled = true;
      cancel(*dialog);
    });
    poll.start(50);
    act();
    EXPECT_TRUE(isCancelled) << "no progress was shown";
  }
  static void pressEscape(ProgressDialog& dialog) { QTest::keyClick(&dialog, Qt::Key_Escape); }

  /// Exports the forces; calls `cancel` as soon as the progress is shown.
  void exportForces(const QString& file, const std::function<void(ProgressDialog&)>& cancel) {
    cancelWhile(
        [&] {
          withDialog<QFileDialog>([&] { action("Export forces")->trigger(); },
                                  [&](QFileDialog& dialog) { chooseFile(dialog, file); });
        },
        cancel);
  }
};

/// Longer than any test.
constexpr std::uint64_t kEndless = 80'000'000;

TEST_F(Exports, ACancelledTableOfForcesLeavesNoFile) {
  simulateSphere();
  openRecording(kEndless);
  const QString file = exported("forces.csv");
  exportForces(file, [](ProgressDialog& dialog) { QTest::keyClick(&dialog, Qt::Key_Escape); });
  EXPECT_EQ(exportedFiles(), QStringList());
  EXPECT_FALSE(isBackgroundJobRunning());
  // An older table stays as it is.
  QFile old(file);
  ASSERT_TRUE(old.open(QIODevice::WriteOnly));
  old.write("old");
  old.close();
  QTimer overwrite;  // the question whether to replace it
  QObject::connect(&overwrite, &QTimer::timeout, [] {
    auto* question = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    if (question) QTest::mouseClick(question->button(QMessageBox::Yes), Qt::LeftButton);
  });
  overwrite.start(20);
  exportForces(file, [](ProgressDialog& dialog) {
    QTest::mouseClick(dialog.findChild<QPushButton*>("cancel"), Qt::LeftButton);
  });
  EXPECT_EQ(exportedFiles(), QStringList("forces.csv"));
  ASSERT_TRUE(old.open(QIODevice::ReadOnly));
  EXPECT_EQ(old.readAll(), "old");
  EXPECT_EQ(window_->messages().messages().filter("export", Qt::CaseInsensitive), QStringList());
  // The window works on.
  action("Release all")->trigger();
  openRecording(20);
  withDialog<QFileDialog>([&] { action("Export forces")->trigger(); },
                          [&](QFileDialog& dialog) { chooseFile(dialog, exported("next.csv")); });
  EXPECT_TRUE(exportedFiles().contains("next.csv"));
}

TEST_F(Exports, ClosingTheWindowCancelsAnExport) {
  simulateSphere();
  openRecording(kEndless);
  exportForces(exported("forces.csv"), [this](ProgressDialog&) { window_->close(); });
  ASSERT_TRUE(QTest::qWaitFor([&] { return !window_->isVisible(); }, 20000));
  EXPECT_EQ(exportedFiles(), QStringList());
}

TEST_F(Exports, ACancelledAnimationLeavesNoPictures) {
  simulateSphere();
  openRecording(2000);
  bool isCancelled = false, isChosen = false;
  QTimer answers;
  QObject::connect(&answers, &QTimer::timeout, [&] {
    QWidget* modal = QApplication::activeModalWidget();
    if (auto* size = qobject_cast<PictureDialog*>(modal)) return size->accept();
    if (auto* files = qobject_cast<QFileDialog*>(modal)) {
      if (std::exchange(isChosen, true)) return;  // it is being answered
      return chooseFile(*files, files->acceptMode() == QFileDialog::AcceptSave
                                    ? exported("film.mp4")
                                    : exported(""));
    }
    auto* progress = qobject_cast<ProgressDialog*>(modal);
    if (!progress || progress->windowTitle() != "Drawing the pictures" || isCancelled) return;
    isCancelled = true;
    QTest::keyClick(progress, Qt::Key_Escape);
  });
  answers.start(20);
  action("Export animation")->trigger();
  EXPECT_TRUE(isCancelled);
  EXPECT_EQ(exportedFiles(), QStringList());
  // The view shows the touches of the loop again.
  EXPECT_TRUE(
      QTest::qWaitFor([&] { return window_->simulation().snapshot().contactCount == 0; }, 5000));
}

TEST_F(Exports, ADeformedSolidHasItsTrueDisplacements) {
  simulateSphere(modeling::Engine::kSplines);
  Simulation& simulation = window_->simulation();
  simulation.begin({Kind::kGrab, 8, 0}, {0, 0, 25}, {0, 0, -1});
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        const auto touched = simulation.snapshot().touched();
        return !touched.empty() && touched.front().force.norm() > 0;
      },
      20000));
  action("× 10")->trigger();
  QTest::qWait(100);
  const QString file = exported("pressed.json");
  QSignalSpy said(&editor(), &Editor::said);
  QTimer accept;
  QObject::connect(&accept, &QTimer::timeout, [] {
    auto* dialog = qobject_cast<ExportDialog*>(QApplication::activeModalWidget());
    if (!dialog) return;
    auto* format = dialog->findChild<QComboBox*>("format");
    format->setCurrentIndex(format->findText("project", Qt::MatchContains));
    dialog->accept();
  });
  accept.start(50);
  QSignalSpy refused(&editor(), &Editor::refused);
  withDialog<QFileDialog>([&] { action("Export deformed solid")->trigger(); },
                          [&](QFileDialog& dialog) { chooseFile(dialog, file); });
  ASSERT_TRUE(QFileInfo::exists(file))
      << (refused.isEmpty() ? QString() : refused[0][0].toString()).toStdString();
  const modeling::Project written = modeling::readProject(file.toStdString());
  const auto state = simulation.describe();
  ASSERT_TRUE(state);
  const auto& now = std::get<modeling::Solid>(written.body).controlPoints();
  const modeling::Solid wanted = app::deformedSolid(simulation.body()->model(), state->field);
  ASSERT_EQ(now.size(), wanted.controlPoints().size());
  double apart = 0;
  for (std::size_t k = 0; k < now.size(); ++k)
    apart = std::max(apart, (now[k] - wanted.controlPoints()[k]).norm());
  EXPECT_LT(apart, 1e-6);
  ASSERT_EQ(said.count(), 1);
  EXPECT_TRUE(said[0][0].toString().contains("true"));
}

TEST_F(Exports, UnexpectedErrorsBecomeMessages) {
  QTimer::singleShot(0, window_.get(), [] { throw std::runtime_error("a broken slot"); });
  QTimer::singleShot(0, window_.get(), [] { throw 7; });
  QTimer::singleShot(0, window_.get(), [] { throw Cancelled{}; });
  WorkerThread worker;
  worker.post([](const std::stop_token&) { throw std::bad_alloc(); });
  worker.waitUntilIdle();
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_->messages().messages().size() == 3; }, 5000));
  const QStringList messages = window_->messages().messages();
  EXPECT_EQ(messages.filter("a broken slot").size(), 1);
  EXPECT_EQ(messages.filter("unknown type").size(), 1);
  EXPECT_EQ(messages.filter("not enough memory").size(), 1);
  for (const QString& message : messages)
    EXPECT_TRUE(message.startsWith("Unexpected error: ")) << message.toStdString();
}

TEST_F(Exports, ASeriesHasAMeshForEveryPicture) {
  simulateSphere();
  openRecording(100);
  withDialog<QFileDialog>([&] { action("Export series")->trigger(); },
                          [&](QFileDialog& dialog) { chooseFile(dialog, exported("pull")); });
  EXPECT_EQ(exportedFiles(), (QStringList{"pull", "pull.pvd"}));
  QFile collection(exported("pull.pvd"));
  ASSERT_TRUE(collection.open(QIODevice::ReadOnly));
  const QString text = collection.readAll();
  EXPECT_EQ(text.count("<DataSet "), 3);  // 0, 33 and 67 ms of 100
  EXPECT_TRUE(text.contains("timestep=\"0.033\""));
  EXPECT_TRUE(text.contains("file=\"pull/pull_00002.vtp\""));
  EXPECT_EQ(QDir(exported("pull")).entryList(QDir::Files).size(), 3);
}

TEST_F(Exports, ACancelledSeriesLeavesNothing) {
  simulateSphere();
  openRecording(kEndless);
  cancelWhile(
      [&] {
        withDialog<QFileDialog>(
            [&] { action("Export series")->trigger(); },
            [&](QFileDialog& dialog) { chooseFile(dialog, exported("pull.pvd")); });
      },
      pressEscape);
  EXPECT_EQ(exportedFiles(), QStringList());
}

TEST_F(Exports, AReportHasTheNumbersOfTheShownModel) {
  ASSERT_TRUE(window_->openFile(PALPA_PROJECTS "/box.json"));
  waitForModel();
  const std::string former = setlocale(LC_NUMERIC, nullptr);
  setlocale(LC_NUMERIC, "de_DE.UTF-8");  // where it is installed
  exportReport(exported("box.html"));
  setlocale(LC_NUMERIC, former.c_str());
  QFile file(exported("box.html"));
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  const QString html = QString::fromUtf8(file.readAll());
  const app::TouchState state =
      app::playTouches(*editor().model(), editor().project().touches, 0, {});
  EXPECT_TRUE(html.contains(QString("force %1 N").arg(state.contacts[1].force.norm(), 0, 'g', 4)))
      << "the given force";
  app::TouchState known = state;
  app::addErrors(*editor().model(), known);
  for (const auto& contact : known.contacts) {
    const bool isGiven = modeling::infoOf(*contact.kind).isForce;
    const std::string force =
        report::withError(contact.force.norm(), isGiven ? 0 : *contact.errorEstimate);
    EXPECT_TRUE(html.contains(QString::fromStdString("|" + force + "| N"))) << force;
  }
  EXPECT_EQ(html.count("<img "), 4);
  EXPECT_TRUE(html.contains("from box.json"));
  EXPECT_EQ(exportedFiles(), QStringList("box.html"));
}

TEST_F(Exports, AReportAsPdfHasAPageForEveryState) {
  ASSERT_TRUE(window_->openFile(PALPA_PROJECTS "/box.json"));
  exportReport(exported("box.pdf"));  // builds the model if it is not ready
  QFile file(exported("box.pdf"));
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  const QByteArray pdf = file.readAll();
  EXPECT_TRUE(pdf.startsWith("%PDF"));
  const int pages = pdf.count("/Type /Page\n") + pdf.count("/Type /Page\r");
  EXPECT_GE(pages, 4);
  EXPECT_LE(pages, 8);
  EXPECT_EQ(pdf.count("/Subtype /Image"), 4) << "pictures without transparency";
  if (const char* folder = std::getenv("PALPA_PICTURES"))
    file.copy(QString(folder) + "/report.pdf");
}

TEST_F(Exports, AReportThatCannotBeMadeSaysWhy) {
  // Nothing acts.
  QSignalSpy refused(&editor(), &Editor::refused);
  ASSERT_TRUE(window_->openFile(PALPA_PROJECTS "/box.json"));
  modeling::Project project = editor().project();
  project.touches.clear();
  editor().start(project);
  action("Export report")->trigger();
  ASSERT_EQ(refused.count(), 1);
  EXPECT_TRUE(refused.takeFirst().at(0).toString().contains("nothing to report"));
  ASSERT_TRUE(window_->openFile(PALPA_PROJECTS "/box.json"));
  // The body is free to move.
  project = editor().project();
  project.supports.clear();
  editor().start(project);
  exportReport(exported("free.html"));
  ASSERT_GE(refused.count(), 1);
  EXPECT_EQ(exportedFiles(), QStringList());
  EXPECT_FALSE(isBackgroundJobRunning());
}

TEST_F(Exports, ACancelledReportLeavesNoFile) {
  ASSERT_TRUE(window_->openFile(kSphere));
  modeling::Project project = editor().project();
  project.mesh.engine = modeling::Engine::kTriangles;
  project.mesh.edgeLength = 1.2;  // some seconds to build
  editor().start(project);
  editor().cancelRebuild();
  cancelWhile([&] { exportReport(exported("ball.html")); }, pressEscape);
  EXPECT_EQ(exportedFiles(), QStringList());
}

}  // namespace
}  // namespace palpa::gui

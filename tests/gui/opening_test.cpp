#include <QFile>
#include <QLabel>
#include <QMenu>
#include <QSignalSpy>
#include <QStatusBar>

#include "modeling/project/project_file.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

class Opening : public WindowTest {
 protected:
  /// Writes a project file with a part of the sphere's text replaced.
  QString broken(const QString& name, const QByteArray& part, const QByteArray& by) {
    QFile source(kSphere);
    EXPECT_TRUE(source.open(QIODevice::ReadOnly));
    QByteArray content = source.readAll();
    EXPECT_TRUE(content.contains(part)) << part.constData();
    content.replace(content.indexOf(part), part.size(), by);
    QFile file(folder_.filePath(name));
    EXPECT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(content);
    return file.fileName();
  }
  QString lastMessage() {
    const QStringList all = window_->messages().messages();
    return all.isEmpty() ? QString() : all.last();
  }
};

TEST_F(Opening, BrokenProjectsAreNamedAndThePresentOneStays) {
  const std::string before = text();
  const QString version = broken("version.json", "\"version\": 3", "\"version\": 99");
  const QString number = broken("number.json", "MPa\": 0.1", "MPa\": NaN");
  const QString truncated = folder_.filePath("truncated.json");
  QFile::copy(kSphere, truncated);
  QFile(truncated).resize(700);
  for (const QString& file : {version, number, truncated, QString("/no/such/missing.json")}) {
    EXPECT_FALSE(window_->openFile(file));
    EXPECT_TRUE(lastMessage().contains(QFileInfo(file).fileName())) << lastMessage().toStdString();
    window_->messages().clear();
  }
  EXPECT_EQ(text(), before);
  EXPECT_TRUE(window_->settings().recentFiles().isEmpty());
}

TEST_F(Opening, TrimmedFacesBecomeAMeshBodyWithWords) {
  ASSERT_TRUE(window_->openFile(PALPA_TEST_DATA "/cad/bored_cylinder.step"));
  EXPECT_FALSE(editor().solid());
  const QString all = window_->messages().messages().join('\n');
  EXPECT_TRUE(all.contains("mesh body")) << all.toStdString();
  EXPECT_TRUE(all.contains("no control points")) << all.toStdString();
  keepPicture("mesh-body");
}

TEST_F(Opening, AnImportIsSaidOnce) {
  QSignalSpy said(&editor(), &Editor::said);
  ASSERT_TRUE(window_->openFile(PALPA_TEST_DATA "/cad/bored_cylinder.step"));
  waitForModel();
  QTest::qWait(100);
  QString all = window_->messages().messages().join('\n') + window_->statusBar()->currentMessage();
  for (const QString& sentence : {QString("became a mesh body"), QString("no control points")})
    EXPECT_EQ(all.count(sentence), 1) << all.toStdString();
  EXPECT_LE(said.count(), 1);
  // Opened again, it is said again, once.
  ASSERT_TRUE(window_->openFile(kSphere));
  ASSERT_TRUE(window_->openFile(PALPA_TEST_DATA "/cad/bored_cylinder.step"));
  QTest::qWait(100);
  all = window_->messages().messages().join('\n') + window_->statusBar()->currentMessage();
  EXPECT_EQ(all.count("became a mesh body"), 1) << all.toStdString();
}

TEST_F(Opening, ASolidMayFollowAMeshBodyWhileNothingOfThemIsShown) {
  ASSERT_TRUE(window_->openFile(PALPA_TEST_DATA "/cad/bored_cylinder.step"));
  window_->simulation().setActive(true);
  ASSERT_TRUE(window_->openFile(kSphere));
  const auto* page = window_->findChild<QWidget*>("page");
  ASSERT_NE(page, nullptr);
  const auto* size = page->findChild<QLabel*>("size");
  ASSERT_NE(size, nullptr);
  EXPECT_EQ(size->text().toStdString(), "50 mm × 50 mm × 50 mm");
}

TEST_F(Opening, AVanishedRecentFileIsGreyAndTheListCanBeCleared) {
  const QString file = folder_.filePath("ball.json");
  QFile::copy(kSphere, file);
  ASSERT_TRUE(window_->openFile(file));
  ASSERT_TRUE(window_->openFile(kSphere));
  auto* menu = find<QMenu>("recent");
  Q_EMIT menu->aboutToShow();
  EXPECT_TRUE(menu->findChild<QAction*>(file)->isEnabled());
  // A file removed between menu and click gives a message only.
  QAction* entry = menu->findChild<QAction*>(file);
  QFile::remove(file);
  entry->trigger();
  EXPECT_EQ(editor().fileName(), kSphere);
  EXPECT_TRUE(lastMessage().contains("ball.json"));
  Q_EMIT menu->aboutToShow();
  EXPECT_FALSE(menu->findChild<QAction*>(file)->isEnabled());
  EXPECT_TRUE(menu->findChild<QAction*>(kSphere)->isEnabled());
  menu->findChild<QAction*>("Clear list")->trigger();
  EXPECT_TRUE(window_->settings().recentFiles().isEmpty());
}

TEST_F(Opening, AnExampleIsANewProject) {
  auto* menu = find<QMenu>("examples");
  ASSERT_GE(menu->actions().size(), 5);
  menu->actions().at(1)->trigger();
  EXPECT_TRUE(editor().fileName().isEmpty());
  EXPECT_NE(editor().project().name, "Untitled");
  EXPECT_FALSE(window_->isWindowModified());
}

TEST_F(Opening, ExamplesWithTargetsOpenFromTheirMenu) {
  const QList<QAction*> actions = find<QMenu>("design examples")->actions();
  ASSERT_EQ(actions.size(), 3);
  for (QAction* action : actions) {
    action->trigger();
    EXPECT_EQ(QString::fromStdString(editor().project().name), action->text());
    ASSERT_TRUE(editor().project().design) << action->text().toStdString();
    EXPECT_FALSE(editor().project().design->targets.empty());
    EXPECT_TRUE(editor().fileName().isEmpty());
  }
}

TEST_F(Opening, AModelBeyondTheMemoryIsRefusedAndTheLastOneStays) {
  window_->settings().setMemoryLimitGiB(0.5);
  ASSERT_TRUE(window_->openFile(kSphere));
  waitForModel();
  const auto model = editor().model();
  modeling::MeshSettings mesh = editor().project().mesh;
  mesh.edgeLength /= 20;
  ASSERT_TRUE(editor().perform(modeling::SetMesh{mesh}));
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return editor().rebuildStatus().state == app::RebuildStatus::State::kFailed; }, 60000));
  QTest::qWait(100);
  EXPECT_EQ(editor().model(), model);
  const QString words = find<QLabel>("rebuildDetails")->text();
  EXPECT_TRUE(words.contains("memory")) << words.toStdString();
  EXPECT_TRUE(words.contains("edge length"));
  keepPicture("memory");
}

}  // namespace
}  // namespace palpa::gui

#include <QLabel>
#include <QPushButton>

#include "app/core/model/model_memory.h"
#include "modeling/mesh/mesh.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

using LargePart = WindowTest;

TEST_F(LargePart, AButtonTakesTheEdgeLengthThatFitsIntoMemory) {
  ASSERT_TRUE(window_->openFile(kSphere));
  modeling::Project project = editor().project();
  project.mesh.engine = modeling::Engine::kTriangles;
  project.mesh.edgeLength = 2;
  // Half of the memory that the model needs.
  const double nodes = modeling::estimateNodeCount(project.body, project.mesh, {});
  window_->settings().setMemoryLimitGiB(
      0.5 *
      app::expectedBytes(nodes, nodes, modeling::Engine::kTriangles, bem::Precision::kAutomatic) /
      (1024.0 * 1024 * 1024));
  editor().start(project);
  const auto buttons = [this] { return window_->messages().findChildren<QPushButton*>("remedy"); };
  ASSERT_TRUE(QTest::qWaitFor([&] { return !buttons().isEmpty(); }, 30000));
  const QStringList messages = window_->messages().messages();
  ASSERT_EQ(messages.size(), 1);
  EXPECT_TRUE(messages[0].contains(" of memory for ")) << messages[0].toStdString();
  EXPECT_TRUE(messages[0].contains(",")) << messages[0].toStdString();
  EXPECT_TRUE(buttons().front()->text().startsWith("Use an edge length of "));
  keepPicture("large-part");
  const std::string before = text();
  QTest::mouseClick(buttons().front(), Qt::LeftButton);
  waitForModel();
  EXPECT_GT(editor().project().mesh.edgeLength, 2);
  EXPECT_NE(editor().model(), nullptr);
  editor().undo();
  EXPECT_EQ(text(), before);
}

}  // namespace
}  // namespace palpa::gui

#include <QLabel>
#include <QPushButton>
#include <cmath>

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
      app::expectedBytes({nodes, nodes}, modeling::Engine::kTriangles, bem::Precision::kAutomatic) /
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

/// A sphere of 2 n^2 - 2 n triangles around the z axis.
modeling::MeshBody fineSphere(int n) {
  modeling::MeshBody::Data data;
  constexpr double kRadius = 25;
  const auto add = [&](double polar, double around) {
    data.positions.emplace_back(kRadius * std::sin(polar) * std::cos(around),
                                kRadius * std::sin(polar) * std::sin(around),
                                kRadius * std::cos(polar));
  };
  add(0, 0);
  for (int i = 1; i < n; ++i)
    for (int j = 0; j < n; ++j) add(M_PI * i / n, 2 * M_PI * j / n);
  add(M_PI, 0);
  const auto vertex = [n](int i, int j) { return 1 + (i - 1) * n + j % n; };
  const int last = static_cast<int>(data.positions.size()) - 1;
  for (int j = 0; j < n; ++j) {
    data.triangles.push_back({0, vertex(1, j), vertex(1, j + 1)});
    for (int i = 1; i + 1 < n; ++i) {
      data.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      data.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
    data.triangles.push_back({last, vertex(n - 1, j + 1), vertex(n - 1, j)});
  }
  data.faceNames = {"skin"};
  data.faceOfTriangle.assign(data.triangles.size(), 0);
  return modeling::MeshBody(std::move(data));
}

TEST_F(LargePart, IsDrawnWithFewerTrianglesWhileTheViewTurns) {
  ASSERT_TRUE(window_->openFile(kSphere));
  modeling::Project project = editor().project();
  project.body = fineSphere(190);
  project.supports.clear();  // of the sphere's patches; without a model nothing else moves
  project.loads.clear();
  editor().start(project);
  const std::size_t all = std::get<modeling::MeshBody>(project.body).triangles().size();
  const auto drawn = [this] { return view().viewport().drawnTriangles(); };
  ASSERT_TRUE(QTest::qWaitFor([&] { return drawn() == all; }, 30000)) << drawn();

  const QPoint from = view().rect().center(), to = from + QPoint(60, 20);
  moveTo(from);
  QTest::mousePress(&view(), Qt::MiddleButton, {}, from);
  moveTo(to, Qt::MiddleButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return drawn() < all / 2; }, 5000)) << drawn();
  EXPECT_GT(drawn(), all / 20);
  keepPicture("large-part-moving");
  // The body stays coarse while the motion goes on, and is drawn finely after it.
  moveTo(to + QPoint(10, 0), Qt::MiddleButton);
  QTest::qWait(50);
  EXPECT_LT(drawn(), all / 2);
  QTest::mouseRelease(&view(), Qt::MiddleButton, {}, to + QPoint(10, 0));
  EXPECT_TRUE(QTest::qWaitFor([&] { return drawn() == all; }, 30000)) << drawn();
  keepPicture("large-part-at-rest");

  QTest::keyClick(&view(), Qt::Key_Right, Qt::AltModifier);
  EXPECT_TRUE(QTest::qWaitFor([&] { return drawn() == all; }, 30000)) << drawn();
}

}  // namespace
}  // namespace palpa::gui

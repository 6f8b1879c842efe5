#include <QComboBox>
#include <QSignalSpy>

#include "app/gui/tools/brush.h"
#include "app/gui/widgets/quantity_edit.h"
#include "modeling/shapes/make_primitive.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

class SurfaceTools : public WindowTest {
 protected:
  SurfaceTools() {
    EXPECT_TRUE(window_->openFile(kSphere));
    steps0_ = text();
  }

  void use(const QString& tool) {
    action(tool)->trigger();
    options_.reset(window_->tools().active().makeOptions(nullptr));
  }
  template <class T>
  T& option(const QString& name) {
    auto* found = options_->findChild<T*>(name);
    if (!found) throw std::runtime_error("no option " + name.toStdString());
    return *found;
  }
  void choose(const QString& name, int index) {
    auto& box = option<QComboBox>(name);
    box.setCurrentIndex(index);
    Q_EMIT box.activated(index);
  }
  void enter(const QString& name, const QString& number) {
    auto& field = option<QuantityEdit>(name);
    field.selectAll();
    QTest::keyClicks(&field, number);
    QTest::keyClick(&field, Qt::Key_Return);
  }
  QPoint middle() { return view().rect().center(); }
  SurfacePlace placeAt(QPoint at) {
    const auto hit = view().viewport().surfaceAt({at.x(), at.y()});
    EXPECT_TRUE(hit) << "no surface under the pointer";
    return {0, {}, hit ? hit->position : Eigen::Vector3d::Zero(), {}};
  }
  void click(QPoint at, Qt::KeyboardModifiers modifiers = {}) {
    moveTo(at, {}, modifiers);
    QTest::mouseClick(&view(), Qt::LeftButton, modifiers, at);
  }
  const modeling::Project& project() { return editor().project(); }
  /// One undo step restores the opened project.
  void expectOneStep() {
    ASSERT_TRUE(editor().session().document().canUndo());
    editor().undo();
    EXPECT_EQ(text(), steps0_);
    EXPECT_FALSE(editor().session().document().canUndo());
  }

  std::unique_ptr<QWidget> options_;
  std::string steps0_;
};

TEST_F(SurfaceTools, AClickedPatchIsHeldAndLetGoAgain) {
  use("Paint support");
  const std::size_t supports = project().supports.size();
  choose("supportKind", 1);
  click(middle());
  ASSERT_EQ(project().supports.size(), supports + 1);
  const modeling::Support& made = project().supports.back();
  EXPECT_EQ(made.name, "support 1");
  EXPECT_EQ(made.kind, modeling::Support::Kind::kRoller);
  ASSERT_EQ(made.where.parts.size(), 1u);
  EXPECT_EQ(std::get<modeling::PatchSet>(made.where.parts[0]).patches.size(), 1u);
  EXPECT_EQ(editor().selection(), Selection::of(Selection::Kind::kSupport, "support 1"));
  keepPicture("support-patch");
  click(middle());
  EXPECT_EQ(text(), steps0_);
  editor().undo();
  expectOneStep();
}

TEST_F(SurfaceTools, ADragOverPatchesIsOneStep) {
  use("Paint support");
  drag(middle() - QPoint(0, 150), middle() + QPoint(0, 150));
  const auto& parts = project().supports.back().where.parts;
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_GE(std::get<modeling::PatchSet>(parts[0]).patches.size(), 2u);
  expectOneStep();
}

TEST_F(SurfaceTools, TheBrushPaintsAStrokeUnderThePointer) {
  use("Paint support");
  choose("paintWay", 1);
  enter("brushRadius", "3 mm");
  const QPoint from = middle() - QPoint(80, 40), to = middle() + QPoint(60, -40);
  drag(from, to);
  ASSERT_EQ(project().supports.back().name, "support 1");
  const auto& parts = project().supports.back().where.parts;
  ASSERT_EQ(parts.size(), 1u);
  const auto stroke = std::get<modeling::Stroke>(parts[0]);
  EXPECT_DOUBLE_EQ(stroke.radius, 3.0);
  for (int i = 0; i <= 4; ++i)
    EXPECT_LT(stroke.value(placeAt(from + (to - from) * i / 4).position), -2.0);
  keepPicture("support-brush");
  // A second stroke is a second step; Ctrl erases under the pointer.
  drag(to, to + QPoint(0, 90));
  EXPECT_EQ(project().supports.back().where.parts.size(), 2u);
  drag(middle() + QPoint(0, -40), middle() + QPoint(1, -41), Qt::ControlModifier);
  EXPECT_EQ(project().supports.back().where.parts.size(), 3u);
  const Eigen::Vector3d erased = placeAt(middle() + QPoint(0, -40)).position;
  for (const auto& part : project().supports.back().where.parts)
    EXPECT_GE(std::get<modeling::Stroke>(part).value(erased), -0.2);
  editor().undo();
  editor().undo();
  expectOneStep();
}

TEST_F(SurfaceTools, WhatIsPaintedEndsWithItsProject) {
  use("Paint support");
  moveTo(middle());
  QTest::mousePress(&view(), Qt::LeftButton, {}, middle());
  ASSERT_TRUE(editor().session().document().isInGroup());
  ASSERT_TRUE(editor().open(kSphere));
  moveTo(middle() + QPoint(20, 0), Qt::LeftButton);
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, middle() + QPoint(20, 0));
  EXPECT_EQ(text(), steps0_);
}

TEST_F(SurfaceTools, ATouchThatIsPulledEndsWithItsProject) {
  use("Place touch");
  moveTo(middle());
  QTest::mousePress(&view(), Qt::LeftButton, {}, middle());
  ASSERT_TRUE(editor().open(kSphere));
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, middle());
  EXPECT_EQ(text(), steps0_);
}

TEST_F(SurfaceTools, AFailedStepWhilePaintingTakesAllOfItBack) {
  use("Paint support");
  moveTo(middle());
  QTest::mousePress(&view(), Qt::LeftButton, {}, middle());
  editor().beginGroup("another");
  editor().cancelGroup();
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, middle());
  EXPECT_FALSE(editor().session().document().isInGroup());
  EXPECT_EQ(text(), steps0_);
}

TEST_F(SurfaceTools, AButtonThatWasReleasedElsewherePaintsNoMore) {
  use("Paint support");
  moveTo(middle());
  QTest::mousePress(&view(), Qt::LeftButton, {}, middle());
  // A dialog receives the release; back in the view no button is pressed.
  moveTo(middle() + QPoint(30, 0));
  EXPECT_FALSE(editor().session().document().isInGroup());
  const std::string painted = text();
  moveTo(middle() + QPoint(150, 0));
  EXPECT_EQ(text(), painted);
  expectOneStep();
}

TEST_F(SurfaceTools, EscapeTakesAStrokeBackAndKeysChangeTheRadius) {
  use("Paint support");
  choose("paintWay", 1);
  const double radius = option<QuantityEdit>("brushRadius").value();
  moveTo(middle());
  QTest::keyClick(&view(), Qt::Key_BracketRight);
  EXPECT_GT(option<QuantityEdit>("brushRadius").value(), radius);
  QTest::keyClick(&view(), Qt::Key_BracketLeft);
  EXPECT_NEAR(option<QuantityEdit>("brushRadius").value(), radius, 1e-9);
  QTest::mousePress(&view(), Qt::LeftButton, {}, middle());
  moveTo(middle() + QPoint(50, 0), Qt::LeftButton);
  EXPECT_NE(text(), steps0_);
  QTest::keyClick(&view(), Qt::Key_Escape);
  EXPECT_EQ(text(), steps0_);
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, middle());
  EXPECT_EQ(text(), steps0_);
  EXPECT_FALSE(editor().session().document().canUndo());
}

TEST_F(SurfaceTools, PressOnAPatchWithAShareOfYoungsModulus) {
  use("Place load");
  const std::size_t loads = project().loads.size();
  click(middle());
  ASSERT_EQ(project().loads.size(), loads + 1);
  const auto pressure = std::get<modeling::Pressure>(project().loads.back().what);
  EXPECT_DOUBLE_EQ(pressure.pressure, 0.02 * project().material.youngsModulus);
  keepPicture("load-pressure");
  enter("loadStrength", "5 kPa");
  EXPECT_DOUBLE_EQ(std::get<modeling::Pressure>(project().loads.back().what).pressure, 0.005);
  // With a selected pressure, the kind traction creates a new load.
  choose("loadKind", 1);
  click(middle() + QPoint(3, 3));
  ASSERT_EQ(project().loads.size(), loads + 2);
  EXPECT_TRUE(std::holds_alternative<modeling::UniformTraction>(project().loads.back().what));
  editor().undo();
  editor().undo();
  expectOneStep();
}

TEST_F(SurfaceTools, ABumpIsDraggedFromItsMiddle) {
  use("Place load");
  choose("loadKind", 2);
  const Eigen::Vector3d centre = placeAt(middle()).position;
  const Eigen::Vector3d rim = placeAt(middle() + QPoint(60, 0)).position;
  QTest::mousePress(&view(), Qt::LeftButton, {}, middle());
  for (int i = 1; i <= 5; ++i) moveTo(middle() + QPoint(12 * i, 0), Qt::LeftButton);
  EXPECT_EQ(text(), steps0_) << "nothing is made before the release";
  keepPicture("load-bump-drag");
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, middle() + QPoint(60, 0));
  const auto bump = std::get<modeling::Bump>(project().loads.back().what);
  EXPECT_LT((bump.center - centre).norm(), 0.2);
  EXPECT_NEAR(bump.radius, (rim - centre).norm(), 0.2);
  EXPECT_LT(bump.direction.dot(centre), 0) << "into the ball";
  EXPECT_NEAR(bump.direction.norm(), 1.0, 1e-12);
  keepPicture("load-bump");
  expectOneStep();
}

TEST_F(SurfaceTools, ATouchIsPulledOutOrPressedIn) {
  use("Place touch");
  const std::size_t touches = project().touches.size();
  drag(middle(), middle() + QPoint(40, 0));
  ASSERT_EQ(project().touches.size(), touches + 1);
  const modeling::Touch pulled = project().touches.back();
  ASSERT_EQ(pulled.kind, modeling::TouchKind::kGrab);
  const Eigen::Vector3d vector = pulled.vector;
  EXPECT_LT((pulled.at - placeAt(middle()).position).norm(), 0.2);
  EXPECT_LE((pixelOf(pulled.at + vector) - middle() - QPoint(40, 0)).manhattanLength(), 3);
  editor().undo();
  click(middle());
  const Eigen::Vector3d pressed = project().touches.back().vector;
  const auto [low, high] = modeling::boundingBox(project().body);
  EXPECT_NEAR(pressed.norm(), 0.05 * (high - low).maxCoeff(), 1e-9);
  EXPECT_LT(pressed.dot(project().touches.back().at), 0);
  keepPicture("touch");
  editor().undo();
  // Along the normal the pointer sets only the distance.
  drag(middle() + QPoint(40, -40), middle() + QPoint(70, -60), Qt::ControlModifier);
  const modeling::Touch along = project().touches.back();
  const Eigen::Vector3d way = along.vector;
  EXPECT_GT(way.norm(), 0.1);
  EXPECT_GT(std::abs(way.normalized().dot(along.at.normalized())), 0.999);
  expectOneStep();
}

TEST_F(SurfaceTools, ATouchIsOfTheKindThatWasChosen) {
  use("Place touch");
  EXPECT_FALSE(option<QuantityEdit>("touchFriction").isEnabled());
  choose("touchKind", 1);
  ASSERT_TRUE(option<QuantityEdit>("touchFriction").isEnabled());
  enter("touchFriction", "0.4");
  click(middle());
  const modeling::Touch touch = project().touches.back();
  ASSERT_EQ(touch.kind, modeling::TouchKind::kPush);
  EXPECT_DOUBLE_EQ(touch.friction, 0.4);
  EXPECT_LT(touch.vector.dot(touch.at), 0);
  keepPicture("touch-push");
  choose("touchKind", 3);
  EXPECT_FALSE(option<QuantityEdit>("touchFriction").isEnabled());
  click(middle() + QPoint(30, 30));
  ASSERT_EQ(project().touches.back().kind, modeling::TouchKind::kPin);
  EXPECT_EQ(project().touches.back().vector.norm(), 0);
}

TEST_F(SurfaceTools, AKnotIsInsertedUnderThePointerAndRemovedAgain) {
  use("Insert knot");
  const QPoint at = middle() + QPoint(20, 30);
  const auto rows = [&] {
    std::size_t sum = 0;
    for (const auto& patch : editor().solid()->patches()) sum += patch.knots[0].size() * 1000;
    for (const auto& patch : editor().solid()->patches()) sum += patch.knots[1].size();
    return sum;
  };
  const std::size_t before = rows();
  view().setFocus();
  moveTo(at);
  keepPicture("knot-hover");
  QTest::keyClick(&view(), Qt::Key_Tab);
  EXPECT_EQ(option<QComboBox>("knotDirection").currentIndex(), 1);
  EXPECT_EQ(window_->focusWidget(), &view()) << "Tab belongs to the tool";
  click(at);
  EXPECT_GT(rows(), before);
  const std::string inserted = text();
  use("Remove knot");
  moveTo(at);
  keepPicture("knot-remove");
  click(at);
  EXPECT_EQ(rows(), before);
  editor().undo();
  EXPECT_EQ(text(), inserted);
  expectOneStep();
}

TEST_F(SurfaceTools, AKnotThatShapesTheBodyStays) {
  use("Remove knot");
  enter("knotTolerance", "0");
  QSignalSpy refused(&editor(), &Editor::refused);
  QSignalSpy said(&editor(), &Editor::said);
  // A path over the sphere crosses a knot line, or the tool reports that there is none.
  for (int x = -100; x <= 100; x += 20) click(middle() + QPoint(x, 30));
  EXPECT_EQ(text(), steps0_);
  EXPECT_EQ(refused.count() + said.count(), 11);
  EXPECT_GT(refused.count(), 0);
  EXPECT_TRUE(refused.at(0).at(0).toString().contains("would move by"))
      << refused.at(0).at(0).toString().toStdString();
}

TEST_F(SurfaceTools, MeshBodiesAreHeldAndLoadedToo) {
  modeling::MeshBody::Data data;
  data.positions = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0, 0, 10}};
  data.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  data.faceOfTriangle = {0, 1, 2, 3};
  data.faceNames = {"bottom", "front", "left", "slope"};
  modeling::Project mesh;
  mesh.name = "tetrahedron";
  mesh.material.name = "rubber";
  mesh.body = modeling::MeshBody(data);
  editor().start(mesh);
  use("Paint support");
  const QPoint at = pixelOf({3, 0, 3});  // on the front
  click(at);
  ASSERT_EQ(project().supports.size(), 1u);
  EXPECT_EQ(std::get<modeling::PatchSet>(project().supports[0].where.parts.at(0)).patches,
            std::vector<std::string>{"front"});
  editor().select({});
  choose("paintWay", 1);
  drag(at, at + QPoint(10, 0));
  ASSERT_EQ(project().supports.size(), 2u);
  keepPicture("support-mesh");
  use("Insert knot");
  QSignalSpy said(&editor(), &Editor::said);
  click(at);
  EXPECT_EQ(said.count(), 1);
}

TEST_F(SurfaceTools, NothingHappensBesideTheBody) {
  for (const char* tool :
       {"Paint support", "Place load", "Place touch", "Insert knot", "Remove knot"}) {
    use(tool);
    click({5, 5});
    drag({5, 5}, {30, 30});
  }
  EXPECT_EQ(text(), steps0_);
  EXPECT_FALSE(editor().session().document().canUndo());
}

// Brush geometry, without a window.

TEST(SurfaceBrush, TheRingIsWhereTheSphereCutsTheTriangles) {
  const std::vector<Eigen::Vector3d> points{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}};
  const std::vector<std::array<int, 3>> triangles{{0, 1, 2}, {0, 2, 3}};
  const std::vector<int> patches{0, 0};
  for (const Eigen::Vector3d& centre : {Eigen::Vector3d(5, 5, 0), Eigen::Vector3d(7, 2, 0.5)}) {
    double length = 0;
    const double radius = 1.5;
    for (const auto& line : ringOnSurface({points, triangles, patches}, centre, radius))
      for (std::size_t i = 0; i < line.size(); ++i) {
        EXPECT_NEAR((line[i] - centre).norm(), radius, 1e-9);
        if (i > 0) length += (line[i] - line[i - 1]).norm();
      }
    const double inPlane = std::sqrt(radius * radius - centre.z() * centre.z());
    EXPECT_NEAR(length, 2 * M_PI * inPlane, 0.01 * inPlane);
  }
  EXPECT_TRUE(ringOnSurface({points, triangles, patches}, {5, 5, 2}, 1.5).empty());
}

TEST(SurfaceBrush, ErasingCutsAStroke) {
  const modeling::Stroke stroke{{{0, 0, 0}, {10, 0, 0}}, 1.0};
  const auto pieces = withoutNear(stroke, {5, 0, 0}, 2.0);
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(pieces[0].points.back(), Eigen::Vector3d(3, 0, 0));
  EXPECT_EQ(pieces[1].points.front(), Eigen::Vector3d(7, 0, 0));
  EXPECT_EQ(pieces[1].points.back(), Eigen::Vector3d(10, 0, 0));
  EXPECT_EQ(withoutNear(stroke, {0, 0, 0}, 2.0).size(), 1u);
  EXPECT_TRUE(withoutNear(stroke, {5, 0, 0}, 6.0).empty());
  EXPECT_TRUE(withoutNear({{{1, 1, 1}}, 1.0}, {1, 1, 1.5}, 0.1).empty());
  EXPECT_EQ(withoutNear(stroke, {5, 4, 0}, 2.0), std::vector{stroke});
}

}  // namespace
}  // namespace palpa::gui

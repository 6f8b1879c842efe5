#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QScrollArea>
#include <QSpinBox>
#include <QToolBar>
#include <QToolButton>
#include <atomic>
#include <chrono>
#include <semaphore>
#include <thread>

#include "app/gui/properties/property_page.h"
#include "app/gui/widgets/vector_edit.h"
#include "app/gui/workspace/tool_box.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

class PropertiesDock : public WindowTest {
 protected:
  PropertiesDock() { EXPECT_TRUE(window_->openFile(kSphere)); }

  QWidget& page() {
    return *window_->findChild<QDockWidget*>("properties")->findChild<QWidget*>("page");
  }
  template <class T = QuantityEdit>
  T& field(const QString& name) {
    auto* found = page().findChild<T*>(name);
    if (!found) throw std::runtime_error("no field " + name.toStdString());
    return *found;
  }
  QString fact(const QString& name) { return field<QLabel>(name).text(); }
  void enter(QLineEdit& edit, const QString& text) {
    edit.setFocus();
    edit.selectAll();
    QTest::keyClicks(&edit, text);
    QTest::keyClick(&edit, Qt::Key_Return);
  }
  QLabel& refusalOf(QWidget& edit) { return *edit.parentWidget()->findChild<QLabel*>("refusal"); }
  const modeling::Project& project() { return editor().project(); }
};

TEST_F(PropertiesDock, TheProjectsMaterialAndMeshAreEdited) {
  enter(field("youngsModulus"), "0.25");
  EXPECT_DOUBLE_EQ(project().material.youngsModulus, 0.25);
  enter(field("edgeLength"), "0.6 cm");
  EXPECT_DOUBLE_EQ(project().mesh.edgeLength, 6.0);
  QTest::mouseClick(&field<QCheckBox>("refineAtBorders"), Qt::LeftButton, {}, QPoint(8, 8));
  EXPECT_TRUE(project().mesh.refineAtBorders);
  enter(field<QLineEdit>("name"), "Soft ball");
  EXPECT_EQ(project().name, "Soft ball");
  EXPECT_TRUE(QTest::qWaitFor([this] { return fact("nodes").startsWith("about "); }));
  for (int i = 0; i < 4; ++i) editor().undo();
  EXPECT_FALSE(editor().session().document().canUndo());  // four edits were four steps
  keepPicture("properties-project");
}

TEST_F(PropertiesDock, FactsOfTheModelAppearWithIt) {
  useEmptyCache();
  ASSERT_TRUE(window_->openFile(PALPA_TEST_DATA "/cad/bored_cylinder.step"));
  EXPECT_EQ(fact("simplification"), "…");
  waitForModel();
  EXPECT_TRUE(QTest::qWaitFor([this] { return fact("simplification") == "nothing"; }))
      << fact("simplification").toStdString();
}

TEST_F(PropertiesDock, AValueThatTakesLongLeavesTheWindowFree) {
  using namespace std::chrono_literals;
  std::binary_semaphore go(0);
  std::atomic<int> begun = 0, cancelled = 0;
  PropertyPage slow(dynamic_cast<PropertyPage&>(page()).workspace());
  slow.addComputedFact("Slow", "slow", [&] {
    return [&, number = ++begun](const Job& job) {
      for (int k = 0; k < 10'000; ++k) {
        if (job.stop.stop_requested()) ++cancelled;
        job.throwIfCancelled();
        std::this_thread::sleep_for(1ms);
        if (number == 2 && go.try_acquire()) return QString("known");
      }
      return QString("late");
    };
  });
  auto* fact = slow.findChild<QLabel*>("slow");
  slow.refreshSlowValues();
  ASSERT_TRUE(QTest::qWaitFor([&] { return fact->text() == "…"; }));
  slow.refreshSlowValues();  // another value is wanted
  EXPECT_TRUE(QTest::qWaitFor([&] { return cancelled == 1; }));
  go.release();
  EXPECT_TRUE(QTest::qWaitFor([&] { return fact->text() == "known"; }));
  slow.refreshSlowValues();
  ASSERT_TRUE(QTest::qWaitFor([&] { return fact->text() == "…"; }));
  slow.retire();  // the page goes meanwhile
  EXPECT_TRUE(QTest::qWaitFor([&] { return cancelled == 2; }));
}

TEST_F(PropertiesDock, WhatIsRefusedIsSaidAtTheFieldAndTheOldValueReturns) {
  QuantityEdit& ratio = field("poissonRatio");
  const std::string before = text();
  const QString shown = ratio.text();
  enter(ratio, "0.7");
  EXPECT_EQ(text(), before);
  EXPECT_TRUE(refusalOf(ratio).isVisible());
  EXPECT_FALSE(refusalOf(ratio).text().isEmpty());
  EXPECT_EQ(ratio.text(), shown);
  keepPicture("properties-refused");
  enter(ratio, "0.4");
  EXPECT_FALSE(refusalOf(ratio).isVisible());
}

TEST_F(PropertiesDock, AShapeIsMadeAnewFromItsNumbers) {
  editor().perform(modeling::MakePrimitive{{modeling::SphereShape{20}}});
  enter(field("length0"), "30");
  ASSERT_TRUE(project().primitive);
  EXPECT_DOUBLE_EQ(std::get<modeling::SphereShape>(project().primitive->shape).radius, 30.0);
  // Facts of the body are updated after a short rest.
  EXPECT_TRUE(QTest::qWaitFor(
      [&] { return std::abs(fact("size").section(' ', 0, 0).toDouble() - 60.0) < 0.1; }, 5000))
      << fact("size").toStdString();
  // A moved point removes the primitive.
  editor().perform(
      modeling::MovePoints{modeling::PointSelection::of({0}), modeling::MoveBy{{0.5, 0, 0}}, {}});
  EXPECT_EQ(page().findChild<QWidget*>("length0"), nullptr);
}

TEST_F(PropertiesDock, PointsAreMovedByNumbers) {
  editor().select(Selection::ofPoints({3}));
  auto& position = field<VectorEdit>("position");
  enter(position.component(0), "1.25");
  EXPECT_DOUBLE_EQ(editor().solid()->controlPoints()[3].x(), 1.25);
  EXPECT_FALSE(fact("nets").isEmpty());
  keepPicture("properties-point");
  editor().select(Selection::ofPoints({3, 4, 5}));
  const auto before = editor().solid()->controlPoints();
  auto& centre = field<VectorEdit>("centre");
  const double z = centre.value().z();
  enter(centre.component(2), QString::number(z + 1.0, 'g', 15));
  for (int point : {3, 4, 5})
    EXPECT_NEAR(editor().solid()->controlPoints()[point].z(), before[point].z() + 1.0, 1e-9);
}

TEST_F(PropertiesDock, TypingIsNotOverwrittenAndNotEnteredElsewhere) {
  editor().select(Selection::ofPoints({3}));
  QuantityEdit& x = field<VectorEdit>("position").component(0);
  x.setFocus();
  x.selectAll();
  QTest::keyClicks(&x, "77");
  editor().perform(modeling::RenameProject{"other"});
  editor().perform(
      modeling::MovePoints{modeling::PointSelection::of({3}), modeling::MoveBy{{0, 0.1, 0}}, {}});
  QTest::qWait(80);
  EXPECT_EQ(x.text(), "77");
  EXPECT_TRUE(x.hasFocus());
  const auto before = editor().solid()->controlPoints();
  editor().select(Selection::ofPoints({4}));
  QTest::keyClick(&x, Qt::Key_Return);
  editor().select(Selection::ofPatches({0}));
  EXPECT_EQ(editor().solid()->controlPoints(), before);
}

TEST_F(PropertiesDock, APatchAndItsMesh) {
  editor().select(Selection::ofPatches({0}));
  EXPECT_FALSE(fact("degrees").isEmpty());
  EXPECT_TRUE(QTest::qWaitFor([this] { return fact("area").endsWith("mm²"); }));
  enter(field("factor"), "0.5");
  const std::string name = editor().solid()->patches()[0].name;
  EXPECT_DOUBLE_EQ(project().mesh.patchFactors.at(name), 0.5);
  keepPicture("properties-patch");
  enter(field("factor"), "1");
  EXPECT_TRUE(project().mesh.patchFactors.empty());
  enter(field<QLineEdit>("name"), QString::fromStdString(editor().solid()->patches()[1].name));
  EXPECT_TRUE(refusalOf(field<QLineEdit>("name")).isVisible());
  EXPECT_EQ(field<QLineEdit>("name").text().toStdString(), name);
}

TEST_F(PropertiesDock, EdgesAreMadeSmoothTogether) {
  editor().perform(modeling::MakePrimitive{{modeling::BoxShape{}}});
  editor().select(Selection::ofEdges({0, 1}));
  auto& kind = field<QComboBox>("kind");
  EXPECT_EQ(kind.currentIndex(), 0);
  kind.setFocus();
  QTest::keyClick(&kind, Qt::Key_Down);
  const bool done = editor().solid()->edges()[0].smooth && editor().solid()->edges()[1].smooth;
  EXPECT_TRUE(done || refusalOf(kind).isVisible());
  EXPECT_EQ(kind.currentIndex(), done ? 1 : 0);
  keepPicture("properties-edges");
}

TEST_F(PropertiesDock, ASupportAndItsRegion) {
  editor().select(Selection::of(Selection::Kind::kSupport, project().supports[0].name));
  enter(field<VectorEdit>("displacement").component(2), "-1.5");
  EXPECT_DOUBLE_EQ(project().supports[0].displacement.z(), -1.5);
  const std::size_t parts = project().supports[0].where.parts.size();
  QTest::mouseClick(&field<QToolButton>("addHalfSpace"), Qt::LeftButton);
  ASSERT_EQ(project().supports[0].where.parts.size(), parts + 1);
  enter(field(QString("below%1").arg(parts)), "-20");
  EXPECT_DOUBLE_EQ(std::get<modeling::HalfSpace>(project().supports[0].where.parts.back()).below,
                   -20.0);
  keepPicture("properties-support");
  QTest::mouseClick(&field<QToolButton>(QString("part%1Remove").arg(parts)), Qt::LeftButton);
  EXPECT_EQ(project().supports[0].where.parts.size(), parts);
  enter(field<QLineEdit>("name"), "foot");
  EXPECT_EQ(project().supports[0].name, "foot");
  EXPECT_EQ(editor().selection(), Selection::of(Selection::Kind::kSupport, "foot"));
}

TEST_F(PropertiesDock, LoadsOfAllKinds) {
  using namespace modeling;
  const std::string patch = editor().solid()->patches()[0].name;
  editor().perform(AddLoad{{"p", Pressure{Region::ofPatches({patch}), 0.01}}});
  editor().perform(AddLoad{{"t", UniformTraction{Region::ofPatches({patch}), {0, 0, 1}}}});
  editor().perform(AddLoad{{"b", Bump{{0, 0, 25}, 5, 0.1, {0, 0, -1}}}});
  editor().select(Selection::of(Selection::Kind::kLoad, "p"));
  enter(field("pressure"), "0.02");
  EXPECT_DOUBLE_EQ(std::get<Pressure>(project().loads.end()[-3].what).pressure, 0.02);
  QTest::mouseClick(&field<QToolButton>("patch " + QString::fromStdString(patch) + "Remove"),
                    Qt::LeftButton);
  EXPECT_EQ(regionOf(project().loads.end()[-3])->parts.size(), 1U);  // the last part stays
  editor().select(Selection::of(Selection::Kind::kLoad, "t"));
  enter(field<VectorEdit>("traction").component(1), "0.5");
  EXPECT_DOUBLE_EQ(std::get<UniformTraction>(project().loads.end()[-2].what).traction.y(), 0.5);
  editor().select(Selection::of(Selection::Kind::kLoad, "b"));
  enter(field("radius"), "0");
  EXPECT_TRUE(refusalOf(field("radius")).isVisible());
  enter(field("radius"), "7");
  EXPECT_DOUBLE_EQ(std::get<Bump>(project().loads.back().what).radius, 7.0);
  keepPicture("properties-bump");
}

TEST_F(PropertiesDock, ATouchBecomesAForceWithARadius) {
  using namespace modeling;
  editor().perform(AddTouch{{"poke", {0, 0, 25}, TouchKind::kGrab, {0, 0, -2}, {}}});
  editor().select(Selection::of(Selection::Kind::kTouch, "poke"));
  auto& kind = field<QComboBox>("kind");
  kind.setFocus();
  QTest::keyClick(&kind, Qt::Key_Down);
  EXPECT_EQ(project().touches.back().kind, TouchKind::kForce);
  EXPECT_EQ(project().touches.back().vector.z(), -1.0);
  EXPECT_TRUE(field<QComboBox>("kind").hasFocus());  // of the new page
  QTest::mouseClick(&field<QCheckBox>("usualRadius"), Qt::LeftButton, {}, QPoint(8, 8));
  enter(field("radius"), "3");
  EXPECT_EQ(project().touches.back().radius, 3.0);
  keepPicture("properties-touch");
}

TEST_F(PropertiesDock, ATouchBecomesAPushWithFrictionAndAPin) {
  using namespace modeling;
  editor().perform(AddTouch{{"poke", {0, 0, 25}, TouchKind::kGrab, {0, 0, -2}, {}}});
  editor().select(Selection::of(Selection::Kind::kTouch, "poke"));
  const auto choose = [&](int steps) {
    auto& kind = field<QComboBox>("kind");
    kind.setFocus();
    for (int k = 0; k < std::abs(steps); ++k)
      QTest::keyClick(&field<QComboBox>("kind"), steps > 0 ? Qt::Key_Down : Qt::Key_Up);
  };
  choose(2);
  // The conversion through a force sets the length to 1.
  EXPECT_EQ(project().touches.back().kind, TouchKind::kPush);
  EXPECT_EQ(project().touches.back().vector.z(), -1.0);
  enter(field<VectorEdit>("vector").component(0), "0.5");
  enter(field("friction"), "11");
  EXPECT_TRUE(refusalOf(field("friction")).isVisible());
  enter(field("friction"), "0.3");
  choose(1);
  const Touch ball = project().touches.back();
  EXPECT_EQ(ball.kind, TouchKind::kBall);
  EXPECT_EQ(ball.friction, 0.3);
  EXPECT_EQ(ball.vector, Eigen::Vector3d(0.5, 0, -1));
  keepPicture("properties-ball");
  choose(1);
  EXPECT_EQ(project().touches.back().kind, TouchKind::kPin);
  EXPECT_EQ(project().touches.back().vector.norm(), 0.0);
}

TEST_F(PropertiesDock, ADragRefreshesTheNumbersLater) {
  const int point = visiblePoint();
  const QPoint pixel = pixelOfPoint(point);
  drag(pixel, pixel + QPoint(40, -20));
  const double x = editor().solid()->controlPoints()[point].x();
  EXPECT_TRUE(QTest::qWaitFor([&] { return field<VectorEdit>("position").value().x() == x; }));
}

TEST_F(PropertiesDock, WhatWasTypedDoesNotOutliveTheWindow) {
  enter(field("edgeLength"), "4");
  QuantityEdit& edit = field("edgeLength");
  edit.setFocus();
  QTest::keyClicks(&edit, "9");
  window_.reset();
}

/// A tool with options.
class SomeTool : public Tool {
 public:
  QString hint() const override { return {}; }
  KeyHelp keyHelp() const override { return {}; }
  QWidget* makeOptions(QWidget* parent) override {
    auto* box = new QCheckBox("Wobble", parent);
    box->setObjectName("wobble");
    return box;
  }
};

TEST_F(PropertiesDock, TheActiveToolsOptionsComeFirst) {
  QMenu menu;
  Tool& first = window_->tools().active();
  Tool* tool = window_->tools().add(std::make_unique<SomeTool>(), &menu, {"move", "So&me tool"});
  const auto heading = [this] {
    QTest::qWait(20);  // until the former options are deleted
    const auto sections =
        window_->findChild<QDockWidget*>("properties")->findChildren<QWidget*>("toolOptions");
    return sections.size() == 1 ? sections[0]->findChild<QLabel*>("heading")->text() : QString();
  };
  EXPECT_EQ(heading(), "Select and move");
  window_->tools().activate(tool);
  EXPECT_EQ(heading(), "Some tool");
  auto* wobble = find<QCheckBox>("wobble");
  EXPECT_TRUE(wobble->isVisible());
  EXPECT_LT(wobble->mapToGlobal(QPoint()).y(), page().mapToGlobal(QPoint()).y());
  window_->tools().activate(&first);
  EXPECT_EQ(heading(), "Select and move");
  EXPECT_EQ(find<QCheckBox>("wobble"), nullptr);
}

TEST_F(PropertiesDock, NothingIsCutOffInANarrowPanel) {
  auto* dock = find<QDockWidget>("properties");
  window_->resizeDocks({dock}, {320}, Qt::Horizontal);
  QApplication::processEvents();
  ASSERT_LE(dock->width(), 320);
  auto* content = find<QWidget>("propertiesContent");
  const auto expectFits = [&](const std::string& what) {
    QTest::qWait(20);
    EXPECT_LE(content->minimumSizeHint().width(),
              dock->findChild<QScrollArea*>()->viewport()->width())
        << what;
    EXPECT_EQ(content->width(), dock->findChild<QScrollArea*>()->viewport()->width()) << what;
  };
  for (QAction* tool : window_->findChild<QToolBar*>("tools")->actions()) {
    if (!tool->isCheckable()) continue;
    tool->trigger();
    expectFits(tool->objectName().toStdString());
    keepPicture("tool-" + tool->objectName(), dock);
  }
  using namespace modeling;
  const std::string patch = editor().solid()->patches()[0].name;
  editor().perform(AddLoad{{"t", UniformTraction{Region::ofPatches({patch}), {0, 0, 1}}}});
  editor().perform(AddLoad{{"b", Bump{{0, 0, 25}, 5, 0.1, {0, 0, -1}}}});
  editor().perform(AddLoad{{"f", TotalForce{Region::ofPatches({patch}), {0, 0, 1}}}});
  editor().perform(AddLoad{{"m", Moment{Region::ofPatches({patch}), {0, 0, 1}}}});
  editor().perform(AddLoad{{"g", Gravity{}}});  // without density: with the remedies
  editor().perform(AddTouch{{"poke", {0, 0, 25}, TouchKind::kForce, {0, 0, -2}, 3.0}});
  using Kind = Selection::Kind;
  for (const auto& [name, selection] :
       {std::pair{"nothing", Selection()},
        {"point", Selection::ofPoints({3})},
        {"points", Selection::ofPoints({3, 4})},
        {"patch", Selection::ofPatches({0})},
        {"patches", Selection::ofPatches({0, 1})},
        {"edge", Selection::ofEdges({0})},
        {"edges", Selection::ofEdges({0, 1})},
        {"support", Selection::of(Kind::kSupport, project().supports[0].name)},
        {"traction", Selection::of(Kind::kLoad, "t")},
        {"bump", Selection::of(Kind::kLoad, "b")},
        {"total force", Selection::of(Kind::kLoad, "f")},
        {"moment", Selection::of(Kind::kLoad, "m")},
        {"gravity", Selection::of(Kind::kLoad, "g")},
        {"touch", Selection::of(Kind::kTouch, "poke")}}) {
    editor().select(selection);
    expectFits(name);
  }
}

TEST_F(PropertiesDock, LooksCalmInBothThemes) {
  for (const QSize size : {QSize(1280, 800), QSize(1920, 1080)}) {
    window_->resize(size);
    action("Reset layout")->trigger();
    QApplication::processEvents();
    EXPECT_GE(view().width(), window_->width() * 6 / 10);
    for (const Theme theme : {Theme::kDark, Theme::kLight}) {
      window_->settings().setTheme(theme);
      keepPicture(
          QString("docks-%1-%2").arg(size.width()).arg(theme == Theme::kDark ? "dark" : "light"));
    }
  }
}

}  // namespace
}  // namespace palpa::gui

#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QTreeView>

#include "app/gui/dialogs/material_dialog.h"
#include "app/gui/docks/forces_dock.h"
#include "app/gui/document/load_kinds.h"
#include "app/gui/simulate/load_marks.h"
#include "app/gui/view/condition_marks.h"
#include "app/gui/widgets/vector_edit.h"
#include "modeling/shapes/primitives.h"
#include "modeling/solid/tessellation.h"
#include "tests/gui/window_fixture.h"

// Loads by their sum and gravity in the window: menu, tool, properties, tree, missing density.
namespace palpa::gui {
namespace {

using modeling::Gravity;
using modeling::Moment;
using modeling::TotalForce;

class Loads : public WindowTest {
 protected:
  Loads() {
    EXPECT_TRUE(window_->openFile(kSphere));
    before_ = text();
  }

  const modeling::Project& project() { return editor().project(); }
  template <class T>
  const T& last() {
    return std::get<T>(project().loads.back().what);
  }
  template <class T = QuantityEdit>
  T& field(const QString& name) {
    auto* page = find<QDockWidget>("properties")->findChild<QWidget*>("page");
    auto* found = page->findChild<T*>(name);
    if (!found) throw std::runtime_error("no field " + name.toStdString());
    return *found;
  }
  /// Option of the active tool in the Properties panel.
  template <class T>
  T& option(const QString& name) {
    QTest::qWait(20);  // until the former options are deleted
    auto* found = find<QWidget>("toolOptions")->findChild<T*>(name);
    if (!found) throw std::runtime_error("no option " + name.toStdString());
    return *found;
  }
  void enter(QLineEdit& edit, const QString& text) {
    edit.setFocus();
    edit.selectAll();
    QTest::keyClicks(&edit, text);
    QTest::keyClick(&edit, Qt::Key_Return);
  }
  /// An entry of the menu "New load".
  void choose(const QString& kind) {
    for (QMenu* menu : window_->findChildren<QMenu*>())
      if (menu->title() == "&New load")
        for (QAction* entry : menu->actions())
          if (entry->objectName() == kind) return entry->trigger();
    FAIL() << "no entry " << kind.toStdString();
  }
  /// Detail of a load in the Model panel.
  QString detail(const std::string& name) {
    auto* tree = find<QDockWidget>("model")->findChild<QTreeView*>();
    const QAbstractItemModel& model = *tree->model();
    const auto found = model.match(model.index(0, 0), Qt::DisplayRole, QString::fromStdString(name),
                                   1, Qt::MatchExactly | Qt::MatchRecursive);
    return found.isEmpty() ? QString() : found[0].siblingAtColumn(1).data().toString();
  }
  QPoint middle() { return view().rect().center(); }
  void clickMiddle() {
    moveTo(middle());
    QTest::mouseClick(&view(), Qt::LeftButton, {}, middle());
  }
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
  /// A small body whose model is built in a moment, without a density.
  void startWithoutDensity() {
    modeling::Project small;
    small.name = "small";
    small.body = modeling::makeBox({10, 10, 10});
    small.material = {"own", 0.15, 0.45};
    small.mesh.engine = modeling::Engine::kTriangles;
    small.mesh.edgeLength = 5;
    small.supports = {{"base", {}, modeling::Region::ofPatches({"bottom"})}};
    editor().start(std::move(small));
  }

  std::string before_;
};

TEST_F(Loads, AForceOnSelectedPatchesByTheKeyboardAlone) {
  editor().select(Selection::ofPatches({0, 1}));
  choose("Total force");
  const auto names = modeling::patchNames(project().body);
  ASSERT_EQ(project().loads.back().name, "force 1");
  EXPECT_EQ(last<TotalForce>().where, modeling::Region::ofPatches({names[0], names[1]}));
  EXPECT_LT(last<TotalForce>().force.z(), 0);
  EXPECT_EQ(editor().selection(), Selection::of(Selection::Kind::kLoad, "force 1"));
  enter(field<VectorEdit>("force").component(2), "-250 mN");
  EXPECT_DOUBLE_EQ(last<TotalForce>().force.z(), -0.25);
  EXPECT_EQ(detail("force 1"), "0.25 N");
  // Nonsense is refused at the field, Escape restores it.
  QuantityEdit& x = field<VectorEdit>("force").component(0);
  const std::string valid = text();
  enter(x, "3 mm");
  EXPECT_TRUE(x.property("refused").toBool());
  EXPECT_EQ(text(), valid);
  QTest::keyClick(&x, Qt::Key_Escape);
  EXPECT_EQ(x.text(), "0 N");
  EXPECT_TRUE(QTest::qWaitFor([&] {
    return field<QLabel>("meanTraction").text().contains("kPa on 2,6");
  })) << field<QLabel>("meanTraction").text().toStdString();
  keepPicture("loads-total-force");
  editor().undo();
  editor().undo();
  EXPECT_EQ(text(), before_);
  EXPECT_FALSE(editor().session().document().canUndo());
}

TEST_F(Loads, AMomentIsPlacedByAClickAndSurvivesSaving) {
  choose("Moment");
  EXPECT_EQ(window_->tools().activeTitle(), "Place load");
  EXPECT_EQ(option<QComboBox>("loadKind").currentText(), "Moment");
  enter(option<VectorEdit>("loadMoment").component(2), "0.03 N m");
  clickMiddle();
  ASSERT_EQ(project().loads.back().name, "moment 1");
  EXPECT_NEAR(last<Moment>().moment.z(), 30, 1e-12);
  EXPECT_EQ(detail("moment 1"), "30 N mm");
  keepPicture("loads-moment");
  window_->settings().setTheme(Theme::kDark);
  choose("Gravity");
  keepPicture("loads-dark");
  editor().undo();
  const auto where = last<Moment>().where;
  const QString file = folder_.path() + "/moment.json";
  ASSERT_TRUE(editor().saveAs(file));
  ASSERT_TRUE(window_->openFile(kSphere));
  ASSERT_TRUE(window_->openFile(file));
  EXPECT_NEAR(last<Moment>().moment.z(), 30, 1e-12);
  EXPECT_EQ(last<Moment>().where, where);
}

TEST_F(Loads, ThePropertiesChangeTheKindAndKeepRegionAndDirection) {
  editor().select(Selection::ofPatches({2}));
  choose("Pressure");
  const modeling::Region where = std::get<modeling::Pressure>(project().loads.back().what).where;
  auto& kind = field<QComboBox>("kind");
  kind.setFocus();
  QTest::keyClick(&kind, Qt::Key_Down);
  QTest::keyClick(&field<QComboBox>("kind"), Qt::Key_Down);
  EXPECT_EQ(last<TotalForce>().where, where);
  enter(field<VectorEdit>("force").component(0), "2");
  enter(field<VectorEdit>("force").component(2), "0");
  QTest::keyClick(&field<QComboBox>("kind"), Qt::Key_Down);
  EXPECT_EQ(last<Moment>().where, where);
  EXPECT_NEAR(last<Moment>().moment.normalized().x(), 1, 1e-12);
  EXPECT_EQ(project().loads.back().name, "pressure 1");
}

TEST_F(Loads, GravityIsOneClickAndOneStep) {
  choose("Gravity");
  EXPECT_EQ(last<Gravity>().accelerationMPerS2, Eigen::Vector3d(0, 0, -Gravity::kStandard));
  EXPECT_EQ(detail("gravity 1"), "9.81 m/s²");
  const std::size_t count = project().loads.size();
  editor().select({});
  choose("Gravity");
  EXPECT_EQ(project().loads.size(), count) << "one weight is enough";
  EXPECT_EQ(editor().selection(), Selection::of(Selection::Kind::kLoad, "gravity 1"));
  enter(field<VectorEdit>("acceleration").component(0), "9810 mm/s2");
  enter(field<VectorEdit>("acceleration").component(2), "0");
  EXPECT_DOUBLE_EQ(last<Gravity>().accelerationMPerS2.x(), 9.81);
  QTest::mouseClick(&field<QPushButton>("earthGravity"), Qt::LeftButton);
  EXPECT_EQ(last<Gravity>(), Gravity());
  for (int i = 0; i < 4; ++i) editor().undo();
  EXPECT_EQ(text(), before_);
}

TEST_F(Loads, TheToolPlacesGravityByAButtonOrAClick) {
  action("Place load")->trigger();
  auto& kind = option<QComboBox>("loadKind");
  kind.setFocus();
  QTest::keyClick(&kind, Qt::Key_End);
  EXPECT_EQ(kind.currentText(), "Gravity");
  auto& add = option<QPushButton>("addGravity");
  ASSERT_TRUE(add.isVisible());
  enter(option<VectorEdit>("loadAcceleration").component(2), "-1.62");
  add.setFocus();
  QTest::keyClick(&add, Qt::Key_Space);
  EXPECT_DOUBLE_EQ(last<Gravity>().accelerationMPerS2.z(), -1.62);
  EXPECT_FALSE(add.isVisible());
  QTest::mouseClick(&option<QPushButton>("earthGravity"), Qt::LeftButton);
  EXPECT_EQ(last<Gravity>(), Gravity());
  keepPicture("loads-gravity-tool");
  editor().undo();
  editor().undo();
  EXPECT_EQ(text(), before_);
  QTest::mouseClick(&option<QPushButton>("earthGravity"), Qt::LeftButton);
  clickMiddle();
  EXPECT_EQ(last<Gravity>(), Gravity());
}

TEST_F(Loads, TheToolFollowsTheSelectedLoad) {
  action("Place load")->trigger();
  choose("Gravity");
  EXPECT_EQ(option<QComboBox>("loadKind").currentText(), "Gravity");
  editor().select(Selection::ofPatches({1}));
  choose("Moment");
  EXPECT_EQ(option<QComboBox>("loadKind").currentText(), "Moment");
  EXPECT_EQ(option<QComboBox>("placedLoad").currentText(), "moment 1");
  editor().select({});
  EXPECT_EQ(option<QComboBox>("placedLoad").currentText(), "New load");
}

TEST_F(Loads, EscapeLeavesNothingBehind) {
  for (const char* kind : {"Total force", "Moment", "Bump"}) {
    choose(kind);
    moveTo(middle());
    view().setFocus();
    QTest::keyClick(&view(), Qt::Key_Escape);
    EXPECT_EQ(text(), before_) << kind;
  }
  choose("Bump");
  QTest::mousePress(&view(), Qt::LeftButton, {}, middle());
  moveTo(middle() + QPoint(30, 0), Qt::LeftButton);
  QTest::keyClick(&view(), Qt::Key_Escape);
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, middle() + QPoint(30, 0));
  EXPECT_EQ(text(), before_);
}

TEST_F(Loads, ArrowsShowMomentsAsTurnsAndWeightsAtTheCentre) {
  editor().select(Selection::ofPatches({0}));
  choose("Moment");
  choose("Gravity");
  const modeling::Solid& solid = *editor().solid();
  const modeling::Tessellation tessellation(solid);
  const auto shape = tessellation.evaluate(solid.controlPoints());
  const ShownSurface surface{shape.positions, tessellation.triangles(),
                             tessellation.patchOfTriangle()};
  const auto arrows = loadArrows(project(), surface, {});
  ASSERT_EQ(arrows.size(), project().loads.size());
  EXPECT_EQ(arrows.end()[-2].kind, view::ForceArrow::Kind::kMoment);
  EXPECT_EQ(arrows.back().kind, view::ForceArrow::Kind::kWeight);
  EXPECT_LT(arrows.back().at.norm(), 0.01) << "the centre of the sphere";
  EXPECT_EQ(arrows.back().label, "gravity 1: 9.81 m/s²");
}

TEST_F(Loads, ArrowsFollowTheBodyInSimulateMode) {
  startWithoutDensity();
  modeling::Material material = project().material;
  material.densityKgPerM3 = 1000;
  editor().perform(modeling::SetMaterial{material});
  const modeling::Region top = modeling::Region::ofPatches({"top"});
  editor().perform(modeling::AddLoad{{"push", TotalForce{top, {0, 0, -0.5}}}});
  editor().perform(modeling::AddLoad{{"turn", Moment{top, {0, 0, 2}}}});
  editor().perform(modeling::AddLoad{{"weight", Gravity{}}});
  waitForModel();
  action("Simulate")->trigger();
  Simulation& simulation = window_->simulation();
  ASSERT_TRUE(QTest::qWaitFor([&] { return simulation.drawn() != nullptr; }, 20000));
  QTest::qWait(100);
  LoadMarks marks(editor(), window_->settings(), simulation);
  marks.find();
  const auto arrows = marks.arrows();
  ASSERT_EQ(arrows.size(), 3u);
  EXPECT_EQ(arrows[0].label, "push: 0.5 N");
  EXPECT_EQ(arrows[1].kind, view::ForceArrow::Kind::kMoment);
  EXPECT_EQ(arrows[2].kind, view::ForceArrow::Kind::kWeight);
  // A bar of 10 mm, 100 mm² and 0.15 MPa is 0.33 mm shorter; the fixed base makes it stiffer.
  const double sinks = 10 - arrows[0].at.z();
  EXPECT_GT(sinks, 0.1);
  EXPECT_LT(sinks, 0.34);
  EXPECT_LT(arrows[2].at.z(), 5) << "the weight sinks, too";
  EXPECT_GT(arrows[2].at.z(), 5 - sinks);
  action("× 10")->trigger();
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return std::abs(10 - marks.arrows()[0].at.z() - 10 * sinks) < 0.01 * sinks; }, 5000));
  action("× 1")->trigger();
  // The view shows them, and hides them with the supports.
  action("Plain")->trigger();
  action("Axes")->trigger();
  action("Grid")->trigger();
  const auto redPixels = [this] {
    QTest::qWait(500);  // until the fine picture is drawn
    const QImage image = view().grab().toImage();
    int count = 0;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) {
        const QColor pixel = image.pixelColor(x, y);
        count +=
            pixel.red() > 100 && pixel.red() > 2 * pixel.green() && pixel.red() > 2 * pixel.blue();
      }
    return count;
  };
  const int shown = redPixels();
  keepPicture("loads-in-simulate");
  action("Supports and loads")->trigger();
  const int hidden = redPixels();
  EXPECT_GT(shown, hidden + 500);
  action("Supports and loads")->trigger();
  // A moment is listed as one.
  const auto& forces = *window_->findChild<ForcesDock*>();
  ASSERT_EQ(forces.text(1, 0), "Load turn");
  EXPECT_EQ(forces.text(1, 1), "2 N mm");
  EXPECT_EQ(forces.details(1), "turns with: 0.000, 0.000, 2.000 N mm");
  action("Model")->trigger();
  EXPECT_GT(redPixels(), hidden + 500);
}

TEST_F(Loads, GravityWithoutDensityOffersTheRemedy) {
  startWithoutDensity();
  waitForModel();
  choose("Gravity");
  const auto buttons = remedies();
  ASSERT_EQ(buttons.size(), 2);
  EXPECT_TRUE(window_->messages().messages().join(' ').contains("has no density"));
  keepPicture("loads-no-density");
  EXPECT_EQ(buttons[1]->text(), "Enter density …");
  // Dragon Skin 10, with 0.152 MPa, is the nearest.
  EXPECT_EQ(buttons[0]->text(), "Use 1070 kg/m³");
  QTest::mouseClick(buttons[0], Qt::LeftButton);
  EXPECT_EQ(project().material.densityKgPerM3, 1070);
  EXPECT_EQ(project().material.name, "own");
  waitForModel();
  EXPECT_TRUE(window_->messages().messages().isEmpty());
  EXPECT_TRUE(QTest::qWaitFor([&] { return field<QLabel>("weight").text() == "0.01049 N"; }))
      << field<QLabel>("weight").text().toStdString();
  editor().undo();
  EXPECT_FALSE(project().material.densityKgPerM3);
  QTest::mouseClick(&field<QPushButton>("useDensity"), Qt::LeftButton);
  EXPECT_EQ(project().material.densityKgPerM3, 1070);
}

TEST_F(Loads, TheDensityIsEnteredFromTheMessage) {
  startWithoutDensity();
  choose("Gravity");
  const auto buttons = remedies();
  ASSERT_EQ(buttons.size(), 2);
  withDialog<MaterialDialog>([&] { QTest::mouseClick(buttons[1], Qt::LeftButton); },
                             [&](MaterialDialog& dialog) {
                               auto* density = dialog.findChild<QLineEdit*>("density");
                               EXPECT_EQ(dialog.focusWidget(), density);
                               QTest::keyClicks(density, "1.2 g/cm3");
                               QTest::keyClick(density, Qt::Key_Return);
                             });
  ASSERT_TRUE(project().material.densityKgPerM3);
  EXPECT_DOUBLE_EQ(*project().material.densityKgPerM3, 1200);
  waitForModel();
}

}  // namespace
}  // namespace palpa::gui

#include <QComboBox>
#include <QCursor>
#include <QDockWidget>
#include <QLineEdit>
#include <QMessageBox>
#include <QScrollArea>
#include <QScrollBar>
#include <QSpinBox>
#include <QTreeView>
#include <QWheelEvent>

#include "app/gui/widgets/vector_edit.h"
#include "modeling/project/project_file.h"
#include "tests/gui/window_fixture.h"

// The keys go where the user looks: to the view under the pointer, or to the field that was
// clicked.
namespace palpa::gui {
namespace {

class KeyboardFocus : public WindowTest {
 protected:
  KeyboardFocus() {
    EXPECT_TRUE(window_->openFile(kSphere));
    pointTo(*find<QDockWidget>("properties"));
  }

  /// Moves the real pointer to the middle of a widget.
  static void pointTo(QWidget& widget) {
    QCursor::setPos(widget.mapToGlobal(widget.rect().center()));
    EXPECT_TRUE(QTest::qWaitFor([&] { return widget.underMouse(); }, 2000));
    QTest::qWait(20);
  }

  /// Types as on a keyboard: shortcuts first, then the widget with the focus.
  void type(const QString& keys) {
    for (const QChar key : keys) press(static_cast<Qt::Key>(key.toUpper().unicode()), key);
  }
  void press(int key, const QString& text = {}, Qt::KeyboardModifiers modifiers = {}) {
    QTest::sendKeyEvent(QTest::Click, window_->windowHandle(), static_cast<Qt::Key>(key), text,
                        modifiers);
  }

  template <class T>
  T& click(const QString& name) {
    auto* field = find<T>(name);
    if (!field) throw std::runtime_error("no field " + name.toStdString());
    if constexpr (std::is_same_v<T, QComboBox>)
      field->setFocus();  // a click opens its list
    else
      QTest::mouseClick(field, Qt::LeftButton);
    EXPECT_TRUE(field->hasFocus());
    if constexpr (!std::is_same_v<T, QComboBox>) field->selectAll();
    return *field;
  }

  QString name() { return QString::fromStdString(editor().project().name); }
  double edgeLength() { return editor().project().mesh.edgeLength; }
};

TEST_F(KeyboardFocus, TheViewUnderThePointerReceivesTheKeys) {
  const int point = visiblePoint();
  const double z = editor().solid()->controlPoints()[point].z();
  click<QComboBox>("engine");
  editor().select(Selection::ofPoints({point}));
  find<VectorEdit>("position")->component(0).setFocus();
  pointTo(view());
  EXPECT_TRUE(view().hasFocus());
  type("gz5");
  press(Qt::Key_Return, "\r");
  EXPECT_NEAR(editor().solid()->controlPoints()[point].z(), z + 5, 1e-9);
  EXPECT_TRUE(action("Grid")->isChecked());
  EXPECT_FALSE(action("Wire")->isChecked());
  EXPECT_FALSE(view().viewport().camera().parallel);
}

TEST_F(KeyboardFocus, UnfinishedInputKeepsTheKeys) {
  click<QLineEdit>("edgeLength");
  type("7");
  pointTo(view());
  type(".5");
  press(Qt::Key_Return, "\r");
  EXPECT_EQ(edgeLength(), 7.5);
  EXPECT_TRUE(view().hasFocus());
}

TEST_F(KeyboardFocus, EnterAppliesAndReturnsTheKeys) {
  click<QLineEdit>("edgeLength");
  type("9");
  press(Qt::Key_Return, "\r");
  EXPECT_EQ(edgeLength(), 9);
  EXPECT_TRUE(view().hasFocus());
  click<QLineEdit>("name");
  type("cup");
  press(Qt::Key_Enter, "\r");
  EXPECT_EQ(name(), "cup");
  EXPECT_TRUE(view().hasFocus());
  click<QSpinBox>("refinementLevels");
  type("2");
  press(Qt::Key_Return, "\r");
  EXPECT_EQ(editor().project().mesh.refinementLevels, 2);
  EXPECT_TRUE(view().hasFocus());
  type("t");
  EXPECT_EQ(window_->tools().activeTitle(), "Place touch");
  EXPECT_EQ(name(), "cup");
}

TEST_F(KeyboardFocus, ARefusedEntryKeepsItsField) {
  auto& length = click<QLineEdit>("edgeLength");
  type("much");
  press(Qt::Key_Return, "\r");
  EXPECT_TRUE(length.hasFocus());
  press(Qt::Key_Escape);
  EXPECT_TRUE(view().hasFocus());
  EXPECT_NE(length.text(), "much");
  EXPECT_FALSE(length.property("refused").toBool());
  EXPECT_FALSE(editor().session().isModified());
}

TEST_F(KeyboardFocus, EscapeRestoresEveryKindOfField) {
  const QString name0 = name();
  auto& named = click<QLineEdit>("name");
  type("xyz");
  press(Qt::Key_Escape);
  EXPECT_EQ(named.text(), name0);
  EXPECT_TRUE(view().hasFocus());
  auto& length = click<QLineEdit>("edgeLength");
  const QString length0 = length.text();
  type("3");
  press(Qt::Key_Escape);
  EXPECT_EQ(length.text(), length0);
  EXPECT_TRUE(view().hasFocus());
  auto& levels = click<QSpinBox>("refinementLevels");
  type("4");
  press(Qt::Key_Escape);
  EXPECT_EQ(levels.text(), "0");
  EXPECT_TRUE(view().hasFocus());
  click<QComboBox>("engine");
  press(Qt::Key_Escape);
  EXPECT_TRUE(view().hasFocus());
  type("t");
  EXPECT_EQ(window_->tools().activeTitle(), "Place touch");
  EXPECT_FALSE(editor().session().isModified());
}

TEST_F(KeyboardFocus, AnotherProjectEndsTheInput) {
  click<QLineEdit>("edgeLength");
  type("9");
  press(Qt::Key_Return, "\r");
  click<QLineEdit>("edgeLength");
  type("8");
  // Opening without a question drops the input: it must not reach the new project.
  ASSERT_TRUE(window_->openFile(PALPA_PROJECTS "/box.json"));
  const std::string opened = text();
  EXPECT_TRUE(view().hasFocus());
  type("t");
  press(Qt::Key_Escape);
  EXPECT_EQ(window_->tools().activeTitle(), "Place touch");
  EXPECT_EQ(text(), opened);
  EXPECT_FALSE(editor().session().isModified());
}

TEST_F(KeyboardFocus, TheInputBelongsToTheProjectThatIsSaved) {
  const QString file = folder_.filePath("ball.json");
  ASSERT_TRUE(editor().saveAs(file));
  click<QLineEdit>("edgeLength");
  type("6.5");
  press(Qt::Key_S, {}, Qt::ControlModifier);
  EXPECT_EQ(modeling::readProject(file.toStdString()).mesh.edgeLength, 6.5);
  click<QLineEdit>("edgeLength");
  type("5.5");
  // The question before another project opens knows the edit.
  withDialog<QMessageBox>([&] { window_->files().mayDiscard(); },
                          [](QMessageBox& box) { box.button(QMessageBox::Save)->click(); });
  EXPECT_EQ(modeling::readProject(file.toStdString()).mesh.edgeLength, 5.5);
}

TEST_F(KeyboardFocus, ARenamingEndsWithItsProject) {
  editor().select(Selection::of(Selection::Kind::kSupport, "base"));
  auto* tree = find<QTreeView>("tree");
  tree->edit(tree->currentIndex().isValid() ? tree->currentIndex()
                                            : tree->selectionModel()->selectedIndexes().front());
  auto* edit = tree->findChild<QLineEdit*>();
  ASSERT_TRUE(edit);
  edit->setText("other");
  ASSERT_TRUE(window_->openFile(PALPA_PROJECTS "/box.json"));
  QTest::qWait(20);
  EXPECT_FALSE(editor().session().isModified());
  EXPECT_TRUE(view().hasFocus());
}

TEST_F(KeyboardFocus, NoFieldTakesTheKeysThatAnotherLost) {
  // The options of a tool disappear with their field.
  action("Paint support")->trigger();
  click<QComboBox>("paintWay");
  const std::string text0 = text();
  action("Select and move")->trigger();
  EXPECT_TRUE(view().hasFocus());
  // A panel is closed.
  click<QLineEdit>("name");
  find<QDockWidget>("properties")->close();
  EXPECT_TRUE(view().hasFocus());
  find<QDockWidget>("properties")->show();
  // The mode puts another panel in front.
  find<QTreeView>("tree")->setFocus();
  action("Simulate")->trigger();
  QTest::qWait(20);
  EXPECT_TRUE(view().hasFocus());
  EXPECT_EQ(text(), text0);
}

TEST_F(KeyboardFocus, EscapeInAPanelActsAsInTheView) {
  editor().select(Selection::of(Selection::Kind::kSupport, "base"));
  find<QTreeView>("tree")->setFocus();
  press(Qt::Key_Escape);
  EXPECT_TRUE(view().hasFocus());
  EXPECT_TRUE(editor().selection().empty());
}

TEST_F(KeyboardFocus, TheWheelScrollsOverFieldsWithoutFocus) {
  action("Paint support")->trigger();
  QTest::qWait(50);
  for (QWidget* box :
       std::initializer_list<QWidget*>{find<QComboBox>("paintWay"), find<QComboBox>("engine"),
                                       find<QSpinBox>("refinementLevels")}) {
    ASSERT_TRUE(box);
    const std::string before = text();
    const auto* combo = qobject_cast<QComboBox*>(box);
    const int index = combo ? combo->currentIndex() : 0;
    for (const int turn : {120, -120}) {
      QWheelEvent wheel(box->rect().center(), box->mapToGlobal(box->rect().center()), {},
                        QPoint(0, turn), Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
      QApplication::sendEvent(box, &wheel);
      EXPECT_FALSE(wheel.isAccepted() && box->hasFocus());
      EXPECT_FALSE(combo && combo->currentIndex() != index) << box->objectName().toStdString();
    }
    EXPECT_EQ(text(), before) << box->objectName().toStdString();
    EXPECT_EQ(box->focusPolicy(), Qt::StrongFocus) << box->objectName().toStdString();
  }
}

TEST_F(KeyboardFocus, ARowOfTheTreeShowsItsSettings) {
  auto* tree = find<QTreeView>("tree");
  auto* area = find<QDockWidget>("properties")->findChild<QScrollArea*>();
  for (const char* row : {"Mesh", "Material"}) {
    find<QDockWidget>("rebuild")->raise();
    QTest::qWait(20);
    ASSERT_TRUE(area->visibleRegion().isEmpty());
    const auto found = tree->model()->match(tree->model()->index(0, 0), Qt::DisplayRole, row, 1,
                                            Qt::MatchExactly | Qt::MatchRecursive);
    ASSERT_EQ(found.size(), 1);
    QTest::mouseClick(tree->viewport(), Qt::LeftButton, {},
                      tree->visualRect(found.front()).center());
    QTest::qWait(50);
    EXPECT_FALSE(area->visibleRegion().isEmpty()) << row;
    QLabel* heading = nullptr;
    for (QLabel* each : area->findChildren<QLabel*>("heading"))
      if (each->text() == row) heading = each;
    ASSERT_TRUE(heading);
    EXPECT_FALSE(heading->visibleRegion().isEmpty()) << row;
  }
}

TEST_F(KeyboardFocus, EscapeKeepsTheTool) {
  for (const char* tool : {"Rotate", "Paint support", "Place touch"}) {
    action(tool)->trigger();
    editor().select(Selection::of(Selection::Kind::kSupport, "base"));
    view().setFocus();
    press(Qt::Key_Escape);
    EXPECT_TRUE(editor().selection().empty()) << tool;
    press(Qt::Key_Escape);
    EXPECT_EQ(window_->tools().activeTitle(), tool);
  }
}

}  // namespace
}  // namespace palpa::gui

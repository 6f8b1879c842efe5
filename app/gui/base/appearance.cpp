#include "app/gui/base/appearance.h"

#include <QFile>
#include <QIconEngine>
#include <QPainter>
#include <QPalette>
#include <QPixmap>
#include <QStyle>
#include <QStyleFactory>
#include <QSvgRenderer>

namespace palpa::gui {
namespace {

Theme theme_ = Theme::kLight;

/// Text in `second` and `error` has a contrast of at least 4.5 with window and base; `faint` is the
/// colour of disabled items.
struct Colours {
  QColor window, base, alternate, text, second, faint, button, border, accent, onAccent, chosen,
      error;
};

Colours coloursOf(Theme theme) {
  if (theme == Theme::kDark)
    return {"#2b2f36", "#22252b", "#272b31", "#e3e6ea", "#a3aab4", "#8b929c",
            "#353a42", "#454b55", "#3d8fb5", "#ffffff", "#2c5468", "#ff8a75"};
  return {"#f3f4f6", "#ffffff", "#f7f8fa", "#22262c", "#5f6771", "#868d97",
          "#fafbfc", "#cfd4da", "#1f7a9e", "#ffffff", "#c9e1eb", "#b93a21"};
}

QPalette paletteOf(const Colours& c) {
  QPalette palette;
  palette.setColor(QPalette::Window, c.window);
  palette.setColor(QPalette::WindowText, c.text);
  palette.setColor(QPalette::Base, c.base);
  palette.setColor(QPalette::AlternateBase, c.alternate);
  palette.setColor(QPalette::Text, c.text);
  palette.setColor(QPalette::PlaceholderText, c.second);
  palette.setColor(QPalette::Button, c.button);
  palette.setColor(QPalette::ButtonText, c.text);
  palette.setColor(QPalette::BrightText, c.onAccent);
  palette.setColor(QPalette::Highlight, c.accent);
  palette.setColor(QPalette::HighlightedText, c.onAccent);
  palette.setColor(QPalette::Link, c.accent);
  palette.setColor(QPalette::ToolTipBase, c.base);
  palette.setColor(QPalette::ToolTipText, c.text);
  palette.setColor(QPalette::Light, c.window.lighter(112));
  palette.setColor(QPalette::Midlight, c.window.lighter(106));
  palette.setColor(QPalette::Mid, c.border);
  palette.setColor(QPalette::Dark, c.border.darker(130));
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
    palette.setColor(QPalette::Disabled, role, c.faint);
  palette.setColor(QPalette::Disabled, QPalette::Highlight, c.border);
  return palette;
}

/// Boxes that are not checked get a border, because the one of Fusion cannot be seen on dark
/// windows.
QString styleSheetOf(const Colours& c) {
  return QStringLiteral(R"(
QToolBar { background: %1; border: 0; border-bottom: 1px solid %2; spacing: 2px; padding: 3px 6px; }
QToolBar::separator { width: 1px; background: %2; margin: 4px 6px; }
QToolButton { border: 1px solid transparent; border-radius: 5px; padding: 4px; }
QToolButton:hover { background: %3; border-color: %2; }
QToolButton:checked, QToolButton:pressed { background: %6; border-color: %4; }
QDockWidget { font-weight: 600; }
QDockWidget::title { background: %1; padding: 6px 8px; border-bottom: 1px solid %2; }
QStatusBar { border-top: 1px solid %2; }
QStatusBar::item { border: 0; }
QMainWindow::separator { background: %2; width: 1px; height: 1px; }
QMainWindow::separator:hover { background: %4; }
QTreeView, QListView, QTableView { border: 0; }
QTreeView::item { padding: 2px 0; } QListWidget::item { padding: 5px 6px; }
QMenu { padding: 4px; } QMenu::item { padding: 5px 28px 5px 12px; border-radius: 4px; }
QMenu::item:selected { background: %6; color: %5; }
QMenu::item:disabled { color: %8; } QMenu::item:disabled:selected { background: transparent; }
QMenu::icon { padding: 3px; border: 1px solid transparent; border-radius: 4px; }
QMenu::icon:checked { background: %6; border-color: %4; }
QDialogButtonBox { dialogbuttonbox-buttons-have-icons: 0; }
QCheckBox::indicator:unchecked { width: 12px; height: 12px; border: 1px solid %8; border-radius: 2px;
  background: %9; }
QCheckBox::indicator:unchecked:disabled { border-color: %2; }
QFrame#rule { background: %2; border: 0; }
QLineEdit[refused="true"] { border: 1px solid %7; }
QLabel#refusal, QLabel#problem { color: %7; }
QToolTip { border: 1px solid %2; padding: 4px; }
)")
      .arg(c.window.name(), c.border.name(), c.button.name(), c.accent.name(), c.text.name(),
           c.chosen.name(), c.error.name(), c.faint.name(), c.base.name());
}

/// Draws an SVG in the palette's text colour instead of black.
class TintedIconEngine : public QIconEngine {
 public:
  explicit TintedIconEngine(QByteArray svg) : svg_(std::move(svg)) {}

  // Ignores the state: checked buttons, checked menu entries and open tree rows show it by their
  // background.
  void paint(QPainter* painter, const QRect& rectangle, QIcon::Mode mode,
             QIcon::State /*state*/) override {
    const Colours colours = coloursOf(theme_);
    QColor colour = colours.text;
    if (mode == QIcon::Disabled) colour = colours.faint;
    if (mode == QIcon::Selected) colour = colours.onAccent;
    QByteArray tinted = svg_;
    tinted.replace("#000", colour.name().toLatin1());
    QSvgRenderer(tinted).render(painter, rectangle);
  }

  QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
    QPixmap pixmap(size);
    if (pixmap.isNull()) return pixmap;  // of a button that a narrow panel leaves no room
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    paint(&painter, QRect(QPoint(), size), mode, state);
    return pixmap;
  }

  QIconEngine* clone() const override { return new TintedIconEngine(svg_); }

 private:
  QByteArray svg_;
};

}  // namespace

void applyTheme(QApplication& application, Theme theme) {
  theme_ = theme;
  const Colours colours = coloursOf(theme);
  application.setStyle(QStyleFactory::create("Fusion"));
  QApplication::setPalette(paletteOf(colours));
  application.setStyleSheet(styleSheetOf(colours));
}

Theme currentTheme() {
  return theme_;
}

view::ViewportTheme viewportTheme(Theme theme) {
  return theme == Theme::kDark ? view::ViewportTheme::dark() : view::ViewportTheme::light();
}

QIcon icon(const QString& name) {
  QFile file(":/icons/" + name + ".svg");
  const bool found = file.open(QIODevice::ReadOnly);
  Q_ASSERT_X(found, "icon", qPrintable(name));
  return found ? QIcon(new TintedIconEngine(file.readAll())) : QIcon();
}

}  // namespace palpa::gui

#pragma once

#include <QApplication>
#include <QIcon>
#include <QString>

#include "app/view/viewport_scene.h"

// How the window looks: one light and one dark theme, icons that follow them.
namespace palpa::gui {

enum class Theme { kLight, kDark };

/// Sets style, palette and style sheet of the whole application. May be called again at any time.
void applyTheme(QApplication& application, Theme theme);

/// The theme set last.
Theme currentTheme();

view::ViewportTheme viewportTheme(Theme theme);

/// An icon of resources/icons in the text colour of the theme, greyed when disabled. It follows
/// later changes of the theme.
QIcon icon(const QString& name);

}  // namespace palpa::gui

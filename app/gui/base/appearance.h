#pragma once

#include <QApplication>
#include <QIcon>
#include <QString>

#include "app/view/scene/theme.h"

// Appearance of the window: a light and a dark theme, icons in the colours of the theme.
namespace palpa::gui {

enum class Theme { kLight, kDark };

/// Sets style, palette and style sheet of the application, at any time.
void applyTheme(QApplication& application, Theme theme);

/// The theme of the last applyTheme().
Theme currentTheme();

view::ViewportTheme viewportTheme(Theme theme);

/// Icon of resources/icons in the text colour of the present theme, grey while disabled. It is
/// drawn again when the theme changes.
QIcon icon(const QString& name);

}  // namespace palpa::gui

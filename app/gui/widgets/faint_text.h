#pragma once

#include <QAbstractItemView>

namespace palpa::gui {

/// Role of items: true draws their text in the palette's colour of hints. Views need
/// drawFaintText(). A colour stored in the item would stay when the theme changes.
inline constexpr int kFaintTextRole = Qt::UserRole + 100;

/// Replaces the delegate of the view by one that knows kFaintTextRole.
void drawFaintText(QAbstractItemView& view);

}  // namespace palpa::gui

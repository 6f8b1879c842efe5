#pragma once

#include <QScrollArea>

namespace palpa::gui {

/// Scroll area for a column of rows: without a frame, as wide as its content, never sideways. Takes
/// ownership of the content.
QScrollArea* scrollColumn(QWidget* content, QWidget* parent);

}  // namespace palpa::gui

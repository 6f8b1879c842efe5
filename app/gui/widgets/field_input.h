#pragma once

#include <QWidget>

// Input of fields: line edits, number boxes, combo boxes.
namespace palpa::gui {

/// True for widgets whose input ends with Enter or Escape.
bool isField(const QWidget& widget);

/// True while a field contains input that was not applied.
bool hasUnfinishedInput(const QWidget& field);

/// Drops the input that was not applied: the field shows its value, or `former` if it stores no
/// value besides its text.
void dropInput(QWidget& field, const QString& former);

/// Applies the unfinished input of the focused field inside `window` and takes the focus from it.
/// Call before the project is saved or replaced.
void finishInput(QWidget& window);

}  // namespace palpa::gui

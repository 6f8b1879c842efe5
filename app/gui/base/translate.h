#pragma once

#include <QCoreApplication>

namespace palpa::gui {

/// Translation of a text of the window that belongs to no class with a tr() function.
inline QString tr(const char* text, const char* note = nullptr, int number = -1) {
  return QCoreApplication::translate("Palpa", text, note, number);
}

}  // namespace palpa::gui

#pragma once

#include <QObject>

#include "app/gui/workspace.h"

namespace palpa::gui {

/// The View menu: where one looks from and what is shown.
class ViewActions : public QObject {
  Q_OBJECT

 public:
  explicit ViewActions(const Workspace& workspace);

 private:
  Workspace workspace_;
};

}  // namespace palpa::gui

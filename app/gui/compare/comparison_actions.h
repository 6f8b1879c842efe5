#pragma once

#include <QObject>

#include "app/gui/compare/variant_comparison.h"
#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// Entries of the File menu that begin a comparison.
class ComparisonActions : public QObject {
  Q_OBJECT

 public:
  ComparisonActions(const Workspace& workspace, VariantComparison& comparison);

  /// Asks for a project file and compares with it.
  void chooseFile();
  /// Asks for a step of the history, or the saved version, and compares with the state before it.
  void chooseState();
  /// Compares with a project file. False if it cannot be read (Editor::refused has the reason) or
  /// the user cancelled; an earlier comparison then stays.
  bool compareWithFile(const QString& file);
  /// Compares with the state before the step of the history with this number, 1 or more.
  void compareWithStateBefore(std::size_t step);
  /// Reads the other variant's file again.
  void reload();

 Q_SIGNALS:
  /// A comparison has begun.
  void begun();

 private:
  void update();

  Workspace workspace_;
  VariantComparison& comparison_;
  QAction* withState_ = nullptr;
};

}  // namespace palpa::gui

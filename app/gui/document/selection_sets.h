#pragma once

#include <QObject>
#include <vector>

#include "app/gui/document/editor.h"
#include "app/gui/document/selection_set.h"

namespace palpa::gui {

/// The named selections of the open project, stored with its view (docs/decisions/028). Names are
/// unique.
class SelectionSets : public QObject {
  Q_OBJECT

 public:
  SelectionSets(Editor& editor, QObject* parent);

  QStringList names() const;
  /// True if the present selection can be named.
  bool canName() const;
  /// "selection 3": the first free name.
  QString freeName() const;
  /// Names the present selection; replaces the set that has the name.
  void put(const QString& name);
  /// Selects the set, or adds it to a selection of the same kind. Editor::said states that nothing
  /// is left of it.
  void choose(const QString& name, bool isAdded = false);
  /// False if the name is empty or in use.
  bool rename(const QString& from, const QString& to);
  void remove(const QString& name);

  /// "12 points", "3 patches", in the present body.
  QString contentOf(const QString& name) const;

 Q_SIGNALS:
  void changed();

 private:
  const SelectionSet* find(const QString& name) const;
  void read();
  void store();
  void followPatchNames();

  Editor& editor_;
  std::vector<SelectionSet> sets_;
  std::vector<std::string> patches_;  // names in the present body
};

}  // namespace palpa::gui

#pragma once

#include <QLineEdit>
#include <QTreeWidget>
#include <string>
#include <vector>

#include "app/gui/document/own_materials.h"

namespace palpa::gui {

/// List of the user's own materials and the materials of the library, with a filter above it. Own
/// materials can be renamed in the list (F2).
class MaterialList : public QWidget {
  Q_OBJECT

 public:
  MaterialList(const OwnMaterials& own, const Settings& settings, QWidget* parent);

  /// Fills the list again and selects the material of this name, if any. Emits no signal.
  void fill(const std::string& chosen);
  /// Selects the first entry with exactly this material; false if there is none.
  bool select(const modeling::Material& material);
  /// Shows the selected entry even if the filter hides it.
  void reveal();
  /// Lets the user type another name for the selected entry.
  void editName();

  /// The selected entry; null if there is none. Valid until fill().
  const modeling::LibraryMaterial* current() const { return entryOf(tree_->currentItem()); }

 Q_SIGNALS:
  /// The user selected an entry.
  void chosen(const palpa::modeling::LibraryMaterial& entry);
  void doubleClicked();
  /// The user typed another name, without spaces around it, for the own material `from`. The list
  /// must not be filled before the handler has returned: it still closes its editor.
  void renamed(const std::string& from, const QString& to);
  /// The user pressed Delete.
  void deletePressed();

 private:
  void filter(const QString& text);
  const modeling::LibraryMaterial* entryOf(const QTreeWidgetItem* item) const;

  const OwnMaterials& own_;
  const Settings& settings_;
  std::vector<modeling::LibraryMaterial> entries_;  // own ones, then the library
  QLineEdit* filter_;
  QTreeWidget* tree_;
  bool isFilling_ = false;
};

}  // namespace palpa::gui

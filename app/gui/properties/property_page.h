#pragma once

#include <Eigen/Core>
#include <QAction>
#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QSpinBox>
#include <QWidget>
#include <functional>
#include <vector>

#include "app/gui/widgets/quantity_edit.h"
#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// Lets a box be narrower than its longest choice.
void shrinkable(QComboBox& box);

/// Takes the underlined letters from labels and buttons: with Alt, letters open the menus, and a
/// letter that a panel has, too, would open nothing.
void leaveLettersToMenus(QWidget& panel);

/// A form with the properties of what is selected. Pages add their rows when they are made, each
/// with how to read and how to write its value; the page keeps the fields in step with the project.
///
/// Writing is one command; what the editor refuses is said below the field, and the field shows the
/// old value again.
class PropertyPage : public QWidget {
  Q_OBJECT

 public:
  template <class Value>
  using Get = std::function<Value()>;
  /// False when the editor refused.
  template <class Value>
  using Set = std::function<bool(const Value&)>;

  explicit PropertyPage(const Workspace& workspace);

  /// Shows the present values; what is being typed stays. Cheap: for every frame of a drag.
  void refresh();
  /// Also what takes milliseconds to compute: areas, numbers of nodes.
  void refreshSlowValues();
  /// Drops what was typed and not entered, and what was refused: something else is selected now.
  void forgetTyping();
  /// Nothing that happens to the fields has an effect any more: the page is about to go.
  void retire();

  void addSection(const QString& title);
  QuantityEdit* addQuantity(const QString& label, const QString& name, Quantity quantity,
                            Get<double> get, Set<double> set);
  void addVector(const QString& label, const QString& name, Quantity quantity,
                 Get<Eigen::Vector3d> get, Set<Eigen::Vector3d> set);
  void addText(const QString& label, const QString& name, Get<QString> get, Set<QString> set);
  QSpinBox* addCount(const QString& label, const QString& name, int least, int most, Get<int> get,
                     Set<int> set);
  void addChoice(const QString& label, const QString& name, const QStringList& choices,
                 Get<int> get, Set<int> set);
  void addCheck(const QString& text, const QString& name, Get<bool> get, Set<bool> set);
  /// Something to read only.
  void addFact(const QString& label, const QString& name, Get<QString> get);
  /// The same when it takes milliseconds.
  void addSlowFact(const QString& label, const QString& name, Get<QString> get);
  void addNote(const QString& text);
  /// A row of any kind over the full width.
  void addWidget(QWidget* widget) { form_->addRow(widget); }
  void addButton(const QString& text, const QString& name, const QString& picture,
                 std::function<void()> work);
  /// Does `work` for a field of the page; what is refused is said at the field.
  bool attempt(QWidget* field, const std::function<bool()>& work);

  const Workspace& workspace() const { return workspace_; }
  Editor& editor() const;
  QString shownLength(double length) const;

 private:
  void addField(const QString& label, const QString& name, QWidget* field, bool isWide = false);
  QLabel* makeFact(const QString& label, const QString& name);
  template <class Value>
  void set(QWidget* field, const Set<Value>& set, const Value& value);

  Workspace workspace_;
  QFormLayout* form_;
  std::vector<std::function<void()>> shows_;
  std::vector<std::function<void()>> slowShows_;
  bool isRetired_ = false;
};

}  // namespace palpa::gui

#pragma once

#include <Eigen/Core>
#include <QAction>
#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QSpinBox>
#include <QWidget>
#include <functional>
#include <memory>
#include <vector>

#include "app/gui/widgets/quantity_edit.h"
#include "app/gui/workspace/workspace.h"
#include "base/job.h"
#include "base/worker_thread.h"

namespace palpa::gui {

class VectorEdit;

/// Allows a box to be narrower than its longest choice.
void shrinkable(QComboBox& box);

/// Removes the underlined letters of labels and buttons: a letter that a menu has, too, would be
/// ambiguous with Alt.
void leaveLettersToMenus(QWidget& panel);

/// Form with the properties of the selection. Each row has functions to read and write its value;
/// the page updates the fields from the project.
///
/// Writing is one command. If the editor refuses it, the message appears below the field, and the
/// field shows the old value again.
class PropertyPage : public QWidget {
  Q_OBJECT

 public:
  template <class Value>
  using Get = std::function<Value()>;
  /// False if the editor refused.
  template <class Value>
  using Set = std::function<bool(const Value&)>;

  explicit PropertyPage(const Workspace& workspace);

  /// Shows the present values and keeps unfinished input. Fast enough for every frame of a drag.
  void refresh();
  /// Shows values that take milliseconds to compute: areas, numbers of nodes.
  void refreshSlowValues();
  /// Drops unfinished input and messages, after a change of the selection.
  void forgetTyping();
  /// Disconnects the fields before the page is removed.
  void retire();

  /// `name` identifies the section for PropertiesDock::showSection().
  void addSection(const QString& title, const QString& name = {});
  QuantityEdit* addQuantity(const QString& label, const QString& name, Quantity quantity,
                            Get<double> get, Set<double> set);
  VectorEdit* addVector(const QString& label, const QString& name, Quantity quantity,
                        Get<Eigen::Vector3d> get, Set<Eigen::Vector3d> set);
  void addText(const QString& label, const QString& name, Get<QString> get, Set<QString> set);
  QSpinBox* addCount(const QString& label, const QString& name, int least, int most, Get<int> get,
                     Set<int> set);
  QComboBox* addChoice(const QString& label, const QString& name, const QStringList& choices,
                       Get<int> get, Set<int> set);
  void addCheck(const QString& text, const QString& name, Get<bool> get, Set<bool> set);
  /// Tool tip of a row: shown at the label and the field.
  void explain(QWidget* field, const QString& tip);
  /// Adds a read-only value.
  QLabel* addFact(const QString& label, const QString& name, Get<QString> get);
  /// The same for a value that takes milliseconds.
  void addSlowFact(const QString& label, const QString& name, Get<QString> get);
  /// Computes a value. Throws Cancelled.
  using Work = std::function<QString(const Job&)>;
  /// The same for a value that may take seconds: `prepare` copies what the work needs, which runs
  /// on a separate thread. "…" is shown while it takes long.
  void addComputedFact(const QString& label, const QString& name, std::function<Work()> prepare);
  void addNote(const QString& text);
  /// Adds a widget over the full width.
  void addWidget(QWidget* widget) { form_->addRow(widget); }
  void addButton(const QString& text, const QString& name, const QString& picture,
                 std::function<void()> work);
  /// Calls `work` for a field of the page and shows a refusal below the field.
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
  std::vector<std::unique_ptr<WorkerThread>> workers_;  // last: their tasks use the labels
};

}  // namespace palpa::gui

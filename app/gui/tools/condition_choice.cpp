#include "app/gui/tools/condition_choice.h"

#include <QSignalBlocker>

namespace palpa::gui {

ConditionChoice::ConditionChoice(Editor& editor, Selection::Kind kind, const QString& fresh,
                                 QWidget* parent)
    : QComboBox(parent), editor_(editor), kind_(kind), fresh_(fresh) {
  connect(this, &QComboBox::activated, this, [this](int index) {
    editor_.select(index == 0 ? Selection{} : Selection::of(kind_, itemText(index).toStdString()));
  });
}

void ConditionChoice::refresh(std::optional<std::size_t> alternative) {
  const QSignalBlocker quiet(this);
  clear();
  addItem(fresh_);
  if (kind_ == Selection::Kind::kSupport) {
    for (const auto& support : editor_.project().supports)
      addItem(QString::fromStdString(support.name));
  } else {
    for (const auto& load : editor_.project().loads)
      if (!alternative || load.what.index() == *alternative)
        addItem(QString::fromStdString(load.name));
  }
  const auto& named = editor_.selection().named;
  int chosen = 0;
  if (named && named->kind == kind_)
    for (int i = 1; i < count(); ++i)
      if (itemText(i).toStdString() == named->name) chosen = i;
  setCurrentIndex(chosen);
}

}  // namespace palpa::gui

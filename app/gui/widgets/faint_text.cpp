#include "app/gui/widgets/faint_text.h"

#include <QStyledItemDelegate>

namespace palpa::gui {
namespace {

class FaintTextDelegate : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

 protected:
  void initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const override {
    QStyledItemDelegate::initStyleOption(option, index);
    if (index.data(kFaintTextRole).toBool())
      option->palette.setBrush(QPalette::Text, option->palette.placeholderText());
  }
};

}  // namespace

void drawFaintText(QAbstractItemView& view) {
  view.setItemDelegate(new FaintTextDelegate(&view));
}

}  // namespace palpa::gui

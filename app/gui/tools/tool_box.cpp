#include "app/gui/tools/tool_box.h"

namespace palpa::gui {

ToolBox::ToolBox(Menus& menus, ViewportWidget& widget)
    : menus_(menus), widget_(widget), group_(this) {
  connect(&widget, &ViewportWidget::escaped, this, [this] {
    if (!entries_.empty()) activate(entries_.front().tool.get());
  });
}

ToolBox::~ToolBox() {
  widget_.setTool(nullptr);
}

Tool* ToolBox::add(std::unique_ptr<Tool> tool, QMenu* menu, const Menus::Item& item) {
  Tool* added = tool.get();
  QAction* action = menus_.add(menu, item, this, [this, added] { activate(added); });
  action->setCheckable(true);
  group_.addAction(action);
  menus_.tools->addAction(action);
  connect(added, &Tool::changed, this, [this, added] {
    if (added == active_) Q_EMIT changed();
  });
  entries_.push_back({std::move(tool), action});
  if (!active_) activate(added);
  return added;
}

QString ToolBox::activeTitle() const {
  for (const Entry& entry : entries_)
    if (entry.tool.get() == active_) return entry.action->objectName();
  return {};
}

void ToolBox::activate(Tool* tool) {
  for (const Entry& entry : entries_)
    if (entry.tool.get() == tool) entry.action->setChecked(true);
  if (tool == active_) return;
  if (active_) active_->deactivate();
  active_ = tool;
  widget_.setTool(tool);
  tool->activate();
  Q_EMIT changed();
}

}  // namespace palpa::gui

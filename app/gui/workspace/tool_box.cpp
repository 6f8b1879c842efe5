#include "app/gui/workspace/tool_box.h"

#include <algorithm>

namespace palpa::gui {

ToolBox::ToolBox(Menus& menus, ViewportWidget& widget)
    : menus_(menus), widget_(widget), group_(this) {
  connect(&widget, &ViewportWidget::keyUnused, this, &ToolBox::explain);
}

ToolBox::~ToolBox() {
  widget_.setTool(nullptr);
}

Tool* ToolBox::add(std::unique_ptr<Tool> tool, QMenu* menu, const Menus::Item& item, Mode mode) {
  Tool* added = tool.get();
  QAction* action = menus_.add(menu, item, this, [this, added] { activate(added); });
  action->setCheckable(true);
  group_.addAction(action);
  menus_.tools->addAction(action);
  connect(added, &Tool::changed, this, [this, added] {
    if (added == active_) Q_EMIT changed();
  });
  entries_.push_back({std::move(tool), action, mode});
  action->setVisible(mode == mode_);
  Tool*& last = last_[static_cast<std::size_t>(mode)];
  if (!last) last = added;
  if (!active_ && mode == mode_) activate(added);
  return added;
}

void ToolBox::setMode(Mode mode) {
  if (mode == mode_) return;
  last_[static_cast<std::size_t>(mode_)] = active_;
  mode_ = mode;
  for (const Entry& entry : entries_) entry.action->setVisible(entry.mode == mode);
  activate(last_[static_cast<std::size_t>(mode)]);
}

QString ToolBox::activeTitle() const {
  for (const Entry& entry : entries_)
    if (entry.tool.get() == active_) return entry.action->objectName();
  return {};
}

QString ToolBox::activeTopic() const {
  for (const Entry& entry : entries_)
    if (entry.tool.get() == active_)
      return QStringLiteral("%1 (%2)").arg(activeTitle(), entry.action->shortcut().toString());
  return {};
}

std::vector<KeyHelp> ToolBox::keyHelp() const {
  std::vector<KeyHelp> groups;
  for (const Entry& entry : entries_) {
    const KeyHelp help = entry.tool->keyHelp();
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const KeyHelp& each) { return each.title == help.title; });
    if (group == groups.end()) group = groups.insert(group, {help.title, {}});
    for (const KeyHelp::Row& row : help.rows)
      if (std::find(group->rows.begin(), group->rows.end(), row) == group->rows.end())
        group->rows.push_back(row);
  }
  return groups;
}

/// A key without effect would leave the user of the wrong mode without a hint.
void ToolBox::explain(int key) {
  for (const Entry& entry : entries_)
    if (entry.mode != mode_ && entry.action->shortcut() == QKeySequence(key)) {
      const QString name = entry.action->objectName();
      Q_EMIT explained(
          entry.mode == Mode::kSimulate
              ? tr("%1 is a tool of Simulate mode: change to it with F5").arg(name)
              : tr("%1 is a tool of Model mode: change to it with Shift+F5").arg(name));
      return;
    }
}

void ToolBox::restart() {
  if (!active_) return;
  active_->deactivate();
  active_->activate();
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

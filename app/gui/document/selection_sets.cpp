#include "app/gui/document/selection_sets.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <algorithm>

namespace palpa::gui {
namespace {

constexpr const char* kKey = "selections";  // in the object of the view

QJsonObject viewObject(const Editor& editor) {
  return QJsonDocument::fromJson(QByteArray::fromStdString(editor.project().view)).object();
}

}  // namespace

SelectionSets::SelectionSets(Editor& editor, QObject* parent) : QObject(parent), editor_(editor) {
  connect(&editor, &Editor::projectReplaced, this, &SelectionSets::read);
  connect(&editor, &Editor::projectChanged, this, [this](const modeling::Change& change) {
    if (change.patchNames) followPatchNames();
    if (change.topology) patches_ = modeling::patchNames(editor_.project().body);
  });
  read();
}

void SelectionSets::read() {
  sets_.clear();
  for (const QJsonValue& value : viewObject(editor_)[kKey].toArray())
    if (const auto set = selectionSetFromJson(value.toObject());
        set && !find(QString::fromStdString(set->name)))
      sets_.push_back(*set);
  patches_ = modeling::patchNames(editor_.project().body);
  Q_EMIT changed();
}

void SelectionSets::store() {
  QJsonObject view = viewObject(editor_);
  QJsonArray array;
  for (const SelectionSet& set : sets_) array.append(toJson(set));
  if (array.isEmpty())
    view.remove(kKey);
  else
    view[kKey] = array;
  editor_.editView(QJsonDocument(view).toJson(QJsonDocument::Compact).toStdString());
  Q_EMIT changed();
}

void SelectionSets::followPatchNames() {
  const std::vector<std::string> now = modeling::patchNames(editor_.project().body);
  if (now.size() != patches_.size()) return;
  const std::vector<SelectionSet> before = sets_;
  for (std::size_t i = 0; i < now.size(); ++i)
    if (now[i] != patches_[i])
      for (SelectionSet& set : sets_) renamePatchIn(set, patches_[i], now[i]);
  patches_ = now;
  if (sets_ != before) store();
}

const SelectionSet* SelectionSets::find(const QString& name) const {
  const auto found = std::find_if(sets_.begin(), sets_.end(), [&](const SelectionSet& set) {
    return set.name == name.toStdString();
  });
  return found == sets_.end() ? nullptr : &*found;
}

QStringList SelectionSets::names() const {
  QStringList names;
  for (const SelectionSet& set : sets_) names << QString::fromStdString(set.name);
  return names;
}

bool SelectionSets::canName() const {
  const Selection& now = editor_.selection();
  return !now.points.empty() || !now.patches.empty() || !now.edges.empty();
}

QString SelectionSets::freeName() const {
  for (int i = 1;; ++i)
    if (const QString name = tr("selection %1").arg(i); !find(name)) return name;
}

void SelectionSets::put(const QString& name) {
  if (!canName() || name.trimmed().isEmpty()) return;
  SelectionSet set =
      makeSet(name.trimmed().toStdString(), editor_.selection(), editor_.project().body);
  if (const SelectionSet* old = find(name.trimmed()))
    sets_[old - sets_.data()] = std::move(set);
  else
    sets_.push_back(std::move(set));
  store();
}

void SelectionSets::choose(const QString& name, bool isAdded) {
  const SelectionSet* set = find(name);
  if (!set) return;
  Selection selection = selectionOf(*set, editor_.project().body);
  if (selection.empty()) {
    Q_EMIT editor_.said(
        tr("Nothing is left of the selection \"%1\": the body has changed").arg(name));
    return;
  }
  if (isAdded) {
    const Selection& now = editor_.selection();
    if (!selection.points.empty()) selection.points.insert(now.points.begin(), now.points.end());
    if (!selection.patches.empty())
      selection.patches.insert(now.patches.begin(), now.patches.end());
    if (!selection.edges.empty()) selection.edges.insert(now.edges.begin(), now.edges.end());
  }
  editor_.select(std::move(selection));
}

bool SelectionSets::rename(const QString& from, const QString& to) {
  const SelectionSet* set = find(from);
  if (!set || to.trimmed().isEmpty()) return false;
  if (to.trimmed() == from) return true;
  if (find(to.trimmed())) return false;
  sets_[set - sets_.data()].name = to.trimmed().toStdString();
  store();
  return true;
}

void SelectionSets::remove(const QString& name) {
  if (std::erase_if(sets_, [&](const SelectionSet& set) { return set.name == name.toStdString(); }))
    store();
}

QString SelectionSets::contentOf(const QString& name) const {
  const SelectionSet* set = find(name);
  if (!set) return {};
  const Selection selection = selectionOf(*set, editor_.project().body);
  const auto counted = [](std::size_t count, const QString& one, const QString& many) {
    return QStringLiteral("%1 %2").arg(count).arg(count == 1 ? one : many);
  };
  if (!selection.points.empty()) return counted(selection.points.size(), tr("point"), tr("points"));
  if (!selection.patches.empty())
    return counted(selection.patches.size(), tr("patch"), tr("patches"));
  if (!selection.edges.empty()) return counted(selection.edges.size(), tr("edge"), tr("edges"));
  return tr("empty");
}

}  // namespace palpa::gui

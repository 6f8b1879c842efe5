
#include "app/gui/base/translate.h"
#include "app/gui/document/editor.h"
#include "app/gui/properties/pages.h"
#include "modeling/solid/edge_curve.h"

namespace palpa::gui {
namespace {

QString sideText(const modeling::Solid& solid, const modeling::PatchEdge& use) {
  const std::string_view side = modeling::sideName(use.side);
  return tr("%1 (%2)").arg(QString::fromStdString(solid.patches()[use.patch].name),
                           QString::fromUtf8(side.data(), static_cast<qsizetype>(side.size())));
}

QString joinedText(const Editor& editor) {
  QStringList texts;
  for (int index : editor.selection().edges) {
    if (texts.size() == 12) {  // no room for more
      texts.push_back(tr("and %1 more").arg(editor.selection().edges.size() - 12));
      break;
    }
    const modeling::SolidEdge& edge = editor.solid()->edges()[index];
    texts.push_back(sideText(*editor.solid(), edge.uses[0]) + " – " +
                    sideText(*editor.solid(), edge.uses[1]));
  }
  return texts.join('\n');
}

double lengthOf(const Editor& editor) {
  const modeling::Solid& solid = *editor.solid();
  double length = 0.0;
  for (int index : editor.selection().edges) {
    const modeling::PatchEdge& use = solid.edges()[index].uses[0];
    const modeling::SurfaceEvaluator patch(solid.controlPoints(), {solid.patches()[use.patch]});
    const int along = modeling::directionOf(use.side);
    const bool isFirst = use.side == modeling::Side::kVMin || use.side == modeling::Side::kUMin;
    const double fixed = patch.range(0, 1 - along)[isFirst ? 0 : 1];
    length += modeling::IsoCurve(patch, 0, along, fixed).length();
  }
  return length;
}

/// 0: sharp, 1: smooth, -1: both.
int kindOf(const Editor& editor) {
  std::set<bool> kinds;
  for (int index : editor.selection().edges) kinds.insert(editor.solid()->edges()[index].smooth);
  return kinds.size() == 1 ? static_cast<int>(*kinds.begin()) : -1;
}

bool makeSmooth(Editor& editor, bool smooth) {
  const std::set<int> edges = editor.selection().edges;
  editor.beginGroup(smooth ? tr("Make edges smooth") : tr("Make edges sharp"));
  for (int index : edges) {
    const modeling::PatchEdge use = editor.solid()->edges()[index].uses[0];
    const std::string patch = editor.solid()->patches()[use.patch].name;
    if (!editor.perform(modeling::SetEdge{patch, use.side, smooth})) {
      editor.cancelGroup();
      return false;
    }
  }
  editor.endGroup();
  return true;
}

}  // namespace

void addEdgeRows(PropertyPage& page) {
  Editor& editor = page.editor();
  const bool isOne = editor.selection().edges.size() == 1;
  page.addSection(isOne ? tr("Edge") : tr("Edges"));
  if (!isOne)
    page.addFact(tr("Selected"), "count",
                 [&editor] { return QString::number(editor.selection().edges.size()); });
  page.addChoice(
      tr("&Kind"), "kind", {tr("Sharp"), tr("Smooth")}, [&editor] { return kindOf(editor); },
      [&editor](int kind) { return makeSmooth(editor, kind == 1); });
  page.addFact(isOne ? tr("Joins") : tr("Join"), "joins", [&editor] { return joinedText(editor); });
  page.addSlowFact(tr("Length"), "length",
                   [&page] { return page.shownLength(lengthOf(page.editor())); });
  page.addNote(
      tr("Editing keeps the surface smooth across a smooth edge. Making an edge smooth "
         "moves the control points beside it."));
}

}  // namespace palpa::gui

#include "app/gui/actions/solid_actions.h"

#include <algorithm>

#include "app/gui/dialogs/transform_dialog.h"
#include "app/gui/document/editor.h"
#include "app/gui/workspace/menus.h"

namespace palpa::gui {
namespace {

constexpr int kMaxDegree = 5;

}  // namespace

SolidActions::SolidActions(const Workspace& workspace)
    : QObject(&workspace.window), workspace_(workspace) {
  Menus& menus = workspace_.menus;
  menus.solid->addSeparator();
  elevateU_ = menus.add(menus.solid,
                        {"elevate-degree",
                         tr("Elevate degree in &u"),
                         {},
                         tr("Raise the degree of the selected patches along u by one; the shape "
                            "stays")},
                        this, [this] { elevate(0); });
  elevateV_ = menus.add(menus.solid,
                        {"elevate-degree",
                         tr("Elevate degree in &v"),
                         {},
                         tr("Raise the degree of the selected patches along v by one; the shape "
                            "stays")},
                        this, [this] { elevate(1); });
  menus.solid->addSeparator();
  smooth_ = menus.add(menus.solid,
                      {"smooth-edge",
                       tr("S&mooth edges"),
                       {},
                       tr("Make the surface smooth across the selected edges and keep it so")},
                      this, [this] { setEdges(true); });
  sharp_ = menus.add(menus.solid,
                     {"edge", tr("S&harp edges"), {}, tr("Allow a crease at the selected edges")},
                     this, [this] { setEdges(false); });
  menus.solid->addSeparator();
  menus.add(menus.solid,
            {"move",
             tr("&Transform solid …"),
             {},
             tr("Move, rotate, scale or mirror the whole body by numbers")},
            this, [this] { transform(); });
  const Editor* editor = &workspace_.editor;
  connect(editor, &Editor::selectionChanged, this, &SolidActions::update);
  connect(editor, &Editor::projectChanged, this, &SolidActions::update);
  connect(editor, &Editor::projectReplaced, this, &SolidActions::update);
  update();
}

void SolidActions::update() {
  const modeling::Solid* solid = workspace_.editor.solid();
  const Selection& selection = workspace_.editor.selection();
  const QString mesh = tr("Not for a mesh body: it has no patches with degrees and edges.");
  for (int direction : {0, 1}) {
    QString obstacle;
    if (!solid)
      obstacle = mesh;
    else if (selection.patches.empty())
      obstacle = tr("Select the patches whose degree is to be raised first.");
    else if (std::all_of(selection.patches.begin(), selection.patches.end(), [&](int patch) {
               return solid->patches()[patch].degree[direction] >= kMaxDegree;
             }))
      obstacle = tr("The selected patches have the highest degree, %1.").arg(kMaxDegree);
    setPossible(direction == 0 ? elevateU_ : elevateV_, obstacle);
  }
  for (bool smooth : {true, false}) {
    QString obstacle;
    if (!solid)
      obstacle = mesh;
    else if (selection.edges.empty())
      obstacle = tr("Select edges first.");
    else if (std::all_of(selection.edges.begin(), selection.edges.end(),
                         [&](int edge) { return solid->edges()[edge].smooth == smooth; }))
      obstacle = smooth ? tr("The selected edges are smooth already.")
                        : tr("The selected edges are sharp already.");
    setPossible(smooth ? smooth_ : sharp_, obstacle);
  }
}

void SolidActions::elevate(int direction) {
  Editor& editor = workspace_.editor;
  const std::set<int> patches = editor.selection().patches;
  std::vector<int> degrees;
  for (int patch : patches)
    degrees.push_back(std::min(editor.solid()->patches()[patch].degree[direction] + 1, kMaxDegree));
  editor.beginGroup(tr("Elevate degree"));
  auto degree = degrees.begin();
  for (int patch : patches) {
    // A neighbour of a raised patch may have been raised with it.
    const modeling::Patch& now = editor.solid()->patches()[patch];
    const int wanted = *degree++;
    if (now.degree[direction] >= wanted) continue;
    if (!editor.perform(modeling::ElevateDegree{now.name, direction, wanted})) {
      editor.cancelGroup();
      return;
    }
  }
  editor.endGroup();
  editor.select(Selection::ofPatches(patches));
}

void SolidActions::setEdges(bool smooth) {
  Editor& editor = workspace_.editor;
  const std::set<int> edges = editor.selection().edges;
  editor.beginGroup(smooth ? tr("Smooth edges") : tr("Sharp edges"));
  for (int edge : edges) {
    const modeling::SolidEdge& now = editor.solid()->edges()[edge];
    if (now.smooth == smooth) continue;
    const modeling::PatchEdge& use = now.uses[0];
    const std::string patch = editor.solid()->patches()[use.patch].name;
    if (!editor.perform(modeling::SetEdge{patch, use.side, smooth})) {
      editor.cancelGroup();
      return;
    }
  }
  editor.endGroup();
  editor.select(Selection::ofEdges(edges));
}

void SolidActions::transform() {
  TransformDialog dialog(workspace_.editor, workspace_.settings, &workspace_.window);
  dialog.exec();
}

}  // namespace palpa::gui

#include "app/gui/actions/proposal_actions.h"

#include "app/core/setup/project_geometry.h"
#include "app/gui/document/editor.h"
#include "app/gui/document/named_items.h"
#include "app/gui/workspace/menus.h"
#include "modeling/error.h"
#include "modeling/project/proposed_support.h"
#include "modeling/project/touch_place.h"

namespace palpa::gui {
namespace {

constexpr double kDepthShare = 0.01;  // of the body's size

}  // namespace

ProposalActions::ProposalActions(const Workspace& workspace)
    : QObject(&workspace.window), workspace_(workspace) {
  Menus& menus = workspace_.menus;
  menus.conditions->addSeparator();
  support_ = menus.add(menus.conditions,
                       {"paint-support",
                        tr("&Propose a support"),
                        {},
                        tr("Hold the selected faces, or, if none is selected, the largest flat "
                           "face")},
                       this, [this] { addSupport(); });
  touch_ = menus.add(menus.conditions,
                     {"place-touch",
                      tr("Propose a t&ouch"),
                      {},
                      tr("Press the place opposite to the supports by 1 % of the body's size")},
                     this, [this] { addTouch(); });
  const Editor* editor = &workspace_.editor;
  connect(editor, &Editor::projectChanged, this, &ProposalActions::update);
  connect(editor, &Editor::projectReplaced, this, &ProposalActions::update);
  update();
}

void ProposalActions::update() {
  const bool isHeld = !workspace_.editor.project().supports.empty();
  setPossible(touch_, isHeld ? QString() : tr("Add a support first."));
}

void ProposalActions::addSupport() {
  Editor& editor = workspace_.editor;
  const modeling::Project& project = editor.project();
  modeling::Support support;
  if (editor.selection().patches.empty()) {
    support = modeling::proposeSupport(project.body).support;
  } else {
    std::vector<std::string> faces;
    const std::vector<std::string> names = modeling::patchNames(project.body);
    for (const int patch : editor.selection().patches) faces.push_back(names[patch]);
    support.where = modeling::Region::ofPatches(std::move(faces));
    support.name = "base";
  }
  if (findNamed(project.supports, support.name))
    support.name = freeName(support.name, project.supports);
  if (editor.perform(modeling::AddSupport{support}))
    editor.select(Selection::of(Selection::Kind::kSupport, support.name));
}

void ProposalActions::addTouch() {
  Editor& editor = workspace_.editor;
  const modeling::Project& project = editor.project();
  const auto [low, high] = modeling::boundingBox(project.body);
  const double size = (high - low).norm();
  modeling::Touch touch;
  try {
    const modeling::TouchPlace place = modeling::placeOppositeToSupports(
        project.body, project.supports, app::radiusOfFirstTouch(size));
    touch.at = place.position;
    touch.vector = -kDepthShare * size * place.normal;
    touch.radius = place.radius;
  } catch (const modeling::ModelingError& error) {
    Q_EMIT editor.refused(QString::fromStdString(error.what()));
    return;
  }
  touch.name = freeName(tr("touch").toStdString(), project.touches);
  if (editor.perform(modeling::AddTouch{touch}))
    editor.select(Selection::of(Selection::Kind::kTouch, touch.name));
}

}  // namespace palpa::gui

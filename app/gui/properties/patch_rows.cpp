
#include "app/gui/base/measures.h"
#include "app/gui/base/translate.h"
#include "app/gui/document/editor.h"
#include "app/gui/document/naming.h"
#include "app/gui/document/point_groups.h"
#include "app/gui/properties/pages.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::gui {
namespace {

const std::set<int>& chosenPatches(const Editor& editor) {
  return editor.selection().patches;
}

/// The selected patch; null for faces of a mesh body.
const modeling::Patch* patchOf(const Editor& editor) {
  if (!editor.solid() || chosenPatches(editor).empty()) return nullptr;
  return &editor.solid()->patches()[*chosenPatches(editor).begin()];
}

std::vector<std::string> namesOf(const Editor& editor) {
  const std::vector<std::string> all = modeling::patchNames(editor.project().body);
  std::vector<std::string> names;
  for (int patch : chosenPatches(editor)) names.push_back(all[patch]);
  return names;
}

double factorOf(const Editor& editor) {
  const auto& factors = editor.project().mesh.patchFactors;
  const std::vector<std::string> names = namesOf(editor);
  if (names.empty()) return 1.0;
  const auto found = factors.find(names.front());
  return found == factors.end() ? 1.0 : found->second;
}

bool setFactor(Editor& editor, double factor) {
  modeling::MeshSettings mesh = editor.project().mesh;
  for (const std::string& name : namesOf(editor)) {
    if (factor == 1.0)
      mesh.patchFactors.erase(name);
    else
      mesh.patchFactors[name] = factor;
  }
  return editor.perform(modeling::SetMesh{mesh});
}

QString knotsText(const std::vector<double>& knots) {
  QStringList texts;
  for (std::size_t i = 0; i < knots.size();) {
    std::size_t end = i;
    while (end < knots.size() && knots[end] == knots[i]) ++end;
    QString text = QString::number(knots[i], 'g', 4);
    if (end - i > 1) text += QStringLiteral(" (×%1)").arg(end - i);
    texts.push_back(text);
    i = end;
  }
  return texts.join(QStringLiteral(", "));
}

QString areaText(const PropertyPage& page) {
  const Editor& editor = page.editor();
  if (!editor.solid()) return {};
  std::vector<modeling::Patch> patches;
  for (int patch : chosenPatches(editor)) patches.push_back(editor.solid()->patches()[patch]);
  if (patches.empty()) return {};
  const double area =
      modeling::area(modeling::SurfaceEvaluator(editor.solid()->controlPoints(), patches));
  return shownArea(area, page.workspace().settings.units());
}

void addPatchFacts(PropertyPage& page) {
  Editor& editor = page.editor();
  const auto fact = [&](const QString& label, const QString& name, auto text) {
    page.addFact(label, name, [&editor, text] {
      const modeling::Patch* patch = patchOf(editor);
      return patch ? text(*patch) : QString();
    });
  };
  fact(tr("Degrees"), "degrees", [](const modeling::Patch& patch) {
    return tr("%1 in u, %2 in v").arg(patch.degree[0]).arg(patch.degree[1]);
  });
  fact(tr("Points"), "netSize", [](const modeling::Patch& patch) {
    return tr("%1 in u, %2 in v").arg(patch.net.size()).arg(patch.net.front().size());
  });
  fact(tr("Knots in u"), "knotsU",
       [](const modeling::Patch& patch) { return knotsText(patch.knots[0]); });
  fact(tr("Knots in v"), "knotsV",
       [](const modeling::Patch& patch) { return knotsText(patch.knots[1]); });
}

}  // namespace

void addPatchRows(PropertyPage& page) {
  Editor& editor = page.editor();
  const bool isOne = chosenPatches(editor).size() == 1;
  if (isOne) {
    page.addSection(editor.solid() ? tr("Patch") : tr("Face"));
    page.addText(
        tr("&Name"), "name",
        [&editor] {
          const auto names = namesOf(editor);
          return names.empty() ? QString() : QString::fromStdString(names.front());
        },
        [&editor](const QString& name) {
          return chosenPatches(editor).empty() ||
                 renamePatch(editor, *chosenPatches(editor).begin(), name);
        });
    if (editor.solid()) addPatchFacts(page);
  } else {
    page.addSection(editor.solid() ? tr("Patches") : tr("Faces"));
    page.addFact(tr("Selected"), "count",
                 [&editor] { return QString::number(chosenPatches(editor).size()); });
  }
  if (editor.solid()) page.addSlowFact(tr("Area"), "area", [&page] { return areaText(page); });
  page.addSection(tr("Mesh"));
  page.addQuantity(
          tr("Edge length ×"), "factor", Quantity::kNumber, [&editor] { return factorOf(editor); },
          [&editor](double factor) { return setFactor(editor, factor); })
      ->setRange(0.05, 20);
  page.addNote(tr("Below 1 the mesh is finer here."));
  if (editor.solid())
    page.addButton(tr("&Select points"), "selectPoints", "net", [&editor] {
      editor.select(Selection::ofPoints(pointsOf(editor.selection(), *editor.solid())));
    });
}

}  // namespace palpa::gui

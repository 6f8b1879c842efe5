#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "app/gui/base/measures.h"
#include "app/gui/base/translate.h"
#include "app/gui/dialogs/material_dialog.h"
#include "app/gui/document/editor.h"
#include "app/gui/document/naming.h"
#include "app/gui/document/own_materials.h"
#include "app/gui/properties/pages.h"
#include "app/gui/view/scene_controller.h"
#include "modeling/error.h"
#include "modeling/mesh/mesh.h"
#include "modeling/project/mesh_foci.h"

namespace palpa::gui {
namespace {

/// Renames a library material with changed constants.
void renameWhenChanged(modeling::Material& material) {
  if (isOfLibrary(material.name)) material.name += tr(", changed").toStdString();
}

void addMaterial(PropertyPage& page) {
  // A new field needs a row: it does not compile here.
  [[maybe_unused]] const auto [name, youngsModulus, poissonRatio, unused] = modeling::Material{};
  Editor& editor = page.editor();
  page.addSection(tr("Material"), "material");
  page.addFact(tr("Name"), "materialName",
               [&editor] { return QString::fromStdString(editor.project().material.name); });
  page.addQuantity(
      tr("&Young's modulus"), "youngsModulus", Quantity::kStress,
      [&editor] { return editor.project().material.youngsModulus; },
      [&editor](double modulus) {
        modeling::Material material = editor.project().material;
        material.youngsModulus = modulus;
        renameWhenChanged(material);
        return editor.perform(modeling::SetMaterial{material});
      });
  page.addQuantity(
      tr("&Poisson's ratio"), "poissonRatio", Quantity::kNumber,
      [&editor] { return editor.project().material.poissonRatio; },
      [&editor](double ratio) {
        modeling::Material material = editor.project().material;
        material.poissonRatio = ratio;
        renameWhenChanged(material);
        return editor.perform(modeling::SetMaterial{material});
      });
  QuantityEdit* density = page.addQuantity(
      tr("&Density"), "density", Quantity::kDensity,
      [&editor] {
        return editor.project().material.densityKgPerM3.value_or(
            std::numeric_limits<double>::quiet_NaN());
      },
      [&editor](double value) {
        modeling::Material material = editor.project().material;
        material.densityKgPerM3 = std::isnan(value) ? std::nullopt : std::optional(value);
        renameWhenChanged(material);
        return editor.perform(modeling::SetMaterial{material});
      });
  density->setOptional(tr("unknown"));
  page.addButton(tr("Choo&se …"), "chooseMaterial", "material",
                 [workspace = page.workspace()] { editMaterial(workspace); });
}

QString nodesText(const modeling::Project& project, const Job& job) {
  try {
    const double nodes =
        modeling::estimateNodeCount(project.body, project.mesh, modeling::meshRegions(project),
                                    modeling::meshFoci(project), job);
    if (!std::isfinite(nodes) || nodes > modeling::kMaxNodes)
      return tr("far too many: more than %L1").arg(modeling::kMaxNodes, 0, 'f', 0);
    return tr("about %L1").arg(nodes, 0, 'f', 0);
  } catch (const modeling::ModelingError& error) {
    return QString::fromStdString(error.what());
  }
}

using ChangeMesh = std::function<bool(const std::function<void(modeling::MeshSettings&)>&)>;

/// Choice among the engines that can compute the body.
void addEngine(PropertyPage& page, const ChangeMesh& change) {
  using modeling::Engine;
  Editor& editor = page.editor();
  std::vector<Engine> engines{Engine::kAutomatic, Engine::kTriangles, Engine::kQuadratic};
  QStringList names{tr("Automatic"), tr("Triangles"), tr("Quadratic triangles")};
  if (editor.solid()) {
    engines.insert(engines.begin() + 1, Engine::kSplines);
    names.insert(1, tr("Splines"));
  }
  page.addChoice(
      tr("Compu&ted with"), "engine", names,
      [&editor, engines] {
        const auto present =
            std::find(engines.begin(), engines.end(), editor.project().mesh.engine);
        return static_cast<int>(present - engines.begin());
      },
      [change, engines](int index) {
        return change([&](auto& mesh) { mesh.engine = engines[static_cast<std::size_t>(index)]; });
      });
}

/// Accuracy of splines.
void addAccuracy(PropertyPage& page, const ChangeMesh& change) {
  Editor& editor = page.editor();
  page.addQuantity(
          tr("Requested &accuracy, %"), "accuracy", Quantity::kNumber,
          [&editor] { return 100 * editor.project().mesh.accuracy; },
          [change](double percent) {
            return change([&](auto& mesh) {
              mesh.accuracy = percent / 100;
              mesh.splineDensity = 1;
              mesh.elementLength.reset();
            });
          })
      ->setRange(0.01, 10);
  if (editor.project().mesh.splineDensity != 1)
    page.addQuantity(
            tr("Spline &density, ×"), "splineDensity", Quantity::kNumber,
            [&editor] { return editor.project().mesh.splineDensity; },
            [change](double density) {
              return change([&](auto& mesh) { mesh.splineDensity = density; });
            })
        ->setRange(1, modeling::MeshSettings::kMaxSplineDensity);
  page.addSlowFact(tr("Spline elements"), "splineElements", [&editor] {
    const auto model = editor.model();
    if (!model) return QString("…");
    const app::BoundarySetup& setup = model->setup();
    if (!setup.splines) return tr("none: triangles");
    return tr("%L1, %L2 coefficients")
        .arg(setup.discretisation->elementCount())
        .arg(setup.discretisation->displacementCount());
  });
}

/// The smallest features of a mesh body that its mesh follows, and what the last mesh left out.
void addSmallFeatures(PropertyPage& page, const ChangeMesh& change) {
  Editor& editor = page.editor();
  page.addQuantity(
          tr("&Smallest features, % of edge"), "featureFraction", Quantity::kNumber,
          [&editor] { return 100 * editor.project().mesh.featureFraction; },
          [change](double percent) {
            return change([&](auto& mesh) { mesh.featureFraction = percent / 100; });
          })
      ->setRange(0, 100);
  page.addSlowFact(tr("Meshed over"), "simplification", [&page, &editor] {
    const auto model = editor.model();
    if (!model) return QString("…");
    const auto& [below, moved, vanishedFaces, partsBelow, cutPins, filledHoles] =
        model->surface().simplification;
    if (below == 0) return tr("nothing");
    QString text = tr("features below %1; the surface moved by up to %2")
                       .arg(page.shownLength(below), page.shownLength(moved));
    if (cutPins > 0)
      text += "; " + (cutPins == 1 ? tr("one pin or knife edge cut off")
                                   : tr("%1 pins and knife edges cut off").arg(cutPins));
    if (filledHoles > 0)
      text += "; " + (filledHoles == 1 ? tr("one hole or gap filled")
                                       : tr("%1 holes and gaps filled").arg(filledHoles));
    if (cutPins + filledHoles > 0) text += tr(", below %1").arg(page.shownLength(partsBelow));
    return text;
  });
}

void addMesh(PropertyPage& page) {
  Editor& editor = page.editor();
  page.addSection(tr("Mesh"), "mesh");
  // Changes one setting and keeps the others.
  const ChangeMesh change = [&editor](const std::function<void(modeling::MeshSettings&)>& edit) {
    modeling::MeshSettings mesh = editor.project().mesh;
    edit(mesh);
    return editor.perform(modeling::SetMesh{mesh});
  };
  addEngine(page, change);
  if (editor.solid()) addAccuracy(page, change);
  page.addQuantity(
      tr("&Edge length"), "edgeLength", Quantity::kLength,
      [&editor] { return editor.project().mesh.edgeLength; },
      [change](double length) { return change([&](auto& mesh) { mesh.edgeLength = length; }); });
  page.addCount(
      tr("&Refinement"), "refinementLevels", 0, 6,
      [&editor] { return editor.project().mesh.refinementLevels; },
      [change](int levels) { return change([&](auto& mesh) { mesh.refinementLevels = levels; }); });
  page.addCheck(
      tr("Finer at s&harp edges"), "refineAtSharpEdges",
      [&editor] { return editor.project().mesh.refineAtSharpEdges; },
      [change](bool on) { return change([&](auto& mesh) { mesh.refineAtSharpEdges = on; }); });
  page.addCheck(
      tr("Finer at &borders of supports"), "refineAtBorders",
      [&editor] { return editor.project().mesh.refineAtBorders; },
      [change](bool on) { return change([&](auto& mesh) { mesh.refineAtBorders = on; }); });
  if (!editor.solid()) addSmallFeatures(page, change);
  page.addComputedFact(tr("Nodes"), "nodes", [&editor] {
    return [project = editor.project()](const Job& job) { return nodesText(project, job); };
  });
  for (const auto& [patch, unused] : editor.project().mesh.patchFactors)
    page.addQuantity(
            tr("%1 ×").arg(QString::fromStdString(patch)),
            "factor " + QString::fromStdString(patch), Quantity::kNumber,
            [&editor, patch = patch] {
              const auto& factors = editor.project().mesh.patchFactors;
              const auto found = factors.find(patch);
              return found == factors.end() ? 1.0 : found->second;
            },
            [change, patch = patch](double factor) {
              return change([&](auto& mesh) {
                if (factor == 1.0)
                  mesh.patchFactors.erase(patch);
                else
                  mesh.patchFactors[patch] = factor;
              });
            })
        ->setRange(0.05, 20);
  page.addNote(
      tr("Each level of refinement halves the edges there. Select a patch to give it a "
         "finer or coarser mesh."));
}

void addBody(PropertyPage& page) {
  Editor& editor = page.editor();
  page.addSection(tr("Body"), "body");
  page.addFact(tr("Size"), "size", [&page] {
    // Extent of the drawn surface; control points extend farther.
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& place : page.workspace().scene.surface().positions)
      box.extend(place);
    const Eigen::Vector3d size = box.sizes();
    return QStringList{page.shownLength(size.x()), page.shownLength(size.y()),
                       page.shownLength(size.z())}
        .join(QStringLiteral(" × "));
  });
  page.addSlowFact(tr("Volume"), "volume", [&page] {
    return shownVolume(modeling::volume(page.editor().project().body),
                       page.workspace().settings.units());
  });
  page.addSlowFact(tr("Area"), "area", [&page] {
    return shownArea(modeling::area(page.editor().project().body),
                     page.workspace().settings.units());
  });
  page.addFact(editor.solid() ? tr("Patches") : tr("Faces"), "patches", [&editor] {
    return QString::number(modeling::patchNames(editor.project().body).size());
  });
  if (editor.solid())
    page.addFact(tr("Control points"), "points", [&editor] {
      return editor.solid() ? QString::number(editor.solid()->controlPoints().size()) : QString();
    });
}

}  // namespace

void addProjectRows(PropertyPage& page) {
  Editor& editor = page.editor();
  page.addSection(tr("Project"));
  page.addText(
      tr("&Name"), "name", [&editor] { return QString::fromStdString(editor.project().name); },
      [&editor](const QString& name) { return renameProject(editor, name); });
  addPrimitiveRows(page);
  addMaterial(page);
  addMesh(page);
  addBody(page);
}

}  // namespace palpa::gui

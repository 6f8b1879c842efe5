#include <algorithm>
#include <array>

#include "app/gui/base/measures.h"
#include "app/gui/base/translate.h"
#include "app/gui/dialogs/material_dialog.h"
#include "app/gui/document/editor.h"
#include "app/gui/document/load_kinds.h"
#include "app/gui/document/named_items.h"
#include "app/gui/document/remedies.h"
#include "app/gui/properties/pages.h"
#include "app/gui/view/condition_marks.h"
#include "app/gui/view/scene_controller.h"

namespace palpa::gui {
namespace {

using Eigen::Vector3d;
using modeling::Load;

constexpr double kCubicMPerMm3 = 1e-9;

/// The selected load; a default one while it is being removed.
Load loadOf(const Editor& editor) {
  const auto& named = editor.selection().named;
  const Load* load = named ? findNamed(editor.project().loads, named->name) : nullptr;
  return load ? *load : Load();
}

bool put(Editor& editor, const Load& load) {
  return editor.perform(modeling::SetLoad{load.name, load});
}
/// Reads a member of the variant in a load. For a load of another kind another page is made.
template <class What, class Member>
auto reader(Editor& editor, Member What::*member) {
  return [&editor, member] {
    const Load load = loadOf(editor);
    const auto* what = std::get_if<What>(&load.what);
    return what ? what->*member : What().*member;
  };
}

template <class What, class Member>
auto writer(Editor& editor, Member What::*member) {
  return [&editor, member](const Member& value) {
    Load load = loadOf(editor);
    auto* what = std::get_if<What>(&load.what);
    if (!what) return false;
    what->*member = value;
    return put(editor, load);
  };
}

constexpr std::array kPatchLoads{LoadKind::kPressure, LoadKind::kTraction, LoadKind::kTotalForce,
                                 LoadKind::kMoment};

void addLoadKind(PropertyPage& page) {
  Editor& editor = page.editor();
  QStringList titles;
  for (const LoadKind kind : kPatchLoads) titles << infoOf(kind).title();
  page.addChoice(
      tr("&Kind"), "kind", titles,
      [&editor] {
        const auto found =
            std::find(kPatchLoads.begin(), kPatchLoads.end(), loadKindOf(loadOf(editor)));
        return static_cast<int>(found - kPatchLoads.begin());
      },
      [&editor](int chosen) {
        const Load load = loadOf(editor);
        const LoadKind kind = kPatchLoads[static_cast<std::size_t>(chosen)];
        return kind == loadKindOf(load) || put(editor, withLoadKind(load, kind, editor.project()));
      });
}

void addLoadVector(PropertyPage& page, LoadKind kind) {
  Editor& editor = page.editor();
  const LoadKindInfo& info = infoOf(kind);
  page.addVector(
      info.vector, kind == LoadKind::kGravity ? QStringLiteral("acceleration") : info.stem,
      info.quantity,
      [&editor] {
        const Load load = loadOf(editor);
        const Vector3d* vector = vectorOf(load);
        return vector ? *vector : Vector3d(Vector3d::Zero());
      },
      [&editor](const Vector3d& vector) {
        Load load = loadOf(editor);
        Vector3d* old = vectorOf(load);
        if (!old) return false;
        *old = vector;
        return put(editor, load);
      });
}

/// In the chosen unit, or in another one if the number would be unreadable.
QString readableStress(double stress, ShownUnits units) {
  constexpr double kMin = 1e-3, kMax = 1e5;
  int& unit = units.chosen[static_cast<std::size_t>(Quantity::kStress)];
  const int chosen = unit;
  const auto isReadable = [&] {
    const double number = stress / units.of(Quantity::kStress).factor;
    return number >= kMin && number < kMax;
  };
  const int count = static_cast<int>(unitsOf(Quantity::kStress).size());
  for (int i = 0; !isReadable() && i < count; ++i) unit = i;
  if (!isReadable()) unit = chosen;
  return shown(stress, Quantity::kStress, units, 3);
}

/// Force per area of a total force.
void addMeanTraction(PropertyPage& page) {
  page.addSlowFact(tr("Per area"), "meanTraction", [&page] {
    const Load load = loadOf(page.editor());
    const auto* total = std::get_if<modeling::TotalForce>(&load.what);
    if (!total) return QString();
    const double area =
        regionArea(total->where, page.editor().project().body, page.workspace().scene.surface());
    if (area <= 0) return tr("its region has no area");
    const ShownUnits units = page.workspace().settings.units();
    return tr("%1 on %2")
        .arg(readableStress(total->force.norm() / area, units), shownArea(area, units));
  });
}

void addGravityRows(PropertyPage& page) {
  Editor& editor = page.editor();
  page.addButton(tr("Earth, −&Z"), "earthGravity", "load-gravity", [&editor] {
    Load load = loadOf(editor);
    load.what = modeling::Gravity{};
    put(editor, load);
  });
  if (editor.project().material.densityKgPerM3) {
    page.addSlowFact(tr("Weight"), "weight", [&page] {
      const modeling::Project& project = page.editor().project();
      const Load load = loadOf(page.editor());
      const auto* gravity = std::get_if<modeling::Gravity>(&load.what);
      if (!gravity || !project.material.densityKgPerM3) return QString();
      const double weight = modeling::volume(project.body) * kCubicMPerMm3 *
                            *project.material.densityKgPerM3 * gravity->accelerationMPerS2.norm();
      return shown(weight, Quantity::kForce, page.workspace().settings.units(), 4);
    });
    return;
  }
  page.addNote(tr("The material has no density; gravity needs it."));
  const Remedy remedy = usualDensity(editor);
  page.addButton(remedy.text, "useDensity", "ok", remedy.apply);
  page.addNote(remedy.tip + ".");
  page.addButton(tr("&Enter density …"), "enterDensity", "material",
                 [workspace = page.workspace()] { editMaterial(workspace, true); });
}

}  // namespace

void addLoadRows(PropertyPage& page) {
  using namespace modeling;
  Editor& editor = page.editor();
  const Load load = loadOf(editor);
  const LoadKind kind = loadKindOf(load);
  page.addSection(tr("Load: %1").arg(infoOf(kind).title().toLower()));
  addNameRow(page);
  if (actsOnPatches(kind)) addLoadKind(page);
  if (kind == LoadKind::kPressure) {
    page.addQuantity(tr("&Pressure"), "pressure", Quantity::kStress,
                     reader(editor, &Pressure::pressure), writer(editor, &Pressure::pressure));
    page.addNote(tr("Positive presses into the body."));
  }
  if (vectorOf(load)) addLoadVector(page, kind);
  if (kind == LoadKind::kTotalForce) addMeanTraction(page);
  if (kind == LoadKind::kGravity) addGravityRows(page);
  if (kind == LoadKind::kBump) {
    page.addVector(tr("&Centre x, y, z"), "centre", Quantity::kLength,
                   reader(editor, &Bump::center), writer(editor, &Bump::center));
    page.addQuantity(tr("&Radius"), "radius", Quantity::kLength, reader(editor, &Bump::radius),
                     writer(editor, &Bump::radius));
    page.addQuantity(tr("Pea&k"), "peak", Quantity::kStress, reader(editor, &Bump::peak),
                     writer(editor, &Bump::peak));
    page.addVector(tr("&Direction x, y, z"), "direction", Quantity::kNumber,
                   reader(editor, &Bump::direction), writer(editor, &Bump::direction));
  }
  if (regionOf(load))
    addRegionRows(
        page,
        [&editor] {
          const Load now = loadOf(editor);
          const Region* region = regionOf(now);
          return region ? *region : Region();
        },
        [&editor](const Region& where) {
          Load changed = loadOf(editor);
          Region* region = regionOf(changed);
          if (!region) return false;
          *region = where;
          return put(editor, changed);
        });
}

}  // namespace palpa::gui

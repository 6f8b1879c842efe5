#include "app/gui/document/load_kinds.h"

#include <QStringList>
#include <algorithm>
#include <cmath>

#include "app/gui/base/translate.h"
#include "app/gui/document/named_items.h"

namespace palpa::gui {
namespace {

using Eigen::Vector3d;
using modeling::Load;

constexpr double kStrengthShare = 0.02;  // of Young's modulus: strains of a few per cent
constexpr double kBumpShare = 0.1;       // of the body's size

static_assert(std::variant_size_v<decltype(Load::what)> == kLoadKindCount);

/// Extents of the body along the axes, ascending, mm.
Vector3d extents(const modeling::Project& project) {
  const auto [low, high] = modeling::boundingBox(project.body);
  Vector3d sizes = high - low;
  std::sort(sizes.begin(), sizes.end());
  return sizes;
}

/// To one significant digit.
double rounded(double value) {
  if (!(value > 0)) return value;
  const double power = std::pow(10, std::floor(std::log10(value)));
  return std::round(value / power) * power;
}

template <class Vector, class LoadRef>
Vector vectorIn(LoadRef& load) {
  return std::visit(
      [](auto& what) -> Vector {
        if constexpr (requires { what.traction; })
          return &what.traction;
        else if constexpr (requires { what.force; })
          return &what.force;
        else if constexpr (requires { what.moment; })
          return &what.moment;
        else if constexpr (requires { what.accelerationMPerS2; })
          return &what.accelerationMPerS2;
        else
          return nullptr;
      },
      load.what);
}

}  // namespace

const std::array<LoadKindInfo, kLoadKindCount>& loadKinds() {
  static const std::array<LoadKindInfo, kLoadKindCount> kinds{{
      {tr("&Pressure"), tr("pressure"), tr("Acts along the normal, on patches"), "load-pressure",
       QString(), Quantity::kStress},
      {tr("&Uniform traction"), tr("traction"), tr("Force per area in one direction, on patches"),
       "load-traction", tr("&Traction x, y, z"), Quantity::kStress},
      {tr("&Bump"), tr("bump"), tr("A pressure around a point that fades out to its border"),
       "load-bump", QString(), Quantity::kStress},
      {tr("Total &force"), tr("force"), tr("A force spread evenly over patches"), "load-force",
       tr("&Force x, y, z"), Quantity::kForce},
      {tr("&Moment"), tr("moment"), tr("A torque or bending moment on patches, without net force"),
       "load-moment", tr("&Moment x, y, z"), Quantity::kMoment},
      {tr("&Gravity"), tr("gravity"),
       tr("The weight of the body, from the density of its material"), "load-gravity",
       tr("&Acceleration x, y, z"), Quantity::kAcceleration},
  }};
  return kinds;
}

const Vector3d* vectorOf(const Load& load) {
  return vectorIn<const Vector3d*>(load);
}

Vector3d* vectorOf(Load& load) {
  return vectorIn<Vector3d*>(load);
}

QString strengthText(const Load& load, const ShownUnits& units) {
  constexpr int kDigits = 3;
  double value = 0;
  if (const Vector3d* vector = vectorOf(load)) value = vector->norm();
  if (const auto* pressure = std::get_if<modeling::Pressure>(&load.what))
    value = pressure->pressure;
  if (const auto* bump = std::get_if<modeling::Bump>(&load.what))
    value = std::abs(bump->peak) * bump->direction.norm();
  return shown(value, infoOf(loadKindOf(load)).quantity, units, kDigits);
}

QString loadText(const Load& load, const ShownUnits& units) {
  constexpr int kDigits = 5;
  const LoadKindInfo& info = infoOf(loadKindOf(load));
  const Vector3d* vector = vectorOf(load);
  if (!vector) return QStringLiteral("%1 %2").arg(info.title(), strengthText(load, units));
  const Unit& unit = units.of(info.quantity);
  QStringList numbers;
  for (const double each : *vector)
    numbers << shown(each / unit.factor, Quantity::kNumber, units, kDigits);
  return QStringLiteral("%1 (%2) %3").arg(info.title(), numbers.join(", "), unit.symbol);
}

Load usualLoad(LoadKind kind, const modeling::Project& project) {
  const double stress = kStrengthShare * project.material.youngsModulus;
  // On a slender body, forces and moments suit its cross-section.
  const Vector3d size = extents(project);
  const double force = rounded(stress * size[0] * size[1] / 4);
  switch (kind) {
    case LoadKind::kPressure:
      return {{}, modeling::Pressure{{}, stress}};
    case LoadKind::kTraction:
      return {{}, modeling::UniformTraction{{}, -stress * Vector3d::UnitZ()}};
    case LoadKind::kBump:
      return {{}, modeling::Bump{Vector3d::Zero(), kBumpShare * size[2], stress}};
    case LoadKind::kTotalForce:
      return {{}, modeling::TotalForce{{}, -force * Vector3d::UnitZ()}};
    case LoadKind::kMoment:
      return {{}, modeling::Moment{{}, rounded(force * size[0] / 4) * Vector3d::UnitZ()}};
    case LoadKind::kGravity:
      return {{}, modeling::Gravity{}};
  }
  return {};
}

Load withLoadKind(const Load& load, LoadKind kind, const modeling::Project& project) {
  Load changed = usualLoad(kind, project);
  changed.name = load.name;
  *regionOf(changed) = *regionOf(load);
  const Vector3d* from = vectorOf(load);
  Vector3d* to = vectorOf(changed);
  if (from && to && from->norm() > 0) *to = to->norm() * from->normalized();
  return changed;
}

bool actsOnPatches(LoadKind kind) {
  return kind != LoadKind::kBump && kind != LoadKind::kGravity;
}

bool addLoad(Editor& editor, Load load) {
  load.name = freeName(infoOf(loadKindOf(load)).stem.toStdString(), editor.project().loads);
  if (!editor.perform(modeling::AddLoad{load})) return false;
  editor.select(Selection::of(Selection::Kind::kLoad, load.name));
  return true;
}

bool addGravity(Editor& editor, const Load& gravity) {
  for (const Load& each : editor.project().loads)
    if (loadKindOf(each) == LoadKind::kGravity) {
      editor.select(Selection::of(Selection::Kind::kLoad, each.name));
      return true;
    }
  return addLoad(editor, gravity);
}

bool addLoadOnSelection(Editor& editor, LoadKind kind) {
  const auto names = modeling::patchNames(editor.project().body);
  modeling::PatchSet patches;
  for (const int patch : editor.selection().patches) patches.patches.push_back(names[patch]);
  Load load = usualLoad(kind, editor.project());
  regionOf(load)->parts = {patches};
  return addLoad(editor, load);
}

}  // namespace palpa::gui

#pragma once

#include <QString>
#include <array>

#include "app/gui/base/units.h"
#include "app/gui/document/editor.h"

// Kinds of loads: their names, usual values, and making loads.
namespace palpa::gui {

/// In the order of the alternatives of Load::what.
enum class LoadKind { kPressure, kTraction, kBump, kTotalForce, kMoment, kGravity };
inline constexpr std::size_t kLoadKindCount = 6;

inline LoadKind loadKindOf(const modeling::Load& load) {
  return static_cast<LoadKind>(load.what.index());
}

struct LoadKindInfo {
  QString entry;  ///< of a menu, with &: "Total &force"
  QString stem;   ///< of the names of new loads
  QString tip;    ///< sentence about the effect
  const char* icon;
  QString vector;     ///< label of its vector, with &; empty without one
  Quantity quantity;  ///< of the vector, or of the strength

  QString title() const { return QString(entry).remove('&'); }
};

/// All kinds, in the order of LoadKind.
const std::array<LoadKindInfo, kLoadKindCount>& loadKinds();

inline const LoadKindInfo& infoOf(LoadKind kind) {
  return loadKinds()[static_cast<std::size_t>(kind)];
}

/// Strength with its unit: "2 kPa", "0.5 N", "9.81 m/s²". A pressure keeps its sign: suction is
/// negative.
QString strengthText(const modeling::Load& load, const ShownUnits& units);
/// Kind, and the vector for loads with one: "Total force (0, 0, -2) N".
QString loadText(const modeling::Load& load, const ShownUnits& units);

/// The vector of a load; null for pressures and bumps.
const Eigen::Vector3d* vectorOf(const modeling::Load& load);
Eigen::Vector3d* vectorOf(modeling::Load& load);

/// A load of this kind without name and region, with the usual strength: 2 % of Young's modulus,
/// which strains the body by some per cent, forces and moments about as much; Earth's gravity along
/// -z.
modeling::Load usualLoad(LoadKind kind, const modeling::Project& project);

/// The same load as another kind that acts on a region: keeps name, region and direction, takes the
/// usual strength. Both kinds must act on a region.
modeling::Load withLoadKind(const modeling::Load& load, LoadKind kind,
                            const modeling::Project& project);

/// True if the kind acts on patches.
bool actsOnPatches(LoadKind kind);

/// Adds the load with a free name and selects it. False if the editor refused.
bool addLoad(Editor& editor, modeling::Load load);
/// Selects the gravity of the project, or adds `gravity`.
bool addGravity(Editor& editor, const modeling::Load& gravity);
/// Adds a load of this kind on the selected patches.
bool addLoadOnSelection(Editor& editor, LoadKind kind);

}  // namespace palpa::gui

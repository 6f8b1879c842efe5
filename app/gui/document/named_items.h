#pragma once

#include <algorithm>
#include <string>

#include "app/gui/document/selection.h"
#include "modeling/project/project.h"

// Lists of the named items of a project: supports, loads, touches, measurements.
namespace palpa::gui {

/// Calls `work` with the list of items of a kind and returns its result.
template <class Work>
auto withList(const modeling::Project& project, Selection::Kind kind, const Work& work) {
  switch (kind) {
    case Selection::Kind::kSupport:
      return work(project.supports);
    case Selection::Kind::kLoad:
      return work(project.loads);
    case Selection::Kind::kTouch:
      return work(project.touches);
    case Selection::Kind::kMeasurement:
      break;
  }
  return work(project.measurements);
}

/// The item with this name; null if absent.
template <class List>
auto findNamed(const List& list, const std::string& name) -> decltype(list.data()) {
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const auto& each) { return each.name == name; });
  return found == list.end() ? nullptr : &*found;
}

/// "support 3": the stem with the first number that is free in the list.
template <class List>
std::string freeName(const std::string& stem, const List& list) {
  for (int i = 1;; ++i) {
    const std::string name = stem + " " + std::to_string(i);
    bool isFree = true;
    for (const auto& each : list) isFree = isFree && each.name != name;
    if (isFree) return name;
  }
}

inline bool hasNamed(const modeling::Project& project, const Selection::Named& item) {
  return withList(project, item.kind,
                  [&](const auto& list) { return findNamed(list, item.name) != nullptr; });
}

}  // namespace palpa::gui

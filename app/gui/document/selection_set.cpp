#include "app/gui/document/selection_set.h"

#include <QJsonArray>
#include <algorithm>
#include <cmath>

#include "modeling/solid/basis.h"

namespace palpa::gui {
namespace {

using modeling::Patch;
using modeling::Solid;

QString fromUtf8(std::string_view text) {
  return QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()));
}

const Patch* findPatch(const Solid& solid, const std::string& name) {
  for (const Patch& patch : solid.patches())
    if (patch.name == name) return &patch;
  return nullptr;
}

std::array<std::vector<double>, 2> linesOf(const Patch& patch) {
  std::array<std::vector<double>, 2> lines;
  const std::array<std::size_t, 2> counts{patch.net.size(), patch.net.front().size()};
  for (int d = 0; d < 2; ++d)
    for (int i = 0; i < static_cast<int>(counts[d]); ++i)
      lines[d].push_back(modeling::greville(patch.knots[d], patch.degree[d], i));
  return lines;
}

std::size_t nearest(const std::vector<double>& lines, double parameter) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < lines.size(); ++i)
    if (std::abs(lines[i] - parameter) < std::abs(lines[best] - parameter)) best = i;
  return best;
}

/// Lines of the set that decide about a line of the present net.
struct Deciders {
  std::vector<std::size_t> lines;
  bool needsAll = false;  // a line between two lines of the set belongs to it if both do
};

std::vector<Deciders> decidersOf(const std::vector<double>& present,
                                 const std::vector<double>& stored) {
  std::vector<Deciders> deciders(present.size());
  for (std::size_t k = 0; k < stored.size(); ++k)
    deciders[nearest(present, stored[k])].lines.push_back(k);
  for (std::size_t i = 0; i < present.size(); ++i) {
    if (!deciders[i].lines.empty()) continue;
    const auto above = std::upper_bound(stored.begin(), stored.end(), present[i]);
    const auto k = static_cast<std::size_t>(above - stored.begin());
    deciders[i].needsAll = true;
    if (k > 0) deciders[i].lines.push_back(k - 1);
    if (k < stored.size()) deciders[i].lines.push_back(k);
  }
  return deciders;
}

template <class Test>
bool decide(const Deciders& deciders, const Test& test) {
  return deciders.needsAll ? std::all_of(deciders.lines.begin(), deciders.lines.end(), test)
                           : std::any_of(deciders.lines.begin(), deciders.lines.end(), test);
}

void addPoints(const SelectionSet::Points& stored, const Patch& patch, std::set<int>& points) {
  const auto present = linesOf(patch);
  const auto u = decidersOf(present[0], stored.lines[0]);
  const auto v = decidersOf(present[1], stored.lines[1]);
  std::vector<std::vector<bool>> isIn(stored.lines[0].size(),
                                      std::vector<bool>(stored.lines[1].size()));
  for (const auto& [i, j] : stored.at) isIn[i][j] = true;
  for (std::size_t i = 0; i < u.size(); ++i)
    for (std::size_t j = 0; j < v.size(); ++j)
      if (decide(u[i], [&](std::size_t k) {
            return decide(v[j], [&](std::size_t l) { return isIn[k][l]; });
          }))
        points.insert(patch.net[i][j]);
}

QJsonArray toJson(const std::vector<double>& numbers) {
  QJsonArray array;
  for (const double number : numbers) array.append(number);
  return array;
}

/// Nothing unless the numbers are finite and ascending.
std::optional<std::vector<double>> linesFrom(const QJsonValue& value) {
  std::vector<double> lines;
  for (const QJsonValue& each : value.toArray()) lines.push_back(each.toDouble(std::nan("")));
  const bool isSound =
      !lines.empty() && std::is_sorted(lines.begin(), lines.end()) &&
      std::all_of(lines.begin(), lines.end(), [](double line) { return std::isfinite(line); });
  return isSound ? std::optional(lines) : std::nullopt;
}

std::optional<SelectionSet::Points> pointsFrom(const QJsonObject& object) {
  SelectionSet::Points points;
  points.patch = object["patch"].toString().toStdString();
  const auto u = linesFrom(object["u"]), v = linesFrom(object["v"]);
  if (!u || !v) return std::nullopt;
  points.lines = {*u, *v};
  for (const QJsonValue& value : object["at"].toArray()) {
    const QJsonArray pair = value.toArray();
    const int i = pair[0].toInt(-1), j = pair[1].toInt(-1);
    if (i < 0 || j < 0 || i >= static_cast<int>(u->size()) || j >= static_cast<int>(v->size()))
      return std::nullopt;
    points.at.push_back({i, j});
  }
  return points;
}

}  // namespace

SelectionSet makeSet(const std::string& name, const Selection& selection,
                     const modeling::Body& body) {
  SelectionSet set{name, {}, {}, {}};
  const std::vector<std::string> patches = modeling::patchNames(body);
  for (const int patch : selection.patches) set.patches.push_back(patches[patch]);
  const auto* solid = std::get_if<Solid>(&body);
  if (!solid) return set;
  for (const int edge : selection.edges) {
    const modeling::PatchEdge& use = solid->edges()[edge].uses[0];
    set.edges.push_back({patches[use.patch], use.side});
  }
  if (selection.points.empty()) return set;
  for (const Patch& patch : solid->patches()) {
    SelectionSet::Points points{patch.name, linesOf(patch), {}};
    for (int i = 0; i < static_cast<int>(patch.net.size()); ++i)
      for (int j = 0; j < static_cast<int>(patch.net[i].size()); ++j)
        if (selection.points.contains(patch.net[i][j])) points.at.push_back({i, j});
    if (!points.at.empty()) set.points.push_back(std::move(points));
  }
  return set;
}

Selection selectionOf(const SelectionSet& set, const modeling::Body& body) {
  Selection selection;
  const std::vector<std::string> patches = modeling::patchNames(body);
  for (std::size_t i = 0; i < patches.size(); ++i)
    if (std::find(set.patches.begin(), set.patches.end(), patches[i]) != set.patches.end())
      selection.patches.insert(static_cast<int>(i));
  const auto* solid = std::get_if<Solid>(&body);
  if (!solid) return selection;
  for (std::size_t i = 0; i < solid->edges().size(); ++i)
    for (const modeling::PatchEdge& use : solid->edges()[i].uses)
      if (std::find(set.edges.begin(), set.edges.end(),
                    SelectionSet::Edge{patches[use.patch], use.side}) != set.edges.end())
        selection.edges.insert(static_cast<int>(i));
  for (const SelectionSet::Points& stored : set.points)
    if (const Patch* patch = findPatch(*solid, stored.patch))
      addPoints(stored, *patch, selection.points);
  return selection;
}

void renamePatchIn(SelectionSet& set, const std::string& from, const std::string& to) {
  const auto rename = [&](std::string& name) {
    if (name == from) name = to;
  };
  for (std::string& patch : set.patches) rename(patch);
  for (SelectionSet::Edge& edge : set.edges) rename(edge.patch);
  for (SelectionSet::Points& points : set.points) rename(points.patch);
}

QJsonObject toJson(const SelectionSet& set) {
  QJsonObject object{{"name", QString::fromStdString(set.name)}};
  QJsonArray patches, edges, points;
  for (const std::string& patch : set.patches) patches.append(QString::fromStdString(patch));
  for (const SelectionSet::Edge& edge : set.edges)
    edges.append(QJsonArray{QString::fromStdString(edge.patch), fromUtf8(sideName(edge.side))});
  for (const SelectionSet::Points& each : set.points) {
    QJsonArray at;
    for (const auto& [i, j] : each.at) at.append(QJsonArray{i, j});
    points.append(QJsonObject{{"patch", QString::fromStdString(each.patch)},
                              {"u", toJson(each.lines[0])},
                              {"v", toJson(each.lines[1])},
                              {"at", at}});
  }
  if (!patches.isEmpty()) object["patches"] = patches;
  if (!edges.isEmpty()) object["edges"] = edges;
  if (!points.isEmpty()) object["points"] = points;
  return object;
}

std::optional<SelectionSet> selectionSetFromJson(const QJsonObject& object) {
  SelectionSet set;
  set.name = object["name"].toString().toStdString();
  if (set.name.empty()) return std::nullopt;
  for (const QJsonValue& patch : object["patches"].toArray())
    set.patches.push_back(patch.toString().toStdString());
  for (const QJsonValue& value : object["edges"].toArray()) {
    const QJsonArray edge = value.toArray();
    for (const modeling::Side side : modeling::kSides)
      if (edge[1].toString() == fromUtf8(sideName(side)))
        set.edges.push_back({edge[0].toString().toStdString(), side});
  }
  for (const QJsonValue& value : object["points"].toArray()) {
    const auto points = pointsFrom(value.toObject());
    if (!points) return std::nullopt;
    set.points.push_back(*points);
  }
  return set;
}

}  // namespace palpa::gui


#include "app/gui/base/translate.h"
#include "app/gui/document/editor.h"
#include "app/gui/properties/pages.h"

namespace palpa::gui {
namespace {

std::vector<int> chosenPoints(const Editor& editor) {
  const std::set<int>& points = editor.selection().points;
  return {points.begin(), points.end()};
}

Eigen::Vector3d placeOf(const Editor& editor) {
  const std::vector<int> points = chosenPoints(editor);
  if (points.empty() || !editor.solid()) return Eigen::Vector3d::Zero();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int point : points) sum += editor.solid()->controlPoints()[point];
  return sum / static_cast<double>(points.size());
}

/// "right: row 2, column 0", one line for each patch that uses the point.
QString netsOf(const Editor& editor) {
  const std::vector<int> points = chosenPoints(editor);
  QStringList places;
  if (points.size() != 1 || !editor.solid()) return {};
  for (const modeling::Patch& patch : editor.solid()->patches())
    for (std::size_t i = 0; i < patch.net.size(); ++i)
      for (std::size_t j = 0; j < patch.net[i].size(); ++j)
        if (patch.net[i][j] == points.front())
          places.push_back(
              tr("%1: u %2, v %3").arg(QString::fromStdString(patch.name)).arg(i).arg(j));
  return places.join('\n');
}

QString extentOf(const PropertyPage& page) {
  const Editor& editor = page.editor();
  const modeling::Solid* solid = editor.solid();
  if (!solid || editor.selection().points.empty()) return {};
  Eigen::Vector3d low = solid->controlPoints()[*editor.selection().points.begin()];
  Eigen::Vector3d high = low;
  for (int point : editor.selection().points) {
    low = low.cwiseMin(solid->controlPoints()[point]);
    high = high.cwiseMax(solid->controlPoints()[point]);
  }
  const Eigen::Vector3d size = high - low;
  return QStringList{page.shownLength(size.x()), page.shownLength(size.y()),
                     page.shownLength(size.z())}
      .join(QStringLiteral(" × "));
}

}  // namespace

void addPointRows(PropertyPage& page) {
  Editor& editor = page.editor();
  const bool isOne = editor.selection().points.size() == 1;
  page.addSection(isOne ? tr("Control point") : tr("Control points"));
  if (isOne) {
    page.addFact(tr("Number"), "number", [&editor] {
      const std::vector<int> points = chosenPoints(editor);
      return points.empty() ? QString() : QString::number(points.front());
    });
    page.addVector(
        tr("&Position x, y, z"), "position", Quantity::kLength,
        [&editor] { return placeOf(editor); },
        [&editor](const Eigen::Vector3d& to) {
          return editor.perform(modeling::MovePoints{
              modeling::PointSelection::of(chosenPoints(editor)), modeling::MoveTo{{to}}, {}});
        });
    page.addFact(tr("In the nets of"), "nets", [&editor] { return netsOf(editor); });
    return;
  }
  page.addFact(tr("Selected"), "count",
               [&editor] { return QString::number(editor.selection().points.size()); });
  page.addVector(
      tr("&Centre x, y, z"), "centre", Quantity::kLength, [&editor] { return placeOf(editor); },
      [&editor](const Eigen::Vector3d& to) {
        return editor.perform(
            modeling::MovePoints{modeling::PointSelection::of(chosenPoints(editor)),
                                 modeling::MoveBy{to - placeOf(editor)},
                                 {}});
      });
  page.addFact(tr("Extent"), "extent", [&page] { return extentOf(page); });
  page.addNote(tr("Another centre moves all selected points."));
}

}  // namespace palpa::gui

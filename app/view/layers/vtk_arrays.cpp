#include "app/view/layers/vtk_arrays.h"

#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <algorithm>
#include <map>

#include "app/view/camera/bounds.h"

namespace palpa::view {
namespace {

/// Lines whose ends meet at a place where no third line ends, as one line: OpenGL leaves out the
/// last pixel of a line, so that two lines that end at the same place have a gap there.
std::vector<std::vector<int>> joined(const std::vector<std::vector<int>>& lines,
                                     const std::vector<Eigen::Vector3d>& positions) {
  const auto placeOf = [&](int point) {
    const Eigen::Vector3d& place = positions[static_cast<std::size_t>(point)];
    return std::array<double, 3>{place.x(), place.y(), place.z()};
  };
  std::map<std::array<double, 3>, std::vector<std::size_t>> linesAt;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].empty()) continue;
    linesAt[placeOf(lines[i].front())].push_back(i);
    linesAt[placeOf(lines[i].back())].push_back(i);
  }
  std::vector<bool> isUsed(lines.size(), false);
  std::vector<std::vector<int>> result;
  for (std::size_t first = 0; first < lines.size(); ++first) {
    if (isUsed[first] || lines[first].empty()) continue;
    isUsed[first] = true;
    std::vector<int> line = lines[first];
    for (int side = 0; side < 2; ++side) {
      for (;;) {
        const auto place = placeOf(line.back());
        const std::vector<std::size_t>& here = linesAt[place];
        const auto next =
            std::find_if(here.begin(), here.end(), [&](std::size_t i) { return !isUsed[i]; });
        if (here.size() != 2 || next == here.end()) break;
        isUsed[*next] = true;
        std::vector<int> more = lines[*next];
        if (placeOf(more.front()) != place) std::reverse(more.begin(), more.end());
        line.insert(line.end(), more.begin() + 1, more.end());
      }
      std::reverse(line.begin(), line.end());
    }
    result.push_back(std::move(line));
  }
  return result;
}

}  // namespace

void assign(const std::vector<Eigen::Vector3d>& from, vtkFloatArray* to) {
  to->SetNumberOfComponents(3);
  to->SetNumberOfTuples(static_cast<vtkIdType>(from.size()));
  if (!from.empty()) {
    float* target = to->GetPointer(0);
    for (const Eigen::Vector3d& point : from) {
      for (int k = 0; k < 3; ++k) *target++ = static_cast<float>(point[k]);
    }
  }
  to->Modified();
}

void assign(const std::vector<Eigen::Vector3d>& from, vtkPoints* to) {
  assign(from, vtkFloatArray::FastDownCast(to->GetData()));
  to->Modified();
}

vtkSmartPointer<vtkPoints> makeFloatPoints() {
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToFloat();
  return points;
}

std::vector<std::vector<int>> distinctLines(const std::vector<std::vector<int>>& lines,
                                            const std::vector<Eigen::Vector3d>& positions) {
  Bounds bounds;
  for (const Eigen::Vector3d& position : positions) bounds.add(position);
  const double tolerance = bounds.empty() ? 0 : 1e-7 * bounds.size().norm();
  const auto coincide = [&](int i, int j) {
    const Eigen::Vector3d& a = positions[static_cast<std::size_t>(i)];
    const Eigen::Vector3d& b = positions[static_cast<std::size_t>(j)];
    return (a - b).squaredNorm() <= tolerance * tolerance;
  };
  const auto same = [&](const std::vector<int>& a, const std::vector<int>& b) {
    return a.size() == b.size() && (std::equal(a.begin(), a.end(), b.begin(), coincide) ||
                                    std::equal(a.begin(), a.end(), b.rbegin(), coincide));
  };
  std::vector<std::vector<int>> distinct;
  for (const std::vector<int>& line : lines) {
    const bool known =
        std::any_of(distinct.begin(), distinct.end(),
                    [&](const std::vector<int>& other) { return same(line, other); });
    if (!known) distinct.push_back(line);
  }
  return joined(distinct, positions);
}

vtkSmartPointer<vtkCellArray> polylines(const std::vector<std::vector<int>>& lines) {
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  for (const std::vector<int>& line : lines) {
    cells->InsertNextCell(static_cast<int>(line.size()));
    for (const int point : line) cells->InsertCellPoint(point);
  }
  return cells;
}

vtkSmartPointer<vtkCellArray> segments(const std::vector<std::array<int, 2>>& lines) {
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  for (const std::array<int, 2>& line : lines) cells->InsertNextCell({line[0], line[1]});
  return cells;
}

void blendInOrder(vtkActor* actor) {
  actor->ForceOpaqueOn();
}

vtkSmartPointer<vtkActor> makeLineActor(vtkPoints* points, vtkCellArray* lines) {
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(lines);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->ScalarVisibilityOff();
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyLineOffsetParameters(-1, -6);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  blendInOrder(actor);
  return actor;
}

void showLines(vtkActor* actor, const std::vector<std::vector<int>>& lines) {
  vtkPolyData::SafeDownCast(actor->GetMapper()->GetInput())->SetLines(polylines(lines));
  actor->SetVisibility(!lines.empty());
}

void setColour(vtkActor* actor, const Colour& colour) {
  actor->GetProperty()->SetColor(colour[0], colour[1], colour[2]);
}

}  // namespace palpa::view

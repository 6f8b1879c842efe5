#include "app/view/viewport_geometry.h"

#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <algorithm>

#include "app/view/bounds.h"

namespace palpa::view {

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
  return distinct;
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

void setColour(vtkActor* actor, const Colour& colour) {
  actor->GetProperty()->SetColor(colour[0], colour[1], colour[2]);
}

Colour mixed(const Colour& a, const Colour& b, double t) {
  Colour colour;
  for (std::size_t i = 0; i < 3; ++i) colour[i] = (1 - t) * a[i] + t * b[i];
  return colour;
}

}  // namespace palpa::view

#include "app/view/layers/coarse_surface.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkQuadricClustering.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "app/view/layers/vtk_arrays.h"

namespace palpa::view {
namespace {

constexpr double kCells = 15'000;  // of the surface, about; each gets one point
constexpr int kMaxDivisions = 500;

using Place = std::array<float, 3>;

struct PlaceHash {
  std::size_t operator()(const Place& place) const {
    return std::hash<std::string_view>()(
        {reinterpret_cast<const char*>(place.data()), sizeof(place)});
  }
};

/// The distinct places of a body's points.
class Places {
 public:
  explicit Places(const ViewportBody& body) : points_(vtkSmartPointer<vtkPoints>::New()) {
    numbers_.reserve(body.positions.size());
    for (const Eigen::Vector3d& position : body.positions) {
      const Place place = placeOf(position);
      const auto [at, isNew] = known_.try_emplace(place, points_->GetNumberOfPoints());
      if (isNew) points_->InsertNextPoint(place.data());
      numbers_.push_back(at->second);
    }
  }
  vtkPoints* points() const { return points_; }
  /// Number of the place of a point of the body.
  vtkIdType ofPoint(int point) const { return numbers_[static_cast<std::size_t>(point)]; }
  /// Number of a place, which must be one of a point.
  vtkIdType at(const Eigen::Vector3d& position) const { return known_.at(placeOf(position)); }

 private:
  /// Without negative zeros.
  static Place placeOf(const Eigen::Vector3d& point) {
    const Eigen::Vector3f rounded = point.cast<float>();
    return {rounded.x() + 0.0F, rounded.y() + 0.0F, rounded.z() + 0.0F};
  }

  vtkSmartPointer<vtkPoints> points_;
  std::unordered_map<Place, vtkIdType, PlaceHash> known_;
  std::vector<vtkIdType> numbers_;
};

/// The body's triangles between distinct places, and their numbers as scalars of cells.
vtkSmartPointer<vtkPolyData> withoutDuplicates(const ViewportBody& body, const Places& places) {
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkIdTypeArray> numbers;
  for (std::size_t t = 0; t < body.triangles.size(); ++t) {
    const Triangle& corners = body.triangles[t];
    cells->InsertNextCell(
        {places.ofPoint(corners[0]), places.ofPoint(corners[1]), places.ofPoint(corners[2])});
    numbers->InsertNextValue(static_cast<vtkIdType>(t));
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(places.points());
  data->SetPolys(cells);
  data->GetCellData()->SetScalars(numbers);
  return data;
}

/// Twice the area along the normal, mm^2; `t`: points of the body.
Eigen::Vector3d areaVector(const ViewportBody& body, const Triangle& t) {
  const auto corner = [&](int k) { return body.positions[static_cast<std::size_t>(t[k])]; };
  return (corner(1) - corner(0)).cross(corner(2) - corner(0));
}

/// Length of cubes of which the surface passes through about kCells, mm.
double cellSize(const ViewportBody& body) {
  double area = 0;
  for (const Triangle& t : body.triangles) area += 0.5 * areaVector(body, t).norm();
  return std::sqrt(area / kCells);
}

vtkSmartPointer<vtkPolyData> clustered(const ViewportBody& body, const Places& places) {
  const vtkSmartPointer<vtkPolyData> data = withoutDuplicates(body, places);
  const double size = cellSize(body);
  std::array<double, 6> bounds{};
  data->GetBounds(bounds.data());
  const auto divisions = [&](std::size_t axis) {
    const double extent = bounds[2 * axis + 1] - bounds[2 * axis];
    return static_cast<int>(
        std::clamp(std::ceil(extent / size), 1.0, static_cast<double>(kMaxDivisions)));
  };
  vtkNew<vtkQuadricClustering> filter;
  filter->SetInputData(data);
  filter->SetAutoAdjustNumberOfDivisions(false);
  filter->SetNumberOfDivisions(divisions(0), divisions(1), divisions(2));
  filter->SetUseInputPoints(true);
  filter->SetCopyCellData(true);
  filter->Update();
  return filter->GetOutput();
}

/// Takes the values of some tuples of another array.
void gather(vtkDataArray* from, const std::vector<vtkIdType>& which, vtkDataArray* to) {
  to->SetNumberOfComponents(from->GetNumberOfComponents());
  const bool isEmpty = from->GetNumberOfTuples() == 0;
  to->SetNumberOfTuples(isEmpty ? 0 : static_cast<vtkIdType>(which.size()));
  if (!isEmpty)
    for (std::size_t k = 0; k < which.size(); ++k)
      to->SetTuple(static_cast<vtkIdType>(k), which[k], from);
  to->Modified();
}

}  // namespace

CoarseSurface::CoarseSurface() : data_(vtkSmartPointer<vtkPolyData>::New()) {
  data_->SetPoints(makeFloatPoints());
}

void CoarseSurface::setBody(const ViewportBody& body) {
  followed_ = 0;
  triangles_.clear();
  pointOf_.clear();
  triangleOf_.clear();
  if (body.triangles.size() <= kManyTriangles) return;
  const Places places(body);
  const vtkSmartPointer<vtkPolyData> coarse = clustered(body, places);
  auto* numbers = vtkIdTypeArray::FastDownCast(coarse->GetCellData()->GetScalars());
  if (!numbers) return;
  // A place on the border of patches belongs to a point of each of them.
  std::map<std::pair<vtkIdType, int>, int> pointAt;
  for (std::size_t t = 0; t < body.triangles.size(); ++t)
    for (const int corner : body.triangles[t])
      pointAt.try_emplace({places.ofPoint(corner), body.patchOfTriangle[t]}, corner);
  std::unordered_map<int, int> numberOf;  // of a point of the body
  for (vtkIdType t = 0; t < coarse->GetNumberOfPolys(); ++t) {
    vtkIdType count = 0;
    const vtkIdType* corners = nullptr;
    coarse->GetCellPoints(t, count, corners);
    const vtkIdType source = numbers->GetValue(t);
    const int patch = body.patchOfTriangle[static_cast<std::size_t>(source)];
    const Triangle& ofSource = body.triangles[static_cast<std::size_t>(source)];
    Triangle triangle{}, inBody{};
    for (std::size_t k = 0; k < 3; ++k) {
      const vtkIdType place = places.at(Eigen::Map<Eigen::Vector3d>(coarse->GetPoint(corners[k])));
      const auto found = pointAt.find({place, patch});
      // A place of other patches alone: a corner of the triangle that stands for this one.
      inBody[k] = found != pointAt.end() ? found->second : ofSource[k];
      const auto [number, isNew] =
          numberOf.try_emplace(inBody[k], static_cast<int>(pointOf_.size()));
      if (isNew) pointOf_.push_back(inBody[k]);
      triangle[k] = number->second;
    }
    // Clusters may turn a triangle over, which then would be a hole.
    if (areaVector(body, inBody).dot(areaVector(body, ofSource)) < 0)
      std::swap(triangle[1], triangle[2]);
    triangles_.push_back(triangle);
    triangleOf_.push_back(source);
  }
  vtkNew<vtkCellArray> cells;
  for (const Triangle& t : triangles_) cells->InsertNextCell({t[0], t[1], t[2]});
  data_->SetPolys(cells);
}

void CoarseSurface::follow(vtkPolyData* body) {
  if (isEmpty() || body->GetMTime() == followed_) return;
  followed_ = body->GetMTime();
  gather(body->GetPoints()->GetData(), pointOf_, data_->GetPoints()->GetData());
  data_->GetPoints()->Modified();
  vtkPointData* from = body->GetPointData();
  vtkPointData* to = data_->GetPointData();
  for (int k = 0; k < from->GetNumberOfArrays(); ++k) {
    vtkDataArray* array = from->GetArray(k);
    if (array == from->GetNormals()) continue;
    if (!to->HasArray(array->GetName())) {
      vtkNew<vtkFloatArray> own;
      own->SetName(array->GetName());
      to->AddArray(own);
    }
    gather(array, pointOf_, to->GetArray(array->GetName()));
  }
  if (vtkDataArray* colours = body->GetCellData()->GetScalars()) {
    if (!data_->GetCellData()->GetScalars())
      data_->GetCellData()->SetScalars(vtkSmartPointer<vtkDataArray>::Take(colours->NewInstance()));
    gather(colours, triangleOf_, data_->GetCellData()->GetScalars());
  }
  updateNormals();
  data_->Modified();
}

void CoarseSurface::updateNormals() {
  std::vector<Eigen::Vector3d> normals(pointOf_.size(), Eigen::Vector3d::Zero());
  const float* places = vtkFloatArray::FastDownCast(data_->GetPoints()->GetData())->GetPointer(0);
  const auto at = [&](int point) {
    return Eigen::Map<const Eigen::Vector3f>(places + 3 * point).cast<double>().eval();
  };
  for (const Triangle& t : triangles_) {
    const Eigen::Vector3d area = (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0]));
    for (const int corner : t) normals[static_cast<std::size_t>(corner)] += area;
  }
  for (Eigen::Vector3d& normal : normals)
    if (normal.squaredNorm() > 0) normal.normalize();
  vtkPointData* data = data_->GetPointData();
  if (!data->GetNormals()) {
    vtkNew<vtkFloatArray> own;
    own->SetNumberOfComponents(3);
    data->SetNormals(own);
  }
  assign(normals, vtkFloatArray::FastDownCast(data->GetNormals()));
}

}  // namespace palpa::view

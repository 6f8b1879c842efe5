#include "app/view/layers/coarse_surface.h"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "app/view/layers/vtk_arrays.h"
#include "tests/render/shapes.h"

namespace palpa::view {
namespace {

using Eigen::Vector3d;

constexpr double kRadius = 25;

/// A sphere whose halves are two patches. With `isFlat` each triangle has its own points,
/// as mesh bodies have them.
ViewportBody sphere(int n, bool isFlat) {
  const render_tests::Shape shape = render_tests::sphere(kRadius, n);
  ViewportBody body;
  if (!isFlat) body.positions = shape.positions;
  for (const Triangle& t : shape.triangles) {
    const auto corner = [&](int k) { return shape.positions[static_cast<std::size_t>(t[k])]; };
    body.patchOfTriangle.push_back((corner(0) + corner(1) + corner(2)).z() > 0 ? 1 : 0);
    if (!isFlat) {
      body.triangles.push_back(t);
      continue;
    }
    const int first = static_cast<int>(body.positions.size());
    for (int k = 0; k < 3; ++k) body.positions.push_back(corner(k));
    body.triangles.push_back({first, first + 1, first + 2});
  }
  for (const Vector3d& position : body.positions) body.normals.push_back(position.normalized());
  return body;
}

/// The body as SurfaceActor has it: with the height of each point as a field, and colours that are
/// the numbers of patches.
vtkSmartPointer<vtkPolyData> dataOf(const ViewportBody& body) {
  auto data = vtkSmartPointer<vtkPolyData>::New();
  const vtkSmartPointer<vtkPoints> points = makeFloatPoints();
  assign(body.positions, points);
  data->SetPoints(points);
  vtkNew<vtkFloatArray> heights;
  heights->SetName("field");
  for (const Vector3d& position : body.positions)
    heights->InsertNextValue(static_cast<float>(position.z()));
  data->GetPointData()->AddArray(heights);
  vtkNew<vtkUnsignedCharArray> colours;
  for (const int patch : body.patchOfTriangle)
    colours->InsertNextValue(static_cast<unsigned char>(patch));
  data->GetCellData()->SetScalars(colours);
  return data;
}

Vector3d pointOf(vtkPolyData* data, vtkIdType point) {
  return Eigen::Map<Vector3d>(data->GetPoint(point));
}

class LargeBody : public testing::TestWithParam<bool> {
 protected:
  ViewportBody body = sphere(110, GetParam());
  vtkSmartPointer<vtkPolyData> full = dataOf(body);
  CoarseSurface coarse;
};

INSTANTIATE_TEST_SUITE_P(Points, LargeBody, testing::Bool(),
                         [](const auto& parameter) { return parameter.param ? "flat" : "shared"; });

TEST_P(LargeBody, HasFewTrianglesOnItsSurface) {
  ASSERT_GT(body.triangles.size(), CoarseSurface::kManyTriangles);
  coarse.setBody(body);
  ASSERT_FALSE(coarse.isEmpty());
  coarse.follow(full);
  vtkPolyData* data = coarse.data();
  EXPECT_GT(data->GetNumberOfPolys(), 5'000);
  EXPECT_LT(data->GetNumberOfPolys(), 45'000);
  double area = 0;
  for (vtkIdType t = 0; t < data->GetNumberOfPolys(); ++t) {
    vtkIdType count = 0;
    const vtkIdType* corners = nullptr;
    data->GetCellPoints(t, count, corners);
    const Vector3d a = pointOf(data, corners[0]), b = pointOf(data, corners[1]),
                   c = pointOf(data, corners[2]);
    area += 0.5 * (b - a).cross(c - a).norm();
  }
  EXPECT_NEAR(area, 4 * M_PI * kRadius * kRadius, 0.03 * area);
  vtkDataArray* normals = data->GetPointData()->GetNormals();
  for (vtkIdType k = 0; k < data->GetNumberOfPoints(); ++k) {
    const Vector3d place = pointOf(data, k);
    EXPECT_NEAR(place.norm(), kRadius, 1e-3);
    EXPECT_GT(Vector3d(Eigen::Map<Vector3d>(normals->GetTuple3(k))).dot(place), 0.5 * kRadius);
  }
}

TEST_P(LargeBody, CarriesNumbersAndColours) {
  coarse.setBody(body);
  coarse.follow(full);
  vtkPolyData* data = coarse.data();
  vtkDataArray* heights = data->GetPointData()->GetArray("field");
  ASSERT_EQ(heights->GetNumberOfTuples(), data->GetNumberOfPoints());
  for (vtkIdType k = 0; k < data->GetNumberOfPoints(); ++k)
    EXPECT_FLOAT_EQ(heights->GetTuple1(k), data->GetPoint(k)[2]);
  vtkDataArray* colours = data->GetCellData()->GetScalars();
  ASSERT_EQ(colours->GetNumberOfTuples(), data->GetNumberOfPolys());
  std::set<double> found;
  for (vtkIdType t = 0; t < data->GetNumberOfPolys(); ++t) {
    vtkIdType count = 0;
    const vtkIdType* corners = nullptr;
    data->GetCellPoints(t, count, corners);
    double height = 0;
    for (int k = 0; k < 3; ++k) height += data->GetPoint(corners[k])[2] / 3;
    found.insert(colours->GetTuple1(t));
    if (std::abs(height) > 2) {
      EXPECT_EQ(colours->GetTuple1(t), height > 0 ? 1 : 0);
    }
  }
  EXPECT_EQ(found, (std::set<double>{0, 1}));
}

TEST_P(LargeBody, FollowsTheBody) {
  coarse.setBody(body);
  coarse.follow(full);
  std::vector<Vector3d> moved;
  for (const Vector3d& position : body.positions) moved.emplace_back(position.x(), 0, 2 * kRadius);
  assign(moved, full->GetPoints());
  full->Modified();
  coarse.follow(full);
  for (vtkIdType k = 0; k < coarse.data()->GetNumberOfPoints(); ++k)
    EXPECT_EQ(coarse.data()->GetPoint(k)[2], 2 * kRadius);
}

TEST(CoarseSurface, SmallBodiesHaveNone) {
  CoarseSurface coarse;
  coarse.setBody(sphere(30, false));
  EXPECT_TRUE(coarse.isEmpty());
  // Also after a large body.
  coarse.setBody(sphere(110, false));
  EXPECT_FALSE(coarse.isEmpty());
  coarse.setBody(sphere(30, false));
  EXPECT_TRUE(coarse.isEmpty());
}

}  // namespace
}  // namespace palpa::view

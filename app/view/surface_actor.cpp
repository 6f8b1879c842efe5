#include "app/view/surface_actor.h"

#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <cmath>

namespace palpa::view {
namespace {

/// How much of the mark's own colour replaces that of the body.
constexpr double kMarkStrength = 0.82;
/// In the wire picture only marked triangles are drawn, as a tint of this opacity.
constexpr double kTintOpacity = 0.35;

Colour colourOf(Mark mark, const ViewportTheme& theme) {
  switch (mark) {
    case Mark::kSupport:
      return mixed(theme.body, theme.support, kMarkStrength);
    case Mark::kLoad:
      return mixed(theme.body, theme.load, kMarkStrength);
    case Mark::kHovered:
      return mixed(theme.body, theme.hovered, kMarkStrength);
    case Mark::kSelected:
      return mixed(theme.body, theme.selected, kMarkStrength);
    case Mark::kWarning:
      return mixed(theme.body, theme.warning, kMarkStrength);
    case Mark::kNone:
      break;
  }
  return theme.body;
}

std::array<unsigned char, 4> bytes(const Colour& colour, double opacity) {
  const auto byte = [](double value) {
    return static_cast<unsigned char>(std::lround(255 * value));
  };
  return {byte(colour[0]), byte(colour[1]), byte(colour[2]), byte(opacity)};
}

}  // namespace

SurfaceActor::SurfaceActor(vtkRenderer* renderer)
    : points_(makeFloatPoints()),
      normals_(vtkSmartPointer<vtkFloatArray>::New()),
      colours_(vtkSmartPointer<vtkUnsignedCharArray>::New()),
      surface_(vtkSmartPointer<vtkPolyData>::New()),
      body_(vtkSmartPointer<vtkActor>::New()) {
  normals_->SetNumberOfComponents(3);
  colours_->SetNumberOfComponents(4);
  surface_->SetPoints(points_);
  surface_->GetPointData()->SetNormals(normals_);
  surface_->GetCellData()->SetScalars(colours_);

  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface_);
  mapper->SetScalarModeToUseCellData();
  mapper->SetColorModeToDirectScalars();
  // Pushed back behind the lines and handles on it, also where it is seen at a grazing angle.
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(2, 2);
  body_->SetMapper(mapper);
  vtkProperty* property = body_->GetProperty();
  property->SetInterpolationToPhong();
  property->SetAmbient(0.50);
  property->SetDiffuse(0.56);
  property->SetSpecular(0.10);
  property->SetSpecularPower(24);
  renderer->AddActor(body_);

  vtkNew<vtkCellArray> none;
  borders_ = makeLineActor(points_, none);
  knotLines_ = makeLineActor(points_, none);
  renderer->AddActor(knotLines_);
  renderer->AddActor(borders_);
  setTheme(theme_);
}

void SurfaceActor::setBody(const ViewportBody& body) {
  vtkNew<vtkCellArray> triangles;
  for (const Triangle& t : body.triangles) triangles->InsertNextCell({t[0], t[1], t[2]});
  surface_->SetPolys(triangles);
  const auto setLines = [](vtkActor* actor, const std::vector<std::vector<int>>& lines) {
    vtkPolyData::SafeDownCast(actor->GetMapper()->GetInput())->SetLines(polylines(lines));
  };
  setLines(borders_, distinctLines(body.borders, body.positions));
  setLines(knotLines_, body.knotLines);
  marks_.assign(body.triangles.size(), Mark::kNone);
  move(body.positions, body.normals);
  colourTriangles();
}

void SurfaceActor::move(const std::vector<Eigen::Vector3d>& positions,
                        const std::vector<Eigen::Vector3d>& normals) {
  assign(positions, points_);
  assign(normals, normals_);
}

void SurfaceActor::setMarks(const std::vector<Mark>& marks) {
  marks_ = marks;
  colourTriangles();
}

void SurfaceActor::setShading(Shading shading) {
  shading_ = shading;
  colourTriangles();
  updateLines();
}

void SurfaceActor::setTheme(const ViewportTheme& theme) {
  theme_ = theme;
  colourTriangles();
  updateLines();
}

void SurfaceActor::setPixelRatio(double ratio) {
  pixelRatio_ = ratio;
  updateLines();
}

void SurfaceActor::colourTriangles() {
  const bool wire = shading_ == Shading::kWire;
  std::array<std::array<unsigned char, 4>, 6> palette{};
  for (std::size_t i = 0; i < palette.size(); ++i) {
    const auto mark = static_cast<Mark>(i);
    const double tint = mark == Mark::kNone ? 0 : kTintOpacity;
    palette[i] = bytes(colourOf(mark, theme_), wire ? tint : 1);
  }
  colours_->SetNumberOfTuples(static_cast<vtkIdType>(marks_.size()));
  bool anyMark = false;
  for (std::size_t i = 0; i < marks_.size(); ++i) {
    anyMark = anyMark || marks_[i] != Mark::kNone;
    colours_->SetTypedTuple(static_cast<vtkIdType>(i),
                            palette[static_cast<std::size_t>(marks_[i])].data());
  }
  colours_->Modified();
  surface_->Modified();
  body_->SetVisibility(!wire || anyMark);
}

void SurfaceActor::updateLines() {
  const bool wire = shading_ == Shading::kWire;
  const bool visible = shading_ != Shading::kShaded;
  borders_->SetVisibility(visible);
  knotLines_->SetVisibility(visible);
  // On the plain background lines take the colour of text, which every theme makes readable there.
  for (vtkActor* lines : {borders_.Get(), knotLines_.Get()}) {
    setColour(lines, wire ? theme_.text : theme_.line);
  }
  borders_->GetProperty()->SetLineWidth(static_cast<float>(2 * pixelRatio_));
  borders_->GetProperty()->SetOpacity(0.65);
  knotLines_->GetProperty()->SetLineWidth(static_cast<float>(pixelRatio_));
  knotLines_->GetProperty()->SetOpacity(wire ? 0.35 : 0.22);
}

}  // namespace palpa::view

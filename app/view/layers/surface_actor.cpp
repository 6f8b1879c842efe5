#include "app/view/layers/surface_actor.h"

#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <algorithm>
#include <cmath>

#include "app/view/layers/mark_colours.h"
#include "app/view/scene/colour_map.h"

namespace palpa::view {
namespace {

constexpr double kAmbient = 0.50;
constexpr double kDiffuse = 0.56;
/// Distance between the strokes of the hatching, logical pixels, up to a factor of 1.4 either way.
constexpr double kHatch = 11;
/// The hatching lies in planes across this direction, along which no face of a simple solid lies.
const Eigen::Vector3d kAcrossHatching = Eigen::Vector3d(0.61, 0.55, 0.57).normalized();

}  // namespace

SurfaceActor::SurfaceActor(vtkRenderer* renderer)
    : points_(makeFloatPoints()),
      normals_(vtkSmartPointer<vtkFloatArray>::New()),
      colours_(vtkSmartPointer<vtkUnsignedCharArray>::New()),
      regions_(vtkSmartPointer<vtkFloatArray>::New()),
      field_(vtkSmartPointer<vtkFloatArray>::New()),
      cut_(vtkSmartPointer<vtkFloatArray>::New()),
      surface_(vtkSmartPointer<vtkPolyData>::New()) {
  normals_->SetNumberOfComponents(3);
  colours_->SetNumberOfComponents(4);
  surface_->SetPoints(points_);
  surface_->GetPointData()->SetNormals(normals_);
  surface_->GetCellData()->SetScalars(colours_);
  regions_->SetName("regions");
  regions_->SetNumberOfComponents(4);
  surface_->GetPointData()->AddArray(regions_);
  field_->SetName("field");
  surface_->GetPointData()->AddArray(field_);
  cut_->SetName("cut");
  surface_->GetPointData()->AddArray(cut_);

  body_ = makeSurfaceActor(surface_);
  coarseBody_ = makeSurfaceActor(coarse_.data());
  vtkProperty* property = body_->GetProperty();
  property->SetInterpolationToPhong();
  property->SetAmbient(kAmbient);
  property->SetDiffuse(kDiffuse);
  property->SetSpecular(0.10);
  property->SetSpecularPower(24);
  renderer->AddActor(body_);
  renderer->AddActor(coarseBody_);

  vtkNew<vtkCellArray> none;
  borders_ = makeLineActor(points_, none);
  knotLines_ = makeLineActor(points_, none);
  for (vtkActor* lines : {borders_.Get(), knotLines_.Get()}) {
    vtkPointData* data = vtkPolyData::SafeDownCast(lines->GetMapper()->GetInput())->GetPointData();
    data->AddArray(field_);
    data->AddArray(cut_);
  }
  renderer->AddActor(knotLines_);
  renderer->AddActor(borders_);
  setTheme(theme_);
}

void SurfaceActor::setBody(const ViewportBody& body) {
  vtkNew<vtkCellArray> triangles;
  for (const Triangle& t : body.triangles) triangles->InsertNextCell({t[0], t[1], t[2]});
  surface_->SetPolys(triangles);
  coarse_.setBody(body);
  const auto setLines = [](vtkActor* actor, const std::vector<std::vector<int>>& lines) {
    vtkPolyData::SafeDownCast(actor->GetMapper()->GetInput())->SetLines(polylines(lines));
  };
  setLines(borders_, distinctLines(body.borders, body.positions));
  setLines(knotLines_, body.knotLines);
  marks_.assign(body.triangles.size(), Mark::kNone);
  supportField_.clear();
  loadField_.clear();
  conflictField_.clear();
  fieldColours_.reset();
  field_->SetNumberOfTuples(0);
  isCut_ = false;
  cut_->SetNumberOfTuples(0);
  move(body.positions, body.normals);
  colourTriangles();
}

void SurfaceActor::move(const std::vector<Eigen::Vector3d>& positions,
                        const std::vector<Eigen::Vector3d>& normals) {
  assign(positions, points_);
  assign(normals, normals_);
  setRegions(supportField_, loadField_, conflictField_);
}

void SurfaceActor::setRegions(const std::vector<double>& supports, const std::vector<double>& loads,
                              const std::vector<double>& conflict) {
  supportField_ = supports;
  loadField_ = loads;
  conflictField_ = conflict;
  const vtkIdType count = points_->GetNumberOfPoints();
  regions_->SetNumberOfTuples(count);
  // Finite: the differences between neighbouring pixels are taken.
  const auto number = [](const std::vector<double>& field, vtkIdType i) {
    constexpr double kFar = 1e15;
    return field.empty()
               ? 1.0F
               : static_cast<float>(std::clamp(field[static_cast<std::size_t>(i)], -kFar, kFar));
  };
  const float* place = vtkFloatArray::FastDownCast(points_->GetData())->GetPointer(0);
  float* target = count > 0 ? regions_->GetPointer(0) : nullptr;
  for (vtkIdType i = 0; i < count; ++i, place += 3, target += 4) {
    const Eigen::Vector3d point(place[0], place[1], place[2]);
    target[0] = number(supports, i);
    target[1] = number(loads, i);
    target[2] = static_cast<float>(kAcrossHatching.dot(point));
    target[3] = number(conflict, i);
  }
  regions_->Modified();
  surface_->Modified();
  updateRegionLooks();
  updateVisibility();
}

void SurfaceActor::setScale(double millimetresPerPixel) {
  // In steps: the strokes stay on the body while the camera comes nearer.
  const double step = std::exp2(std::round(std::log2(kHatch * millimetresPerPixel)));
  if (step == scale_) return;
  scale_ = step;
  updateRegionLooks();
}

void SurfaceActor::setRegionsVisible(bool visible) {
  regionsVisible_ = visible;
  updateRegionLooks();
  updateVisibility();
}

void SurfaceActor::updateRegionLooks() {
  updateShader();
  SurfaceUniforms uniforms;
  uniforms.hatchStep = scale_;
  uniforms.lineScale = pixelRatio_;
  uniforms.ambient = kAmbient;
  uniforms.diffuse = kDiffuse;
  uniforms.tintOpacity = kTintOpacity;
  uniforms.support = supportColours(theme_, fieldColours_.has_value()).ground;
  uniforms.load = markColour(Mark::kLoad, theme_);
  uniforms.conflict = theme_.warning;
  uniforms.body = theme_.body;
  uniforms.edge = theme_.line;
  for (vtkActor* actor : {body_.Get(), coarseBody_.Get(), borders_.Get(), knotLines_.Get()})
    setUniforms(uniforms, actor);
}

void SurfaceActor::updateVisibility() {
  const bool anyRegion = regionsVisible_ && !(supportField_.empty() && loadField_.empty());
  const bool isShown = isVisible_ && (shading_ != Shading::kWire || anyMark_ || anyRegion);
  const bool isCoarse = isCoarse_ && !coarse_.isEmpty();
  body_->SetVisibility(isShown && !isCoarse);
  coarseBody_->SetVisibility(isShown && isCoarse);
}

void SurfaceActor::setCoarse(bool coarse) {
  isCoarse_ = coarse;
  if (isCoarse_) coarse_.follow(surface_);
  if (isCoarse_) showBothSides(body_->GetProperty(), coarseBody_, coarseLook_);
  updateVisibility();
}

std::size_t SurfaceActor::drawnTriangles() const {
  vtkPolyData* drawn = isCoarse_ && !coarse_.isEmpty() ? coarse_.data() : surface_.Get();
  return static_cast<std::size_t>(drawn->GetNumberOfPolys());
}

void SurfaceActor::setMarks(const std::vector<Mark>& marks) {
  marks_ = marks;
  colourTriangles();
}

void SurfaceActor::setVisible(bool visible) {
  isVisible_ = visible;
  updateVisibility();
  updateLines();
}

void SurfaceActor::setShading(Shading shading) {
  shading_ = shading;
  colourTriangles();
  updateLines();
}

void SurfaceActor::updateShader() {
  SurfaceLook look;
  look.isWire = shading_ == Shading::kWire;
  look.anySupport = regionsVisible_ && !supportField_.empty();
  look.anyLoad = regionsVisible_ && !loadField_.empty();
  look.anyConflict = regionsVisible_ && !conflictField_.empty();
  look.anyMark = anyMark_;
  look.isCut = isCut_;
  look.field = fieldColours_;
  if (look == look_) return;
  look_ = look;
  for (vtkActor* actor : {body_.Get(), coarseBody_.Get()}) applyShader(look, actor);
  for (vtkActor* lines : {borders_.Get(), knotLines_.Get()}) {
    applyLineShader(look.isWire ? look.field : std::nullopt, look.isCut, lines);
  }
  // Bodies are closed: the far side is hidden.
  body_->GetProperty()->SetBackfaceCulling(!look.isWire);
}

void SurfaceActor::setCut(const std::vector<double>& distances) {
  isCut_ = !distances.empty();
  cut_->SetNumberOfTuples(static_cast<vtkIdType>(distances.size()));
  float* target = isCut_ ? cut_->GetPointer(0) : nullptr;
  for (const double distance : distances) *target++ = static_cast<float>(distance);
  cut_->Modified();
  surface_->Modified();
  updateRegionLooks();
}

void SurfaceActor::setField(const std::optional<ScalarField>& field) {
  fieldColours_.reset();
  if (field) {
    fieldColours_ = field->colours;
    isLogarithmic_ = field->isLogarithmic;
    setFieldValues(field->values, colourRange(*field));
  }
  updateRegionLooks();
  updateVisibility();
}

void SurfaceActor::setFieldValues(const std::vector<double>& values,
                                  const std::array<double, 2>& range) {
  field_->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  float* target = values.empty() ? nullptr : field_->GetPointer(0);
  if (isLogarithmic_) {
    const double scale = 1 / std::log(range[1] / range[0]);
    for (const double value : values)
      *target++ = placeInColours(std::log(value / range[0]) * scale);
  } else {
    const double scale = 1 / (range[1] - range[0]);
    for (const double value : values) *target++ = placeInColours((value - range[0]) * scale);
  }
  field_->Modified();
  surface_->Modified();
}

void SurfaceActor::setTheme(const ViewportTheme& theme) {
  theme_ = theme;
  colourTriangles();
  updateLines();
}

void SurfaceActor::setPixelRatio(double ratio) {
  pixelRatio_ = ratio;
  updateLines();
  updateRegionLooks();
}

void SurfaceActor::colourTriangles() {
  const bool wire = shading_ == Shading::kWire;
  const MarkPalette palette = markPalette(theme_, wire);
  colours_->SetNumberOfTuples(static_cast<vtkIdType>(marks_.size()));
  anyMark_ = false;
  for (std::size_t i = 0; i < marks_.size(); ++i) {
    anyMark_ = anyMark_ || marks_[i] != Mark::kNone;
    colours_->SetTypedTuple(static_cast<vtkIdType>(i),
                            palette[static_cast<std::size_t>(marks_[i])].data());
  }
  colours_->Modified();
  surface_->Modified();
  // Without marks, as during a simulation, no colours of triangles are looked up.
  for (vtkActor* actor : {body_.Get(), coarseBody_.Get()})
    actor->GetMapper()->SetScalarVisibility(wire || anyMark_);
  // Rounded like the colours of triangles, so that the first mark does not change the body.
  Colour plain{};
  for (std::size_t k = 0; k < 3; ++k) plain[k] = std::round(255 * theme_.body[k]) / 255;
  body_->GetProperty()->SetAmbientColor(plain.data());
  body_->GetProperty()->SetDiffuseColor(plain.data());
  updateVisibility();
  updateRegionLooks();
}

void SurfaceActor::updateLines() {
  const bool wire = shading_ == Shading::kWire;
  const bool visible = isVisible_ && shading_ != Shading::kShaded;
  borders_->SetVisibility(visible);
  knotLines_->SetVisibility(visible);
  // On the plain background lines take the colour of text, which every theme makes readable there.
  for (vtkActor* lines : {borders_.Get(), knotLines_.Get()})
    setColour(lines, wire ? theme_.text : theme_.line);
  borders_->GetProperty()->SetLineWidth(static_cast<float>(2 * pixelRatio_));
  borders_->GetProperty()->SetOpacity(0.65);
  knotLines_->GetProperty()->SetLineWidth(static_cast<float>(pixelRatio_));
  knotLines_->GetProperty()->SetOpacity(wire ? 0.35 : 0.22);
}

}  // namespace palpa::view

#include "app/view/surface_actor.h"

#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>
#include <vtkUniforms.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace palpa::view {
namespace {

/// How much of the mark's own colour replaces that of the body.
constexpr double kMarkStrength = 0.82;
/// In the wire picture only marked triangles are drawn, as a tint of this opacity.
constexpr double kTintOpacity = 0.35;

constexpr double kAmbient = 0.50;
constexpr double kDiffuse = 0.56;
/// Distance between the strokes of the hatching, logical pixels, up to a factor of 1.4 either way.
constexpr double kHatch = 11;
/// The hatching lies in planes across this direction, along which no face of a simple solid lies.
const Eigen::Vector3d kAcrossHatching = Eigen::Vector3d(0.61, 0.55, 0.57).normalized();

/// Colours supports and loads exactly up to the line where their numbers are zero, whatever the
/// triangles: the numbers are interpolated to each pixel, and their slope there gives the distance
/// to the border for a line of constant width. Supports are hatched, so that they can be told from
/// loads without colour. The colour of a marked triangle stays visible where it is in a region.
/// Words in capitals stand for true or false: what is not shown is not computed.
constexpr const char* kColourRegions = R"(//VTK::Color::Impl
vec3 plain = ambientColor / ambientPart;
vec3 region = plain;
float strongest = 0.0;
float edge = 0.0;
if (ANY_LOAD) {
  float outside = regionsVSOutput.y / max(fwidth(regionsVSOutput.y), 1e-20);
  strongest = clamp(0.5 - outside, 0.0, 1.0);
  edge = clamp(1.1 * lineScale + 0.5 - abs(outside), 0.0, 1.0);
  region = mix(plain, loadColour, strongest);
}
if (ANY_SUPPORT) {
  float outside = regionsVSOutput.x / max(fwidth(regionsVSOutput.x), 1e-20);
  float inside = clamp(0.5 - outside, 0.0, 1.0);
  float across = regionsVSOutput.z / hatchStep;
  float fromStroke = abs(fract(across) - 0.5) / max(fwidth(across), 1e-6);
  float stroke = clamp(1.3 * lineScale + 0.5 - fromStroke, 0.0, 1.0);
  region = mix(region, mix(supportColour, edgeColour, 0.30 * stroke), inside);
  strongest = max(strongest, inside);
  edge = max(clamp(1.1 * lineScale + 0.5 - abs(outside), 0.0, 1.0), edge * (1.0 - inside));
}
bool isMarked = WIRE ? opacity > 0.01 : distance(plain, bodyColour) > 0.01;
if (isMarked) region = mix(region, plain, 0.6);
if (WIRE) opacity = max(opacity, wireOpacity * strongest);
edge *= 0.75;
region = mix(region, edgeColour, edge);
opacity = max(opacity, edge);
ambientColor = ambientPart * region;
diffuseColor = diffusePart * region;
)";

/// Not in the shaded picture: with it pixels are shaded before they are found to be hidden.
constexpr const char* kDiscardUntinted = "if (opacity < 0.004) discard;\n";

/// The tints of the wire picture let all that lies behind them shine through, and be drawn after
/// them: they count as infinitely far. VTK's own translucent pass divides by the sum of opacities
/// and shows wild colours where that is nearly zero, at the rims.
constexpr const char* kDepthOfTints = R"(//VTK::Depth::Impl
gl_FragDepth = 1.0;
)";

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
      regions_(vtkSmartPointer<vtkFloatArray>::New()),
      surface_(vtkSmartPointer<vtkPolyData>::New()),
      body_(vtkSmartPointer<vtkActor>::New()) {
  normals_->SetNumberOfComponents(3);
  colours_->SetNumberOfComponents(4);
  surface_->SetPoints(points_);
  surface_->GetPointData()->SetNormals(normals_);
  surface_->GetCellData()->SetScalars(colours_);
  regions_->SetName("regions");
  regions_->SetNumberOfComponents(3);
  surface_->GetPointData()->AddArray(regions_);

  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface_);
  mapper->SetScalarModeToUseCellData();
  mapper->SetColorModeToDirectScalars();
  // Pushed back behind the lines and handles on it, also where it is seen at a grazing angle.
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(2, 2);
  mapper->MapDataArrayToVertexAttribute("regionsMC", "regions",
                                        vtkDataObject::FIELD_ASSOCIATION_POINTS);
  body_->SetMapper(mapper);
  blendInOrder(body_);
  vtkShaderProperty* shader = body_->GetShaderProperty();
  shader->AddVertexShaderReplacement("//VTK::Normal::Dec", true,
                                     "//VTK::Normal::Dec\n"
                                     "in vec3 regionsMC;\n"
                                     "out vec3 regionsVSOutput;\n",
                                     false);
  shader->AddVertexShaderReplacement("//VTK::Normal::Impl", true,
                                     "//VTK::Normal::Impl\n"
                                     "regionsVSOutput = regionsMC;\n",
                                     false);
  shader->AddFragmentShaderReplacement("//VTK::Normal::Dec", true,
                                       "//VTK::Normal::Dec\n"
                                       "in vec3 regionsVSOutput;\n",
                                       false);
  vtkProperty* property = body_->GetProperty();
  property->SetInterpolationToPhong();
  property->SetAmbient(kAmbient);
  property->SetDiffuse(kDiffuse);
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
  supportField_.clear();
  loadField_.clear();
  move(body.positions, body.normals);
  colourTriangles();
}

void SurfaceActor::move(const std::vector<Eigen::Vector3d>& positions,
                        const std::vector<Eigen::Vector3d>& normals) {
  assign(positions, points_);
  assign(normals, normals_);
  setRegions(supportField_, loadField_);
}

void SurfaceActor::setRegions(const std::vector<double>& supports,
                              const std::vector<double>& loads) {
  supportField_ = supports;
  loadField_ = loads;
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
  for (vtkIdType i = 0; i < count; ++i, place += 3, target += 3) {
    const Eigen::Vector3d point(place[0], place[1], place[2]);
    target[0] = number(supports, i);
    target[1] = number(loads, i);
    target[2] = static_cast<float>(kAcrossHatching.dot(point));
  }
  regions_->Modified();
  surface_->Modified();
  updateRegionLooks();
  updateVisibility();
}

void SurfaceActor::setScale(double millimetresPerPixel) {
  // In steps: the strokes stay on the body while one comes nearer.
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
  vtkUniforms* uniforms = body_->GetShaderProperty()->GetFragmentCustomUniforms();
  const auto set = [&](const char* name, double value) {
    uniforms->SetUniformf(name, static_cast<float>(value));
  };
  set("hatchStep", scale_);
  set("lineScale", pixelRatio_);
  set("ambientPart", kAmbient);
  set("diffusePart", kDiffuse);
  set("wireOpacity", kTintOpacity);
  const Colour support = colourOf(Mark::kSupport, theme_);
  const Colour load = colourOf(Mark::kLoad, theme_);
  uniforms->SetUniform3f("supportColour", support.data());
  uniforms->SetUniform3f("loadColour", load.data());
  uniforms->SetUniform3f("bodyColour", theme_.body.data());
  uniforms->SetUniform3f("edgeColour", theme_.line.data());
}

void SurfaceActor::updateVisibility() {
  const bool anyRegion = regionsVisible_ && !(supportField_.empty() && loadField_.empty());
  body_->SetVisibility(shading_ != Shading::kWire || anyMark_ || anyRegion);
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

void SurfaceActor::updateShader() {
  const bool isWire = shading_ == Shading::kWire;
  const bool anySupport = regionsVisible_ && !supportField_.empty();
  const bool anyLoad = regionsVisible_ && !loadField_.empty();
  const std::string before =
      std::exchange(shaderKey_, {isWire ? 'w' : '-', anySupport ? 's' : '-', anyLoad ? 'l' : '-'});
  if (shaderKey_ == before) return;
  vtkShaderProperty* shader = body_->GetShaderProperty();
  std::string colours = kColourRegions;
  for (const auto& [word, value] : {std::pair("WIRE", isWire), std::pair("ANY_SUPPORT", anySupport),
                                    std::pair("ANY_LOAD", anyLoad)})
    for (std::size_t at; (at = colours.find(word)) != std::string::npos;)
      colours.replace(at, std::strlen(word), value ? "true" : "false");
  if (isWire) colours += kDiscardUntinted;
  shader->ClearFragmentShaderReplacement("//VTK::Color::Impl", true);
  if (isWire || anySupport || anyLoad)
    shader->AddFragmentShaderReplacement("//VTK::Color::Impl", true, colours, false);
  // Only there: a shader that sets the depth itself is slower.
  if (isWire)
    shader->AddFragmentShaderReplacement("//VTK::Depth::Impl", true, kDepthOfTints, false);
  else
    shader->ClearFragmentShaderReplacement("//VTK::Depth::Impl", true);
  // Bodies are closed: the far side is hidden.
  body_->GetProperty()->SetBackfaceCulling(!isWire);
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
  std::array<std::array<unsigned char, 4>, 6> palette{};
  for (std::size_t i = 0; i < palette.size(); ++i) {
    const auto mark = static_cast<Mark>(i);
    const double tint = mark == Mark::kNone ? 0 : kTintOpacity;
    palette[i] = bytes(colourOf(mark, theme_), wire ? tint : 1);
  }
  colours_->SetNumberOfTuples(static_cast<vtkIdType>(marks_.size()));
  anyMark_ = false;
  for (std::size_t i = 0; i < marks_.size(); ++i) {
    anyMark_ = anyMark_ || marks_[i] != Mark::kNone;
    colours_->SetTypedTuple(static_cast<vtkIdType>(i),
                            palette[static_cast<std::size_t>(marks_[i])].data());
  }
  colours_->Modified();
  surface_->Modified();
  updateVisibility();
  updateRegionLooks();
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

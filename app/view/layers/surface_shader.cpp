#include "app/view/layers/surface_shader.h"

#include <vtkDataObject.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkShaderProperty.h>
#include <vtkUniforms.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "app/view/layers/vtk_arrays.h"
#include "app/view/scene/colour_map.h"

namespace palpa::view {
namespace {

/// Far below all places in the colours: a triangle with one such corner has no colour.
constexpr float kNowhere = -1e6F;
constexpr double kFarthestPlace = 1e3;

/// Colours supports and loads exactly up to the line where their numbers are zero, whatever the
/// triangles: the numbers are interpolated to each pixel, and their slope there gives the distance
/// to the border for a line of constant width. Supports are hatched, so that they can be told from
/// loads without colour. The colour of a marked triangle stays visible where it is in a region.
/// Words in capitals stand for numbers, or for true or false: colours that are not shown are not
/// computed.
constexpr const char* kColourRegions = R"(//VTK::Color::Impl
vec3 plain = ambientColor / ambientPart;
vec3 region = plain;
FIELD_COLOUR
float strongest = 0.0;
float edge = 0.0;
if (ANY_LOAD) {
  float outside = regionsVSOutput.y / max(fwidth(regionsVSOutput.y), 1e-20);
  edge = clamp(1.1 * lineScale + 0.5 - abs(outside), 0.0, 1.0);
  if (!HAS_FIELD) {
    strongest = clamp(0.5 - outside, 0.0, 1.0);
    region = mix(plain, loadColour, strongest);
  }
}
if (ANY_SUPPORT) {
  float outside = regionsVSOutput.x / max(fwidth(regionsVSOutput.x), 1e-20);
  float inside = clamp(0.5 - outside, 0.0, 1.0);
  float across = regionsVSOutput.z / hatchStep;
  float fromStroke = abs(fract(across) - 0.5) / max(fwidth(across), 1e-6);
  float stroke = clamp(1.3 * lineScale + 0.5 - fromStroke, 0.0, 1.0);
  region = mix(region, mix(supportColour, edgeColour, STROKE_STRENGTH * stroke), inside);
  strongest = max(strongest, inside);
  edge = max(clamp(1.1 * lineScale + 0.5 - abs(outside), 0.0, 1.0), edge * (1.0 - inside));
}
if (ANY_CONFLICT) {
  float outside = regionsVSOutput.w / max(fwidth(regionsVSOutput.w), 1e-20);
  float inside = clamp(0.5 - outside, 0.0, 1.0);
  region = mix(region, conflictColour, 0.75 * inside);
  strongest = max(strongest, inside);
  edge = max(clamp(1.8 * lineScale + 0.5 - abs(outside), 0.0, 1.0), edge * (1.0 - inside));
}
if (ANY_MARK) {
  bool isMarked = WIRE ? opacity > 0.01 : distance(plain, bodyColour) > 0.01;
  if (isMarked) region = mix(region, plain, 0.6);
}
if (WIRE) opacity = max(opacity, wireOpacity * strongest);
edge *= 0.75;
region = mix(region, edgeColour, edge);
opacity = max(opacity, edge);
ambientColor = ambientPart * region;
diffuseColor = diffusePart * region;
)";

constexpr const char* kColourLines = R"(//VTK::Color::Impl
vec3 region = ambientColor;
FIELD_COLOUR
ambientColor = region;
diffuseColor = vec3(0.0);
opacity = 1.0;
)";

/// Not in the shaded picture: with it pixels are shaded before they are found to be hidden.
constexpr const char* kDiscardUntinted = "if (opacity < 0.004) discard;\n";

constexpr const char* kDiscardCut = "if (cutVSOutput > 0.0) discard;\n";

/// The tints of the wire picture let all that lies behind them shine through, and be drawn after
/// them: they count as infinitely far. VTK's own translucent pass divides by the sum of opacities
/// and shows wild colours where that is nearly zero, at the rims.
constexpr const char* kDepthOfTints = R"(//VTK::Depth::Impl
gl_FragDepth = 1.0;
)";

/// A colour as GLSL has it.
std::string vec3(const Colour& colour) {
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "vec3(%.6f, %.6f, %.6f)", colour[0], colour[1],
                colour[2]);
  return text.data();
}

/// Sets `region` to the colour of the field. The number is interpolated to each pixel before its
/// colour is looked up: so the colours of the map alone appear, also across large triangles. Where
/// the processor draws, polynomials with constants take a fraction of the time of a table.
std::string fieldColour(ScalarField::Colours colours) {
  const ColourFit fit = fitColours(colours);
  const auto horner = [](const ColourFit::Half& half, const std::string& s) {
    std::string sum = vec3(half.back());
    for (std::size_t i = half.size() - 1; i-- > 0;)
      sum = vec3(half[i]) + " + " + s + " * (" + sum + ")";
    return sum;
  };
  return "float place = 2.0 * clamp(fieldVSOutput, 0.0, 1.0);\n"
         "vec3 lower = " +
         horner(fit.lower, "place") +
         ";\n"
         "place -= 1.0;\n"
         "vec3 upper = " +
         horner(fit.upper, "place") +
         ";\n"
         "vec3 mapped = place > 0.0 ? upper : lower;\n"
         "region = fieldVSOutput > -2000.0 ? mapped : region;\n";
}

void replaceAll(std::string& text, const std::string& word, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += by.size()) {
    text.replace(at, word.size(), by);
  }
}

/// Hands a point array through to the fragment shader under the same name.
void passThrough(const std::vector<std::pair<std::string, std::string>>& typesAndNames,
                 vtkActor* actor) {
  auto* mapper = vtkPolyDataMapper::SafeDownCast(actor->GetMapper());
  mapper->RemoveAllVertexAttributeMappings();
  std::string vertexNames = "//VTK::Normal::Dec\n";
  std::string fragmentNames = vertexNames;
  std::string body = "//VTK::Normal::Impl\n";
  for (const auto& [type, name] : typesAndNames) {
    mapper->MapDataArrayToVertexAttribute((name + "MC").c_str(), name.c_str(),
                                          vtkDataObject::FIELD_ASSOCIATION_POINTS);
    vertexNames += "in " + type + " " + name + "MC;\nout " + type + " " + name + "VSOutput;\n";
    fragmentNames += "in " + type + " " + name + "VSOutput;\n";
    body += name + "VSOutput = " + name + "MC;\n";
  }
  vtkShaderProperty* shader = actor->GetShaderProperty();
  shader->ClearAllVertexShaderReplacements();
  shader->ClearAllFragmentShaderReplacements();
  if (typesAndNames.empty()) return;
  shader->AddVertexShaderReplacement("//VTK::Normal::Dec", true, vertexNames, false);
  shader->AddVertexShaderReplacement("//VTK::Normal::Impl", true, body, false);
  shader->AddFragmentShaderReplacement("//VTK::Normal::Dec", true, fragmentNames, false);
}

}  // namespace

float placeInColours(double share) {
  if (std::isnan(share)) return kNowhere;
  return static_cast<float>(std::clamp(share, -kFarthestPlace, kFarthestPlace));
}

vtkSmartPointer<vtkActor> makeSurfaceActor(vtkPolyData* surface) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface);
  mapper->SetScalarModeToUseCellData();
  mapper->SetColorModeToDirectScalars();
  // Pushed back behind the lines and handles on it, also where it is seen at a grazing angle.
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(2, 2);
  mapper->MapDataArrayToVertexAttribute("regionsMC", "regions",
                                        vtkDataObject::FIELD_ASSOCIATION_POINTS);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  blendInOrder(actor);
  return actor;
}

void showBothSides(vtkProperty* property, vtkActor* actor, vtkMTimeType& copied) {
  if (copied == property->GetMTime()) return;  // a change compiles the shader again
  copied = property->GetMTime();
  actor->GetProperty()->DeepCopy(property);
  actor->GetProperty()->BackfaceCullingOff();
}

void applyShader(const SurfaceLook& look, vtkActor* surface) {
  // In the wire picture the lines take the colours of the field.
  const bool hasField = look.field && !look.isWire;
  std::vector<std::pair<std::string, std::string>> arrays{{"vec4", "regions"}};
  if (hasField) arrays.emplace_back("float", "field");
  if (look.isCut) arrays.emplace_back("float", "cut");
  passThrough(arrays, surface);
  std::string colours = kColourRegions;
  replaceAll(colours, "FIELD_COLOUR", hasField ? fieldColour(*look.field) : "");
  replaceAll(colours, "STROKE_STRENGTH", std::to_string(strokeStrength(hasField)));
  for (const auto& [word, value] :
       {std::pair("HAS_FIELD", hasField), std::pair("WIRE", look.isWire),
        std::pair("ANY_SUPPORT", look.anySupport), std::pair("ANY_LOAD", look.anyLoad),
        std::pair("ANY_CONFLICT", look.anyConflict), std::pair("ANY_MARK", look.anyMark)}) {
    replaceAll(colours, word, value ? "true" : "false");
  }
  if (look.isWire) colours += kDiscardUntinted;
  if (look.isCut) colours += kDiscardCut;
  vtkShaderProperty* shader = surface->GetShaderProperty();
  if (look.isWire || look.anySupport || look.anyLoad || look.anyConflict || look.isCut || hasField)
    shader->AddFragmentShaderReplacement("//VTK::Color::Impl", true, colours, false);
  // Only there: a shader that sets the depth itself is slower.
  if (look.isWire)
    shader->AddFragmentShaderReplacement("//VTK::Depth::Impl", true, kDepthOfTints, false);
}

void applyLineShader(const std::optional<ScalarField::Colours>& field, bool isCut,
                     vtkActor* lines) {
  std::vector<std::pair<std::string, std::string>> arrays;
  if (field) arrays.emplace_back("float", "field");
  if (isCut) arrays.emplace_back("float", "cut");
  passThrough(arrays, lines);
  if (arrays.empty()) return;
  std::string colours = field ? kColourLines : "//VTK::Color::Impl\n";
  if (field) replaceAll(colours, "FIELD_COLOUR", fieldColour(*field));
  if (isCut) colours += kDiscardCut;
  lines->GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Color::Impl", true, colours,
                                                           false);
}

void setUniforms(const SurfaceUniforms& numbers, vtkActor* actor) {
  vtkUniforms* uniforms = actor->GetShaderProperty()->GetFragmentCustomUniforms();
  const auto set = [&](const char* name, double value) {
    uniforms->SetUniformf(name, static_cast<float>(value));
  };
  set("hatchStep", numbers.hatchStep);
  set("lineScale", numbers.lineScale);
  set("ambientPart", numbers.ambient);
  set("diffusePart", numbers.diffuse);
  set("wireOpacity", numbers.tintOpacity);
  uniforms->SetUniform3f("supportColour", numbers.support.data());
  uniforms->SetUniform3f("loadColour", numbers.load.data());
  uniforms->SetUniform3f("conflictColour", numbers.conflict.data());
  uniforms->SetUniform3f("bodyColour", numbers.body.data());
  uniforms->SetUniform3f("edgeColour", numbers.edge.data());
}

}  // namespace palpa::view

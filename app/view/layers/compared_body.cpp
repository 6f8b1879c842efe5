#include "app/view/layers/compared_body.h"

#include <vtkNew.h>
#include <vtkProperty.h>

namespace palpa::view {
namespace {

/// Colours of a field below it stay readable where the surface faces the eye.
constexpr const char* kComparedRim = R"(
float facing = abs(normalVCVSOutput.z);
opacity = mix(0.78, 0.24, smoothstep(0.0, 0.5, facing));
//VTK::Light::Impl
)";

constexpr double kBorderOpacity = 0.95, kHiddenOpacity = 0.35, kBorderWidth = 1.6;

/// Pushed back a little: where both bodies coincide the body is visible, without a pattern of
/// rounding errors.
constexpr const char* kBehindCoincident =
    "gl_Position.z += 0.002 * gl_Position.w;\n"
    "//VTK::Light::Impl\n";

}  // namespace

ComparedBody::ComparedBody(vtkRenderer* scene, vtkRenderer* shineThrough)
    : surface_(scene, {kComparedRim, kBehindCoincident, 0.55, 0.45}) {
  surface_.setColour(kComparedColour);
  for (std::size_t k = 0; k < borders_.size(); ++k) {
    vtkNew<vtkCellArray> none;
    borders_[k] = makeLineActor(surface_.points(), none);
    borders_[k]->GetProperty()->SetOpacity(k == 0 ? kBorderOpacity : kHiddenOpacity);
    borders_[k]->VisibilityOff();
    setColour(borders_[k], kComparedColour);
    (k == 0 ? scene : shineThrough)->AddActor(borders_[k]);
  }
}

void ComparedBody::set(const ViewportBody& body) {
  size_ = body.positions.size();
  surface_.set(body);
  const auto lines = distinctLines(body.borders, body.positions);
  for (vtkActor* actor : borders_) showLines(actor, lines);
  findBounds(body.positions);
}

void ComparedBody::move(const std::vector<Eigen::Vector3d>& positions,
                        const std::vector<Eigen::Vector3d>& normals) {
  surface_.move(positions, normals);
  findBounds(positions);
}

void ComparedBody::findBounds(const std::vector<Eigen::Vector3d>& positions) {
  bounds_ = {};
  for (const Eigen::Vector3d& position : positions) bounds_.add(position);
}

void ComparedBody::setPixelRatio(double ratio) {
  for (vtkActor* actor : borders_)
    actor->GetProperty()->SetLineWidth(static_cast<float>(kBorderWidth * ratio));
}

}  // namespace palpa::view

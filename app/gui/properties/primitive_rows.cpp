#include <array>

#include "app/gui/base/overloaded.h"
#include "app/gui/base/translate.h"
#include "app/gui/dialogs/profile_dialog.h"
#include "app/gui/document/editor.h"
#include "app/gui/document/naming.h"
#include "app/gui/properties/pages.h"
#include "modeling/shapes/outer_size.h"
#include "modeling/shapes/shape_parameters.h"
#include "modeling/shapes/shape_sketch.h"

namespace palpa::gui {
namespace {

using modeling::Primitive;

/// A length of a shape.
struct Length {
  QString label;
  double* value;
};

std::vector<Length> components(Eigen::Vector3d& vector, const std::array<QString, 3>& labels) {
  return {{labels[0], &vector[0]}, {labels[1], &vector[1]}, {labels[2], &vector[2]}};
}

std::vector<Length> lengthsOf(Primitive& primitive) {
  using namespace modeling;
  using Lengths = std::vector<Length>;
  return std::visit(
      Overloaded{
          [](BoxShape& box) {
            return components(box.size, {tr("Size in x"), tr("Size in y"), tr("Size in z")});
          },
          [](SphereShape& sphere) {
            return Lengths{{tr("Radius"), &sphere.radius}};
          },
          [](EllipsoidShape& ellipsoid) {
            return components(ellipsoid.radii,
                              {tr("Radius in x"), tr("Radius in y"), tr("Radius in z")});
          },
          [](CylinderShape& cylinder) {
            return Lengths{{tr("Radius"), &cylinder.radius}, {tr("Height"), &cylinder.height}};
          },
          [](ConeShape& cone) {
            return Lengths{{tr("Bottom radius"), &cone.bottomRadius},
                           {tr("Top radius"), &cone.topRadius},
                           {tr("Height"), &cone.height}};
          },
          [](CapsuleShape& capsule) {
            return Lengths{{tr("Radius"), &capsule.radius}, {tr("Length"), &capsule.length}};
          },
          [](TorusShape& torus) {
            return Lengths{{tr("Major radius"), &torus.majorRadius},
                           {tr("Minor radius"), &torus.minorRadius}};
          },
          [](RevolveShape&) { return Lengths{}; },
          [](ExtrudeShape& extrude) {
            return Lengths{{tr("Height"), &extrude.height}};
          },
          [](LoftShape&) { return Lengths{}; },
      },
      primitive.shape);
}

/// Changes a copy of the primitive and makes the body from it.
bool remake(Editor& editor, const std::function<void(Primitive&)>& change) {
  if (!editor.project().primitive) return false;
  Primitive primitive = *editor.project().primitive;
  change(primitive);
  return editor.perform(modeling::MakePrimitive{primitive});
}

}  // namespace

void addPrimitiveRows(PropertyPage& page) {
  Editor& editor = page.editor();
  if (!editor.project().primitive) return;
  Primitive shape = *editor.project().primitive;
  page.addSection(bodyTitle(editor.project()), "body");
  const std::vector<Length> lengths = lengthsOf(shape);
  for (std::size_t i = 0; i < lengths.size(); ++i)
    page.addQuantity(
        lengths[i].label, QString("length%1").arg(i), Quantity::kLength,
        [&editor, i] {
          if (!editor.project().primitive) return 0.0;
          Primitive now = *editor.project().primitive;
          const std::vector<Length> values = lengthsOf(now);
          return i < values.size() ? *values[i].value : 0.0;
        },
        [&editor, i](double value) {
          return remake(editor, [&](Primitive& to) { *lengthsOf(to)[i].value = value; });
        });
  if (modeling::hasProfile(shape))
    page.addButton(tr("Edit profile …"), "editProfile", {},
                   [workspace = page.workspace()] { editProfileOfProject(workspace); });
  page.addSlowFact(tr("Outer size"), "outerSize", [&page, &editor]() -> QString {
    if (!editor.project().primitive) return {};
    const Eigen::Vector3d size = modeling::outerSize(*editor.project().primitive);
    return tr("%1 × %2 × %3")
        .arg(page.shownLength(size.x()), page.shownLength(size.y()), page.shownLength(size.z()));
  });
  page.addCount(
      tr("Degree"), "degree", 1, 5,
      [&editor] { return editor.project().primitive ? editor.project().primitive->degree : 3; },
      [&editor](int degree) { return remake(editor, [&](Primitive& to) { to.degree = degree; }); });
  QSpinBox* points = page.addCount(
      tr("Control points"), "controlPoints", 0, modeling::kMaxControlPoints,
      [&editor] {
        return editor.project().primitive ? editor.project().primitive->controlPoints : 0;
      },
      [&editor](int count) {
        return remake(editor, [&](Primitive& to) { to.controlPoints = count; });
      });
  points->setSpecialValueText(tr("automatic"));
  points->setToolTip(tr("Per direction and patch"));
  page.addNote(
      tr("Until a control point is moved, these numbers rebuild the body; supports and loads "
         "stay."));
}

}  // namespace palpa::gui

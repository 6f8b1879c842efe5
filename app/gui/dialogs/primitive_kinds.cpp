#include "app/gui/dialogs/primitive_kinds.h"

#include <QObject>

#include "app/gui/base/translate.h"

namespace palpa::gui {
namespace {

using namespace modeling;

template <class Shape>
PrimitiveLength length(const QString& label, const std::string& inWords, double Shape::*member,
                       bool mayBeZero = false) {
  return {label, inWords, mayBeZero,
          [member](Primitive& p) -> double& { return std::get<Shape>(p.shape).*member; }};
}

template <class Shape>
std::vector<PrimitiveLength> axes(Eigen::Vector3d Shape::*member, const QString& label,
                                  const char* words) {
  std::vector<PrimitiveLength> all;
  for (int axis = 0; axis < 3; ++axis) {
    const QChar letter = QLatin1Char("xyz"[axis]);
    all.push_back({label.arg("&" + QString(letter)), words + std::string(1, "xyz"[axis]), false,
                   [member, axis](Primitive& p) -> double& {
                     return (std::get<Shape>(p.shape).*member)[axis];
                   }});
  }
  return all;
}

/// Curve with uniform clamped knots.
ProfileCurve curve(std::vector<Eigen::Vector2d> points, int degree = 3) {
  ProfileCurve made;
  made.degree = degree;
  const int spans = static_cast<int>(points.size()) - degree;
  made.knots.assign(static_cast<std::size_t>(degree), 0.0);
  for (int i = 0; i <= spans; ++i) made.knots.push_back(i);
  made.knots.insert(made.knots.end(), static_cast<std::size_t>(degree), spans);
  made.points = std::move(points);
  return made;
}

ProfileCurve oval(double a, double b) {
  return curve({{a, 0},
                {a, 0.6 * b},
                {0.6 * a, b},
                {-0.6 * a, b},
                {-1.1 * a, 0},
                {-0.6 * a, -b},
                {0.6 * a, -b},
                {a, -0.6 * b},
                {a, 0}});
}

std::vector<PrimitiveKind::Profile> revolved() {
  const ProfileCurve vase =
      curve({{14, 0}, {24, 8}, {27, 22}, {16, 34}, {10, 44}, {13, 54}, {18, 60}});
  const ProfileCurve dome = curve({{25, 0}, {25, 9}, {21, 18}, {12, 24}, {0, 24}});
  const ProfileCurve spool = curve({{20, 0}, {20, 8}, {9, 12}, {9, 28}, {20, 32}, {20, 40}});
  return {{tr("Vase"), RevolveShape{vase}},
          {tr("Dome"), RevolveShape{dome}},
          {tr("Spool"), RevolveShape{spool}}};
}

std::vector<PrimitiveKind::Profile> extruded() {
  const ProfileCurve bean = curve({{30, 0},
                                   {30, 14},
                                   {14, 22},
                                   {0, 10},
                                   {-14, 22},
                                   {-30, 14},
                                   {-30, -6},
                                   {-14, -18},
                                   {14, -18},
                                   {30, -8},
                                   {30, 0}});
  const ProfileCurve angle =
      curve({{0, 0}, {40, 0}, {40, 12}, {12, 12}, {12, 40}, {0, 40}, {0, 0}}, 1);
  return {{tr("Oval"), ExtrudeShape{oval(25, 15), 20}},
          {tr("Bean"), ExtrudeShape{bean, 15}},
          {tr("Angle, with corners"), ExtrudeShape{angle, 20}}};
}

std::vector<PrimitiveKind::Profile> lofted() {
  const auto loft = [](std::vector<LoftShape::Section> sections) {
    return LoftShape{std::move(sections)};
  };
  return {{tr("Handle"),
           loft({{0, oval(17, 15)}, {25, oval(11, 9)}, {50, oval(14, 12)}, {75, oval(10, 9)}})},
          {tr("Taper"), loft({{0, oval(25, 20)}, {20, oval(18, 15)}, {40, oval(8, 8)}})}};
}

std::vector<PrimitiveKind> makeKinds() {
  std::vector<PrimitiveKind> kinds;
  const auto add = [&kinds](const QString& title, const QString& icon, auto shape,
                            std::vector<PrimitiveLength> lengths,
                            std::vector<PrimitiveKind::Profile> profiles = {}) {
    PrimitiveKind& kind = kinds.emplace_back();
    kind.title = title;
    kind.icon = "shape-" + icon;
    kind.primitive.shape = std::move(shape);
    kind.lengths = std::move(lengths);
    kind.profiles = std::move(profiles);
  };
  add(tr("Box"), "box", BoxShape{}, axes(&BoxShape::size, tr("Size in %1:"), "the size in "));
  add(tr("Sphere"), "sphere", SphereShape{},
      {length(tr("&Radius:"), "the radius", &SphereShape::radius)});
  add(tr("Ellipsoid"), "ellipsoid", EllipsoidShape{},
      axes(&EllipsoidShape::radii, tr("Radius in %1:"), "the radius in "));
  add(tr("Cylinder"), "cylinder", CylinderShape{},
      {length(tr("&Radius:"), "the radius", &CylinderShape::radius),
       length(tr("&Height:"), "the height", &CylinderShape::height)});
  add(tr("Cone"), "cone", ConeShape{},
      {length(tr("&Bottom radius:"), "the bottom radius", &ConeShape::bottomRadius),
       length(tr("&Top radius:"), "the top radius", &ConeShape::topRadius, true),
       length(tr("&Height:"), "the height", &ConeShape::height)});
  add(tr("Capsule"), "capsule", CapsuleShape{},
      {length(tr("&Radius:"), "the radius", &CapsuleShape::radius),
       length(tr("&Length between the half spheres:"), "the length", &CapsuleShape::length)});
  add(tr("Torus"), "torus", TorusShape{},
      {length(tr("&Major radius:"), "the major radius", &TorusShape::majorRadius),
       length(tr("Mi&nor radius:"), "the minor radius", &TorusShape::minorRadius)});
  add(tr("Revolved profile"), "revolved", revolved().front().shape, {}, revolved());
  add(tr("Extruded profile"), "extruded", extruded().front().shape,
      {length(tr("&Height:"), "the height", &ExtrudeShape::height)}, extruded());
  add(tr("Lofted sections"), "lofted", lofted().front().shape, {}, lofted());
  return kinds;
}

}  // namespace

const std::vector<PrimitiveKind>& primitiveKinds() {
  static const std::vector<PrimitiveKind> kinds = makeKinds();
  return kinds;
}

}  // namespace palpa::gui

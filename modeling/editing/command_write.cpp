#include "base/text.h"
#include "modeling/editing/command_file.h"
#include "modeling/editing/command_names.h"
#include "modeling/project/json_values.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

/// Builds `{"key": value, …}`.
class ObjectText {
 public:
  ObjectText& add(const std::string& key, const std::string& value) {
    text_ += (text_.size() > 1 ? ", " : "") + quoted(key) + ": " + value;
    return *this;
  }
  template <class T, class Text>
  ObjectText& addIf(const std::string& key, const std::optional<T>& value, Text write) {
    return value ? add(key, write(*value)) : *this;
  }
  std::string text() const { return text_ + "}"; }

 private:
  std::string text_ = "{";
};

std::string text(int value) {
  return std::to_string(value);
}

std::string text(const MirrorPlane& plane) {
  return ObjectText()
      .add("point_mm", vectorText(plane.point))
      .add("normal", vectorText(plane.normal))
      .text();
}

std::string nested(const std::string& key, const std::string& value) {
  return ObjectText().add(key, value).text();
}

struct PartText {
  std::string operator()(const PointIndices& part) const {
    return listText(part.indices, [](int index) { return text(index); });
  }
  std::string operator()(const PatchPoints& part) const {
    return nested("patches", listText(part.patches, quoted));
  }
  std::string operator()(const SidePoints& part) const {
    return nested("edge", ObjectText()
                              .add("patch", quoted(part.patch))
                              .add("side", quoted(sideKey(part.side)))
                              .text());
  }
  std::string operator()(const NetPoints& part) const {
    const auto row = [](const std::optional<int>& at) { return at ? text(*at) : "\"all\""; };
    return nested(
        "net",
        ObjectText().add("patch", quoted(part.patch)).add("row", listText(part.at, row)).text());
  }
  std::string operator()(const SlabPoints& part) const {
    return nested("half_space", ObjectText()
                                    .add("normal", vectorText(part.normal))
                                    .addIf("above_mm", part.above, numberText)
                                    .addIf("below_mm", part.below, numberText)
                                    .text());
  }
  std::string operator()(const BoxPoints& part) const {
    return nested("box_mm", listText(std::array{part.low, part.high}, vectorText));
  }
  std::string operator()(const BallPoints& part) const {
    return nested("sphere_mm", ObjectText()
                                   .add("center", vectorText(part.center))
                                   .add("radius", numberText(part.radius))
                                   .text());
  }
  std::string operator()(const AllOf& part) const { return nested("all_of", list(part)); }
  std::string operator()(const NoneOf& part) const { return nested("none_of", list(part)); }

  template <class Selections>
  static std::string list(const Selections& part) {
    return listText(part.selections, [](const PointSelection& one) { return toJson(one); });
  }
};

void add(ObjectText& object, const Reach& reach) {
  object.addIf("falloff_mm", reach.falloff, numberText);
  object.addIf("mirror", reach.mirror, [](const MirrorPlane& plane) { return text(plane); });
}

void add(ObjectText& object, const MoveBy& how) {
  object.add("by_mm", vectorText(how.vector));
}
void add(ObjectText& object, const MoveTo& how) {
  object.add("to_mm", listText(how.positions, vectorText));
}
void add(ObjectText& object, const MoveAlongNormal& how) {
  object.add("along_normal_mm", numberText(how.distance));
}

void add(ObjectText& object, const MovePoints& c) {
  object.add("points", toJson(c.points));
  std::visit([&](const auto& how) { add(object, how); }, c.how);
  add(object, c.reach);
}

void add(ObjectText& object, const ScalePoints& c) {
  object.add("points", toJson(c.points)).add("factors", vectorText(c.factors));
  object.addIf("center_mm", c.center, vectorText);
  add(object, c.reach);
}

void add(ObjectText& object, const RotatePoints& c) {
  object.add("points", toJson(c.points)).add("axis", vectorText(c.axis));
  object.add("angle_deg", numberText(c.angleDegrees));
  object.addIf("center_mm", c.center, vectorText);
  add(object, c.reach);
}

void add(ObjectText& object, const AlignPoints& c) {
  object.add("points", toJson(c.points)).addIf("normal", c.normal, vectorText);
  object.addIf("offset_mm", c.offset, numberText);
}

template <class OneDirection>
ObjectText& addDirection(ObjectText& object, const OneDirection& c) {
  return object.add("patch", quoted(c.patch))
      .add("direction", c.direction == 0 ? "\"u\"" : "\"v\"");
}

void add(ObjectText& object, const InsertKnot& c) {
  addDirection(object, c).add("at", numberText(c.at)).add("times", text(c.times));
}

void add(ObjectText& object, const RemoveKnot& c) {
  addDirection(object, c).add("at", numberText(c.at)).add("times", text(c.times));
  object.add("tolerance_mm", numberText(c.tolerance));
}

void add(ObjectText& object, const ElevateDegree& c) {
  addDirection(object, c).add("degree", text(c.degree));
}

void add(ObjectText& object, const Translation& how) {
  object.add("translate_mm", vectorText(how.vector));
}
void add(ObjectText& object, const Rotation& how) {
  object.add("rotate", ObjectText()
                           .add("axis", vectorText(how.axis))
                           .add("angle_deg", numberText(how.angleDegrees))
                           .add("center_mm", vectorText(how.center))
                           .text());
}
void add(ObjectText& object, const Scaling& how) {
  object.add("scale", ObjectText()
                          .add("factors", vectorText(how.factors))
                          .add("center_mm", vectorText(how.center))
                          .text());
}
void add(ObjectText& object, const MirrorPlane& how) {
  object.add("mirror", text(how));
}

void add(ObjectText& object, const TransformSolid& c) {
  std::visit([&](const auto& how) { add(object, how); }, c.how);
}
void add(ObjectText& object, const MakePrimitive& c) {
  object.add("primitive", primitiveText(c.primitive));
}
void add(ObjectText& object, const SetEdge& c) {
  object.add("patch", quoted(c.patch)).add("side", quoted(sideKey(c.side)));
  object.add("smooth", c.smooth ? "true" : "false");
}
void add(ObjectText& object, const AddSupport& c) {
  object.add("support", supportText(c.support));
}
void add(ObjectText& object, const SetSupport& c) {
  object.add("name", quoted(c.name)).add("support", supportText(c.support));
}
void add(ObjectText& object, const AddLoad& c) {
  object.add("load", loadText(c.load));
}
void add(ObjectText& object, const SetLoad& c) {
  object.add("name", quoted(c.name)).add("load", loadText(c.load));
}
void add(ObjectText& object, const AddTouch& c) {
  object.add("touch", touchText(c.touch));
}
void add(ObjectText& object, const SetTouch& c) {
  object.add("name", quoted(c.name)).add("touch", touchText(c.touch));
}
void add(ObjectText& object, const SetMaterial& c) {
  object.add("material", materialText(c.material));
}
void add(ObjectText& object, const SetMesh& c) {
  object.add("mesh", meshText(c.mesh));
}
void add(ObjectText& object, const RenamePatch& c) {
  object.add("patch", quoted(c.patch)).add("name", quoted(c.name));
}
/// RemoveSupport, RemoveLoad, RemoveTouch, RenameProject.
template <class Named>
void add(ObjectText& object, const Named& c) {
  object.add("name", quoted(c.name));
}

}  // namespace

std::string toJson(const PointSelection& selection) {
  return selection.parts.size() == 1 ? std::visit(PartText(), selection.parts.front())
                                     : listText(selection.parts, [](const auto& part) {
                                         return std::visit(PartText(), part);
                                       });
}

std::string toJson(const Command& command) {
  ObjectText object;
  object.add("command", quoted(std::string(kCommandNames[command.index()])));
  std::visit([&](const auto& one) { add(object, one); }, command);
  return object.text();
}

std::string toJson(const std::vector<Command>& commands) {
  std::vector<std::string> lines;
  for (const Command& command : commands) lines.push_back(toJson(command));
  return "{\n  \"commands\": " + linesText(lines, "  ") + "\n}\n";
}

}  // namespace palpa::modeling

#include "modeling/editing/command.h"

namespace palpa::modeling {
namespace {

std::string quoted(const std::string& name) {
  return "\"" + name + "\"";
}

/// "3 control points", or "control points" if the number is unknown without the solid.
std::string pointsText(const PointSelection& selection) {
  if (selection.parts.size() == 1)
    if (const auto* list = std::get_if<PointIndices>(&selection.parts.front()))
      return list->indices.size() == 1 ? "1 control point"
                                       : std::to_string(list->indices.size()) + " control points";
  return "control points";
}

struct Label {
  std::string operator()(const MovePoints& c) const { return "Move " + pointsText(c.points); }
  std::string operator()(const ScalePoints& c) const { return "Scale " + pointsText(c.points); }
  std::string operator()(const RotatePoints& c) const { return "Rotate " + pointsText(c.points); }
  std::string operator()(const AlignPoints& c) const { return "Align " + pointsText(c.points); }
  std::string operator()(const InsertKnot& c) const { return "Insert knot in " + quoted(c.patch); }
  std::string operator()(const RemoveKnot& c) const {
    return "Remove knot from " + quoted(c.patch);
  }
  std::string operator()(const ElevateDegree& c) const {
    return "Raise degree of " + quoted(c.patch);
  }
  std::string operator()(const TransformSolid& c) const {
    constexpr const char* kNames[] = {"Move body", "Rotate body", "Scale body", "Mirror body"};
    return kNames[c.how.index()];
  }
  std::string operator()(const MakePrimitive& c) const {
    constexpr const char* kNames[] = {"box",     "sphere", "ellipsoid",  "cylinder",  "cone",
                                      "capsule", "torus",  "revolution", "extrusion", "loft"};
    static_assert(std::size(kNames) == std::variant_size_v<decltype(Primitive::shape)>);
    return std::string("Make ") + kNames[c.primitive.shape.index()];
  }
  std::string operator()(const SetEdge& c) const {
    return std::string(c.smooth ? "Smooth" : "Sharp") + " edge of " + quoted(c.patch);
  }
  std::string operator()(const AddSupport& c) const {
    return "Add support " + quoted(c.support.name);
  }
  std::string operator()(const SetSupport& c) const { return "Change support " + quoted(c.name); }
  std::string operator()(const RemoveSupport& c) const {
    return "Remove support " + quoted(c.name);
  }
  std::string operator()(const TakeOverlap& c) const {
    return "Take overlap from support " + quoted(c.from);
  }
  std::string operator()(const AddLoad& c) const { return "Add load " + quoted(c.load.name); }
  std::string operator()(const SetLoad& c) const { return "Change load " + quoted(c.name); }
  std::string operator()(const RemoveLoad& c) const { return "Remove load " + quoted(c.name); }
  std::string operator()(const AddTouch& c) const { return "Add touch " + quoted(c.touch.name); }
  std::string operator()(const SetTouch& c) const { return "Change touch " + quoted(c.name); }
  std::string operator()(const RemoveTouch& c) const { return "Remove touch " + quoted(c.name); }
  std::string operator()(const AddMeasurement& c) const {
    return "Add measurement " + quoted(c.measurement.name);
  }
  std::string operator()(const SetMeasurement& c) const {
    return "Change measurement " + quoted(c.name);
  }
  std::string operator()(const RemoveMeasurement& c) const {
    return "Remove measurement " + quoted(c.name);
  }
  std::string operator()(const SetMaterial&) const { return "Change material"; }
  std::string operator()(const SetMesh&) const { return "Change mesh settings"; }
  std::string operator()(const SetDesign& c) const {
    return c.design ? "Change design" : "Remove design";
  }
  std::string operator()(const RenameProject&) const { return "Rename project"; }
  std::string operator()(const RenamePatch& c) const { return "Rename patch " + quoted(c.patch); }
};

}  // namespace

std::string label(const Command& command) {
  return std::visit(Label(), command);
}

}  // namespace palpa::modeling

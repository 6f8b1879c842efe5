#include "modeling/exchange/step_names.h"

#include <STEPConstruct_UnitContext.hxx>
#include <StepBasic_Product.hxx>
#include <StepBasic_ProductDefinition.hxx>
#include <StepBasic_ProductDefinitionFormation.hxx>
#include <StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx.hxx>
#include <StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext.hxx>
#include <StepRepr_GlobalUnitAssignedContext.hxx>
#include <StepShape_Face.hxx>
#include <StepShape_SolidModel.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Iterator.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <cmath>
#include <map>
#include <set>

namespace palpa::modeling {
namespace {

/// Identity of a shape, whatever its placement and orientation.
using Key = const TopoDS_TShape*;

std::string textOf(const Handle(TCollection_HAsciiString) & text) {
  return text.IsNull() ? "" : text->ToCString();
}

/// Empty for the names that OpenCASCADE gives to products without one.
std::string nameOf(const Handle(StepBasic_ProductDefinition) & definition) {
  if (definition->Formation().IsNull() || definition->Formation()->OfProduct().IsNull()) return "";
  const auto product = definition->Formation()->OfProduct();
  const std::string name = textOf(product->Name());
  const std::string found = name.empty() ? textOf(product->Id()) : name;
  return found.starts_with("Open CASCADE STEP translator") ? "" : found;
}

struct NamedSolid {
  TopoDS_Shape shape;
  Key product = nullptr;  // the innermost one that contains the solid
};

class Walk {
 public:
  explicit Walk(const STEPControl_Reader& reader) {
    const auto process = reader.WS()->TransferReader()->TransientProcess();
    for (int i = 1; i <= process->NbMapped(); ++i) {
      const Handle(Standard_Transient) entity = process->Mapped(i);
      const auto solid = Handle(StepShape_SolidModel)::DownCast(entity);
      const auto product = Handle(StepBasic_ProductDefinition)::DownCast(entity);
      if (solid.IsNull() && product.IsNull()) continue;
      const TopoDS_Shape shape = TransferBRep::ShapeResult(process, entity);
      if (shape.IsNull()) continue;
      const Key key = shape.TShape().get();
      if (!solid.IsNull()) solidNames_.try_emplace(key, textOf(solid->Name()));
      if (!product.IsNull()) productNames_.try_emplace(key, nameOf(product));
    }
  }

  void collect(const TopoDS_Shape& shape, Key product) {
    const Key key = shape.TShape().get();
    if (productNames_.count(key)) product = key;
    if (shape.ShapeType() == TopAbs_SOLID) {
      solids_.push_back({shape, product});
      solidsOf_[product].insert(key);
    } else if (shape.ShapeType() < TopAbs_SOLID) {
      for (TopoDS_Iterator part(shape); part.More(); part.Next()) collect(part.Value(), product);
    }
  }

  ShapeNames names() {
    ShapeNames names;
    for (const NamedSolid& solid : solids_) {
      const std::string& product = productNames_[solid.product];
      const std::string& own = solidNames_[solid.shape.TShape().get()];
      const bool isOnly = solidsOf_[solid.product].size() == 1;
      const std::string& name = own.empty() || (isOnly && !product.empty()) ? product : own;
      if (!name.empty()) names.Bind(solid.shape, name);
    }
    return names;
  }

 private:
  std::map<Key, std::string> solidNames_;
  std::map<Key, std::string> productNames_;
  std::vector<NamedSolid> solids_;
  std::map<Key, std::set<Key>> solidsOf_;
};

Handle(StepRepr_GlobalUnitAssignedContext) unitsOf(const Handle(Standard_Transient) & entity) {
  using Plain = StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext;
  using WithUncertainty = StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx;
  if (const auto context = Handle(WithUncertainty)::DownCast(entity); !context.IsNull())
    return context->GlobalUnitAssignedContext();
  if (const auto context = Handle(Plain)::DownCast(entity); !context.IsNull())
    return context->GlobalUnitAssignedContext();
  return Handle(StepRepr_GlobalUnitAssignedContext)::DownCast(entity);
}

}  // namespace

ShapeNames stepSolidNames(const STEPControl_Reader& reader, const TopoDS_Shape& shape) {
  Walk walk(reader);
  walk.collect(shape, nullptr);
  return walk.names();
}

ShapeNames stepFaceNames(const STEPControl_Reader& reader, const TopoDS_Shape& shape) {
  std::map<Key, std::string> found;
  const auto process = reader.WS()->TransferReader()->TransientProcess();
  for (int i = 1; i <= process->NbMapped(); ++i) {
    const auto face = Handle(StepShape_Face)::DownCast(process->Mapped(i));
    if (face.IsNull() || textOf(face->Name()).empty()) continue;
    const TopoDS_Shape result = TransferBRep::ShapeResult(process, face);
    if (!result.IsNull()) found.try_emplace(result.TShape().get(), textOf(face->Name()));
  }
  ShapeNames names;
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  for (int i = 1; i <= faces.Extent(); ++i) {
    const auto name = found.find(faces(i).TShape().get());
    if (name != found.end()) names.Bind(faces(i), name->second);
  }
  return names;
}

double stepLengthUnit(const STEPControl_Reader& reader) {
  double unit = 0.0;
  const auto model = reader.WS()->Model();
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const auto units = unitsOf(model->Value(i));
    if (units.IsNull()) continue;
    STEPConstruct_UnitContext context;
    if (context.ComputeFactors(units) != 0 || !context.LengthDone()) continue;
    const double found = context.LengthFactor();
    if (unit != 0.0 && std::abs(found - unit) > 1e-9 * unit) return 0.0;
    unit = found;
  }
  return unit == 0.0 ? 1.0 : unit;
}

}  // namespace palpa::modeling

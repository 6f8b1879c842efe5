#include "modeling/exchange/cad_export.h"

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepTools.hxx>
#include <IGESBasic_Name.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Static.hxx>
#include <STEPConstruct.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TransferBRep.hxx>
#include <XSControl_TransferWriter.hxx>
#include <XSControl_WorkSession.hxx>
#include <fstream>
#include <stdexcept>

#include "base/atomic_file.h"
#include "modeling/error.h"
#include "modeling/exchange/brep_names.h"
#include "modeling/exchange/file_format.h"
#include "modeling/exchange/opencascade_session.h"
#include "modeling/exchange/solid_shape.h"

namespace palpa::modeling {
namespace {

Handle(TCollection_HAsciiString) text(const std::string& value) {
  return new TCollection_HAsciiString(value.c_str());
}

bool writeStep(const ShapeOfSolid& made, const Solid& solid, const std::string& name,
               const std::filesystem::path& path, const Job& job) {
  STEPControl_Controller::Init();
  Interface_Static::SetCVal("write.step.schema", "AP214IS");
  Interface_Static::SetCVal("write.step.unit", "MM");
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  Interface_Static::SetCVal("write.step.product.name", name.c_str());
  STEPControl_Writer writer;
  const auto progress = makeProgress(job, Phase::kExport);
  if (writer.Transfer(made.shape, STEPControl_ManifoldSolidBrep, Standard_True,
                      progress->Start()) != IFSelect_RetDone)
    return false;
  const auto finder = writer.WS()->TransferWriter()->FinderProcess();
  for (std::size_t p = 0; p < made.faces.size(); ++p) {
    const auto item = STEPConstruct::FindEntity(finder, made.faces[p]);
    if (!item.IsNull()) item->SetName(text(solid.patches()[p].name));
  }
  APIHeaderSection_MakeHeader header(writer.Model());
  header.SetName(text(name));
  header.SetAuthorValue(1, text(""));
  header.SetOrganizationValue(1, text(""));
  header.SetOriginatingSystem(text("Palpa"));
  job.throwIfCancelled();
  return writer.Write(path.c_str()) == IFSelect_RetDone;
}

bool writeIges(const ShapeOfSolid& made, const Solid& solid, const std::string& name,
               const std::filesystem::path& path, const Job& job) {
  IGESControl_Controller::Init();
  Interface_Static::SetCVal("write.iges.unit", "MM");
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  Interface_Static::SetCVal("write.iges.header.product", name.c_str());
  constexpr int kBoundaryRepresentation =
      1;  // faces share edges, instead of loose trimmed surfaces
  IGESControl_Writer writer("MM", kBoundaryRepresentation);
  const auto progress = makeProgress(job, Phase::kExport);
  if (!writer.AddShape(made.shape, progress->Start())) return false;
  const auto finder = writer.TransferProcess();
  for (std::size_t p = 0; p < made.faces.size(); ++p) {
    const auto face = Handle(IGESData_IGESEntity)::DownCast(
        TransferBRep::TransientFromShape(finder, made.faces[p]));
    if (face.IsNull()) continue;
    Handle(IGESBasic_Name) property = new IGESBasic_Name;
    property->Init(1, text(solid.patches()[p].name));
    face->AddProperty(property);
    writer.AddEntity(property);
  }
  writer.ComputeModel();
  job.throwIfCancelled();
  return writer.Write(path.c_str());
}

bool writeBrep(const ShapeOfSolid& made, const Solid& solid, const std::filesystem::path& path) {
  std::ofstream file(path, std::ios::binary);
  BRepTools::Write(made.shape, file, Standard_False, Standard_False,
                   TopTools_FormatVersion_VERSION_1);
  std::vector<std::string> names;
  for (const Patch& patch : solid.patches()) names.push_back(patch.name);
  file << brepNamesText(names);
  file.close();
  return file.good();
}

bool write(FileFormat format, const ShapeOfSolid& made, const Solid& solid, const std::string& name,
           const std::filesystem::path& path, const Job& job) {
  switch (format) {
    case FileFormat::kStep:
      return writeStep(made, solid, name, path, job);
    case FileFormat::kIges:
      return writeIges(made, solid, name, path, job);
    case FileFormat::kBrep:
      return writeBrep(made, solid, path);
    case FileFormat::kProject:
    case FileFormat::kStl:
    case FileFormat::kObj:
    case FileFormat::kPly:
    case FileFormat::kVtp:
    case FileFormat::kPage:
      break;
  }
  throw std::invalid_argument("exportCad: no CAD format");
}

[[noreturn]] void failWriting(const std::filesystem::path& path) {
  throw ModelingError(path.string() +
                          ": cannot be written; check that its folder exists and is writable and "
                          "that the disk is not full. An existing file is unchanged",
                      ModelingError::Kind::kIo);
}

}  // namespace

void exportCad(const Body& body, const std::filesystem::path& path, const std::string& name,
               const Job& job) {
  const FileFormat format = requireFormat(path, isCad);
  const Solid* solid = std::get_if<Solid>(&body);
  if (!solid)
    throw ModelingError(path.string() +
                        ": a mesh body has no spline surface to write to a CAD file; write it to "
                        "STL, OBJ or PLY instead");
  if (solid->patches().empty()) throw ModelingError("the solid has no patches to write");
  job.throwIfCancelled();
  job.report(Phase::kExport, 0.0);

  try {
    AtomicFile file(path);
    const std::filesystem::path& fresh = file.freshPath();
    // OpenCASCADE gives no reason for a failure, so unwritable files are detected in advance.
    if (!std::ofstream(fresh, std::ios::binary).is_open()) failWriting(path);
    const OpenCascadeSession session;
    const bool isWritten =
        write(format, makeShape(*solid), *solid, name.empty() ? "palpa" : name, fresh, job);
    job.throwIfCancelled();
    if (!isWritten) failWriting(path);
    file.commit();
  } catch (const FileError& error) {
    throw ModelingError(error.what(), ModelingError::Kind::kIo);
  } catch (...) {
    rethrowAsModelingError(path.string());
  }
  job.report(Phase::kExport, 1.0);
}

}  // namespace palpa::modeling

#include "modeling/exchange/cad_read.h"

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Reader.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "modeling/error.h"
#include "modeling/exchange/brep_names.h"
#include "modeling/exchange/cad_text_check.h"
#include "modeling/exchange/file_format.h"
#include "modeling/exchange/opencascade_session.h"
#include "modeling/exchange/step_names.h"

namespace palpa::modeling {
namespace {

std::string readText(const std::filesystem::path& path) {
  std::error_code code;
  if (!std::filesystem::exists(path, code))
    throw ModelingError(path.string() + ": there is no such file", ModelingError::Kind::kNotFound);
  if (!std::filesystem::is_regular_file(path, code))
    throw ModelingError(path.string() + ": is not a file; give the name of a file",
                        ModelingError::Kind::kIo);
  const auto size = std::filesystem::file_size(path, code);
  if (!code && size > kMaxCadFile)
    throw ModelingError(path.string() + ": has " + std::to_string(size >> 20) + " MiB; at most " +
                            std::to_string(kMaxCadFile >> 20) + " MiB are read: simplify the part",
                        ModelingError::Kind::kTooLarge);
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file.is_open() || file.bad())
    throw ModelingError(path.string() + ": cannot be read; check its permissions",
                        ModelingError::Kind::kIo);
  return text.str();
}

[[noreturn]] void failReading(const std::filesystem::path& path) {
  throw ModelingError(path.string() +
                      ": OpenCASCADE cannot read the file; it is damaged, or its ending does not "
                      "match its format: export it again");
}

void forEachFace(const TopoDS_Shape& shape, const auto& action) {
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  for (int i = 1; i <= faces.Extent(); ++i) action(i, faces(i));
}

CadContent readStep(const std::filesystem::path& path, const std::string& text, const Job& job) {
  STEPControl_Controller::Init();
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  STEPControl_Reader reader;
  std::istringstream stream(text);
  if (reader.ReadStream("file", stream) != IFSelect_RetDone) failReading(path);
  job.throwIfCancelled();
  const auto progress = makeProgress(job, Phase::kRead);
  reader.TransferRoots(progress->Start());
  job.throwIfCancelled();
  CadContent content{reader.OneShape(), {}, {}, stepLengthUnit(reader), true};
  if (content.shape.IsNull()) return content;
  content.solidNames = stepSolidNames(reader, content.shape);
  content.faceNames = stepFaceNames(reader, content.shape);
  return content;
}

CadContent readIges(const std::filesystem::path& path, const Job& job) {
  IGESControl_Controller::Init();
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  Interface_Static::SetIVal("read.iges.bspline.continuity", 0);  // splines are not changed
  IGESControl_Reader reader;
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) failReading(path);
  job.throwIfCancelled();
  const auto progress = makeProgress(job, Phase::kRead);
  reader.TransferRoots(progress->Start());
  job.throwIfCancelled();
  const auto model = reader.IGESModel();
  CadContent content{reader.OneShape(), {}, {}, model->GlobalSection().UnitValue(), true};
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const auto entity = model->Entity(i);
    if (!entity->HasName()) continue;
    const TopoDS_Shape shape =
        TransferBRep::ShapeResult(reader.WS()->TransferReader()->TransientProcess(), entity);
    if (shape.IsNull()) continue;
    if (shape.ShapeType() == TopAbs_FACE)
      content.faceNames.Bind(shape, entity->NameValue()->ToCString());
    if (shape.ShapeType() == TopAbs_SOLID)
      content.solidNames.Bind(shape, entity->NameValue()->ToCString());
  }
  return content;
}

CadContent readBrep(const std::string& text, const Job& job) {
  CadContent content;
  std::istringstream stream(text);
  const auto progress = makeProgress(job, Phase::kRead);
  BRepTools::Read(content.shape, stream, BRep_Builder(), progress->Start());
  job.throwIfCancelled();
  if (content.shape.IsNull()) return content;
  const std::vector<std::string> names = brepNamesFrom(text);
  forEachFace(content.shape, [&](int index, const TopoDS_Shape& face) {
    if (index <= static_cast<int>(names.size()))
      content.faceNames.Bind(face, names[static_cast<std::size_t>(index) - 1]);
  });
  return content;
}

CadContent readContent(const std::filesystem::path& path, const std::string& text, const Job& job) {
  switch (requireFormat(path, isCad)) {
    case FileFormat::kStep:
      return readStep(path, text, job);
    case FileFormat::kIges:
      return readIges(path, job);
    case FileFormat::kBrep:
      return readBrep(text, job);
    case FileFormat::kProject:
    case FileFormat::kStl:
    case FileFormat::kObj:
    case FileFormat::kPly:
    case FileFormat::kVtp:
    case FileFormat::kPage:
      break;
  }
  throw std::invalid_argument("readCad: no CAD format");
}

}  // namespace

std::string readCadText(const std::filesystem::path& path) {
  const FileFormat format = requireFormat(path, isCad);
  std::string text = readText(path);
  checkCadText(text, format, path.string());
  return text;
}

CadContent readCad(const std::filesystem::path& path, const std::string& text, const Job& job) {
  job.report(Phase::kRead, 0.0);
  CadContent content = readContent(path, text, job);
  if (content.shape.IsNull())
    throw ModelingError(path.string() + ": contains no readable shape; export the part as a solid");
  job.report(Phase::kRead, 1.0);
  return content;
}

}  // namespace palpa::modeling

#include "tests/modeling/cad_files.h"

#include <unistd.h>

#include <BRepGProp.hxx>
#include <BRepTools.hxx>
#include <GProp_GProps.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <atomic>
#include <fstream>
#include <sstream>

#include "modeling/exchange/file_format.h"

namespace palpa::modeling::tests {

Folder::Folder() {
  static std::atomic<int> count = 0;
  path_ = std::filesystem::temp_directory_path() /
          ("palpa-cad-" + std::to_string(getpid()) + "-" + std::to_string(count++));
  std::filesystem::create_directories(path_);
}

Folder::~Folder() {
  std::error_code code;
  std::filesystem::remove_all(path_, code);
}

void writeForeign(const TopoDS_Shape& shape, const std::filesystem::path& path,
                  const std::string& stepUnit) {
  Message::DefaultMessenger()->ChangePrinters().Clear();
  switch (requireFormat(path, isCad)) {
    case FileFormat::kStep: {
      STEPControl_Controller::Init();
      Interface_Static::SetCVal("write.step.unit", stepUnit.c_str());
      STEPControl_Writer writer;
      writer.Transfer(shape, STEPControl_AsIs);
      writer.Write(path.c_str());
      Interface_Static::SetCVal("write.step.unit", "MM");
      break;
    }
    case FileFormat::kIges: {
      IGESControl_Controller::Init();
      IGESControl_Writer writer("MM", 0);  // separate trimmed surfaces, as in most IGES files
      writer.AddShape(shape);
      writer.ComputeModel();
      writer.Write(path.c_str());
      break;
    }
    case FileFormat::kBrep:
      BRepTools::Write(shape, path.c_str());
      break;
    case FileFormat::kProject:
    case FileFormat::kStl:
    case FileFormat::kObj:
    case FileFormat::kPly:
    case FileFormat::kVtp:
    case FileFormat::kPage:
      throw std::invalid_argument("writeForeign: no CAD format");
  }
}

std::string readText(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

void writeText(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

testing::AssertionResult says(const std::string& message, const std::string& words) {
  if (message.find(words) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "\"" << message << "\" does not say \"" << words << "\"";
}

double volumeOf(const TopoDS_Shape& shape) {
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties, 1e-8);
  return properties.Mass();
}

double areaOf(const TopoDS_Shape& shape) {
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(shape, properties, 1e-8);
  return properties.Mass();
}

}  // namespace palpa::modeling::tests

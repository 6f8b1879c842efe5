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

#include "modeling/exchange/cad_format.h"

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
  switch (cadFormatOf(path).value()) {
    case CadFormat::kStep: {
      STEPControl_Controller::Init();
      Interface_Static::SetCVal("write.step.unit", stepUnit.c_str());
      STEPControl_Writer writer;
      writer.Transfer(shape, STEPControl_AsIs);
      writer.Write(path.c_str());
      Interface_Static::SetCVal("write.step.unit", "MM");
      break;
    }
    case CadFormat::kIges: {
      IGESControl_Controller::Init();
      IGESControl_Writer writer("MM", 0);  // loose trimmed surfaces, the usual IGES file
      writer.AddShape(shape);
      writer.ComputeModel();
      writer.Write(path.c_str());
      break;
    }
    case CadFormat::kBrep:
      BRepTools::Write(shape, path.c_str());
      break;
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

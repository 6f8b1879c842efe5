#include "app/view/png.h"

#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPNGWriter.h>

#include "app/view/errors.h"

namespace palpa::view {

void writePng(vtkImageData* image, const std::filesystem::path& path) {
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(image);
  // VTK reports a failed write on its own error channel; the exception below says it in words.
  vtkObject::GlobalWarningDisplayOff();
  writer->Write();
  vtkObject::GlobalWarningDisplayOn();
  if (writer->GetErrorCode() != 0 || !std::filesystem::exists(path)) {
    throw ViewError("cannot write the picture " + path.string() +
                    "; check that its folder exists and can be written");
  }
}

}  // namespace palpa::view

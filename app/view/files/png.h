#pragma once

#include <vtkImageData.h>

#include <filesystem>

/// Picture files. Internal to app/view.
namespace palpa::view {

/// Throws ViewError when the file cannot be written.
void writePng(vtkImageData* image, const std::filesystem::path& path);

}  // namespace palpa::view

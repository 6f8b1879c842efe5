#pragma once

#include <filesystem>

class vtkRenderWindow;

/// Picture files. Internal to app/view.
namespace palpa::view {

/// Writes the pixels that were drawn last, averaged over blocks of `reduction`² pixels (a divisor
/// of the window's width and height). Throws ViewError if the file cannot be written.
void writePng(vtkRenderWindow* window, const std::filesystem::path& path, int reduction = 1);

}  // namespace palpa::view

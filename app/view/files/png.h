#pragma once

#include <filesystem>
#include <string>

class vtkRenderWindow;

/// Picture files. Internal to app/view.
namespace palpa::view {

/// The pixels that were drawn last as a PNG file, averaged over blocks of `reduction`² pixels (a
/// divisor of the window's width and height).
std::string pngBytes(vtkRenderWindow* window, int reduction = 1);

/// Writes pngBytes(). Throws ViewError if the file cannot be written.
void writePng(vtkRenderWindow* window, const std::filesystem::path& path, int reduction = 1);

}  // namespace palpa::view

#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

class vtkRenderWindow;

/// Picture files. Internal to app/view.
namespace palpa::view {

/// The pixels that were drawn last as a PNG file, averaged over blocks of `reduction`² pixels (a
/// divisor of the window's width and height).
std::string pngBytes(vtkRenderWindow* window, int reduction = 1);

/// Rows of red, green and blue from the bottom.
struct Pixels {
  int width = 0, height = 0;
  std::vector<unsigned char> values;  ///< 3 × width × height
};

/// The pixels that were drawn last, averaged as in pngBytes().
Pixels pixelsOf(vtkRenderWindow* window, int reduction = 1);

/// Images of one height, side by side, as a PNG file.
std::string pngBytes(std::span<const Pixels> images);

/// Writes pngBytes(). Throws ViewError if the file cannot be written.
void writePng(vtkRenderWindow* window, const std::filesystem::path& path, int reduction = 1);

}  // namespace palpa::view

#include "app/view/files/png.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstddef>

#include "app/view/files/errors.h"
#include "base/atomic_file.h"

namespace palpa::view {
namespace {

/// The pixels of an image `width` pixels wide, averaged over blocks.
void reduce(const unsigned char* source, int width, int reduction, Pixels& image) {
  unsigned char* target = image.values.data();
  const int block = reduction * reduction;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (std::size_t channel = 0; channel < 3; ++channel) {
        int sum = 0;
        for (int dy = 0; dy < reduction; ++dy) {
          for (int dx = 0; dx < reduction; ++dx) {
            const auto row = static_cast<std::size_t>(reduction * y + dy);
            const auto column = static_cast<std::size_t>(reduction * x + dx);
            sum += source[3 * (row * static_cast<std::size_t>(width) + column) + channel];
          }
        }
        *target++ = static_cast<unsigned char>((sum + block / 2) / block);
      }
    }
  }
}

}  // namespace

Pixels pixelsOf(vtkRenderWindow* window, int reduction) {
  const int width = window->GetSize()[0], height = window->GetSize()[1];
  vtkNew<vtkUnsignedCharArray> drawn;
  window->GetPixelData(0, 0, width - 1, height - 1, 1, drawn);
  Pixels pixels{width / reduction, height / reduction, {}};
  pixels.values.resize(3 * static_cast<std::size_t>(pixels.width) *
                       static_cast<std::size_t>(pixels.height));
  reduce(drawn->GetPointer(0), width, reduction, pixels);
  return pixels;
}

std::string pngBytes(std::span<const Pixels> images) {
  int width = 0;
  for (const Pixels& each : images) width += each.width;
  const int height = images.front().height;
  vtkNew<vtkImageData> image;
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* target = static_cast<unsigned char*>(image->GetScalarPointer());
  for (std::ptrdiff_t row = 0; row < height; ++row)
    for (const Pixels& each : images)
      target = std::copy_n(each.values.begin() + 3 * row * each.width, 3 * each.width, target);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* const bytes = writer->GetResult();
  return {reinterpret_cast<const char*>(bytes->GetPointer(0)),
          static_cast<std::size_t>(bytes->GetNumberOfValues())};
}

std::string pngBytes(vtkRenderWindow* window, int reduction) {
  const Pixels pixels = pixelsOf(window, reduction);
  return pngBytes(std::span(&pixels, 1));
}

void writePng(vtkRenderWindow* window, const std::filesystem::path& path, int reduction) {
  try {
    replaceFile(pngBytes(window, reduction), path);
  } catch (const FileError&) {
    throw ViewError("cannot write the picture " + path.string() +
                    "; check that its folder exists and can be written");
  }
}

}  // namespace palpa::view

#include "tests/render/compare.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPNGWriter.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace palpa::render_tests {
namespace {

constexpr int kBlock = 6;
constexpr double kMaxBlock = 20;
constexpr double kMean = 0.6;

vtkSmartPointer<vtkImageData> read(const std::filesystem::path& path) {
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

const unsigned char* pixel(vtkImageData* image, int x, int y) {
  return static_cast<const unsigned char*>(image->GetScalarPointer(x, y, 0));
}

/// The mean over a block of the signed difference, the channel that differs most.
double blockDifference(vtkImageData* a, vtkImageData* b, int left, int bottom, int right, int top) {
  std::array<double, 3> sums{};
  for (int y = bottom; y < top; ++y) {
    for (int x = left; x < right; ++x) {
      for (std::size_t channel = 0; channel < 3; ++channel) {
        sums[channel] += pixel(a, x, y)[channel] - pixel(b, x, y)[channel];
      }
    }
  }
  double largest = 0;
  for (const double sum : sums) largest = std::max(largest, std::abs(sum));
  return largest / ((right - left) * (top - bottom));
}

void paint(vtkImageData* image, int left, int bottom, int right, int top, double difference) {
  const auto value = static_cast<unsigned char>(std::clamp(6 * difference, 0.0, 255.0));
  for (int y = bottom; y < top; ++y) {
    for (int x = left; x < right; ++x) {
      auto* target = static_cast<unsigned char*>(image->GetScalarPointer(x, y, 0));
      std::fill(target, target + 3, value);
    }
  }
}

}  // namespace

bool Difference::acceptable() const {
  return sameSize && largestBlock <= kMaxBlock && mean <= kMean;
}

std::string Difference::text() const {
  if (!sameSize) return "the sizes differ";
  std::array<char, 160> line{};
  std::snprintf(line.data(), line.size(),
                "largest block %.1f (at most %.0f), mean %.3f (at most %.1f)", largestBlock,
                kMaxBlock, mean, kMean);
  return line.data();
}

Difference compare(const std::filesystem::path& picture, const std::filesystem::path& baseline,
                   const std::filesystem::path& differencePath) {
  const auto a = read(picture);
  const auto b = read(baseline);
  Difference difference;
  const int width = a->GetDimensions()[0];
  const int height = a->GetDimensions()[1];
  difference.sameSize = width == b->GetDimensions()[0] && height == b->GetDimensions()[1] &&
                        a->GetNumberOfScalarComponents() >= 3 &&
                        b->GetNumberOfScalarComponents() >= 3;
  if (!difference.sameSize) return difference;

  vtkNew<vtkImageData> map;
  map->SetDimensions(width, height, 1);
  map->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  double sum = 0;
  for (int bottom = 0; bottom < height; bottom += kBlock) {
    for (int left = 0; left < width; left += kBlock) {
      const int right = std::min(left + kBlock, width);
      const int top = std::min(bottom + kBlock, height);
      const double block = blockDifference(a, b, left, bottom, right, top);
      paint(map, left, bottom, right, top, block);
      difference.largestBlock = std::max(difference.largestBlock, block);
      sum += block * (right - left) * (top - bottom);
    }
  }
  difference.mean = sum / (static_cast<double>(width) * height);
  if (!differencePath.empty()) {
    vtkNew<vtkPNGWriter> writer;
    writer->SetFileName(differencePath.c_str());
    writer->SetInputData(map);
    writer->Write();
  }
  return difference;
}

}  // namespace palpa::render_tests

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>

#include "modeling/error.h"
#include "modeling/exchange/mesh_reader.h"
#include "modeling/exchange/polygon_soup.h"
#include "modeling/exchange/text_cursor.h"

namespace palpa::modeling {
namespace {

// Structure of binary STL files: header of 80 bytes, number of triangles, then for each triangle
// its normal, three points (all float) and two unused bytes. Numbers are little endian.
constexpr std::size_t kHeader = 84;
constexpr std::size_t kTriangle = 50;
static_assert(std::endian::native == std::endian::little,
              "binary STL is read without conversion of the byte order");

template <class T>
T at(std::string_view bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

std::size_t binarySize(std::string_view bytes) {
  return kHeader + kTriangle * at<std::uint32_t>(bytes, kHeader - sizeof(std::uint32_t));
}

PolygonSoup parseBinary(std::string_view bytes, const Job& job) {
  const auto count = at<std::uint32_t>(bytes, kHeader - sizeof(std::uint32_t));
  if (binarySize(bytes) > bytes.size())
    throw ModelingError(
        "declares " + std::to_string(count) + " triangles, which need " +
        std::to_string(binarySize(bytes)) + " bytes, but has " + std::to_string(bytes.size()) +
        "; it is cut off or not a binary STL file (a text begins with \"solid\"): export it again");
  PolygonSoup soup;
  for (std::size_t t = 0; t < count; ++t) {
    if (t % 65536 == 0) job.throwIfCancelled();
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t offset = kHeader + kTriangle * t + sizeof(float) * 3 * (corner + 1);
      Eigen::Vector3d point;
      for (std::size_t axis = 0; axis < 3; ++axis)
        point[static_cast<int>(axis)] = at<float>(bytes, offset + sizeof(float) * axis);
      if (!point.allFinite())
        throw ModelingError("triangle " + std::to_string(t + 1) +
                            ": a coordinate is not a finite number; export the file again");
      soup.corners.push_back(static_cast<int>(soup.points.size()));
      soup.points.push_back(point);
    }
    soup.closePolygon();
  }
  return soup;
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return result;
}

class TextStl {
 public:
  TextStl(std::string_view text, const Job& job) : cursor_(text), job_(job) {}

  PolygonSoup parse() {
    while (cursor_.nextLine()) {
      if (cursor_.line() % 65536 == 0) job_.throwIfCancelled();
      statement(lower(cursor_.word()));
    }
    if (!soup_.corners.empty() && unfinished() > 0)
      cursor_.fail("the file ends within a facet; it is cut off");
    return std::move(soup_);
  }

 private:
  int unfinished() const {
    return static_cast<int>(soup_.corners.size()) - (soup_.ends.empty() ? 0 : soup_.ends.back());
  }

  void statement(const std::string& keyword) {
    if (keyword == "vertex") {
      Eigen::Vector3d point;
      for (int axis = 0; axis < 3; ++axis) point[axis] = cursor_.number();
      soup_.corners.push_back(static_cast<int>(soup_.points.size()));
      soup_.points.push_back(point);
      if (unfinished() > kMaxPolygonCorners) cursor_.fail("a facet has too many vertices");
    } else if (keyword == "endfacet" || keyword == "endloop") {
      if (unfinished() == 0 && keyword == "endfacet") return;
      if (unfinished() < 3) cursor_.fail("a facet has fewer than three vertices");
      soup_.closePolygon();
      soup_.groups.push_back(group_);
    } else if (keyword == "solid") {
      if (unfinished() > 0) cursor_.fail("a solid begins within a facet");
      const std::string name(cursor_.restOfLine());
      const auto [place, isNew] =
          numbers_.try_emplace(name, static_cast<int>(soup_.groupNames.size()));
      if (isNew) soup_.groupNames.push_back(name);
      group_ = place->second;
    } else if (keyword == "outer" || keyword == "facet") {
      if (unfinished() > 0) cursor_.fail("a facet begins within a facet");
    } else if (!keyword.empty() && keyword != "endsolid") {
      cursor_.fail(excerpt(keyword) + " is not a statement of an STL text");
    }
  }

  TextCursor cursor_;
  const Job& job_;
  PolygonSoup soup_;
  std::map<std::string, int> numbers_;
  int group_ = 0;
};

}  // namespace

PolygonSoup parseStl(std::string_view bytes, const Job& job) {
  // Some programs begin binary files with "solid", too; then the size identifies them.
  const bool isText = lower(bytes.substr(0, 5)) == "solid";
  const bool fits = bytes.size() >= kHeader && binarySize(bytes) == bytes.size();
  if (isText && !fits) return TextStl(bytes, job).parse();
  if (bytes.size() < kHeader)
    throw ModelingError(
        "is not an STL file: it has " + std::to_string(bytes.size()) +
        " bytes and does not begin with \"solid\"; export it again, or correct its ending");
  return parseBinary(bytes, job);
}

}  // namespace palpa::modeling

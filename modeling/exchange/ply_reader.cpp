#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "modeling/error.h"
#include "modeling/exchange/mesh_reader.h"
#include "modeling/exchange/ply_header.h"
#include "modeling/exchange/polygon_soup.h"
#include "modeling/exchange/text_cursor.h"

namespace palpa::modeling {
namespace {

using Type = PlyHeader::Type;

/// Reader of the values of the body, one after the other, in any encoding. A double holds all PLY
/// types exactly.
class Values {
 public:
  explicit Values(const PlyHeader& header)
      : encoding_(header.encoding), rest_(header.body), text_(header.body), lines_(header.lines) {}

  double next(Type type) {
    return encoding_ == PlyHeader::Encoding::kText ? nextWord() : nextBinary(type);
  }

  std::size_t listLength(Type countType, Type itemType) {
    const double length = next(countType);
    const std::size_t itemSize = encoding_ == PlyHeader::Encoding::kText ? 1 : sizeOf(itemType);
    const std::size_t left =
        encoding_ == PlyHeader::Encoding::kText ? text_.rest().size() + kLine : rest_.size();
    if (length < 0.0 || length != std::floor(length) ||
        length * static_cast<double>(itemSize) > static_cast<double>(left))
      fail("a list has an invalid length");
    return static_cast<std::size_t>(length);
  }

  [[noreturn]] void fail(const std::string& what) const {
    if (encoding_ == PlyHeader::Encoding::kText)
      throw ModelingError("line " + std::to_string(lines_ + text_.line()) + ": " + what +
                          "; export the file again");
    throw ModelingError(what + ", " + std::to_string(rest_.size()) +
                        " bytes before the end; export the file again");
  }

 private:
  static constexpr std::size_t kLine = 1U << 20U;  // a list in a text cannot exceed its line

  double nextWord() {
    while (word_.empty()) {
      if (!inLine_ && !text_.nextLine()) fail("the file is cut off");
      inLine_ = true;
      word_ = text_.word();
      if (word_.empty()) inLine_ = false;
    }
    TextCursor one(word_);
    one.nextLine();
    word_ = {};
    try {
      return one.number();
    } catch (const ModelingError& error) {
      const std::string_view message = error.what();
      const std::size_t begin = message.find(": ") + 2;
      fail(std::string(message.substr(begin, message.rfind("; ") - begin)));  // without the remedy
    }
  }

  template <class T>
  double take() {
    std::array<char, sizeof(T)> bytes;
    if (rest_.size() < sizeof(T)) fail("the file is cut off");
    std::memcpy(bytes.data(), rest_.data(), sizeof(T));
    rest_.remove_prefix(sizeof(T));
    const bool isLittle = encoding_ == PlyHeader::Encoding::kLittleEndian;
    if (isLittle != (std::endian::native == std::endian::little))
      std::reverse(bytes.begin(), bytes.end());
    return static_cast<double>(std::bit_cast<T>(bytes));
  }

  double nextBinary(Type type) {
    switch (type) {
      case Type::kInt8:
        return take<std::int8_t>();
      case Type::kUint8:
        return take<std::uint8_t>();
      case Type::kInt16:
        return take<std::int16_t>();
      case Type::kUint16:
        return take<std::uint16_t>();
      case Type::kInt32:
        return take<std::int32_t>();
      case Type::kUint32:
        return take<std::uint32_t>();
      case Type::kFloat32:
        return take<float>();
      case Type::kFloat64:
        return take<double>();
    }
    return 0.0;
  }

  PlyHeader::Encoding encoding_;
  std::string_view rest_;  // binary
  TextCursor text_;
  std::string_view word_;
  bool inLine_ = false;
  int lines_;
};

class PlyBody {
 public:
  PlyBody(const PlyHeader& header, const Job& job) : header_(header), values_(header), job_(job) {}

  PolygonSoup parse() {
    for (const PlyHeader::Element& element : header_.elements) {
      if (element.name == "tristrips")
        throw ModelingError(
            "contains triangle strips, which are not supported; export plain triangles");
      if (element.properties.empty()) continue;
      for (std::uint64_t i = 0; i < element.count; ++i) {
        if (i % 65536 == 0) job_.throwIfCancelled();
        if (element.name == "vertex")
          vertex(element);
        else
          others(element);
      }
    }
    checkIndices();
    return std::move(soup_);
  }

 private:
  void vertex(const PlyHeader::Element& element) {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    std::array<bool, 3> found{};
    for (const PlyHeader::Property& property : element.properties) {
      if (property.countType) {
        skipList(property);
        continue;
      }
      const double value = values_.next(property.type);
      for (int axis = 0; axis < 3; ++axis)
        if (property.name == std::string_view("xyz").substr(axis, 1)) {
          if (!std::isfinite(value)) values_.fail("a coordinate is not a finite number");
          point[axis] = value;
          found[axis] = true;
        }
    }
    if (!found[0] || !found[1] || !found[2])
      throw ModelingError(
          "the element vertex has no properties x, y and z; export the points with them");
    soup_.points.push_back(point);
  }

  void others(const PlyHeader::Element& element) {
    for (const PlyHeader::Property& property : element.properties) {
      const bool isPolygon = element.name == "face" &&
                             (property.name == "vertex_indices" || property.name == "vertex_index");
      if (property.countType && isPolygon)
        polygon(property);
      else if (property.countType)
        skipList(property);
      else
        values_.next(property.type);
    }
  }

  void skipList(const PlyHeader::Property& property) {
    const std::size_t length = values_.listLength(*property.countType, property.type);
    for (std::size_t i = 0; i < length; ++i) values_.next(property.type);
  }

  void polygon(const PlyHeader::Property& property) {
    const std::size_t length = values_.listLength(*property.countType, property.type);
    if (length < 3 || length > kMaxPolygonCorners)
      values_.fail("a polygon has " + std::to_string(length) + " corners, not between 3 and " +
                   std::to_string(kMaxPolygonCorners));
    for (std::size_t i = 0; i < length; ++i) {
      const double index = values_.next(property.type);
      constexpr double kMaxIndex = 2147483647.0;
      if (!(index >= 0.0 && index <= kMaxIndex) || index != std::floor(index))
        values_.fail("a polygon has an invalid corner index");
      soup_.corners.push_back(static_cast<int>(index));
    }
    soup_.closePolygon();
  }

  /// Checks the indices at the end, because faces may precede the vertices.
  void checkIndices() const {
    const auto count = static_cast<int>(soup_.points.size());
    for (int i = 0; i < soup_.polygonCount(); ++i)
      for (int corner : soup_.polygon(i))
        if (corner >= count)
          throw ModelingError("face " + std::to_string(i) + ": there is no vertex " +
                              std::to_string(corner) + "; the file has " + std::to_string(count) +
                              ": export it again");
  }

  const PlyHeader& header_;
  Values values_;
  const Job& job_;
  PolygonSoup soup_;
};

}  // namespace

PolygonSoup parsePly(std::string_view bytes, const Job& job) {
  const PlyHeader header = parsePlyHeader(bytes);
  return PlyBody(header, job).parse();
}

}  // namespace palpa::modeling

#include "modeling/exchange/ply_header.h"

#include <charconv>

#include "modeling/error.h"
#include "modeling/exchange/text_cursor.h"

namespace palpa::modeling {
namespace {

using Type = PlyHeader::Type;

constexpr std::size_t kMaxElements = 64;
constexpr std::size_t kMaxProperties = 256;

Type typeNamed(std::string_view name, const TextCursor& cursor) {
  if (name == "char" || name == "int8") return Type::kInt8;
  if (name == "uchar" || name == "uint8") return Type::kUint8;
  if (name == "short" || name == "int16") return Type::kInt16;
  if (name == "ushort" || name == "uint16") return Type::kUint16;
  if (name == "int" || name == "int32") return Type::kInt32;
  if (name == "uint" || name == "uint32") return Type::kUint32;
  if (name == "float" || name == "float32") return Type::kFloat32;
  if (name == "double" || name == "float64") return Type::kFloat64;
  cursor.fail(excerpt(name) + " is not a type of a PLY file");
}

std::uint64_t count(std::string_view word, const TextCursor& cursor) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || error != std::errc() || end != word.data() + word.size())
    cursor.fail("expected the number of elements, found " + excerpt(word));
  return value;
}

PlyHeader::Property property(TextCursor& cursor) {
  PlyHeader::Property result;
  const std::string_view first = cursor.word();
  if (first == "list") {
    result.countType = typeNamed(cursor.word(), cursor);
    if (*result.countType == Type::kFloat32 || *result.countType == Type::kFloat64)
      cursor.fail("the length of a list must be a whole number");
    result.type = typeNamed(cursor.word(), cursor);
  } else {
    result.type = typeNamed(first, cursor);
  }
  result.name = cursor.word();
  return result;
}

PlyHeader::Encoding encoding(TextCursor& cursor) {
  const std::string_view name = cursor.word();
  if (name == "ascii") return PlyHeader::Encoding::kText;
  if (name == "binary_little_endian") return PlyHeader::Encoding::kLittleEndian;
  if (name == "binary_big_endian") return PlyHeader::Encoding::kBigEndian;
  cursor.fail(excerpt(name) + " is not a format of a PLY file");
}

/// Smallest size of an element in bytes: in a text two per value (a digit and a blank).
std::size_t leastSize(const PlyHeader::Element& element, PlyHeader::Encoding encoding) {
  std::size_t size = 0;
  for (const PlyHeader::Property& one : element.properties)
    size += encoding == PlyHeader::Encoding::kText ? 2 : sizeOf(one.countType.value_or(one.type));
  return size;
}

void checkCounts(const PlyHeader& header) {
  // The last number of a text needs no blank after it.
  std::size_t left = header.body.size() + 1;
  for (const PlyHeader::Element& element : header.elements) {
    const std::size_t size = leastSize(element, header.encoding);
    if (size == 0) continue;
    if (element.count > left / size)
      throw ModelingError(
          "declares " + std::to_string(element.count) + " elements " + excerpt(element.name) +
          ", which need " + std::to_string(size) + " bytes each, but only " +
          std::to_string(header.body.size()) +
          " bytes follow the header; the file is cut off or wrong: export it again");
    left -= element.count * size;
  }
}

}  // namespace

std::size_t sizeOf(Type type) {
  switch (type) {
    case Type::kInt8:
    case Type::kUint8:
      return 1;
    case Type::kInt16:
    case Type::kUint16:
      return 2;
    case Type::kInt32:
    case Type::kUint32:
    case Type::kFloat32:
      return 4;
    case Type::kFloat64:
      return 8;
  }
  return 8;
}

PlyHeader parsePlyHeader(std::string_view bytes) {
  TextCursor cursor(bytes);
  if (!cursor.nextLine() || cursor.word() != "ply")
    throw ModelingError(
        "is not a PLY file: it does not begin with \"ply\"; export it again, or correct its "
        "ending");
  PlyHeader header{};
  bool hasFormat = false;
  while (cursor.nextLine()) {
    const std::string_view keyword = cursor.word();
    if (keyword == "format") {
      header.encoding = encoding(cursor);
      hasFormat = true;
    } else if (keyword == "element") {
      const std::string name(cursor.word());
      header.elements.push_back({name, count(cursor.word(), cursor), {}});
      if (header.elements.size() > kMaxElements) cursor.fail("too many kinds of elements");
    } else if (keyword == "property") {
      if (header.elements.empty()) cursor.fail("a property before the first element");
      auto& properties = header.elements.back().properties;
      properties.push_back(property(cursor));
      if (properties.size() > kMaxProperties) cursor.fail("too many properties");
    } else if (keyword == "end_header") {
      if (!hasFormat) cursor.fail("the header names no format");
      header.lines = cursor.line();
      header.body = cursor.rest();
      checkCounts(header);
      return header;
    } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
      cursor.fail(excerpt(keyword) + " is not a statement of a PLY header");
    }
  }
  throw ModelingError("the PLY header has no end; export the file again");
}

}  // namespace palpa::modeling

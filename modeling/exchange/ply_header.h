#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace palpa::modeling {

/// Header of a PLY file: elements of the body and their encoding.
struct PlyHeader {
  enum class Encoding { kText, kLittleEndian, kBigEndian };
  enum class Type { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

  struct Property {
    std::string name;
    Type type;                      ///< of the value, or of each item of the list
    std::optional<Type> countType;  ///< type of the item count, for lists only
  };
  struct Element {
    std::string name;
    std::uint64_t count;
    std::vector<Property> properties;
  };

  Encoding encoding;
  std::vector<Element> elements;
  int lines;              ///< number of lines of the header
  std::string_view body;  ///< the bytes after the header; refers to the parsed bytes
};

/// Size of a value in bytes.
std::size_t sizeOf(PlyHeader::Type type);

/// Parses a header. Also checks that the body is long enough for the counts, so that callers may
/// allocate memory for them. Throws ModelingError (without the file's name) if the header is
/// malformed.
PlyHeader parsePlyHeader(std::string_view bytes);

}  // namespace palpa::modeling

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace palpa::modeling {

/// The beginning of a PLY file: what follows and how it is stored.
struct PlyHeader {
  enum class Encoding { kText, kLittleEndian, kBigEndian };
  enum class Type { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

  struct Property {
    std::string name;
    Type type;                      ///< of the value, or of each item of the list
    std::optional<Type> countType;  ///< of a list
  };
  struct Element {
    std::string name;
    std::uint64_t count;
    std::vector<Property> properties;
  };

  Encoding encoding;
  std::vector<Element> elements;
  int lines;              ///< of the header
  std::string_view body;  ///< what follows it
};

/// Bytes of a value.
std::size_t sizeOf(PlyHeader::Type type);

/// Also checks that the body can be long enough for the counts, so that they can be trusted with
/// memory. @throws ModelingError
PlyHeader parsePlyHeader(std::string_view bytes);

}  // namespace palpa::modeling

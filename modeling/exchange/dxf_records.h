#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "modeling/exchange/text_cursor.h"

// Text DXF files: pairs of lines, a group code and its value (AutoCAD DXF reference). Views refer
// to the text of the file. Functions throw ModelingError that names line and record.
namespace palpa::modeling::dxf {

/// Group code and value.
struct Group {
  int code = 0;
  std::string_view value;
  int line = 0;  ///< of the value
};

/// An entity, a variable of the header, or a record of a table: the groups up to the next group 0.
struct Record {
  std::string_view type;
  int line = 0;
  std::vector<Group> groups;

  // Values of the first group with a code. Numbers throw if the value is not a number.
  /// Nothing if the group is missing.
  std::optional<std::string_view> text(int code) const;
  static double number(const Group& group);
  double number(int code, double otherwise) const;
  /// Throws if the group is missing, too.
  double number(int code) const;
  /// Bits 0 … 65535; 0 if the group is missing.
  int flags(int code) const;
  /// x and y, whose codes differ by 10. Throws if one is missing.
  Eigen::Vector2d point(int code) const { return {number(code), number(code + 10)}; }
  /// "line 12: LWPOLYLINE", the beginning of messages.
  std::string place() const;
  [[noreturn]] void fail(const std::string& what) const;
};

/// Reads records one after the other.
class RecordReader {
 public:
  explicit RecordReader(std::string_view text) : text_(text) { nextGroup(); }

  /// False after the last record. A file that ends before EOF is refused.
  bool next(Record& record);

 private:
  void nextGroup();

  TextCursor text_;
  Group group_;
  bool isAtEnd_ = false;
};

/// A name from the file, for messages.
std::string plainText(std::string_view text);

/// Unit of $INSUNITS: its name, and its length in mm. Throws if it is not a length for parts.
std::pair<std::string, double> unitNumbered(int number);

}  // namespace palpa::modeling::dxf

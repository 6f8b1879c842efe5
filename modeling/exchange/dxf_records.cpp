#include "modeling/exchange/dxf_records.h"

#include "base/text.h"
#include "modeling/error.h"

namespace palpa::modeling::dxf {

std::string plainText(std::string_view text) {
  const std::string quoted = excerpt(text);
  return quoted.substr(1, quoted.size() - 2);
}

std::optional<std::string_view> Record::text(int code) const {
  for (const Group& group : groups)
    if (group.code == code) return group.value;
  return std::nullopt;
}

double Record::number(const Group& group) {
  TextCursor cursor(group.value);
  cursor.nextLine();
  try {
    return cursor.number();
  } catch (const ModelingError& error) {
    const std::string what = error.what();
    throw ModelingError("line " + std::to_string(group.line) + what.substr(what.find(':')));
  }
}

double Record::number(int code, double otherwise) const {
  for (const Group& group : groups)
    if (group.code == code) return number(group);
  return otherwise;
}

double Record::number(int code) const {
  for (const Group& group : groups)
    if (group.code == code) return number(group);
  fail("the value with group code " + std::to_string(code) + " is missing");
}

int Record::flags(int code) const {
  const double value = number(code, 0.0);
  if (!(value >= 0.0) || value > 65535.0)
    fail("group code " + std::to_string(code) + ": expected a number from 0 to 65535");
  return static_cast<int>(value);
}

std::string Record::place() const {
  return "line " + std::to_string(line) + ": " + plainText(type);
}

void Record::fail(const std::string& what) const {
  throw ModelingError(place() + ": " + what);
}

bool RecordReader::next(Record& record) {
  if (isAtEnd_) return false;
  if (group_.code != 0)
    throw ModelingError("line " + std::to_string(group_.line - 1) +
                        ": expected group code 0, found " + std::to_string(group_.code));
  record = {group_.value, group_.line, {}};
  if (record.type == "EOF") return false;
  for (nextGroup(); !isAtEnd_ && group_.code != 0; nextGroup()) record.groups.push_back(group_);
  if (isAtEnd_)
    throw ModelingError("line " + std::to_string(group_.line) +
                        ": the file ends before its EOF; it is incomplete");
  return true;
}

void RecordReader::nextGroup() {
  // A comment has the group code 999.
  do {
    if (!text_.nextLine()) {
      isAtEnd_ = true;
      return;
    }
    const int line = text_.line();
    const long long code = text_.integer();
    if (code < -5 || code > 1071)
      throw ModelingError("line " + std::to_string(line) + ": " + std::to_string(code) +
                          " is no group code; this is not a text DXF file");
    if (!text_.nextLine())
      throw ModelingError("line " + std::to_string(line) +
                          ": the file ends before its EOF; it is incomplete");
    group_ = {static_cast<int>(code), text_.restOfLine(), text_.line()};
  } while (group_.code == 999);
}

std::pair<std::string, double> unitNumbered(int number) {
  switch (number) {
    case 0:
      return {"mm (the file states no unit)", 1.0};
    case 1:
      return {"in", 25.4};
    case 2:
      return {"ft", 304.8};
    case 4:
      return {"mm", 1.0};
    case 5:
      return {"cm", 10.0};
    case 6:
      return {"m", 1000.0};
    case 8:
      return {"µin", 25.4e-6};
    case 9:
      return {"mil", 25.4e-3};
    case 10:
      return {"yd", 914.4};
    case 12:
      return {"nm", 1e-6};
    case 13:
      return {"µm", 1e-3};
    case 14:
      return {"dm", 100.0};
    default:
      throw ModelingError("$INSUNITS: the unit number " + std::to_string(number) +
                          " is not a length for parts; use mm (4) or in (1)");
  }
}

}  // namespace palpa::modeling::dxf

#include <array>
#include <charconv>
#include <string_view>

#include "modeling/error.h"
#include "modeling/exchange/cad_text_check.h"

// Structure of IGES files: lines of 80 columns; column 73 names the section (start, global,
// directory, parameter, terminate), columns 74 to 80 hold the number of the line in its section.
// The last line repeats the line counts of the other sections: "S0000001G0000004D0000046P0000040".
namespace palpa::modeling {
namespace {

constexpr std::string_view kSections = "SGDPT";

[[noreturn]] void fail(const std::string& source, std::size_t line, const std::string& what) {
  throw ModelingError(source + ": line " + std::to_string(line) + ": " + what +
                      "; export the file again");
}

int numberIn(std::string_view columns) {
  const std::size_t start = columns.find_first_not_of(" 0");
  if (start == std::string_view::npos) return 0;
  int number = -1;
  std::from_chars(columns.data() + start, columns.data() + columns.size(), number);
  return number;
}

}  // namespace

void checkIgesText(const std::string& text, const std::string& source) {
  std::array<int, 5> count{};
  std::string_view last;
  std::size_t section = 0;
  std::size_t lineNumber = 0;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = text.find('\n', at);
    if (end == std::string::npos) end = text.size();
    std::string_view line = std::string_view(text).substr(at, end - at);
    at = end + 1;
    ++lineNumber;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty() && section == 4) continue;  // blank lines after the end
    if (line.size() < 80)
      fail(source, lineNumber,
           lineNumber == 1 ? "is not an IGES file, whose lines have 80 columns"
                           : "has fewer than 80 columns; the file is damaged or cut off");
    const std::size_t found = kSections.find(line[72]);
    if (found == std::string_view::npos || found < section)
      fail(source, lineNumber, "column 73 names no section (S, G, D, P, T in this order)");
    section = found;
    ++count[section];
    if (numberIn(line.substr(73, 7)) != count[section])
      fail(source, lineNumber, "the number of the line is not " + std::to_string(count[section]));
    last = line;
  }
  if (section != 4) fail(source, lineNumber, "the file is cut off: the section T is missing");
  for (std::size_t s = 0; s < 4; ++s)
    if (last[8 * s] != kSections[s] || numberIn(last.substr(8 * s + 1, 7)) != count[s])
      fail(source, lineNumber,
           std::string("does not agree with the number of lines in section ") + kSections[s]);
}

}  // namespace palpa::modeling

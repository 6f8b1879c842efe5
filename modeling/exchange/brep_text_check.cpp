#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include "modeling/error.h"
#include "modeling/exchange/cad_text_check.h"

// Structure of BREP files: "CASCADE Topology V…", then sections that begin with a heading and the
// number of their entries. Each entry of the last section, TShapes, ends with an asterisk; then the
// location of the whole shape follows. OpenCASCADE loops endlessly if a part is missing.
namespace palpa::modeling {
namespace {

constexpr std::array<std::string_view, 8> kHeadings{
    "Locations", "Curve2ds",       "Curves", "Polygon3D", "PolygonOnTriangulations",
    "Surfaces",  "Triangulations", "TShapes"};

/// The number after the heading at `at`; -1 if there is none.
long countAt(const std::string& text, std::size_t at) {
  while (at < text.size() && text[at] == ' ') ++at;
  long count = -1;
  std::from_chars(text.data() + at, text.data() + text.size(), count);
  return count;
}

}  // namespace

void checkBrepText(const std::string& text, const std::string& source) {
  std::size_t at = text.substr(0, 4096).find("CASCADE Topology V");
  if (at == std::string::npos)
    throw ModelingError(source +
                        ": is not a BREP file; CASCADE Topology is missing at its beginning: "
                        "export it again, or correct its ending");
  long shapes = 0;
  for (const std::string_view heading : kHeadings) {
    const std::size_t found = text.find("\n" + std::string(heading) + " ", at);
    if (found == std::string::npos)
      throw ModelingError(source + ": the file is damaged or cut off: the section " +
                          std::string(heading) + " is missing; export it again");
    at = found + 1 + heading.size();
    shapes = countAt(text, at);
    const long lines = std::count(text.begin() + static_cast<std::ptrdiff_t>(at), text.end(), '\n');
    if (shapes < 0 || shapes > lines)
      throw ModelingError(source + ": the file is damaged: the section " + std::string(heading) +
                          " cannot have the number of entries that it states; export it again");
  }
  std::size_t end = at;
  long ends = 0;
  while (ends < shapes && (end = text.find('*', end)) != std::string::npos) {
    ++ends;
    ++end;
  }
  if (ends < shapes || text.find_first_of("+-", end) == std::string::npos)
    throw ModelingError(source + ": the file is cut off: it has " + std::to_string(ends) + " of " +
                        std::to_string(shapes) + " shapes; export it again");
}

}  // namespace palpa::modeling

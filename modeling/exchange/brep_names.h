#pragma once

#include <string>
#include <vector>

// Names of faces in BREP files. The format has no place for names, so Palpa writes them after the
// shape, which other readers ignore: the line "palpa-face-names N" and then one name per line.
namespace palpa::modeling {

/// Text to append to a BREP file, with one name per face, in the order of the faces.
std::string brepNamesText(const std::vector<std::string>& names);

/// The names at the end of the text of a BREP file; empty if there are none.
std::vector<std::string> brepNamesFrom(const std::string& text);

}  // namespace palpa::modeling

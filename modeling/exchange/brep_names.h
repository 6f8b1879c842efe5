#pragma once

#include <string>
#include <vector>

// BREP files have no place for names. Palpa writes those of the faces behind the shape, where
// other readers do not look: the line "palpa-face-names N" and then one name per line.
namespace palpa::modeling {

std::string brepNamesText(const std::vector<std::string>& names);

/// The names at the end of a BREP file's text; empty when there are none.
std::vector<std::string> brepNamesFrom(const std::string& text);

}  // namespace palpa::modeling

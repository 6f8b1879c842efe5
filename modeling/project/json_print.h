#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <string>

namespace palpa::modeling {

/// JSON with the order of keys in files.
using Json = nlohmann::ordered_json;

/// The text of a value in the layout of files: shortest digits that read back as the same number,
/// negative zero as 0, invalid UTF-8 replaced. Values at the paths in `open` have one entry per
/// line, all others are on one line. The path of the whole is "", of others like
/// "solid.patches[].net". The container of an open value must be open, too.
std::string jsonText(const Json& value, const std::set<std::string>& open = {});

}  // namespace palpa::modeling

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "app/core/page/touch_page.h"

namespace palpa::app {

/// The file of a page: HTML with its style, script and data, which needs nothing else
/// (docs/touchable-page.md).
std::string touchPageText(const TouchPage& page);

/// The errors as they stand in the file and in the report of the command line.
nlohmann::ordered_json toJson(const TouchPage::Errors& errors);

/// Bytes as text of the alphabet of RFC 4648, section 4, with padding.
std::string base64(std::string_view bytes);

}  // namespace palpa::app

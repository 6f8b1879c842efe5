#pragma once

#include <string>
#include <string_view>

#include "app/core/page/touch_page.h"

namespace palpa::app {

/// The file of a page: HTML with its style, script and data, which needs nothing else
/// (docs/touchable-page.md).
std::string touchPageText(const TouchPage& page);

/// Bytes as text of the alphabet of RFC 4648, section 4, with padding.
std::string base64(std::string_view bytes);

}  // namespace palpa::app

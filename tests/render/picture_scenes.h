#pragma once

#include <map>
#include <string>

#include "app/view/viewport/picture.h"

namespace palpa::render_tests {

struct PictureCase {
  view::Picture picture;
  view::PictureSize size{800, 600};
};

/// Pictures without a window by name: words, layout and ghost, which viewport cases lack.
std::map<std::string, PictureCase> pictureCases();

}  // namespace palpa::render_tests

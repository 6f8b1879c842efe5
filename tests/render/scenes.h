#pragma once

#include <map>
#include <string>

#include "app/view/picture.h"
#include "app/view/scene.h"

namespace palpa::render_tests {

struct Case {
  view::SurfaceScene scene;
  view::PictureOptions options{800, 600};
};

/// Every case by name. The fields are made up, smooth and simple: what is tested is the drawing.
std::map<std::string, Case> allCases();

}  // namespace palpa::render_tests

#pragma once

#include <functional>
#include <map>
#include <string>

#include "app/view/viewport/viewport.h"
#include "modeling/solid/solid.h"

namespace palpa::render_tests {

/// A solid for a viewport.
view::ViewportBody viewportBody(const modeling::Solid& solid, int piecesPerSpan = 6);
view::ControlNet controlNet(const modeling::Solid& solid);

/// A picture of a viewport.
struct ViewportCase {
  std::function<void(view::Viewport&)> setUp;
  int width = 800;
  int height = 600;
  double pixelRatio = 1;
};

/// Every case by name.
std::map<std::string, ViewportCase> viewportCases();

void draw(const ViewportCase& viewportCase, const std::filesystem::path& picture);

/// Draws `last` in a window that has shown `first`, in another size, before.
void drawAfter(const ViewportCase& first, const ViewportCase& last,
               const std::filesystem::path& picture);

}  // namespace palpa::render_tests

#include "tests/render/moving_body.h"

#include <vtkNew.h>
#include <vtkRenderWindow.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

#include "app/view/files/png.h"
#include "app/view/viewport/viewport.h"
#include "tests/render/compare.h"
#include "tests/render/shapes.h"

namespace palpa::render_tests {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

/// A ball with waves and a supported cap, whose triangles have their own points.
view::ViewportBody waves(int n) {
  const Shape shape = sphere(25, n);
  view::ViewportBody body;
  for (const view::Triangle& t : shape.triangles) {
    const auto corner = [&](int k) -> Vector3d {
      const Vector3d& x = shape.positions[static_cast<std::size_t>(t[k])];
      return x * (1 + 0.06 * std::sin(0.4 * x.x()) * std::cos(0.3 * x.z()));
    };
    const Vector3d normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
    const int first = static_cast<int>(body.positions.size());
    for (int k = 0; k < 3; ++k) {
      body.positions.push_back(corner(k));
      body.normals.push_back(normal);
    }
    body.triangles.push_back({first, first + 1, first + 2});
    body.patchOfTriangle.push_back(0);
  }
  return body;
}

/// Pictures of a body in the given qualities, one after the other in one window.
class Window {
 public:
  explicit Window(const view::ViewportBody& body) {
    window_->SetOffScreenRendering(1);
    window_->SetSize(600, 450);
    viewport_.setBody(body);
    std::vector<double> supports;
    view::ScalarField field{"x", "mm"};
    field.range = {-25, 25};
    for (const Vector3d& position : body.positions) {
      supports.push_back(position.z() + 14);
      field.values.push_back(position.x());
    }
    viewport_.setRegions(supports, {});
    viewport_.setField(field);
    viewport_.fit();
  }
  view::Pixels draw(view::Quality quality, const fs::path& picture) {
    viewport_.render(quality);
    view::writePng(window_, picture);
    return view::pixelsOf(window_);
  }

 private:
  vtkNew<vtkRenderWindow> window_;
  view::Viewport viewport_{window_};
};

/// Pixels in the middle of the body that differ much: the background seen through gaps.
int gaps(const view::Pixels& one, const view::Pixels& other) {
  constexpr int kReach = 120, kMuch = 60;
  int count = 0;
  for (int y = -kReach; y <= kReach; ++y)
    for (int x = -kReach; x <= kReach; ++x) {
      if (x * x + y * y > kReach * kReach) continue;
      const auto at =
          static_cast<std::size_t>(3 * ((one.height / 2 + y) * one.width + one.width / 2 - 30 + x));
      for (std::size_t k = at; k < at + 3; ++k)
        if (std::abs(one.values[k] - other.values[k]) > kMuch) {
          ++count;
          break;
        }
    }
  return count;
}

}  // namespace

int requireFewerTrianglesWhileMoving(const fs::path& output) {
  fs::create_directories(output);
  int failures = 0;
  const auto check = [&](const std::string& name, const fs::path& a, const fs::path& b,
                         const auto& isRight) {
    const Difference result = compare(a, b, {});
    const bool right = result.sameSize && isRight(result);
    std::cout << name << ": " << result.text() << (right ? "" : "  <- wrong") << '\n';
    failures += !right;
  };
  const auto same = [](const Difference& d) { return d.largestBlock == 0; };
  const auto similar = [](const Difference& d) {
    return d.largestBlock > 0 && d.largestBlock < 30 && d.mean < 0.6;
  };
  for (const auto& [name, n] : {std::pair{"large", 110}, std::pair{"small", 40}}) {
    const auto file = [&, prefix = std::string("moving_") + name](const char* what) {
      return output / (prefix + "_" + what + ".png");
    };
    Window window(waves(n));
    window.draw(view::Quality::kFine, file("before"));
    const view::Pixels quick = window.draw(view::Quality::kQuick, file("quick"));
    const view::Pixels moving = window.draw(view::Quality::kMoving, file("moving"));
    const int found = gaps(quick, moving);
    std::cout << name << ": " << found << " pixels of gaps\n";
    failures += found > 0;
    window.draw(view::Quality::kFine, file("after"));
    check(std::string(name) + ", after moving", file("after"), file("before"), same);
    if (n > 100)
      check(std::string(name) + ", moving", file("moving"), file("quick"), similar);
    else
      check(std::string(name) + ", moving", file("moving"), file("quick"), same);
  }
  return failures == 0 ? 0 : 1;
}

}  // namespace palpa::render_tests

#pragma once

namespace palpa::gui {

/// Several lambdas as one visitor for std::visit.
template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};

}  // namespace palpa::gui

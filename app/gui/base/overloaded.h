#pragma once

namespace palpa::gui {

/// Combines lambdas into a visitor for std::visit.
template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};

}  // namespace palpa::gui

#pragma once

#include <stdexcept>

namespace palpa::view {

/// The world's fault while drawing or writing: the message says what, where and what to do.
class ViewError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// There is no X display to draw on. VTK would abort the process; this is thrown instead.
class NoDisplayError : public ViewError {
 public:
  using ViewError::ViewError;
};

}  // namespace palpa::view

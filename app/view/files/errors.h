#pragma once

#include "base/error.h"

namespace palpa::view {

/// The world's fault while drawing or writing: the message says what, where and what to do.
class ViewError : public Error {
 public:
  using Error::Error;
};

/// There is no X display to draw on. VTK would abort the process; this is thrown instead.
class NoDisplayError : public ViewError {
 public:
  using ViewError::ViewError;
};

}  // namespace palpa::view

#pragma once

#include "base/error.h"

namespace palpa::view {

/// Drawing or writing failed because of input or environment. The message names place, problem and
/// remedy.
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

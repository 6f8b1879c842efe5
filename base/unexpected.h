#pragma once

#include <exception>
#include <functional>
#include <string>

#include "base/job.h"

// Exceptions that no caller handles: defects, or out of memory, in a thread or a slot of the
// window. They must not end the program and with it unsaved work.
namespace palpa {

/// Sentence part for users: what() of a std::exception.
std::string describe(const std::exception_ptr& exception);

using UnexpectedHandler = std::function<void(const std::string& what)>;

/// Sets the handler of reportUnexpected() for the whole process; empty: the standard error output.
/// It may be called from any thread, one call at a time, and must not throw.
void setUnexpectedHandler(UnexpectedHandler handler);

/// Passes the present exception to the handler; call it in a catch block. Ignores Cancelled, which
/// somebody asked for.
void reportUnexpected() noexcept;

}  // namespace palpa

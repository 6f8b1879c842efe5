#include "base/unexpected.h"

#include <cstdio>
#include <mutex>
#include <new>
#include <utility>

namespace palpa {
namespace {

std::mutex mutex_;  // guards handler_
UnexpectedHandler handler_;

}  // namespace

std::string describe(const std::exception_ptr& exception) {
  try {
    std::rethrow_exception(exception);
  } catch (const std::bad_alloc&) {
    return "there is not enough memory";
  } catch (const Cancelled&) {
    return "cancelled";
  } catch (const std::exception& error) {
    return error.what();
  } catch (...) {
    return "an exception of unknown type";
  }
}

void setUnexpectedHandler(UnexpectedHandler handler) {
  const std::lock_guard lock(mutex_);
  handler_ = std::move(handler);
}

void reportUnexpected() noexcept {
  const std::exception_ptr exception = std::current_exception();
  try {
    std::rethrow_exception(exception);
  } catch (const Cancelled&) {
    return;
  } catch (...) {
    // Reported below.
  }
  const std::string what = describe(exception);
  const std::lock_guard lock(mutex_);
  if (handler_)
    handler_(what);
  else
    std::fprintf(stderr, "palpa: unexpected error: %s\n", what.c_str());
}

}  // namespace palpa

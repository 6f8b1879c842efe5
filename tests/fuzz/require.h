#pragma once

#include <cstdio>
#include <cstdlib>

namespace palpa::fuzz {

/// Ends the process, which is a finding for libFuzzer and a failed test for the replay.
inline void require(bool truth, const char* what) {
  if (truth) return;
  std::fprintf(stderr, "finding: %s\n", what);
  std::abort();
}

}  // namespace palpa::fuzz

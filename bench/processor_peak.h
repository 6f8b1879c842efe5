#pragma once

namespace palpa::bench {

/// Floating-point operations in double precision per second and core, while `threads` threads
/// perform independent fused multiply-adds (counted twice) with the widest instructions that bem::
/// uses on this machine.
double peakFlopsPerCore(int threads);

/// Bytes per second that `threads` threads together read from and write to memory (a = b + s c over
/// arrays much larger than the caches; written arrays count as read too).
double memoryBandwidth(int threads);

}  // namespace palpa::bench

#pragma once

namespace palpa::bench {

/// Fused multiply-adds per second on all of `threads` threads together, times two: floating-point
/// operations in double precision, with the widest instructions that bem:: uses here.
double peakFlops(int threads);

/// Bytes per second that `threads` threads together read from and write to memory (a = b + s c over
/// arrays much larger than the caches; of the written ones the reading counts, too).
double memoryBandwidth(int threads);

}  // namespace palpa::bench

#pragma once

namespace palpa::bench {

/// Floating-point operations in double precision per second of one core's time, while `threads`
/// threads do nothing but independent fused multiply-adds, which count twice, with the widest
/// instructions that bem:: uses here.
double peakFlopsPerCore(int threads);

/// Bytes per second that `threads` threads together read from and write to memory (a = b + s c over
/// arrays much larger than the caches; of the written ones the reading counts, too).
double memoryBandwidth(int threads);

}  // namespace palpa::bench

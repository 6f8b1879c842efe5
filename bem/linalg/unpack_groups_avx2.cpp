#include "bem/linalg/unpack_groups_loop.h"

namespace palpa::bem {

void unpackGroupsAvx2(const UnpackGroupsTask& task) {
  detail::unpackGroups<xsimd::fma3<xsimd::avx2>>(task);
}

}  // namespace palpa::bem

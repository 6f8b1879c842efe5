#include "bem/linalg/unpack_groups_loop.h"

namespace palpa::bem {

void unpackGroupsAvx512(const UnpackGroupsTask& task) {
  detail::unpackGroups<xsimd::avx512f>(task);
}

}  // namespace palpa::bem

#include "bem/linalg/unpack_groups_loop.h"

namespace palpa::bem {

void unpackGroupsBaseline(const UnpackGroupsTask& task) {
  detail::unpackGroups<xsimd::default_arch>(task);
}

}  // namespace palpa::bem

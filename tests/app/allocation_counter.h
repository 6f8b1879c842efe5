#pragma once

/// Counts what one thread of this program allocates: every operator new and every malloc() of code
/// compiled here (Eigen's among them). The program is linked with --wrap=malloc.
namespace palpa::app::test {

/// Watches a thread (its number in /proc/self/task) from now on; 0: none.
void watchAllocations(int thread);
/// Since watchAllocations().
long allocations();
/// Number of the thread of this process with a name; 0 when there is none.
int threadNamed(const char* name);

}  // namespace palpa::app::test

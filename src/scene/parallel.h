// A loop whose iterations run on several threads.
#pragma once

#include <cstddef>
#include <functional>

namespace scumble::scene {

// As many threads as options ask for; 0: as many as the machine has.
int threadCount(int wanted);

// Calls body(0) .. body(count - 1), each once, in any order, on this thread and on others of a pool that the
// process keeps (TBB's). A thread that waits here takes up no work of other loops, so that a body may hold a
// mutex, and begin loops of its own. When iterations throw, the exception of the
// lowest index is thrown here after all threads have stopped, so that the outcome does not depend on luck.
void parallelFor(size_t count, int threads, const std::function<void(size_t)>& body);

}  // namespace scumble::scene

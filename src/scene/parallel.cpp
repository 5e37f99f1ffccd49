#include "scene/parallel.h"

#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>

namespace scumble::scene {

int threadCount(int wanted) {
  if (wanted > 0) return std::min(wanted, 256);
  return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

void parallelFor(size_t count, int threads, const std::function<void(size_t)>& body) {
  std::atomic<size_t> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  std::atomic<size_t> failedAt{std::numeric_limits<size_t>::max()};

  const auto work = [&] {
    // Indices are handed out in order, so everything below a failed index has been started already.
    for (size_t i = next++; i < count && i < failedAt; i = next++) {
      try {
        body(i);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (i < failedAt) {
          failedAt = i;
          failure = std::current_exception();
        }
      }
    }
  };

  const int wanted = static_cast<int>(std::min<size_t>(count, static_cast<size_t>(std::max(1, threads))));
  if (wanted <= 1) {
    work();
  } else {
    // An arena for this loop alone: its threads take no tasks of other loops.
    tbb::task_arena arena(wanted);
    arena.execute([&] {
      tbb::task_group helpers;
      for (int i = 1; i < wanted; ++i) helpers.run(work);
      work();
      helpers.wait();
    });
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace scumble::scene

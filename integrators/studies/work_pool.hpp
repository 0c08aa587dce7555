// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Independent pieces of work on a few threads. Results go to places fixed beforehand, so that what
// comes out does not depend on which thread was faster.
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace yoke {

/// Calls work(i) for i = 0 ... count - 1 on at most `jobs` threads, the next i to whichever is free; jobs
/// < 1 is one. The first exception stops what has not begun and is thrown again here.
template <class Work>
void run_parallel(std::size_t count, int jobs, const Work& work) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr error;
  std::mutex mutex;
  const auto worker = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!error) error = std::current_exception();
        next = count;
      }
    }
  };
  std::vector<std::jthread> helpers;
  const std::size_t threads = std::min(count, static_cast<std::size_t>(std::max(jobs, 1)));
  for (std::size_t i = 1; i < threads; ++i) helpers.emplace_back(worker);
  worker();
  helpers.clear();  // joins
  if (error) std::rethrow_exception(error);
}

}  // namespace yoke

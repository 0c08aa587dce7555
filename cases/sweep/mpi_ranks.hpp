// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A sweep on the ranks of MPI: `mpirun -n 64 yoke sweep ...`. Rank 0 hands out points, computes too, and is the
// only one that writes. A message holds so many points that it is worth its way; a rank gets the next ones
// when it has sent rows back. If a rank is lost the job ends; the same command then computes what was under way.
#pragma once

#include <yoke/integrators/studies/study.hpp>

namespace yoke::cases {

/// Was the program built with MPI?
extern const bool has_mpi;

/// MPI from its start to its end, if the program was started by mpirun or srun; otherwise one rank without it.
/// Throws ModelError if there are more ranks but the program was built without MPI.
class MpiRanks {
 public:
  MpiRanks();
  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;
  /// Sends the others home if nothing was computed; waits for them.
  ~MpiRanks();

  int rank() const { return rank_; }
  int size() const { return size_; }
  /// On all ranks, with `jobs` threads on each (< 1: one). Once, on every rank.
  StudyExecutor executor(int jobs);

 private:
  int rank_ = 0, size_ = 1;
  bool dismissed_ = false;
};

/// How many points a message holds: for so long that its way does not count, and so few that all ranks end
/// together. `mean` [s] of a point, 0: not known yet.
std::size_t points_of_message(double mean, std::size_t left, int ranks, int jobs);

}  // namespace yoke::cases

// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Sweeps on the ranks of MPI; of a program built without it only what it says of that.
#include <doctest/doctest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <yoke/cases/sweep/mpi_ranks.hpp>
#include <yoke/tests/cases/program/program_run.hpp>
#include <yoke/tests/cases/sweep/sweep_rows.hpp>
#include <yoke/tests/files.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke::tests;
namespace fs = std::filesystem;

const std::string sweep =
    " sweep slider_crank --samples 11 --vary crank=20mm:60mm:20 --vary speed=100:200:5 "
    "--vary rod=50mm,120mm -q ";

std::string mpirun(const TemporaryFolder& scratch, int ranks, const std::string& arguments,
                   const char* name = "yoke") {
  return "cd '" + scratch.path().string() +
         "'; export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1; exec mpirun -n " +
         std::to_string(ranks) + " --oversubscribe '" YOKE_BINARY_DIR "/" + name + "'" + arguments +
         " >log 2>&1";
}

/// Processes whose parent is `parent`, or a child of it.
std::vector<pid_t> below(pid_t parent) {
  std::vector<pid_t> found;
  std::istringstream children(
      content("/proc/" + std::to_string(parent) + "/task/" + std::to_string(parent) + "/children"));
  for (pid_t child = 0; children >> child;) found.push_back(child);
  return found;
}

}  // namespace

// Run by the test behind it, on the ranks of mpirun. Messages are so long that a rank waits for the other to
// take them: two that send to each other must not wait for ever.
TEST_CASE("tiny points on ranks" * doctest::skip()) {
  using namespace yoke;
  cases::MpiRanks ranks;
  StudyOptions options{.executor = ranks.executor(1)};
  options.leads = ranks.rank() == 0;
  const StudyResult study = run_study(
      grid_points({linear_axis("x", 0.0, 1.0, 30001)}), {{"a"}, {"b"}, {"c"}},
      [](const StudyPoint& p) {
        return StudyOutcome{{p["x"], 2.0 * p["x"], 3.0 * p["x"]}};
      },
      options);
  CHECK(ranks.size() == 2);
  if (ranks.rank() > 0) return;
  CHECK(study.complete);
  bool right = true;
  for (const StudyRow& row : study.rows)
    right = right && row.values[2] == 3.0 * study.points.coordinate(row.point, 0);
  CHECK(right);
}

TEST_SUITE("sweep") {
  TEST_CASE("ranks that send to each other do not wait for each other") {
    if (!yoke::cases::has_mpi) return;
    const TemporaryFolder scratch;
    const pid_t run =
        start(mpirun(scratch, 2, " --no-skip -tc='tiny points on ranks'", "yoke_tests_cases"));
    int code = -1;
    for (int i = 0; i < 6000 && code < 0; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      int status = 0;
      if (waitpid(run, &status, WNOHANG) == run) code = WIFEXITED(status) ? WEXITSTATUS(status) : 1;
    }
    if (code < 0) kill(run, SIGTERM);
    INFO(content(scratch / "log"));
    CHECK(code == 0);
  }

  TEST_CASE("messages: as many points as are worth their way, few enough to end together") {
    using yoke::cases::points_of_message;
    CHECK(points_of_message(0.0, 100000, 64, 1) == 1);     // nothing is known yet
    CHECK(points_of_message(1e-5, 100000, 2, 1) == 5000);  // 50 ms
    CHECK(points_of_message(1e-5, 800, 2, 1) == 100);
    CHECK(points_of_message(3.0, 100000, 2, 1) == 1);
    CHECK(points_of_message(3.0, 100000, 2, 4) == 4);
    CHECK(points_of_message(1e-5, 1, 64, 1) == 1);
  }

  TEST_CASE("under mpirun the table is that of threads, also after a rank was killed") {
    const TemporaryFolder scratch;
    REQUIRE(run_yoke(scratch, sweep + "-o threads --jobs 2").code == 0);
    CHECK(rows_of_sweep(scratch / "threads/sweep.csv") == 200);
    if (!yoke::cases::has_mpi) {
      const auto said = run_yoke(scratch, sweep + "-o ranks", "export OMPI_COMM_WORLD_SIZE=2; ");
      CHECK(said.code == 1);
      CHECK(contains(said.out, "built without MPI"));
      return;
    }
    for (const int ranks : {2, 3}) {
      const std::string name = std::to_string(ranks);
      CHECK(wait_for(start(mpirun(scratch, ranks, sweep + "-o ranks" + name))) == 0);
      INFO(content(scratch / "log"));
      CHECK(content(scratch / ("ranks" + name) / "sweep.csv") ==
            content(scratch / "threads/sweep.csv"));
    }
    // A failure of all is said once, and nobody waits.
    CHECK(wait_for(start(mpirun(scratch, 2, sweep + "--rtol 1e-9 -o ranks2"))) != 0);
    const std::string said = content(scratch / "log");
    CHECK(contains(said, "holds another sweep"));
    CHECK(said.find("holds another sweep") == said.rfind("holds another sweep"));

    const pid_t run = start(mpirun(scratch, 2, sweep + "-o killed"));
    const fs::path journal = scratch / "killed/journal.tsv";
    for (int i = 0; i < 3000 && !(fs::exists(journal) && lines(journal).size() > 5); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    for (const pid_t rank : below(run)) kill(rank, SIGKILL);
    CHECK(wait_for(run) != 0);
    CHECK_FALSE(fs::exists(scratch / "killed/sweep.csv"));
    const std::size_t rows = lines(journal).size() - 1;
    CHECK(rows > 4);
    CHECK(rows < 200);
    CHECK(wait_for(start(mpirun(scratch, 2, sweep + "-o killed"))) == 0);
    CHECK(lines(journal).size() == 201);  // none twice
    CHECK(content(scratch / "killed/sweep.csv") == content(scratch / "threads/sweep.csv"));
  }
}

// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// kill -9 at random instants, two hundred times: whatever instant it is, the checkpoint on the disk
// is a good one, and the run that is taken up ends with the bytes of the one that was left alone.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <yoke/integrators/run/checkpoint.hpp>
#include <yoke/tests/files.hpp>

extern char** environ;

namespace {

using namespace yoke::tests;
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

const std::string law = "table11-johnson";

pid_t start(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), YOKE_BINARY_DIR "/yoke");
  std::vector<char*> argv;
  for (std::string& a : arguments) argv.push_back(a.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&quiet, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  REQUIRE(posix_spawn(&child, argv[0], &quiet, nullptr, argv.data(), environ) == 0);
  posix_spawn_file_actions_destroy(&quiet);
  return child;
}

/// 0 if it ended by itself and well.
int wait_for(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

std::vector<std::string> run_arguments(const fs::path& folder) {
  return {"run",           "scotch_yoke",  "--law",  law,      "--set",
          "revolutions=1", "--samples",    "401",    "--rtol", "1e-10",
          "--no-plots",    "--checkpoint", "0.004s", "-o",     folder.string()};
}

}  // namespace

TEST_CASE(
    "two hundred kills at random instants leave a good checkpoint, and the same bytes in the end") {
  const TemporaryFolder scratch;
  const fs::path reference = scratch / "reference";
  const auto began = Clock::now();
  REQUIRE(wait_for(start(run_arguments(reference))) == 0);
  const double duration = std::chrono::duration<double>(Clock::now() - began).count();

  std::mt19937 random(20261122);
  std::uniform_real_distribution<double> share(0.0, 0.7);
  int kills = 0, rounds = 0, with_checkpoint = 0;
  while (kills < 200) {
    const fs::path folder = scratch / ("round" + std::to_string(rounds++));
    std::vector<std::string> arguments = run_arguments(folder);
    for (bool finished = false; !finished;) {
      const pid_t child = start(arguments);
      // The last word of each round is left to the program.
      const bool shall_die = kills < 200 && kills < 10 * rounds;
      if (shall_die) {
        std::this_thread::sleep_for(std::chrono::duration<double>(share(random) * duration));
        kill(child, SIGKILL);
      }
      const int status = wait_for(child);
      finished = WIFEXITED(status);
      if (finished) REQUIRE(WEXITSTATUS(status) == 0);
      kills += finished ? 0 : 1;
      // Never a damaged one; none only if the first was not written yet.
      const auto checkpoint = yoke::read_checkpoint(folder / law / "checkpoint");
      with_checkpoint += checkpoint && !finished ? 1 : 0;
      arguments = fs::exists(folder / "run.json")
                      ? std::vector<std::string>{"resume", folder.string()}
                      : run_arguments(folder);
    }
    for (const char* file : {"motion.csv", "events.csv"})
      CHECK(content(folder / law / file) == content(reference / law / file));
    fs::remove_all(folder);
  }
  MESSAGE(kills << " kills in " << rounds << " runs, " << with_checkpoint
                << " of them with a checkpoint on the disk");
  CHECK(with_checkpoint > 100);
}

// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What the program says of itself and on a terminal: help, examples, completion, man page, what was perhaps
// meant, colours; and the project that `yoke new` writes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <yoke/cases/terminal/terminal.hpp>
#include <yoke/tests/cases/program/program_run.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke::tests;
namespace fs = std::filesystem;

std::vector<std::string> verbs() {
  const TemporaryFolder scratch;
  std::istringstream help(run_yoke(scratch, "--help").out);
  std::vector<std::string> names;
  bool listed = false;
  for (std::string line; std::getline(help, line);) {
    if (line.empty()) listed = false;
    if (listed) names.push_back(line.substr(2, line.find(' ', 2) - 2));
    if (line == "Subcommands:") listed = true;
  }
  return names;
}

bool installed(const std::string& command) {
  const bool there = std::system(("command -v " + command + " >/dev/null").c_str()) == 0;
  if (!there) MESSAGE("skipped: no " << command);
  return there;
}

}  // namespace

TEST_CASE("every verb's help has examples of it, and the program's help its exit codes") {
  const TemporaryFolder scratch;
  const std::vector<std::string> names = verbs();
  CHECK(names.size() > 15);
  for (const std::string& name : names) {
    CAPTURE(name);
    const std::string text = run_yoke(scratch, name + " --help").out;
    const std::size_t examples = text.find("Examples:\n");
    REQUIRE(examples != std::string::npos);
    CHECK(contains(text.substr(examples), "  yoke " + name));
  }
  const std::string text = run_yoke(scratch, "--help").out;
  for (const char* line : {"  0    everything", "  1    a run failed", "  2    the command line",
                           "  130  interrupted", "NO_COLOR"})
    CHECK(contains(text, line));
  CHECK(run_yoke(scratch, "list").code == 0);
  CHECK(run_yoke(scratch, "run nothing").code == 1);
  CHECK(run_yoke(scratch, "run --nothing").code == 2);
}

TEST_CASE("a verb or an option that is none is answered with the nearest") {
  const TemporaryFolder scratch;
  CHECK(contains(run_yoke(scratch, "rnu scotch_yoke").out, "did you mean 'run'?"));
  CHECK(
      contains(run_yoke(scratch, "run scotch_yoke --sampels 3").out, "did you mean '--samples'?"));
  CHECK(contains(run_yoke(scratch, "run scotch_yoke --formt=csv").out, "did you mean '--format'?"));
  CHECK(contains(run_yoke(scratch, "run scoth_yoke").out, "did you mean 'scotch_yoke'?"));
  CHECK(contains(run_yoke(scratch, "run geneva --formulation ida-gll").out,
                 "did you mean 'ida-ggl'?"));
}

TEST_CASE("completion is what the shells take, and completes verbs, cases and options") {
  const TemporaryFolder scratch;
  const auto write = [&](const std::string& shell) {
    const ProgramOutcome outcome = run_yoke(scratch, "completion " + shell);
    CHECK(outcome.code == 0);
    std::ofstream(scratch / shell) << outcome.out;
    return "'" + (scratch / shell).string() + "'";
  };
  CHECK(contains(run_yoke(scratch, "completion fish").out, "'bash', 'zsh'"));
  if (installed("bash")) {
    std::ofstream(scratch / "try")
        << ". " << write("bash") << "\n"
        << "try() { COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); COMPREPLY=(); _yoke 2>/dev/null; "
           "echo \"${COMPREPLY[*]}\"; }\n"
           "try yoke ru\ntry yoke run scotch\ntry yoke run geneva --samp\ntry yoke run geneva --format h\n"
           "try yoke run geneva --formulation ida-g\n";
    const std::string command =
        "bash '" + (scratch / "try").string() + "' >'" + (scratch / "tried").string() + "' 2>&1";
    CHECK(std::system(command.c_str()) == 0);
    CHECK(lines(scratch / "tried") ==
          std::vector<std::string>{"run", "scotch_yoke", "--samples", "hdf5", "ida-ggl"});
  }
  const std::string zsh = write("zsh");
  if (installed("zsh")) CHECK(std::system(("zsh -n " + zsh).c_str()) == 0);
}

TEST_CASE("the man page has every verb and option, and man shows it without a complaint") {
  const TemporaryFolder scratch;
  const std::string page = run_yoke(scratch, "man").out;
  for (const std::string& name : verbs()) {
    std::string escaped;
    for (const char c : name) escaped += c == '-' ? "\\-" : std::string(1, c);
    CHECK_MESSAGE(contains(page, ".SS yoke " + escaped + "\n"), name);
  }
  CHECK(contains(page, "\\-\\-events\\-only"));
  if (!installed("groff")) return;
  std::ofstream(scratch / "yoke.1") << page;
  const std::string command = "groff -man -Tascii -ww '" + (scratch / "yoke.1").string() + "' >'" +
                              (scratch / "shown").string() + "' 2>'" +
                              (scratch / "complaints").string() + "'";
  CHECK(std::system(command.c_str()) == 0);
  CHECK(content(scratch / "complaints") == "");
}

TEST_CASE("a run ends with a summary, and --quiet prints nothing but what goes wrong") {
  const TemporaryFolder scratch;
  const std::string run =
      "run slider_crank_clearance --set turns=1 --law hertz-flores --no-plots -o out";
  const ProgramOutcome loud = run_yoke(scratch, run);
  for (const char* text :
       {"slider_crank_clearance, hertz-flores: reached the end time\n", "  simulated ",
        "  energy      off by ", " rad/s\n", "  peak force ",
        " in 'slider pin' at t = ", ", x = ", "  impacts     ", "  cost  ", "motion.csv"})
    CHECK_MESSAGE(contains(loud.out, text), loud.out);
  CHECK(!contains(loud.out, "\033"));  // no terminal, no colour
  CHECK(std::count(loud.out.begin(), loud.out.end(), '\n') < 20);
  const ProgramOutcome quiet = run_yoke(scratch, run + " --quiet");
  CHECK(quiet.code == 0);
  CHECK(quiet.out == "");
  CHECK(fs::exists(scratch / "out/hertz-flores/summary.json"));
  CHECK(contains(run_yoke(scratch, run + " --quiet --law nothing").out, "nothing"));
}

TEST_CASE("colours are for terminals, and NO_COLOR turns them off") {
  if (!installed("script")) return;
  const TemporaryFolder scratch;
  const auto on_a_terminal = [&](const std::string& environment) {
    const std::string command =
        "cd '" + scratch.path().string() + "'; " + environment +
        " script -qec \"'" YOKE_BINARY_DIR
        "/yoke' run point_pendulum --no-plots --no-report -o out\" /dev/null >shown";
    CHECK(std::system(command.c_str()) == 0);
    return content(scratch / "shown");
  };
  const std::string bold = "\033[1mpoint_pendulum";
  CHECK(contains(on_a_terminal("TERM=xterm LC_ALL=C.UTF-8 NO_COLOR="), bold));
  const std::string plain = on_a_terminal("TERM=xterm LC_ALL=C.UTF-8 NO_COLOR=1");
  CHECK(!contains(plain, bold));
  CHECK(contains(plain, "point_pendulum: reached"));
  CHECK(contains(plain, "\u2588"));
  CHECK(!contains(on_a_terminal("TERM=xterm LC_ALL=C NO_COLOR=1"), "\u2588"));
}

TEST_CASE("a sparkline runs from the least to the largest value") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double values[] = {0.0, 4.0, nan, 8.0};
  CHECK(yoke::cases::sparkline(values) == "\u2581\u2585 \u2588");
  const double same[] = {3.0, 3.0};
  CHECK(yoke::cases::sparkline(same) == "\u2581\u2581");
}

#if !defined( \
    __SANITIZE_ADDRESS__)  // an installed library of sanitizers needs them in its programs too
TEST_CASE("yoke new writes a project that builds at once against the installed library, and runs") {
  const TemporaryFolder scratch;
  const std::string in = "cd '" + scratch.path().string() + "' && ";
  const auto step = [&](const std::string& command) {
    const int code = std::system((in + command + " >log 2>&1").c_str());
    REQUIRE_MESSAGE(code == 0, command << "\n" << content(scratch / "log"));
  };
  step("cmake --install '" YOKE_BINARY_DIR "' --prefix prefix");
  for (const char* file :
       {"bash-completion/completions/yoke", "zsh/site-functions/_yoke", "man/man1/yoke.1"})
    CHECK_MESSAGE(fs::file_size(scratch / (std::string("prefix/share/") + file)) > 1000, file);
  step("prefix/bin/yoke new my-mechanism | tee said");
  step("sed -n 's/^next: //p' said >next && . ./next");  // as it says itself
  CHECK(contains(content(scratch / "log"), "reached the end time: 0.1667 s"));
  CHECK(fs::file_size(scratch / "my-mechanism/results/motion.csv") > 10000);
  const ProgramOutcome again = run_yoke(scratch, "new my-mechanism");
  CHECK(again.code == 1);
  CHECK(contains(again.out, "there is such a file or folder already"));
  CHECK(contains(run_yoke(scratch, "new 1st").out, "a name begins with a letter"));
}
#endif

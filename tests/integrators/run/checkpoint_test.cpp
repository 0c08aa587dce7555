// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include <yoke/cases/n_four_bar.hpp>
#include <yoke/core/control/event_function.hpp>
#include <yoke/core/error.hpp>
#include <yoke/integrators/run/checkpoint_schedule.hpp>
#include <yoke/integrators/run/fingerprint.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/tests/files.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;
namespace fs = std::filesystem;

Model rattling_yoke(double crank_length = 45.0_mm) {
  return scotch_yoke({.crank_length = crank_length});
}

SimulationOptions options(const fs::path& folder, std::string_view formulation = "ida-ggl") {
  return {.until = 0.012,
          .relative_tolerance = 1e-7,
          .formulation = std::string(formulation),
          .samples = 301,
          .contact_rows = 3,
          .checkpoints = {.folder = folder, .every = 0.0017}};
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), sizeof(double) * a.size()) == 0);
}

void check_same(const Result& a, const Result& b) {
  CHECK(same_bits(a.samples.data(), b.samples.data()));
  CHECK(same_bits(a.contact_samples.data(), b.contact_samples.data()));
  REQUIRE(a.events.size() == b.events.size());
  for (std::size_t i = 0; i < a.events.size(); ++i) {
    CHECK(a.events[i].t == b.events[i].t);
    CHECK(a.events[i].element == b.events[i].element);
    CHECK(a.events[i].kind == b.events[i].kind);
    CHECK(a.events[i].region == b.events[i].region);
    CHECK(a.events[i].speed == b.events[i].speed);
    CHECK(a.events[i].penetration == b.events[i].penetration);
  }
  CHECK((a.final.q.array() == b.final.q.array()).all());
  CHECK((a.final.v.array() == b.final.v.array()).all());
  CHECK((a.final.energy.array() == b.final.energy.array()).all());
  CHECK(a.final.contacts == b.final.contacts);
  Summary sa = a.summary, sb = b.summary;
  sa.wall_time = sb.wall_time = 0.0;
  CHECK(to_json(sa) == to_json(sb));
}

/// Stops at a step, as a kill would: what is on the disk then is what there was at the last
/// checkpoint, and perhaps more rows.
Result interrupted_run(const Model& model, SimulationOptions o, long step) {
  o.observer = [step](const Progress& p) { return p.steps < step; };
  return simulate(model, o);
}

void cut(const fs::path& file, std::uintmax_t bytes) { fs::resize_file(file, bytes); }

}  // namespace

TEST_CASE("a run that is taken up gives the same bits as the one that was not interrupted") {
  const Model model = rattling_yoke();
  for (const FormulationNote& f : formulations()) {
    INFO(f.name);
    for (const long every_events : {0L, 3L}) {
      TemporaryFolder whole, cut_short;
      SimulationOptions o = options(whole.path(), f.name);
      if (every_events > 0) o.checkpoints = {.folder = whole.path(), .every_events = every_events};
      const Result reference = simulate(model, o);
      REQUIRE(reference.summary.ok());
      REQUIRE(reference.events.size() > 8);
      REQUIRE(reference.contact_samples.rows() > 20);
      o.checkpoints.folder = cut_short.path();
      for (const double part : {0.05, 0.4, 0.8}) {
        const long step = static_cast<long>(part * static_cast<double>(reference.summary.steps));
        const Result stopped = interrupted_run(model, o, step);
        REQUIRE(stopped.summary.stop == Stop::interrupted);
        check_same(resume(model, cut_short.path()), reference);
      }
    }
  }
}

TEST_CASE("a formulation that an event has changed survives being taken up") {
  Model m;
  const BodyId b =
      m.add(Body{.name = "mass", .mass = 1.0, .inertia = 1.0, .pose = {{1.5, 0.0}, 0.0}});
  m.add(TranslationalSpring{.name = "oil",
                            .a = ground,
                            .b = b,
                            .at_a = {0.0, 0.0},
                            .at_b = {1.5, 0.0},
                            .stiffness = 40.0,
                            .damping = 1.0,
                            .free_length = 1.0});
  for (const double at : {0.5, 1.5})
    m.add(EventFunction{.name = at < 1.0 ? "thicker" : "thinner",
                        .function = [at](const Motion& now) { return now.t - at; },
                        .set = {{"oil.damping", at < 1.0 ? 1e5 : 1.0}}});
  for (const double every : {0.13, 0.0}) {  // by time, or at each event
    TemporaryFolder whole, cut_short;
    SimulationOptions o{.until = 2.0,
                        .relative_tolerance = 1e-6,
                        .samples = 101,
                        .time_scale = 1.0,
                        .checkpoints = {.folder = whole.path(), .every = every}};
    if (every == 0.0) o.checkpoints.every_events = 1;
    const Result reference = simulate(m, o);
    REQUIRE_MESSAGE(reference.summary.ok(), reference.summary.reason);
    CHECK(reference.summary.notes.size() == 2);
    for (const double part : {0.3, 0.6, 0.95}) {
      o.checkpoints.folder = cut_short.path();
      interrupted_run(m, o, static_cast<long>(part * static_cast<double>(reference.summary.steps)));
      check_same(resume(m, cut_short.path()), reference);
    }
  }
}

TEST_CASE("redundant equations, singular positions and users' events survive being taken up") {
  Model m = cases::n_four_bar({.loops = 2});
  // A third way to hold the last bar, which says nothing new; a count of half turns that slows
  // down.
  m.add(Revolute{.name = "again", .a = ground, .b = m.find_body("link 2"), .at = {2.0, 0.0}});
  m.add(EventFunction{.name = "lowest",
                      .function = [](const Motion& at) { return at[BodyId{1}].x; },
                      .crossing = Crossing::both});
  for (const FormulationNote& f : formulations()) {
    INFO(f.name);
    TemporaryFolder whole, cut_short;
    SimulationOptions o{.until = 2.0,
                        .relative_tolerance = 1e-7,
                        .formulation = std::string(f.name),
                        .samples = 101,
                        .checkpoints = {.folder = whole.path(), .every = 0.13}};
    const Result reference = simulate(m, o);
    INFO(reference.summary.reason);
    REQUIRE(reference.summary.ok());
    CHECK(reference.summary.redundant_equations.size() == 2);
    CHECK(reference.summary.singular_positions.size() >= 2);
    o.checkpoints.folder = cut_short.path();
    interrupted_run(m, o, reference.summary.steps / 2);
    check_same(resume(m, cut_short.path()), reference);
  }
}

TEST_CASE(
    "a run may be interrupted again and again, also with rows on the disk beyond the last "
    "checkpoint") {
  const Model model = rattling_yoke();
  TemporaryFolder whole, patched;
  const Result reference = simulate(model, options(whole.path()));
  interrupted_run(model, options(patched.path()), reference.summary.steps / 5);
  for (int i = 2; i < 5; ++i) {
    for (const char* name : {"samples.bin", "contacts.bin", "events.bin"})
      std::ofstream(patched / name, std::ios::app | std::ios::binary) << "rows of a step "
                                                                         "that was killed";
    const long step = i * reference.summary.steps / 5;
    resume(model, patched.path(), [&](const Progress& p) { return p.steps < step; });
  }
  check_same(resume(model, patched.path()), reference);
  // A run that is over is over.
  check_same(resume(model, patched.path()), reference);
}

TEST_CASE("simulate goes on if it is told to and there is something to go on from") {
  const Model model = rattling_yoke();
  TemporaryFolder whole, folder;
  const Result reference = simulate(model, options(whole.path()));
  SimulationOptions o = options(folder.path());
  o.checkpoints.resume = true;
  CHECK(interrupted_run(model, o, 40).summary.stop == Stop::interrupted);
  check_same(simulate(model, o), reference);
  o.relative_tolerance = 1e-6;
  CHECK_THROWS_WITH_AS(simulate(model, o),
                       doctest::Contains("is of a run with relative_tolerance = 1e-07, not 1e-06"),
                       ModelError);
}

TEST_CASE(
    "a checkpoint that is truncated, damaged or of another model is refused with the reason") {
  const Model model = rattling_yoke();
  TemporaryFolder folder;
  const fs::path file = folder / "checkpoint.bin";
  CHECK_THROWS_WITH_AS(resume(model, folder.path()), doctest::Contains("there is no checkpoint"),
                       ModelError);
  interrupted_run(model, options(folder.path()), 200);
  CHECK_THROWS_WITH_AS(resume(rattling_yoke(45.01_mm), folder.path()),
                       doctest::Contains("is of another model"), ModelError);

  const std::string bytes = content(file);
  const auto put_back = [&](std::string changed) {
    std::ofstream(file, std::ios::binary) << changed;
  };
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{10}, std::size_t{30}, bytes.size() / 2, bytes.size() - 1}) {
    put_back(bytes.substr(0, length));
    CHECK_THROWS_WITH_AS(resume(model, folder.path()), doctest::Contains("is refused"), ModelError);
  }
  std::string changed = bytes;
  changed[bytes.size() / 2] ^= 1;
  put_back(changed);
  CHECK_THROWS_WITH_AS(resume(model, folder.path()), doctest::Contains("damaged"), ModelError);
  changed = bytes;
  changed[8] = 99;
  put_back(changed);
  CHECK_THROWS_WITH_AS(resume(model, folder.path()), doctest::Contains("version 99"), ModelError);

  put_back(bytes);
  for (const char* name : {"samples.bin", "contacts.bin", "events.bin"}) {
    std::fstream log(folder / name, std::ios::in | std::ios::out | std::ios::binary);
    log.seekg(37);
    const auto byte = static_cast<char>(log.get());
    log.seekp(37);
    log.put(static_cast<char>(byte ^ 4));
    log.close();
    CHECK_THROWS_WITH_AS(resume(model, folder.path()), doctest::Contains("is refused"), ModelError);
    std::fstream again(folder / name, std::ios::in | std::ios::out | std::ios::binary);
    again.seekp(37);
    again.put(byte);
  }
  cut(folder / "events.bin", 3);
  CHECK_THROWS_WITH_AS(resume(model, folder.path()), doctest::Contains("truncated: event"),
                       ModelError);
  cut(folder / "samples.bin", 8);
  CHECK_THROWS_WITH_AS(resume(model, folder.path()), doctest::Contains("truncated: 8 of"),
                       ModelError);
}

TEST_CASE("checkpoints that cannot be written stop the run with what there is") {
  CHECK_THROWS_AS(simulate(rattling_yoke(), options("/proc/no such folder")), OutputError);
}

TEST_CASE("a model whose event differs has another fingerprint") {
  const auto with = [](EventFunction event) {
    Model m = rattling_yoke();
    if (!event.function) event.function = [](const Motion& at) { return at.t - 0.05; };
    m.add(event);
    return fingerprint(m);
  };
  const std::uint64_t plain = with({.name = "event"});
  CHECK(plain == with({.name = "event"}));
  CHECK(plain != with({.name = "event", .stop = true}));
  CHECK(plain != with({.name = "event", .crossing = Crossing::upwards}));
  CHECK(plain != with({.name = "event", .action = [](const EventAction&) {}}));
  CHECK(plain != with({.name = "event", .function = [](const Motion& at) { return at.t - 0.03; }}));
}

TEST_CASE("checkpoints without a folder, or a folder without a schedule, are refused") {
  const Model model = rattling_yoke();
  const auto refused = [&](const Checkpoints& checkpoints, const char* why) {
    CHECK_THROWS_WITH_AS(simulate(model, {.until = 0.01, .checkpoints = checkpoints}),
                         doctest::Contains(why), ModelError);
  };
  TemporaryFolder folder;
  refused({.every = 0.1}, "checkpoints.folder is empty, but one is to be written every 0.1 s");
  refused({.every_events = 3},
          "checkpoints.folder is empty, but one is to be written every 3 events");
  refused({.resume = true}, "checkpoints.folder is empty: there is nothing to resume from");
  refused({.folder = folder.path()}, "neither checkpoints.every [s] nor checkpoints.every_events");
  refused({.folder = folder.path(), .every = -1.0}, "checkpoints.every = -1 s must be finite");
  CHECK(fs::is_empty(folder.path()));
}

TEST_CASE("checkpoints closer than any run is worth are refused with what would be accepted") {
  const TemporaryFolder scratch;
  const auto asked = [&](double every) {
    return SimulationOptions{.until = 10.0,
                             .checkpoints = {.folder = scratch.path(), .every = every}};
  };
  CHECK(message_of<ModelError>([&] { simulate(double_pendulum(), asked(1e-9)); }) ==
        "checkpoints every 1e-09 s would be 1e+10 of them in 10 s; accepted are up to 1e+06, at "
        "least 1e-05 s apart; every 0.1 s would be 100");
  CHECK(!fs::exists(scratch / "checkpoint.bin"));
  CHECK_NOTHROW(check_checkpoint_interval(1e-5, 10.0));
  CHECK_NOTHROW(check_checkpoint_interval(0.0, 10.0));  // not by time
}

TEST_CASE("a schedule that will take long to write is warned of once, before the run goes on") {
  CHECK(checkpoint_cost(1e-3, 10.0, 2e-3).empty());  // 20 s
  CHECK(checkpoint_cost(0.0, 10.0, 2e-3).empty());
  CHECK(checkpoint_cost(1e-4, 10.0, 5e-3) ==
        "100000 checkpoints, one every 0.0001 s, will take about 8 min to write, 5 ms each; every "
        "0.1 s would be 100");
  CHECK(checkpoint_cost(1e-5, 7.0, 0.5).find("will take about 4 days to write") !=
        std::string::npos);
  CHECK(checkpoint_cost(1e-5, 7.0, 0.5).find("every 0.1 s would be 70") != std::string::npos);

  const TemporaryFolder scratch;
  int warnings = 0, steps = 0;
  SimulationOptions o{
      .until = 1e6, .samples = 2, .checkpoints = {.folder = scratch.path(), .every = 1.0}};
  o.warning = [&](const std::string& text) {
    ++warnings;
    CHECK(steps == 0);
    CHECK(text.find("1000000 checkpoints, one every 1 s") == 0);
  };
  o.observer = [&](const Progress&) { return ++steps < 3; };
  CHECK(simulate(double_pendulum(), o).summary.stop == Stop::interrupted);
  CHECK(warnings == 1);
}

TEST_CASE("a disk that fills up leaves the last checkpoint whole") {
  const TemporaryFolder scratch;
  SimulationOptions o{
      .until = 1.0, .samples = 2, .checkpoints = {.folder = scratch.path(), .every = 0.1}};
  o.observer = [](const Progress& now) { return now.t < 0.25; };
  simulate(double_pendulum(), o);
  REQUIRE(fs::exists(scratch / "checkpoint.bin"));
  const std::string before = content(scratch / "checkpoint.bin");
  // A folder where the new one is to be written does what a full disk does.
  fs::create_directory(scratch / "checkpoint.new");
  o.observer = nullptr;
  o.checkpoints.resume = true;
  const Result run = simulate(double_pendulum(), o);
  CHECK(run.summary.stop == Stop::failed);
  CHECK(run.summary.reason.find("checkpoint.new") != std::string::npos);
  CHECK(content(scratch / "checkpoint.bin") == before);
}

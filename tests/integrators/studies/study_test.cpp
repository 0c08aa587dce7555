// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Studies: which points, in what order, and that no row is lost, doubled or other than it should be.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <yoke/integrators/studies/study.hpp>
#include <yoke/integrators/studies/work_pool.hpp>
#include <yoke/tests/files.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;
namespace fs = std::filesystem;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

std::vector<StudyAxis> box() {
  return {linear_axis("width", 1.0, 2.0, 6, "m"), log_axis("load", 1.0, 100.0, 5, "N"),
          word_axis("law", {"soft", "hard", "odd, \"law\""})};
}

/// Fails at some points in each of the ways there are.
StudyOutcome work(const StudyPoint& point) {
  if (point.index() % 11 == 5) throw std::runtime_error("no\tposition\nat all");
  if (point.index() % 13 == 7) return {.values = {1.0}, .failure = "stopped early, at \"once\""};
  return {{std::sin(point["width"]) / point["load"],
           static_cast<double>(point.text("law").size()) + 0.1}};
}

const std::vector<StudyQuantity> two = {{"force", "N"}, {"size"}};

std::string csv_of(const StudyResult& study, const TemporaryFolder& scratch) {
  study.write_csv(scratch / "study.csv");
  return content(scratch / "study.csv");
}

/// How often the function of a study was called.
struct Counted {
  std::atomic<int> calls = 0;
  StudyOutcome operator()(const StudyPoint& point) {
    ++calls;
    return work(point);
  }
};

StudyResult in_folder(const fs::path& folder, int* calls = nullptr,
                      const StudyOptions& options = {}) {
  Counted counted;
  StudyOptions own = options;
  own.folder = folder;
  if (own.jobs == 0) own.jobs = 2;
  StudyResult study = run_study(grid_points(box()), two, std::ref(counted), own);
  if (calls != nullptr) *calls = counted.calls;
  return study;
}

}  // namespace

TEST_SUITE("studies") {
  TEST_CASE("axes: ends exact, values as a person would write them") {
    const StudyAxis a = linear_axis("a", 0.01, 0.5, 50);
    REQUIRE(a.values.size() == 50);
    for (int i = 0; i < 50; ++i) CHECK(a.values[static_cast<std::size_t>(i)] == (i + 1) / 100.0);
    CHECK(linear_axis("a", 3.0, 1.0, 3).values == std::vector<double>{3.0, 2.0, 1.0});
    CHECK(linear_axis("a", 3.0, 3.0, 1).values == std::vector<double>{3.0});
    const StudyAxis b = log_axis("b", 1e-3, 1e3, 7);
    for (int i = 0; i < 7; ++i)
      CHECK(b.values[static_cast<std::size_t>(i)] == std::stod(fmt::format("1e{}", i - 3)));
    CHECK(log_axis("b", 2.0, 32.0, 5).values == std::vector<double>{2.0, 4.0, 8.0, 16.0, 32.0});
  }

  TEST_CASE("axes: what they refuse") {
    CHECK(contains(message_of([] { linear_axis("speed", 1.0, 2.0, 1); }),
                   "axis 'speed': one value cannot be both 1 and 2"));
    CHECK(contains(message_of([] { linear_axis("speed", 1.0, 2.0, 0); }), "0 values"));
    CHECK(contains(message_of([] { linear_axis("speed", not_a_number, 2.0, 3); }), "low = nan"));
    CHECK(contains(message_of([] { log_axis("speed", 0.0, 2.0, 3, "m/s"); }),
                   "axis 'speed': low, on a logarithmic axis, = 0 m/s must be"));
    CHECK(contains(message_of([] { value_axis("speed", {}); }), "'speed' has no values"));
    CHECK(contains(message_of([] { word_axis("law", {}); }), "'law' has no words"));
    CHECK(contains(message_of([] { grid_points({}); }), "at least one axis"));
    const StudyAxis many = linear_axis("a", 0.0, 1.0, 100000);
    StudyAxis more = many;
    more.name = "b";
    CHECK(contains(message_of([&] {
                     grid_points({many, more});
                   }),
                   "grid of 100000 x 100000: 1e+10 points"));
    CHECK(contains(message_of([&] { grid_points({many, many}); }), "accepted are at most"));
    CHECK(contains(message_of([] {
                     grid_points({value_axis("a", {1}), value_axis("a", {2})});
                   }),
                   "axis 'a' is given twice"));
    CHECK(contains(message_of([] { random_points({value_axis("a", {1})}, 0, 1); }), "0 points"));
    CHECK(contains(message_of([] { listed_points({word_axis("a", {"x"})}, {{1.0}}); }),
                   "axis 'a': 1 is not the number of one of its 1 words"));
    CHECK(contains(message_of([] {
                     listed_points({word_axis("a", {"x"})}, {{0.0, 1.0}});
                   }),
                   "point 0 has 2 coordinates"));
    const StudyPoints points = grid_points(box());
    CHECK(contains(message_of([&] { points.axis("laws"); }),
                   "unknown axis 'laws'; there are 'width', 'load', 'law'"));
  }

  TEST_CASE("grids: all combinations, the last axis fastest") {
    const StudyPoints points = grid_points(box());
    REQUIRE(points.size() == 90);
    CHECK(points.origin() == "grid of 6 x 5 x 3");
    std::size_t i = 0;
    for (const double width : points.axes()[0].values)
      for (const double load : points.axes()[1].values)
        for (double law = 0.0; law < 3.0; ++law, ++i) {
          CHECK(points.coordinate(i, 0) == width);
          CHECK(points.coordinate(i, 1) == load);
          CHECK(points.coordinate(i, 2) == law);
        }
    CHECK(points.text(1, 2) == "hard");
    CHECK(points.text(0, 0) == "1");
  }

  TEST_CASE("samples: within the box, the same for the same seed, another for another") {
    StudyAxis links = linear_axis("links", 2.0, 4.0, 3);
    links.whole = true;
    const std::vector<StudyAxis> axes = {linear_axis("a", -1.0, 1.0, 2), log_axis("b", 1.0, 1e6, 2),
                                         word_axis("c", {"x", "y"}), links,
                                         value_axis("d", {7.0, 5.0})};
    const StudyPoints points = random_points(axes, 4000, 42);
    double sum = 0.0, log_sum = 0.0;
    std::set<double> seen[3];
    for (std::size_t i = 0; i < points.size(); ++i) {
      CHECK(std::abs(points.coordinate(i, 0)) <= 1.0);
      sum += points.coordinate(i, 0);
      log_sum += std::log10(points.coordinate(i, 1));
      for (std::size_t k = 0; k < 3; ++k) seen[k].insert(points.coordinate(i, 2 + k));
    }
    // Means of uniform numbers: four standard deviations of the mean.
    CHECK(std::abs(sum / 4000.0) < 4.0 * 2.0 / std::sqrt(12.0 * 4000.0));
    CHECK(std::abs(log_sum / 4000.0 - 3.0) < 4.0 * 6.0 / std::sqrt(12.0 * 4000.0));
    CHECK(seen[0] == std::set<double>{0.0, 1.0});
    CHECK(seen[1] == std::set<double>{2.0, 3.0, 4.0});
    CHECK(seen[2] == std::set<double>{5.0, 7.0});
    const StudyPoints again = random_points(axes, 4000, 42), other = random_points(axes, 4000, 43);
    CHECK(again.coordinate(3999, 1) == points.coordinate(3999, 1));
    CHECK(other.coordinate(3999, 1) != points.coordinate(3999, 1));
    CHECK(points.origin() == "4000 random points, seed 42");
    // The standard gives the 10000th number of this generator with its own seed; ours is its upper part.
    const StudyPoints standard = random_points({linear_axis("a", 0.0, 1.0, 2)}, 10000, 5489);
    CHECK(standard.coordinate(9999, 0) ==
          static_cast<double>(9981545732273789042ull >> 11) * 0x1p-53);
  }

  TEST_CASE("Sobol: the sequence as published; any 2^k points are one in each of 2^k strips") {
    const std::vector<StudyAxis> axes = {linear_axis("a", 0.0, 1.0, 2),
                                         linear_axis("b", 0.0, 1.0, 2)};
    const StudyPoints points = sobol_points(axes, 1023);
    const double published[5][2] = {{.5, .5}, {.75, .25}, {.25, .75}, {.375, .375}, {.875, .875}};
    for (std::size_t i = 0; i < 5; ++i)
      for (std::size_t a = 0; a < 2; ++a) CHECK(points.coordinate(i, a) == published[i][a]);
    for (std::size_t a = 0; a < 2; ++a) {
      std::set<int> strips;  // with the point 0 that the sequence leaves out
      for (std::size_t i = 0; i < 1023; ++i)
        strips.insert(static_cast<int>(points.coordinate(i, a) * 1024.0));
      CHECK(strips.size() == 1023);
      CHECK(strips.count(0) == 0);
    }
  }

  TEST_CASE(
      "the table is in the order of the points and has the same bits on any number of threads") {
    const TemporaryFolder scratch;
    std::string first;
    for (const int jobs : {1, 2, 3, 8}) {
      const StudyResult study = run_study(grid_points(box()), two, work, {.jobs = jobs});
      CHECK(study.complete);
      CHECK(study.progress.done == 90);
      CHECK(study.progress.failed == 15);
      const std::string csv = csv_of(study, scratch);
      if (first.empty()) first = csv;
      CHECK(csv == first);
    }
    CHECK(
        first.starts_with("point,width_m,load_N,law,force_N,size,state,reason\n"
                          "0,1,1,soft,0.8414709848078965,4.1,completed,\n"));
    CHECK(contains(
        first, "\n5,1,3.162277660168,\"odd, \"\"law\"\"\",nan,nan,failed,no position at all\n"));
    CHECK(contains(first, "\n7,1,10,hard,1,nan,failed,\"stopped early, at \"\"once\"\"\"\n"));
  }

  TEST_CASE("the table in memory") {
    const Table table = run_study(grid_points(box()), two, work, {.jobs = 2}).table();
    REQUIRE(table.rows() == 90);
    CHECK(table["width_m"][89] == 2.0);
    CHECK(table.text(89, table.index("law")) == "odd, \"law\"");
    CHECK(table.text(5, table.index("state")) == "failed");
    CHECK(table["force_N"][0] == std::sin(1.0));
  }

  TEST_CASE("a study in a folder is not done twice") {
    const TemporaryFolder scratch;
    int calls = 0;
    const std::string first = csv_of(in_folder(scratch / "study", &calls), scratch);
    CHECK(calls == 90);
    const StudyResult again = in_folder(scratch / "study", &calls);
    CHECK(calls == 0);
    CHECK(again.progress.reused == 90);
    CHECK(again.progress.failed == 15);
    CHECK(csv_of(again, scratch) == first);
  }

  TEST_CASE("wherever the journal was cut off, whole rows are kept and the table is the same") {
    const TemporaryFolder scratch;
    const std::string table = csv_of(in_folder(scratch / "study"), scratch);
    const std::string journal = content(scratch / "study" / journal_name);
    const auto resumed = [&](const std::string& left, std::size_t whole_rows) {
      std::ofstream(scratch / "study" / journal_name, std::ios::binary) << left;
      int calls = 0;
      CHECK(csv_of(in_folder(scratch / "study", &calls), scratch) == table);
      CHECK(calls == 90 - static_cast<int>(whole_rows));
    };
    const auto rows_in = [](const std::string& text) {
      const auto lines = static_cast<std::size_t>(std::ranges::count(text, '\n'));
      return lines > 0 ? lines - 1 : 0;
    };
    for (std::size_t length = 0; length < journal.size(); length += 61)
      resumed(journal.substr(0, length), rows_in(journal.substr(0, length)));
    // A power failure may leave zeros, or a changed byte.
    std::string torn = journal.substr(0, journal.size() / 2);
    resumed(torn + std::string(100, '\0'), rows_in(torn));
    std::string changed = journal.substr(0, journal.rfind('\n', journal.size() - 2) + 1);
    const std::size_t all = rows_in(changed);
    changed[changed.rfind('.')] = '7';
    resumed(changed, all - 1);
    resumed(journal + journal.substr(journal.find('\n') + 1), 90);  // every row twice
  }

  TEST_CASE("a stopped study goes on; what is unfinished is no row") {
    const TemporaryFolder scratch;
    const std::string whole =
        csv_of(run_study(grid_points(box()), two, work, {.jobs = 1}), scratch);
    std::atomic<std::size_t> done = 0;
    StudyOptions options;
    options.observer = [&](const StudyProgress& p) { done = p.done; };
    options.stop = [&] { return done >= 20; };
    const StudyResult part = in_folder(scratch / "study", nullptr, options);
    CHECK_FALSE(part.complete);
    CHECK(part.progress.done >= 20);
    CHECK(part.progress.done < 25);
    CHECK(part.table().rows() == part.progress.done);
    const StudyResult half = run_study(
        grid_points(box()), two,
        [](const StudyPoint& p) {
          return p.index() < 60 ? work(p) : StudyOutcome{.values = {1, 2}, .unfinished = true};
        },
        {.jobs = 2, .folder = scratch / "study"});
    CHECK(half.progress.done == 60);
    int calls = 0;
    CHECK(csv_of(in_folder(scratch / "study", &calls), scratch) == whole);
    CHECK(calls == 30);
  }

  TEST_CASE("another study in the folder is refused, and so is a second process") {
    const TemporaryFolder scratch;
    in_folder(scratch / "study");
    const auto refused = [&](const std::vector<StudyAxis>& axes,
                             const std::vector<StudyQuantity>& quantities,
                             const std::string& identity) {
      return message_of([&] {
        run_study(grid_points(axes), quantities, work,
                  {.folder = scratch / "study", .identity = identity});
      });
    };
    CHECK(refused(box(), two, "") == "no error");
    CHECK(contains(refused(box(), two, "of another model"), "holds another study"));
    std::vector<StudyAxis> other = box();
    other[0].values[2] = std::nextafter(other[0].values[2], 9.0);
    CHECK(contains(refused(other, two, ""), "holds another study"));
    CHECK(contains(refused(box(), {{"force", "N"}, {"length"}}, ""), "holds another study"));
    StudyOptions options;
    std::string second = "not tried";
    options.observer = [&](const StudyProgress&) {
      if (second == "not tried")
        second = message_of<OutputError>([&] { in_folder(scratch / "locked"); });
    };
    in_folder(scratch / "locked", nullptr, options);
    CHECK(contains(second, "is being written by another process"));
  }

  TEST_CASE("what else is refused") {
    CHECK(contains(message_of([] { run_study({}, two, work); }), "at least one axis"));
    CHECK(contains(message_of([] {
                     run_study(grid_points(box()), {{"width", "m"}}, work);
                   }),
                   "two columns 'width_m'"));
    const TemporaryFolder scratch;
    std::ofstream(scratch / "file") << "x";
    CHECK(contains(message_of<OutputError>([&] { in_folder(scratch / "file"); }), "file"));
    const StudyResult wide = run_study(grid_points(box()), {{"one"}}, [](const StudyPoint&) {
      return StudyOutcome{{1, 2}};
    });
    CHECK(wide.rows[0].reason == "the function gave 2 values; there are 1 quantities");
  }

  TEST_CASE("a process that only computes has no rows and leaves the folder alone") {
    const TemporaryFolder scratch;
    std::size_t computed = 0;
    StudyOptions options{.folder = scratch / "study"};
    options.leads = false;
    options.executor = [&](const StudyWork& share) {
      CHECK(share.points.empty());
      const StudyRow row = share.compute(3);
      CHECK(row.point == 3);
      CHECK(row.state == PointState::completed);
      ++computed;
    };
    const StudyResult study = run_study(grid_points(box()), two, work, options);
    CHECK(computed == 1);
    CHECK(study.rows.empty());
    CHECK_FALSE(fs::exists(scratch / "study"));
  }

  TEST_CASE("progress knows what is done and what remains") {
    const TemporaryFolder scratch;
    std::vector<StudyProgress> seen;
    StudyOptions options{.jobs = 1};
    options.observer = [&](const StudyProgress& p) { seen.push_back(p); };
    run_study(grid_points(box()), two, work, options);
    REQUIRE(seen.size() == 92);  // before, for each, at the end
    CHECK(seen[0].done == 0);
    CHECK(std::isnan(seen[0].remaining));
    CHECK(seen[45].done == 45);
    CHECK(seen[45].total == 90);
    CHECK(seen[45].remaining == doctest::Approx(seen[45].elapsed).epsilon(1e-12));
    CHECK(seen[91].remaining == 0.0);
  }
}

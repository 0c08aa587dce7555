// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Pictures that other programs take long to draw.
#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include <yoke/tests/cases/program/program_run.hpp>
#include <yoke/tests/files.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke::tests;
using Outcome = ProgramOutcome;
namespace fs = std::filesystem;

TEST_CASE("figures for print are as wide as a column, in three formats and with their scripts") {
  if (std::system("command -v gnuplot >/dev/null") != 0) return;
  const TemporaryFolder scratch;
  const std::string run = "run point_pendulum --no-report ";
  CHECK(run_yoke(scratch, run + "--paper both -o both").code == 0);
  const fs::path plots = scratch / "both/plots";
  // [dots] of PNG at 600 an inch, [1/96 inch] of SVG, [1/72 inch] of PDF.
  struct Width {
    const char* name;
    int png, svg, pdf;
  };
  for (const Width& w : {Width{"path-single", 1984, 317, 238}, {"path-double", 4110, 658, 493}}) {
    const std::string png = content(plots / (std::string(w.name) + ".png"));
    REQUIRE(png.size() > 24);
    int width = 0;
    for (int i = 16; i < 20; ++i)
      width = 256 * width + static_cast<unsigned char>(png[static_cast<std::size_t>(i)]);
    CHECK(width == w.png);
    CHECK(contains(content(plots / (std::string(w.name) + ".svg")),
                   "width=\"" + std::to_string(w.svg) + "\""));
    CHECK(contains(content(plots / (std::string(w.name) + ".pdf")),
                   "MediaBox [ 0 0 " + std::to_string(w.pdf) + " "));
    CHECK(fs::exists(plots / (std::string(w.name) + ".gp")));
  }
  // The word may be left out, also before the name of the case.
  CHECK(run_yoke(scratch, "run --paper point_pendulum --no-report -o one").code == 0);
  CHECK(fs::exists(scratch / "one/plots/path-double.pdf"));
  CHECK(!fs::exists(scratch / "one/plots/path-single.pdf"));
  CHECK(run_yoke(scratch, run + "--paper --samples 101 -o other").code == 0);
  CHECK(fs::exists(scratch / "other/plots/path-double.pdf"));
  CHECK(run_yoke(scratch, run + "--paper single -o narrow").code == 0);
  CHECK(fs::exists(scratch / "narrow/plots/path-single.pdf"));
  CHECK(!fs::exists(scratch / "narrow/plots/path-double.pdf"));
  const Outcome wrong = run_yoke(scratch, run + "--paper wide");
  CHECK(wrong.code == 1);
  CHECK(contains(wrong.out, "--paper wide: accepted are single, double, both"));
}

TEST_CASE("animations are films too, or their absence is explained") {
  if (std::system("command -v gnuplot >/dev/null") != 0) return;
  const TemporaryFolder scratch;
  const std::string run =
      "run scotch_yoke --paper single --no-report --set revolutions=1 --law table11-johnson -o ";
  const Outcome without = run_yoke(scratch, run + "none",
                                   "mkdir bin; ln -s $(command -v gnuplot) bin; PATH=$PWD/bin; ");
  CHECK(without.code == 0);
  CHECK(contains(without.out, "no films, because ffmpeg is not installed"));
  CHECK(fs::exists(scratch / "none/plots/mechanism_moving.gif"));
  CHECK(!fs::exists(scratch / "none/plots/mechanism_moving.webm"));
  if (std::system("command -v ffmpeg >/dev/null") != 0) return;
  const Outcome drawn = run_yoke(scratch, run + "films");
  CHECK_MESSAGE(contains(drawn.out, "*.gif, *.mp4, *.webm}"), drawn.out);
  CHECK(content(scratch / "films/plots/mechanism_moving.webm").starts_with("\x1a\x45\xdf\xa3"));
  CHECK(content(scratch / "films/plots/mechanism_moving.mp4").substr(4, 4) == "ftyp");
}

}  // namespace

// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/jobs/plot.hpp>

#include <fcntl.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <utility>

#include <yoke/core/error.hpp>
#include <yoke/core/result.hpp>
#include <yoke/integrators/studies/work_pool.hpp>

extern char** environ;

namespace yoke::cases {

namespace {

constexpr const char* script_head = R"(# {title}
# Made by yoke. To draw it again: gnuplot {name}.gp
set encoding utf8
set datafile separator ","
set grid linetype 1 linecolor rgb "#e4e4e4" linewidth 0.5
set border linecolor rgb "#606060"
set key outside {key} reverse Left noautotitle samplen 2
{more})";

// Names below the plot need room under the label of the axis; low panels a few tics, in round steps.
constexpr const char* print_head = R"(set xlabel offset 0,{lift}
power(x) = 10**floor(log10(x))
round_step(x) = x <= 2*power(x) ? 2*power(x) : x <= 5*power(x) ? 5*power(x) : 10*power(x)
)";

constexpr const char* still = R"(do for [format in "png svg"] {{
  if (format eq "png") {{
    set terminal pngcairo size {width},{height} font "DejaVu Sans,11" background rgb "white"
  }} else {{
    set terminal svg size {width},{height} font "DejaVu Sans,11" background rgb "white"
  }}
  set output "{name}.".format
{body}
  unset output
}}
)";

// Text of 8 points, {millimetres:g} mm wide: PNG with 600 dots an inch, SVG in pixels of 1/96 inch; the
// default text of the terminal for PDF is two thirds of what it is called.
constexpr const char* printed = R"(do for [format in "png svg pdf"] {{
  if (format eq "png") {{
    set terminal pngcairo size {dots},{dots_high} font "DejaVu Sans,11" fontscale {png:.4g} linewidth {png:.4g} pointscale {png:.4g} background rgb "white"
  }} else {{ if (format eq "svg") {{
    set terminal svg size {svg_width},{svg_height} font "DejaVu Sans,10.67" linewidth {svg:.4g} background rgb "white"
  }} else {{
    set terminal pdfcairo size {cm:.4g}cm,{cm_high:.4g}cm font "DejaVu Sans,8" fontscale 0.75 linewidth {pdf:.4g}
  }} }}
  set output "{name}.".format
{body}
  unset output
}}
)";

constexpr const char* moving =
    R"(set terminal gif animate delay 4 loop 0 optimize size {width},{height} font "DejaVu Sans,10"
set output "{name}.gif"
{body}
unset output
)";

std::string file_of(const Figure& f) {
  return f.sheet.print() ? fmt::format("{}-{}", f.name, f.sheet.name) : f.name;
}

std::string printed_script(const Figure& f) {
  constexpr double dots_a_mm = 600.0 / 25.4, pixels_a_mm = 96.0 / 25.4, lines_a_mm = 144.0 / 25.4;
  const double scale = f.sheet.millimetres / f.width;  // [mm] of a pixel of the layout
  const auto whole = [&](double x) { return static_cast<int>(std::lround(x * scale)); };
  return fmt::format(
      printed, fmt::arg("name", file_of(f)), fmt::arg("body", f.body),
      fmt::arg("millimetres", f.sheet.millimetres), fmt::arg("dots", whole(dots_a_mm * f.width)),
      fmt::arg("dots_high", whole(dots_a_mm * f.height)), fmt::arg("png", dots_a_mm * scale),
      fmt::arg("svg_width", whole(pixels_a_mm * f.width)),
      fmt::arg("svg_height", whole(pixels_a_mm * f.height)), fmt::arg("svg", pixels_a_mm * scale),
      fmt::arg("cm", 0.1 * scale * f.width), fmt::arg("cm_high", 0.1 * scale * f.height),
      fmt::arg("pdf", lines_a_mm * scale));
}

std::string script(const Figure& f) {
  const std::string more =
      f.sheet.print() ? fmt::format(print_head, fmt::arg("lift", f.sheet.narrow() ? 0.6 : 0.0))
                      : "";
  const std::string head =
      fmt::format(script_head, fmt::arg("title", f.title), fmt::arg("name", file_of(f)),
                  fmt::arg("key", f.sheet.narrow() ? "below center maxcols 1" : "right top"),
                  fmt::arg("more", more));
  if (f.sheet.print()) return head + printed_script(f);
  return head + fmt::format(fmt::runtime(f.animated ? moving : still), fmt::arg("name", f.name),
                            fmt::arg("width", f.width), fmt::arg("height", f.height),
                            fmt::arg("body", f.body));
}

/// Runs a program in the folder, its messages into NAME.log, which stays if it fails. Returns the exit
/// code, 127 if there is no such program.
int run_tool(std::vector<std::string> words, const std::string& name,
             const std::filesystem::path& folder) {
  const std::string log = name + ".log";
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, 1, 2);
  pid_t child = 0;
  const int error =
      posix_spawnp(&child, words.front().c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return 127;
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) std::filesystem::remove(folder / log);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

/// The animation as films too: smaller, and with buttons to stop them. Returns the worst exit code, 127
/// if there is no ffmpeg.
int make_films(const std::string& name, const std::filesystem::path& folder) {
  using Words = std::vector<std::string>;
  int worst = 0;
  for (const auto& [ending, options] :
       {std::pair<std::string, Words>{".mp4", {"-movflags", "+faststart"}},
        std::pair<std::string, Words>{".webm",
                                      {"-c:v", "libvpx-vp9", "-crf", "32", "-b:v", "0"}}}) {
    Words words = {"ffmpeg", "-y", "-loglevel", "error", "-i", name + ".gif"};
    words.insert(words.end(), options.begin(), options.end());
    for (const char* word : {"-pix_fmt", "yuv420p", "-vf", "scale=trunc(iw/2)*2:trunc(ih/2)*2"})
      words.emplace_back(word);
    words.push_back(name + ending);
    const int code = run_tool(words, name + ending, folder);
    if (code != 0) std::filesystem::remove(folder / (name + ending));
    worst = std::max(worst, code);
  }
  return worst;
}

std::string endings(const std::vector<Figure>& figures, bool films) {
  std::string text = "*.png, *.svg";
  if (std::ranges::any_of(figures, [](const Figure& f) { return f.sheet.print(); }))
    text += ", *.pdf";
  if (std::ranges::any_of(figures, &Figure::animated))
    text += films ? ", *.gif, *.mp4, *.webm" : ", *.gif";
  return text;
}

}  // namespace

std::string draw_figures(const std::vector<Figure>& figures, const std::filesystem::path& folder,
                         int jobs, bool films) {
  make_output_folder(folder);
  for (const Figure& f : figures) write_text(folder / (file_of(f) + ".gp"), script(f));
  std::vector<int> codes(figures.size()), film_codes(figures.size());
  run_parallel(figures.size(), jobs, [&](std::size_t i) {
    const Figure& f = figures[i];
    codes[i] = run_tool({"gnuplot", file_of(f) + ".gp"}, file_of(f), folder);
    if (f.animated && codes[i] == 0 && films) film_codes[i] = make_films(f.name, folder);
  });

  std::vector<std::string> failed;
  for (std::size_t i = 0; i < figures.size(); ++i) {
    if (codes[i] == 127)
      return fmt::format(
          "plots: none, because gnuplot is not installed (Debian: apt-get install gnuplot-nox). "
          "The "
          "scripts are in {0}; later: cd {0} && gnuplot *.gp",
          folder.string());
    if (codes[i] != 0) failed.push_back(file_of(figures[i]));
  }
  if (!failed.empty())
    return fmt::format("plots: {}/, but gnuplot failed on {}; see the .log beside the script",
                       folder.string(), fmt::join(failed, ", "));
  const int film = film_codes.empty() ? 0 : std::ranges::max(film_codes);
  std::string text =
      fmt::format("plots: {}/{{{}}}", folder.string(), endings(figures, films && film == 0));
  if (film == 127)
    text += "; no films, because ffmpeg is not installed (Debian: apt-get install ffmpeg)";
  else if (film != 0)
    text += "; ffmpeg failed on a film, see the .log beside it";
  return text;
}

}  // namespace yoke::cases

// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/jobs/plot.hpp>

#include <fcntl.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>

#include <yoke/cases/jobs/parallel.hpp>
#include <yoke/core/error.hpp>
#include <yoke/core/result.hpp>

extern char** environ;

namespace yoke::cases {

namespace {

constexpr const char* script_head = R"(# {title}
# Made by yoke. To draw it again: gnuplot {name}.gp
set encoding utf8
set datafile separator ","
set grid linetype 1 linecolor rgb "#e4e4e4" linewidth 0.5
set border linecolor rgb "#606060"
set key outside right top reverse Left noautotitle samplen 2
)";

// The PDF is as wide as a page of a journal with two columns, its text as large as a caption's.
constexpr const char* still = R"(do for [format in "{formats}"] {{
  if (format eq "png") {{
    set terminal pngcairo size {width},{height} font "DejaVu Sans,11" background rgb "white"
  }} else {{ if (format eq "svg") {{
    set terminal svg size {width},{height} font "DejaVu Sans,11" background rgb "white"
  }} else {{
    set terminal pdfcairo size 17.4cm,{pdf_height}cm font "DejaVu Sans,6.5" linewidth 0.7
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

std::string script(const Figure& f, Figures kind) {
  return fmt::format(script_head, fmt::arg("title", f.title), fmt::arg("name", f.name)) +
         fmt::format(fmt::runtime(f.animated ? moving : still), fmt::arg("name", f.name),
                     fmt::arg("width", f.width), fmt::arg("height", f.height),
                     fmt::arg("formats", kind == Figures::paper ? "png svg pdf" : "png svg"),
                     fmt::arg("pdf_height", 17.4 * f.height / f.width), fmt::arg("body", f.body));
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

/// The animation as a film too, if there is ffmpeg: smaller, and with buttons to stop it.
void make_film(const std::string& name, const std::filesystem::path& folder) {
  const int code = run_tool(
      {"ffmpeg", "-y", "-loglevel", "error", "-i", name + ".gif", "-movflags", "+faststart",
       "-pix_fmt", "yuv420p", "-vf", "scale=trunc(iw/2)*2:trunc(ih/2)*2", name + ".mp4"},
      name, folder);
  if (code != 0 && code != 127) std::filesystem::remove(folder / (name + ".mp4"));
}

}  // namespace

std::string draw_figures(const std::vector<Figure>& figures, const std::filesystem::path& folder,
                         int jobs, Figures kind) {
  make_output_folder(folder);
  for (const Figure& f : figures) write_text(folder / (f.name + ".gp"), script(f, kind));
  std::vector<int> codes(figures.size());
  run_parallel(figures.size(), jobs, [&](std::size_t i) {
    const Figure& f = figures[i];
    codes[i] = run_tool({"gnuplot", f.name + ".gp"}, f.name, folder);
    if (f.animated && codes[i] == 0 && kind == Figures::paper) make_film(f.name, folder);
  });

  std::vector<std::string> failed;
  for (std::size_t i = 0; i < figures.size(); ++i) {
    if (codes[i] == 127)
      return fmt::format(
          "plots: none, because gnuplot is not installed (Debian: apt-get install gnuplot-nox). "
          "The "
          "scripts are in {0}; later: cd {0} && gnuplot *.gp",
          folder.string());
    if (codes[i] != 0) failed.push_back(figures[i].name);
  }
  if (!failed.empty())
    return fmt::format("plots: {}/, but gnuplot failed on {}; see the .log beside the script",
                       folder.string(), fmt::join(failed, ", "));
  return fmt::format("plots: {}/*.png, *.svg, {}*.gif", folder.string(),
                     kind == Figures::paper ? "*.pdf, " : "");
}

}  // namespace yoke::cases

// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/jobs/progress.hpp>

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>

namespace yoke::cases {

namespace {

std::atomic<bool> stop_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may set it");

constexpr double pause_on_terminal = 0.1, pause_elsewhere = 10.0;  // [s] between two lines

/// "50 s", "12 min", "3.5 h".
std::string duration_text(double seconds) {
  if (seconds < 120.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 7200.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

void on_signal(int) { stop_requested = true; }

double seconds() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

}  // namespace

void catch_signals() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // the second one does what it always did
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);
}

bool interrupted() { return stop_requested; }

void set_interrupted(bool value) { stop_requested = value; }

ProgressLine::ProgressLine(std::vector<std::string> names, bool shown)
    : last_draw_(seconds()), shown_(shown), terminal_(isatty(STDERR_FILENO)) {
  for (std::string& name : names) lines_.push_back({.name = std::move(name)});
}

ProgressLine::~ProgressLine() {
  if (drawn_ && terminal_) std::fputs("\r\033[K", stderr);
}

void ProgressLine::report(std::size_t index, const Progress& progress) {
  if (!shown_) return;
  const std::lock_guard lock(mutex_);
  Line& line = lines_[index];
  const double now = seconds();
  if (line.begun < 0.0) line.begun = now;
  line.fraction = progress.fraction;
  line.t = progress.t;
  if (progress.so_far != nullptr) {
    const std::vector<EventRecord>& events = progress.so_far->events;
    for (; line.events < events.size(); ++line.events)
      if (events[line.events].kind == "onset") ++line.contacts;
  }
  if (now - last_draw_ < (terminal_ ? pause_on_terminal : pause_elsewhere)) return;
  last_draw_ = now;
  draw(now);
}

std::string ProgressLine::text_of(const Line& line, double now) {
  std::string text = fmt::format("{} {:.0f} %", line.name, 100.0 * line.fraction);
  const double taken = now - line.begun;
  if (line.t > 0.0 && taken > 0.0)
    text += fmt::format(", t = {:.4g} s, {:.2g} s/s", line.t, line.t / taken);
  if (line.contacts > 0) text += fmt::format(", {} contacts", line.contacts);
  if (line.fraction > 0.0)
    text += fmt::format(", {:.0f} s left", taken * (1.0 - line.fraction) / line.fraction);
  return text;
}

void ProgressLine::draw(double now) {
  double total = 0.0;
  std::string running;
  for (const Line& line : lines_) {
    total += line.fraction / static_cast<double>(lines_.size());
    if (line.fraction > 0.0 && line.fraction < 1.0) running += "  " + text_of(line, now);
  }
  const std::string text = fmt::format("{:3.0f} %{}", 100.0 * total, running);
  std::fputs((terminal_ ? "\r\033[K" + text : text + "\n").c_str(), stderr);
  std::fflush(stderr);
  drawn_ = true;
}

StudyProgressLine::StudyProgressLine(bool shown)
    : last_draw_(seconds()), shown_(shown), terminal_(isatty(STDERR_FILENO)) {}

void StudyProgressLine::report(const StudyProgress& p) {
  if (!shown_) return;
  const double now = seconds();
  if (now - last_draw_ < (terminal_ ? pause_on_terminal : pause_elsewhere)) return;
  last_draw_ = now;
  std::string text = fmt::format("{:3.0f} %, {} of {} points",
                                 100.0 * double(p.done) / double(p.total), p.done, p.total);
  if (p.failed > 0) text += fmt::format(", {} failed", p.failed);
  if (p.done > p.reused)
    text += fmt::format(", {:.3g} points/s, {} left", double(p.done - p.reused) / p.elapsed,
                        duration_text(p.remaining));
  std::fputs((terminal_ ? "\r\033[K" + text : text + "\n").c_str(), stderr);
  std::fflush(stderr);
  drawn_ = true;
}

void StudyProgressLine::clear() {
  if (drawn_ && terminal_) std::fputs("\r\033[K", stderr);
  drawn_ = false;
}

std::function<bool(const Progress&)> ProgressLine::observer(std::size_t index) {
  return [this, index](const Progress& progress) {
    report(index, progress);
    return !interrupted();
  };
}

}  // namespace yoke::cases

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

ProgressLine::ProgressLine(std::vector<std::string> names)
    : names_(std::move(names)), fractions_(names_.size(), 0.0), terminal_(isatty(STDERR_FILENO)) {}

ProgressLine::~ProgressLine() {
  if (drawn_) std::fputs("\r\033[K", stderr);
}

void ProgressLine::report(std::size_t index, double fraction) {
  if (!terminal_) return;
  const std::lock_guard lock(mutex_);
  fractions_[index] = fraction;
  const double now = seconds();
  if (now - last_draw_ < 0.1) return;
  last_draw_ = now;
  draw();
}

void ProgressLine::draw() {
  double total = 0.0;
  std::string running;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    total += fractions_[i] / static_cast<double>(names_.size());
    if (fractions_[i] > 0.0 && fractions_[i] < 1.0)
      running += fmt::format("  {} {:.0f} %", names_[i], 100.0 * fractions_[i]);
  }
  std::fputs(fmt::format("\r\033[K{:3.0f} %{}", 100.0 * total, running).c_str(), stderr);
  std::fflush(stderr);
  drawn_ = true;
}

std::function<bool(const Progress&)> ProgressLine::observer(std::size_t index) {
  return [this, index](const Progress& progress) {
    report(index, progress.fraction);
    return !interrupted();
  };
}

}  // namespace yoke::cases

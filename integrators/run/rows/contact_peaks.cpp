// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/run/rows/contact_peaks.hpp>

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cstdint>
#include <iterator>

namespace yoke {

namespace {

constexpr double rise = 1e-6;       // of the largest so far, by which a peak must exceed it
constexpr int place_bits = 20;      // of the length of a step; the peak is flat
constexpr double misjudged = 1e-3;  // relative, by a glance
constexpr double overshoot = 0.5;   // of the change between looks, by which a peak may exceed them

bool is_watched(const Channel& channel) {
  return channel.name == "normal_force" || channel.name == "penetration";
}

// Of the cubic through four values at equal distances, per a third of the step.
double slope_at_start(const std::array<double, 4>& f) {
  return (-11.0 * f[0] + 18.0 * f[1] - 9.0 * f[2] + 2.0 * f[3]) / 6.0;
}

double slope_at_end(const std::array<double, 4>& f) {
  return (11.0 * f[3] - 18.0 * f[2] + 9.0 * f[1] - 2.0 * f[0]) / 6.0;
}

// Is there a peak inside the step, and is it larger than `before`? By the looks alone.
bool may_peak(const std::array<double, 4>& f, double before) {
  const auto [least, most] = std::ranges::minmax(f);
  if (most + overshoot * (most - least) <= before) return false;
  if (std::max(f[1], f[2]) > std::max(f[0], f[3])) return true;
  return slope_at_start(f) > 0.0 && slope_at_end(f) < 0.0;
}

}  // namespace

ContactPeaks::ContactPeaks(const System& system) {
  std::size_t most = 0;
  for (const ForceSlot& f : system.forces()) {
    if (f.element->contacts() == 0) continue;
    const std::vector<Channel> channels = f.element->channels();
    most = std::max(most, channels.size());
    for (std::size_t i = 0; i < channels.size(); ++i)
      if (is_watched(channels[i])) watched_.push_back({.force = f, .channel = i});
  }
  channels_.resize(most);
}

void ContactPeaks::start(const State& state) {
  for (Watched& w : watched_) w.touching = 0;
  restart(state);
}

void ContactPeaks::restart(const State& state) {
  for (Watched& w : watched_) {
    const auto first = state.contacts.begin() + w.force.contacts;
    const std::ptrdiff_t now =
        std::count_if(first, std::next(first, w.force.element->contacts()),
                      [](const ContactMemory& c) { return c.phase != ContactPhase::apart; });
    if (now > w.touching) w.largest = 0.0;
    w.touching = now;
  }
}

void ContactPeaks::find(double from, double to, System& system, Formulation& formulation,
                        State& scratch, std::vector<double>& times) {
  if (!(to > from)) return;
  const auto part = [](std::size_t i) { return static_cast<double>(i) / (looks - 1); };
  const auto time = [&](double s) { return std::clamp(from + s * (to - from), from, to); };
  system.bind(scratch);
  for (std::size_t i = 0; i < looks; ++i) {
    formulation.glance(time(part(i)), scratch);
    system.set_motion(scratch.t, scratch.q.data(), scratch.v.data());
    system.set_states(scratch.z.data());
    for (Watched& w : watched_)
      if (w.touching > 0) w.seen[i] = value(w, system);
  }
  for (Watched& w : watched_) {
    if (w.touching == 0) continue;
    if (may_peak(w.seen, w.largest * (1.0 + rise))) {
      const auto at = static_cast<std::size_t>(std::ranges::max_element(w.seen) - w.seen.begin());
      std::uintmax_t iterations = 50;
      const auto [s, negative] = boost::math::tools::brent_find_minima(
          [&](double x) { return -value_at(time(x), w, system, formulation, scratch); },
          part(at == 0 ? 0 : at - 1), part(std::min(at + 1, looks - 1)), place_bits, iterations);
      // The glance is good for the place; heights of peaks that hardly differ need a step.
      if (-negative <= w.largest * (1.0 - misjudged)) continue;
      formulation.sample(time(s), scratch);
      if (const double peak = value_of(scratch, w, system); peak > w.largest * (1.0 + rise)) {
        w.largest = peak;
        times.push_back(time(s));
      }
    }
    w.largest = std::max({w.largest, w.seen.front(), w.seen.back()});
  }
}

double ContactPeaks::value(const Watched& w, const System& system) {
  w.force.element->calc_channels(system.force_input(w.force), channels_.data());
  return channels_[w.channel];
}

double ContactPeaks::value_of(const State& state, const Watched& w, System& system) {
  system.set_motion(state.t, state.q.data(), state.v.data());
  system.set_states(state.z.data());
  return value(w, system);
}

double ContactPeaks::value_at(double t, const Watched& w, System& system, Formulation& formulation,
                              State& scratch) {
  formulation.glance(t, scratch);
  return value_of(scratch, w, system);
}

}  // namespace yoke

// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/studies/maps/poincare.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <yoke/integrators/simulation.hpp>
#include <yoke/integrators/studies/maps/details/period_tolerances.hpp>

namespace yoke {

namespace {

constexpr double turn = 2.0 * pi;
constexpr double too_near = 1e-9;  // of the run: a point that is the start itself

/// k of the first point offset + k period behind `t`.
double first_multiple(const Section& s, double t) {
  double k = std::floor((t - s.offset) / s.period);
  while (!(s.offset + k * s.period > t + too_near * s.period)) k += 1.0;
  return k;
}

void check_poincare_options(const Model& model, const Section& section,
                            const PoincareOptions& options) {
  section.check(model);
  const std::string owner = fmt::format("section '{}'", section.name);
  if (options.points < 1) throw ModelError(fmt::format("{}: points = 0 must be at least 1", owner));
  require_not_negative(owner, "duration", options.duration, "s");
  require_positive(owner, "period_tolerance", options.period_tolerance, "");
  if (section.kind == SectionKind::period) return;
  if (options.duration == 0.0)
    throw ModelError(
        fmt::format("{}: duration = 0 s must be greater than 0 s: how long may it take?", owner));
  const auto located = [&](const auto& f) { return f->name() == section.name; };
  if (section.kind != SectionKind::event && std::ranges::none_of(model.forces(), located))
    throw ModelError(fmt::format("{} has not been added to the model", owner));
}

/// Goes from point to point of a run.
class PointSeeker {
 public:
  PointSeeker(Simulation& run, const Model& model, const Section& section)
      : run_(run), model_(model), section_(section), start_(run.time()) {
    if (section.kind == SectionKind::period) k_ = first_multiple(section, start_);
    seen_ = run.events().size();
  }
  /// To the next point; false if the run ends before.
  bool next() {
    if (section_.kind == SectionKind::period) return next_multiple();
    while (!run_.ended()) {
      run_.step();
      if (passed()) return true;
    }
    return false;
  }
  /// That is the point; null for a section by time.
  const EventRecord* event() const { return event_ ? &*event_ : nullptr; }

 private:
  bool next_multiple() {
    const double t = section_.offset + k_ * section_.period;
    k_ += 1.0;
    return t <= run_.end_time() && run_.advance_to(t);
  }
  bool passed() {
    const std::vector<EventRecord>& events = run_.events();
    bool is_point = false;
    for (; seen_ < events.size(); ++seen_) {
      const EventRecord& e = events[seen_];
      if (!is_wanted(e) || e.t - start_ <= too_near * (run_.end_time() - start_)) continue;
      is_point = true;
      event_ = e;
    }
    return is_point;
  }
  bool is_wanted(const EventRecord& e) {
    if (section_.kind == SectionKind::event)
      return e.element == section_.element && e.kind == section_.event_kind;
    if (e.element != section_.name) return false;
    return section_.kind == SectionKind::plane || turns_as_wanted(e);
  }
  /// sin(x/2) rises where x passes 0, 4 pi ... upwards, and falls where it passes 2 pi ...
  bool turns_as_wanted(const EventRecord& e) {
    if (section_.crossing == Crossing::both) return true;
    const bool even = std::cos(0.5 * angle_from_phase()) > 0.0;
    const bool upwards = (e.region == "upwards") == even;
    return upwards == (section_.crossing == Crossing::upwards);
  }
  double angle_from_phase() {
    const auto angle = [&](BodyId id) {
      return id == ground ? 0.0 : run_.state().q[3 * (id.index - 1) + 2];
    };
    for (const auto& c : model_.constraints())
      if (c->name() == section_.element)
        return angle(c->bodies().back()) -
               (c->bodies().size() > 1 ? angle(c->bodies().front()) : 0.0) - section_.value;
    return angle(model_.find_body(section_.element)) - section_.value;
  }

  Simulation& run_;
  const Model& model_;
  const Section& section_;
  double start_;
  double k_ = 0.0;
  std::size_t seen_ = 0;
  std::optional<EventRecord> event_;
};

/// Takes the columns of a run, and how far each reaches.
class PointTaker {
 public:
  PointTaker(Simulation& run, const std::vector<std::string>& columns, bool at_events,
             Poincare& map)
      : run_(run), map_(map), at_events_(at_events) {
    map.points.add_column("t", "s");
    for (const std::string& name : columns) {
      if (name == "t_s") continue;
      sources_.push_back(run.find_output(name));
      map.points.add_column(name, "");
    }
    if (at_events) {
      map.points.add_column("speed", "m/s");
      map.points.add_column("penetration", "m");
    }
    low_.assign(map.points.names().size(), std::numeric_limits<double>::infinity());
    high_.assign(map.points.names().size(), -std::numeric_limits<double>::infinity());
    row_.resize(map.points.names().size());
  }
  void take(const EventRecord* event, bool keep) {
    row_[0] = run_.time();
    std::size_t j = 1;
    for (const std::size_t source : sources_) row_[j++] = run_.output(source);
    if (at_events_) {
      row_[j++] = event->speed;
      row_[j++] = event->penetration;
    }
    for (std::size_t i = 0; i < row_.size(); ++i) {
      low_[i] = std::min(low_[i], row_[i]);
      high_[i] = std::max(high_[i], row_[i]);
    }
    if (keep) std::ranges::copy(row_, map_.points.append());
  }
  void finish() {
    for (std::size_t i = 0; i < row_.size(); ++i)
      map_.range.push_back(is_angle_column(map_.points.names()[i])
                               ? std::min(turn, high_[i] - low_[i])
                               : high_[i] - low_[i]);
  }

 private:
  Simulation& run_;
  Poincare& map_;
  bool at_events_;
  std::vector<std::size_t> sources_;
  std::vector<double> low_, high_, row_;
};

std::string why_not_all(const Simulation& run, const Poincare& map,
                        const PoincareOptions& options) {
  const std::string counted = fmt::format("{} of {} points", map.discarded + map.points.rows(),
                                          options.discard + options.points);
  const Summary& summary = run.summary();
  if (!run.ended()) return fmt::format("stopped after {}", counted);
  if (summary.stop == Stop::completed)
    return fmt::format("{} in {:.6g} s", counted, summary.t_end - summary.t_start);
  return fmt::format("{}: {}", counted, summary.reason);
}

}  // namespace

std::size_t period_of(const Table& rows, const std::vector<double>& tolerances) {
  const std::size_t n = rows.rows(), columns = rows.names().size();
  std::vector<bool> angles;
  for (const std::string& name : rows.names()) angles.push_back(is_angle_column(name));
  const auto same = [&](std::size_t a, std::size_t b) {
    for (std::size_t j = 0; j < columns; ++j) {
      if (tolerances[j] < 0.0) continue;
      const double d = rows.value(a, j) - rows.value(b, j);
      if (!(std::abs(angles[j] ? std::remainder(d, turn) : d) <= tolerances[j])) return false;
    }
    return true;
  };
  for (std::size_t k = 1; 2 * k <= n; ++k) {
    bool repeats = true;
    for (std::size_t i = n - 1; repeats && i >= k; --i) repeats = same(i, i - k);
    if (repeats) return k;
  }
  return 0;
}

Poincare poincare(const Model& model, const State& start, const Section& section,
                  const PoincareOptions& options) {
  check_poincare_options(model, section, options);
  SimulationOptions run_options = options.run;
  run_options.samples = 0;
  run_options.contact_rows = 0;
  run_options.until = start.t + options.duration;
  if (options.duration == 0.0)
    run_options.until =
        section.offset + (first_multiple(section, start.t) +
                          static_cast<double>(options.discard + options.points - 1)) *
                             section.period;
  Simulation run(model, start, run_options);
  Poincare map;
  map.last = run.state();
  PointSeeker seeker(run, model, section);
  PointTaker taker(run, options.columns.empty() ? free_coordinates(model) : options.columns,
                   section.kind == SectionKind::event, map);
  while (map.points.rows() < options.points && seeker.next()) {
    const bool keep = map.discarded == options.discard;
    taker.take(seeker.event(), keep);
    if (!keep) ++map.discarded;
    map.last = run.state();
    if (options.observer && !options.observer(map.discarded + map.points.rows())) break;
  }
  taker.finish();
  map.complete = map.points.rows() == options.points;
  if (!map.complete) map.reason = why_not_all(run, map, options);
  map.summary = run.result().summary;
  if (map.points.rows() > 0)
    map.period = period_of(map.points, period_tolerances(map, map.range, options));
  return map;
}

Poincare poincare(const Model& model, const Section& section, const PoincareOptions& options) {
  return poincare(model, model.start_state(), section, options);
}

}  // namespace yoke

// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/studies/maps/bifurcation.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>

#include <yoke/integrators/studies/maps/details/period_tolerances.hpp>
#include <yoke/integrators/studies/work_pool.hpp>

namespace yoke {

namespace {

/// One value in one direction.
struct DiagramPart {
  double value = 0.0;
  bool backward = false;
  bool done = false;
  Poincare map{};
};

/// The values of one thread in their turn.
using Chain = std::vector<std::size_t>;

/// Where the model at the next value begins, when that before has ended at its last point.
State continued(const SectionedModel& before, const State& last, const SectionedModel& next) {
  State start = carried_over(before.model, last, next.model, next.start);
  const Section& s = next.section;
  if (s.kind == SectionKind::period)
    start.t = s.offset + std::max(0.0, std::ceil((next.start.t - s.offset) / s.period)) * s.period;
  else
    start.t = time_of_drivers(next.model, start, last.t);
  return start;
}

class DiagramMaker {
 public:
  DiagramMaker(const ModelOfParameter& model, const std::vector<double>& values,
               const BifurcationOptions& options)
      : model_(model), options_(options) {
    const bool forward = options.continuation != Continuation::backward;
    if (forward)
      for (const double value : values) parts_.push_back({.value = value});
    if (options.continuation == Continuation::backward ||
        options.continuation == Continuation::both)
      for (const double value : values) parts_.push_back({.value = value, .backward = true});
    make_chains(values.size());
  }

  void run() {
    run_parallel(chains_.size(), options_.jobs, [this](std::size_t i) { follow(chains_[i]); });
  }

  Bifurcation result() const {
    Bifurcation all;
    all.complete = std::ranges::all_of(parts_, &DiagramPart::done);
    add_points(all.points);
    const std::vector<double> range = range_of(all.points);
    for (const DiagramPart& part : parts_) {
      if (!part.done && part.map.points.rows() == 0) continue;
      all.rows.push_back({.value = part.value,
                          .backward = part.backward,
                          .points = part.map.points.rows(),
                          .period = period(part, range),
                          .reason = part.map.reason});
    }
    return all;
  }

 private:
  void make_chains(std::size_t count) {
    if (options_.continuation == Continuation::afresh) {
      for (std::size_t i = 0; i < parts_.size(); ++i) chains_.push_back({i});
      return;
    }
    for (std::size_t first = 0; first < parts_.size(); first += count) {
      Chain chain;
      for (std::size_t i = 0; i < count; ++i) chain.push_back(first + i);
      if (parts_[first].backward) std::ranges::reverse(chain);
      chains_.push_back(std::move(chain));
    }
  }

  void follow(const Chain& chain) {
    std::unique_ptr<SectionedModel> before;
    State last;
    for (const std::size_t i : chain) {
      if (stopped()) return;
      DiagramPart& part = parts_[i];
      PoincareOptions options = options_.map;
      options.observer = [this](std::size_t) { return !stopped(); };
      std::unique_ptr<SectionedModel> here;
      try {
        here = std::make_unique<SectionedModel>(model_(part.value));
        compute(part, *here, before.get(), last, options);
      } catch (const ModelError& error) {
        if (i == 0) throw;  // of the whole diagram, most likely
        part.map = {};
        part.map.reason = error.what();
      }
      if (part.map.summary.stop == Stop::interrupted || (stopped() && !part.map.complete)) return;
      part.done = true;
      last = part.map.last;
      before = part.map.complete ? std::move(here) : nullptr;
      report();
    }
  }

  /// What cannot go on from where the value before has ended begins at its own start.
  void compute(DiagramPart& part, const SectionedModel& here, const SectionedModel* before,
               const State& last, const PoincareOptions& options) {
    if (before == nullptr) {
      part.map = poincare(here.model, here.start, here.section, options);
      return;
    }
    try {
      part.map = poincare(here.model, continued(*before, last, here), here.section, options);
    } catch (const ModelError& error) {
      part.map = poincare(here.model, here.start, here.section, options);
      part.map.reason =
          fmt::format("begun afresh, because what was carried over does not fit: {}{}{}",
                      error.what(), part.map.reason.empty() ? "" : "; ", part.map.reason);
    }
  }

  bool stopped() const { return options_.stop && options_.stop(); }

  void report() {
    const std::lock_guard lock(mutex_);
    ++done_;
    if (options_.observer) options_.observer(done_, parts_.size());
  }

  void add_points(Table& table) const {
    table.add_column("value", "");
    table.add_column("direction", "", {"forward", "backward"});
    table.add_column("point", "");
    const auto first = std::ranges::find_if(
        parts_, [](const DiagramPart& part) { return !part.map.points.names().empty(); });
    if (first == parts_.end()) return;
    for (const std::string& name : first->map.points.names()) table.add_column(name, "");
    for (const DiagramPart& part : parts_)
      for (std::size_t i = 0; i < part.map.points.rows(); ++i) {
        double* row = table.append();
        row[0] = part.value;
        row[1] = part.backward ? 1.0 : 0.0;
        row[2] = static_cast<double>(i);
        for (std::size_t j = 0; j < part.map.points.names().size(); ++j)
          row[3 + j] = part.map.points.value(i, j);
      }
  }

  /// Of the columns of the section, over all values.
  static std::vector<double> range_of(const Table& points) {
    std::vector<double> range;
    for (std::size_t j = 3; j < points.names().size(); ++j) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (std::size_t i = 0; i < points.rows(); ++i) {
        low = std::min(low, points.value(i, j));
        high = std::max(high, points.value(i, j));
      }
      const double width = points.rows() > 0 ? high - low : 0.0;
      range.push_back(is_angle_column(points.names()[j]) ? std::min(width, 2.0 * pi) : width);
    }
    return range;
  }

  /// A value beside others knows what is far by them; one alone by its transient.
  std::size_t period(const DiagramPart& part, const std::vector<double>& range) const {
    if (part.map.points.rows() == 0) return 0;
    return period_of(
        part.map.points,
        period_tolerances(part.map, parts_.size() > 1 ? range : part.map.range, options_.map));
  }

  const ModelOfParameter& model_;
  const BifurcationOptions& options_;
  std::vector<DiagramPart> parts_;
  std::vector<Chain> chains_;
  std::mutex mutex_;
  std::size_t done_ = 0;
};

}  // namespace

Bifurcation bifurcation(const ModelOfParameter& model, const std::vector<double>& values,
                        const BifurcationOptions& options) {
  if (values.empty()) throw ModelError("bifurcation: values: there must be at least one");
  for (const double value : values) require_finite("bifurcation", "value", value);
  DiagramMaker maker(model, values, options);
  maker.run();
  return maker.result();
}

}  // namespace yoke

// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/analyses/equilibrium_path.hpp>

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>

#include <yoke/integrators/analyses/details/path_equations.hpp>
#include <yoke/integrators/analyses/details/stiffness.hpp>
#include <yoke/integrators/analyses/equilibrium.hpp>
#include <yoke/integrators/analyses/modes.hpp>
#include <yoke/integrators/run/recorder.hpp>
#include <yoke/integrators/run/start/start_checks.hpp>

namespace yoke {

namespace {

constexpr double first_step = 0.2;        // of the largest
constexpr double corner_below = 1e-7;     // of the largest: no smooth path needs such steps
constexpr double corner_located = 1e-11;  // the same
constexpr double largest_leap = 20.0;     // beyond a corner, in changes of the parameter
constexpr double same_way = 0.9;          // cosine between tangents that are accepted
constexpr double straight = 0.99;         // the same: the step may grow
constexpr double very_straight = 0.999;
constexpr double bent = 0.97;         // the same: it shrinks
constexpr double near_tangent = 0.5;  // of a step: the largest correction
constexpr double located = 1e-13;     // of a step
constexpr double branch_located = 1e-9, branch_seen = 1e-6;
constexpr double torn = 1e3;             // of that: the points belong to different paths
constexpr double parameter_step = 1e-5;  // of the range, for a difference
constexpr unsigned max_trials = 80;

using Vector = Eigen::VectorXd;

/// The parameter that changes: where it lives and what its column is called.
struct Changing {
  std::string name = "load_factor", unit{};
  std::optional<std::size_t> index{};  // into State::parameters; none: the factor of the loads
};

std::string column_unit(const std::string& unit) {
  std::string text;
  for (const char c : unit) {
    if (c == '/')
      text += "_per_";
    else if (c != ' ' || !text.ends_with("_per_"))
      text += c == ' ' ? '_' : c;
  }
  return text;
}

Changing find_changing(const Model& model, const EquilibriumPathOptions& options) {
  if (options.parameter.empty()) return {};
  model.check_parameter("equilibrium_path", options.parameter, options.from);
  model.check_parameter("equilibrium_path", options.parameter, options.to);
  const std::size_t index = model.find_parameter(options.parameter);
  const OwnedParameter& changing = model.parameters()[index];
  if (changing.of_constraint)
    throw ModelError(fmt::format(
        "equilibrium_path: parameter = '{}' sets a motion; nothing rests then", options.parameter));
  return {options.parameter, changing.parameter.unit, index};
}

void check_options(const EquilibriumPathOptions& o) {
  require_finite("equilibrium_path", "from", o.from);
  require_finite("equilibrium_path", "to", o.to);
  require_finite("equilibrium_path", "t", o.t);
  if (o.from == o.to)
    throw ModelError(fmt::format("equilibrium_path: from and to are both {:g}", o.from));
  if (!(o.largest_step > 0.0 && o.largest_step <= 1.0))
    throw ModelError(fmt::format("equilibrium_path: largest_step = {:g} must be above 0, at most 1",
                                 o.largest_step));
  if (o.points < 2)
    throw ModelError(fmt::format("equilibrium_path: points = {} must be at least 2", o.points));
  if (!o.parameter.empty() && !o.loads.empty())
    throw ModelError(
        fmt::format("equilibrium_path: loads are named, but what changes is '{}'; give one of both",
                    o.parameter));
}

/// Where the way has got to.
struct Place {
  Vector y, tangent;
  std::optional<Stiffness> stiffness;
  int negatives() const { return stiffness ? stiffness->negatives : 0; }
};

class Follower {
 public:
  Follower(const Model& model, const State& rest, const EquilibriumPathOptions& options,
           Changing changing)
      : options_(options),
        changing_(std::move(changing)),
        statics_(model, rest, {.t = options.t, .loads = options.loads}),
        equations_(
            statics_, [this](double progress) { set(progress); },
            changing_.index ? parameter_step : 0.5),
        recorder_(statics_.dynamics(), narrow_, 0) {
    statics_.set_rest(rest);
    add_columns();
  }

  EquilibriumPath follow() {
    Place here;
    here.y = equations_.point(statics_.unknowns(), 0.0);
    const Vector forward = equations_.border_of_progress(here.y.size());
    if (!equations_.correct(here.y, forward, 0.0) ||
        !equations_.tangent(here.y, forward, here.tangent))
      return end(here,
                 "the path has no direction at its start: the equilibrium is itself a limit "
                 "or branch point; start beside it");
    equations_.set_reach(statics_.largest_displacement(here.tangent) /
                         std::abs(PathEquations::progress(here.tangent)));
    here.tangent /= equations_.norm(here.tangent);
    look(here);
    record(here, PathPoint::regular);
    step_ = first_step * options_.largest_step;
    while (static_cast<int>(path_.points.rows()) < options_.points) {
      Place next;
      if (!advance(here, next))
        return end(here,
                   "no equilibrium was found next to it, in steps as small as rounding "
                   "allows: a contact law at its limit, or a singular position?");
      if (jumps(here, next)) {
        step_ = 0.25 * made_;
        continue;
      }
      if (look_between(here, next)) {
        if (arrive(here, next)) return end(here, {});
        return end(here, "the equilibrium at the end itself was not found");
      }
      record(next, PathPoint::regular);
      here = std::move(next);
    }
    return end(here, fmt::format("{} points are made, which may be raised", options_.points));
  }

 private:
  double value(double progress) const {
    return progress == 1.0 ? options_.to : std::lerp(options_.from, options_.to, progress);
  }
  void set(double progress) {
    if (changing_.index)
      statics_.set_parameter(*changing_.index, value(progress));
    else
      statics_.set_load(value(progress));
  }

  /// The point of the path across the tangent of `from`, so far ahead.
  bool point_ahead(const Place& from, double step, Vector& y) {
    const Vector border = equations_.border(from.tangent), ahead = from.y + step * from.tangent;
    y = ahead;
    return equations_.correct(y, border, border.dot(ahead)) &&
           equations_.norm(y - ahead) <= near_tangent * step;
  }

  /// The same with the tangent, if the path does not bend much on the way.
  bool step_ahead(const Place& from, double step, Place& to) {
    const Vector border = equations_.border(from.tangent);
    return point_ahead(from, step, to.y) && equations_.tangent(to.y, border, to.tangent) &&
           border.dot(to.tangent) >= same_way;
  }

  /// One step of a length that suits the path.
  bool advance(const Place& here, Place& next) {
    step_ = std::min(step_, options_.largest_step / equations_.largest(here.tangent));
    for (; step_ > corner_below * options_.largest_step; step_ *= 0.5) {
      if (!step_ahead(here, step_, next)) continue;
      made_ = step_;
      const double cosine = equations_.border(here.tangent).dot(next.tangent);
      if (cosine > straight) step_ *= cosine > very_straight ? 2.0 : 1.5;
      if (cosine < bent) step_ *= 0.7;
      look(next);
      return true;
    }
    return turn_corner(here, next);
  }

  /// Where a contact begins or ends to press the path has a corner, maybe so sharp that it goes back
  /// in the same plane: it is located from this side, then a point beyond is looked for at a
  /// parameter a little changed.
  bool turn_corner(const Place& here, Place& next) {
    double low = 0.0, high = 2.0 * step_;
    Place corner = here, p;
    while (high - low > corner_located * options_.largest_step) {
      const double middle = 0.5 * (low + high);
      const bool ahead = step_ahead(here, middle, p);
      if (ahead) corner = p;
      (ahead ? low : high) = middle;
    }
    made_ = 0.0;
    for (double change = 1e-6; change < 0.2; change *= 10.0)
      for (double beyond = 1e-10; beyond < 1e-2; beyond *= 10.0)
        for (const double side : {1.0, -1.0})
          if (leave_corner(corner, beyond, side * change, next)) {
            const bool turns =
                PathEquations::progress(corner.tangent) * PathEquations::progress(next.tangent) <
                0.0;
            look(corner);
            record(corner, turns ? PathPoint::limit : PathPoint::regular);
            look(next);
            step_ = std::max(equations_.norm(next.y - corner.y),
                             10.0 * corner_below * options_.largest_step);
            return true;
          }
    return false;
  }

  bool leave_corner(const Place& corner, double beyond, double change, Place& next) {
    next.y = corner.y + beyond * corner.tangent;
    const double target = PathEquations::progress(corner.y) + change;
    next.y[next.y.size() - 1] = target;
    const Vector border = equations_.border_of_progress(next.y.size());
    if (!equations_.correct(next.y, border, target)) return false;
    const Vector way = next.y - corner.y;
    const double length = equations_.norm(way);
    const bool back = equations_.border(corner.tangent).dot(way) < -straight * length;
    if (back || length > largest_leap * (std::abs(change) + beyond)) return false;
    if (!equations_.tangent(next.y, border, next.tangent)) return false;
    if (equations_.border(next.tangent).dot(way) < 0.0) next.tangent = -next.tangent;
    return true;
  }

  /// Records what lies between two points; true if the end is there, between low_ and high_.
  bool look_between(const Place& here, const Place& next) {
    low_ = 0.0, high_ = made_;
    if (made_ == 0.0) return reaches(here, next);  // over a corner
    Place limit;
    if (PathEquations::progress(here.tangent) * PathEquations::progress(next.tangent) < 0.0) {
      if (!locate_limit(here, limit)) return reaches(here, next);
      if (reaches(here, limit)) return high_ = limit_, true;
      record(limit, PathPoint::limit);
      low_ = limit_;
      return reaches(limit, next);
    }
    if (reaches(here, next)) return true;
    if (branch_) record(*branch_, PathPoint::branch);
    return false;
  }

  static bool reaches(const Place& a, const Place& b) {
    return (PathEquations::progress(a.y) - 1.0) * (PathEquations::progress(b.y) - 1.0) <= 0.0;
  }

  /// The step between low and high at which f [of a place ahead, with its tangent] is zero.
  template <class F>
  std::optional<double> root_ahead(const Place& here, double low, double high, const F& f) {
    bool failed = false;
    const auto g = [&](double step) {
      Place p = here;
      if (step > 0.0 && (!point_ahead(here, step, p.y) ||
                         !equations_.tangent(p.y, equations_.border(here.tangent), p.tangent))) {
        failed = true;
        return 0.0;
      }
      return f(p);
    };
    const double at_low = g(low), at_high = g(high);
    if (failed || !(at_low * at_high <= 0.0)) return std::nullopt;
    if (at_low == 0.0 || at_high == 0.0) return at_low == 0.0 ? low : high;
    std::uintmax_t trials = max_trials;
    const auto [a, b] = boost::math::tools::toms748_solve(
        g, low, high, at_low, at_high,
        [&](double x, double y) { return std::abs(x - y) <= located * made_; }, trials);
    if (failed) return std::nullopt;
    return 0.5 * (a + b);
  }

  /// The limit point, `limit_` ahead of `here`.
  bool locate_limit(const Place& here, Place& limit) {
    const auto step = root_ahead(here, 0.0, made_,
                                 [](const Place& p) { return PathEquations::progress(p.tangent); });
    if (!step || !point_ahead(here, *step, limit.y)) return false;
    limit_ = *step;
    look(limit);
    return true;
  }

  /// To the end exactly, which lies low_ to high_ ahead of `here`, or close to `next`.
  bool arrive(Place& here, const Place& next) {
    Place there = next;
    if (made_ > 0.0) {
      const auto step = root_ahead(
          here, low_, high_, [](const Place& p) { return PathEquations::progress(p.y) - 1.0; });
      if (!step || !point_ahead(here, *step, there.y)) return false;
    }
    const Vector border = equations_.border_of_progress(there.y.size());
    there.y[there.y.size() - 1] = 1.0;
    if (!equations_.correct(there.y, border, 1.0)) return false;
    look(there);
    record(there, PathPoint::regular);
    here = std::move(there);
    return path_.complete = true;
  }

  /// Where stability changes between two points though the parameter does not turn, there is a branch
  /// point, which is located, or the step has jumped from one path to another close by.
  bool jumps(const Place& here, const Place& next) {
    branch_.reset();
    if (made_ == 0.0 || !here.stiffness || !next.stiffness ||
        here.negatives() == next.negatives() ||
        PathEquations::progress(here.tangent) * PathEquations::progress(next.tangent) < 0.0)
      return false;
    double low = 0.0, high = made_;
    Place before = here, beyond = next;
    while (high - low > branch_located * made_) {
      const double step = 0.5 * (low + high);
      Place p;
      // At a branch point itself nothing tells the branches apart; between paths there is a gap.
      if (!point_ahead(here, step, p.y)) {
        if (high - low > branch_seen * made_) return true;
        break;
      }
      look(p);
      const bool over = p.negatives() == next.negatives();
      (over ? high : low) = step;
      (over ? beyond : before) = p;
    }
    if (equations_.norm(beyond.y - before.y) > torn * (high - low)) return true;
    branch_ = std::move(beyond);
    return false;
  }

  void look(Place& place) {
    set_place(place);
    place.stiffness = stiffness_at(statics_, statics_.state());
  }
  void set_place(const Place& place) {
    set(PathEquations::progress(place.y));
    statics_.set(place.y.head(place.y.size() - 1));
  }

  void add_columns() {
    Table& table = path_.points;
    table.add_column(changing_.name, column_unit(changing_.unit));
    table.add_column("point", "", {"regular", "limit", "branch"});
    table.add_column("stability", "", {"stable", "neutral", "unstable", "unknown"});
    table.add_column("lowest_stiffness", "per_s2");
    const Table& all = narrow_.samples;
    for (std::size_t i = 0; i < all.names().size(); ++i)
      table.add_column(all.names()[i], "", all.labels(i));
  }

  /// Index into the labels of "stability".
  int stability(const Place& place, PathPoint kind) {
    if (!place.stiffness) {
      const System& system = statics_.dynamics().system();
      return system.dofs() + system.states() > largest_linearisation ? 3 : 0;
    }
    // At a critical point rounding decides the sign of what is zero; a corner has no zero.
    const bool corner = made_ == 0.0;
    if (kind != PathPoint::regular && !corner && place.stiffness->negatives <= 1) return 1;
    return place.stiffness->negative() ? 2 : place.stiffness->neutral ? 1 : 0;
  }

  void record(const Place& place, PathPoint kind) {
    set_place(place);
    path_.final = statics_.finish();
    statics_.dynamics().system().bind(path_.final);
    recorder_.start(path_.final);
    recorder_.record(path_.final);
    const double p = value(PathEquations::progress(place.y));
    double* row = path_.points.append();
    *row++ = p;
    *row++ = static_cast<double>(kind);
    *row++ = stability(place, kind);
    *row++ = place.stiffness ? place.stiffness->lowest : std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < narrow_.samples.names().size(); ++i)
      *row++ = narrow_.samples.value(narrow_.samples.rows() - 1, i);
    if (kind != PathPoint::regular)
      path_.critical.push_back({kind, p, path_.points.rows() - 1, path_.final});
  }

  EquilibriumPath end(const Place& here, const std::string& why) {
    const double p = value(PathEquations::progress(here.y));
    const std::string unit = changing_.unit.empty() ? "" : " " + changing_.unit;
    path_.reason = path_.complete ? fmt::format("{} = {:g}{} was reached in {} points",
                                                changing_.name, p, unit, path_.points.rows())
                                  : fmt::format("the path ends at {} = {:g}{}: {}", changing_.name,
                                                p, unit, why);
    path_.iterations = equations_.iterations();
    return std::move(path_);
  }

  const EquilibriumPathOptions& options_;
  Changing changing_;
  Statics statics_;
  PathEquations equations_;
  Result narrow_;
  Recorder recorder_;
  EquilibriumPath path_;
  std::optional<Place> branch_;                  // in the last step
  double step_ = 0.0, made_ = 0.0;               // the next step, the last
  double limit_ = 0.0, low_ = 0.0, high_ = 0.0;  // parts of the last: to what lies in it
};

}  // namespace

EquilibriumPath equilibrium_path(const Model& model, const State& start,
                                 const EquilibriumPathOptions& options) {
  check_model(model);
  check_state(model, start);
  check_options(options);
  Changing changing = find_changing(model, options);
  State first = start;
  if (changing.index) first.parameters[*changing.index] = options.from;
  const Equilibrium rest = equilibrium(model, first,
                                       {.t = options.t,
                                        .loads = options.loads,
                                        .load_factor = changing.index ? 1.0 : options.from,
                                        .allow_neutral = options.allow_neutral});
  if (!rest.found) {
    EquilibriumPath none;
    none.reason = fmt::format("the path has no start at {} = {:g}: {}", changing.name, options.from,
                              rest.reason);
    none.final = rest.state;
    return none;
  }
  return Follower(model, rest.state, options, std::move(changing)).follow();
}

EquilibriumPath equilibrium_path(const Model& model, const EquilibriumPathOptions& options) {
  return equilibrium_path(model, model.start_state(), options);
}

}  // namespace yoke

// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/equations/redundancy.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include <yoke/core/equations/least_change.hpp>
#include <yoke/core/equations/linear/index.hpp>

namespace yoke {

namespace {

constexpr int tries = 3;
constexpr double excursion = 0.02;         // length scales or rad, of a look beside the pose
constexpr double moved = 0.1;              // of the excursion: less is no motion
constexpr double negligible_share = 1e-7;  // of the largest part of a null vector

double scaled_distance(const System& system, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < a.size(); ++i)
    largest =
        std::max(largest, std::abs(a[i] - b[i]) / (i % 3 == 2 ? 1.0 : system.scales().length));
  return largest;
}

/// What each row with a part in a null vector adds to which component of a reaction.
void mark_doubts(const System& system, const RankAnalysis& analysis,
                 std::vector<ReactionDoubt>& marks) {
  const double length = system.scales().length;
  std::vector<double> u(at(system.rows()));
  for (int k = 0; k < analysis.null_space.outerSize(); ++k) {
    std::ranges::fill(u, 0.0);
    for (Eigen::SparseMatrix<double>::InnerIterator it(analysis.null_space, k); it; ++it)
      u[at(static_cast<int>(it.row()))] = it.value();
    std::vector<Reaction> reactions;
    double largest = 0.0;
    for (std::size_t i = 0; i < system.joints().size(); ++i) {
      const Reaction r = system.reaction(i, u.data());
      reactions.push_back(r);
      largest = std::max({largest, r.force.norm(), std::abs(r.moment) / length});
    }
    for (std::size_t i = 0; i < reactions.size(); ++i) {
      const Reaction& r = reactions[i];
      marks[i].fx |= std::abs(r.force.x()) > negligible_share * largest;
      marks[i].fy |= std::abs(r.force.y()) > negligible_share * largest;
      marks[i].moment |= std::abs(r.moment) > negligible_share * length * largest;
    }
  }
}

}  // namespace

std::string partners_of(const System& system, const RankAnalysis& analysis, int row) {
  for (int k = 0; k < analysis.null_space.outerSize(); ++k) {
    double own = 0.0, largest = 0.0;
    using It = Eigen::SparseMatrix<double>::InnerIterator;
    for (It it(analysis.null_space, k); it; ++it) {
      largest = std::max(largest, std::abs(it.value()));
      if (it.row() == row) own = std::abs(it.value());
    }
    if (own < negligible_share * largest) continue;
    std::string names;
    int count = 0;
    for (It it(analysis.null_space, k); it && count < 5; ++it) {
      if (it.row() == row || std::abs(it.value()) < negligible_share * largest) continue;
      names +=
          (names.empty() ? "'" : ", '") + system.equation_name(static_cast<int>(it.row())) + "'";
      ++count;
    }
    if (!names.empty()) return names;
  }
  return "an equation that no coordinate can change";
}

std::vector<std::string> column_names(const System& system,
                                      const std::vector<ReactionDoubt>& doubts) {
  std::vector<std::string> names;
  for (const ReactionDoubt& d : doubts) {
    const std::string& joint = system.joints()[d.constraint].element->name();
    if (d.fx) names.push_back(joint + ".fx_N");
    if (d.fy) names.push_back(joint + ".fy_N");
    if (d.moment) names.push_back(joint + ".moment_N_m");
  }
  return names;
}

Redundancy analyse_redundancy(System& system, const State& state) {
  // Drivers are taken off while looking beside the pose: a driven mechanism cannot move at once.
  std::vector<char> drivers(at(system.rows()), 0);
  for (const ConstraintSlot& c : system.constraints())
    if (c.element->rheonomic()) std::fill_n(drivers.begin() + c.row, c.rows, 1);
  const std::vector<double> none(at(system.dofs()), 0.0);
  const auto evaluate = [&](const Eigen::VectorXd& q) {
    std::vector<double> phi(at(system.rows()));
    system.set_motion(state.t, q.data(), none.data());
    system.calc_position_level(phi.data());
  };

  Redundancy result;
  evaluate(state.q);
  result.here = analyse_rank(system);
  result.rank = result.here.rank;
  result.redundant = result.here.dependent;
  if (result.redundant.empty()) return result;
  std::vector<ReactionDoubt> marks(system.joints().size());
  for (std::size_t i = 0; i < marks.size(); ++i) marks[i].constraint = i;
  std::vector<ReactionDoubt> marks_here = marks;
  mark_doubts(system, result.here, marks_here);

  const int mobility = system.dofs() - analyse_rank(system, drivers).rank;
  LeastChange nearby(system, metric_of_lengths(system), {}, drivers);
  std::mt19937_64 random(20050104);
  bool has_moved = false;
  for (int i = 0; i < tries && mobility > 0; ++i) {
    evaluate(state.q);
    Eigen::VectorXd d(system.dofs());
    for (Eigen::Index k = 0; k < d.size(); ++k) {
      const double unit = static_cast<double>(random() >> 11) * 0x1p-53;  // the same everywhere
      d[k] = (2.0 * unit - 1.0) * (k % 3 == 2 ? 1.0 : system.scales().length);
    }
    nearby.make_admissible(d.data());
    const double size = scaled_distance(system, d, Eigen::VectorXd::Zero(d.size()));
    if (!(size > 0.0)) continue;
    Eigen::VectorXd q = state.q + excursion / size * d;
    if (!nearby.solve_positions(state.t, q.data())) continue;
    if (scaled_distance(system, q, state.q) < moved * excursion) continue;
    evaluate(q);
    const RankAnalysis beside = analyse_rank(system);
    if (beside.rank > result.rank) {
      result.rank = beside.rank;
      result.redundant = beside.dependent;
      result.singular_here = true;
      for (ReactionDoubt& m : marks) m.fx = m.fy = m.moment = false;
    }
    if (beside.rank == result.rank) mark_doubts(system, beside, marks);
    has_moved = true;
  }
  if (!has_moved && mobility > 0) {
    const int row = result.here.dependent.front();
    result.conflict = fmt::format(
        "'{}' is in conflict with {}: they agree at the start pose only and leave the mechanism no "
        "way to move from it",
        system.equation_name(row), partners_of(system, result.here, row));
  }
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (!result.singular_here) {
      marks[i].fx |= marks_here[i].fx;
      marks[i].fy |= marks_here[i].fy;
      marks[i].moment |= marks_here[i].moment;
    }
    if (marks[i].fx || marks[i].fy || marks[i].moment) result.doubts.push_back(marks[i]);
  }
  return result;
}

}  // namespace yoke

// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/equations/massless.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include <yoke/core/equations/least_change.hpp>
#include <yoke/core/equations/linear/index.hpp>
#include <yoke/core/equations/rank.hpp>

namespace yoke {

namespace {

constexpr double undetermined = 1e-8;     // at the start: what dependent equations are held to
constexpr double at_impasse = 1e-3;       // as near as steps come; the distance is of this order
constexpr double negligible_part = 1e-6;  // of the largest part of a motion
constexpr int looks = 3;                  // beside the start pose
constexpr double look_excursion = 0.02;   // length scales or rad
constexpr std::size_t most_described = 5;

using Sparse = Eigen::SparseMatrix<double>;

/// The joints, and below them a row for every coordinate that has mass; the coordinates are lengths,
/// every row has the length 1. How much mass there is does not matter.
Sparse joints_and_masses(const System& system, const std::vector<double>& metric) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const ConstraintSlot& c : system.constraints())
    for (int i = 0; i < c.rows; ++i) {
      if (system.is_dropped(c.row + i)) continue;
      double square = 0.0;
      const std::size_t first = entries.size();
      for (int j = 0; j < c.columns; ++j) {
        const int dof = system.dof()[at(c.dofs + j)];
        const double g = system.G()[c.block + i * c.columns + j];
        if (dof < 0 || g == 0.0) continue;
        entries.emplace_back(c.row + i, dof, g / std::sqrt(metric[at(dof)]));
        square += std::pow(entries.back().value(), 2);
      }
      for (std::size_t k = first; k < entries.size(); ++k)
        entries[k] = {entries[k].row(), entries[k].col(), entries[k].value() / std::sqrt(square)};
    }
  int rows = system.rows();
  for (int i = 0; i < system.dofs(); ++i)
    if (system.mass()[at(i)] > 0.0) entries.emplace_back(rows++, i, 1.0);
  Sparse a(rows, system.dofs());
  a.setFromTriplets(entries.begin(), entries.end());
  a.makeCompressed();
  return a;
}

/// Parts of what has mass are not zero, only small.
MasslessMotion describe(const System& system, Eigen::VectorXd motion) {
  MasslessMotion result;
  for (Eigen::Index i = 0; i < motion.size(); ++i)
    if (system.mass()[at(static_cast<int>(i))] > 0.0) motion[i] = 0.0;
  const double least = negligible_part * motion.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < motion.size(); i += 3) {
    const MasslessMotion::Part part{.body = static_cast<int>(i / 3 + 1),
                                    .turns = std::abs(motion[i + 2]) > least,
                                    .shifts = motion.segment<2>(i).cwiseAbs().maxCoeff() > least};
    if (part.turns || part.shifts) result.parts.push_back(part);
  }
  return result;
}

/// "'a', 'b' and 'c'"
std::string names_of(const Model& model, const MasslessMotion& motion) {
  std::string names;
  const std::size_t count = std::min(motion.parts.size(), most_described);
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) names += i + 1 == motion.parts.size() ? " and " : ", ";
    names += "'" + model.bodies()[at(motion.parts[i].body)].name + "'";
  }
  return count < motion.parts.size() ? names + " and others" : names;
}

bool lacks_inertia_only(const Model& model, const MasslessMotion& motion) {
  return std::ranges::all_of(motion.parts, [&](const MasslessMotion::Part& part) {
    return model.bodies()[at(part.body)].mass > 0.0;
  });
}

/// "no mass and free to turn"; `what` a body can do is the union of all its own motions.
std::string freedom(const Model& model, const std::vector<MasslessMotion>& motions) {
  const MasslessMotion& first = motions.front();
  const char* lack = lacks_inertia_only(model, first) ? "no inertia" : "no mass";
  if (first.parts.size() > 1)
    return fmt::format("{}: {} and free to move together", names_of(model, first), lack);
  MasslessMotion::Part part = first.parts.front();
  // A body that is pinned turns about its pin: its centre shifts only because it turns.
  part.shifts = !part.turns;
  for (std::size_t i = 1; i < motions.size(); ++i)
    if (motions[i].parts.size() == 1 && motions[i].parts.front().body == part.body) {
      part.turns = part.turns || motions[i].parts.front().turns;
      part.shifts = true;
    }
  return fmt::format("{}: {} and free to {}", names_of(model, first), lack,
                     part.turns && part.shifts ? "turn and shift"
                     : part.turns              ? "turn"
                                               : "shift");
}

void evaluate(System& system, double t, const Eigen::VectorXd& q) {
  const std::vector<double> rest(at(system.dofs()));
  std::vector<double> phi(at(system.rows()));
  system.set_motion(t, q.data(), rest.data());
  system.calc_position_level(phi.data());
}

/// Is there a pose beside the one given where masses and joints determine more?
bool determined_beside(System& system, const State& state, const std::vector<double>& metric,
                       std::size_t here) {
  std::vector<char> drivers(at(system.rows()), 0);
  for (const ConstraintSlot& c : system.constraints())
    if (c.element->rheonomic()) std::fill_n(drivers.begin() + c.row, c.rows, 1);
  LeastChange nearby(system, metric, {}, drivers);
  std::mt19937_64 random(20050104);
  for (int look = 0; look < looks; ++look) {
    evaluate(system, state.t, state.q);
    Eigen::VectorXd d(system.dofs());
    for (Eigen::Index k = 0; k < d.size(); ++k)
      d[k] = (2.0 * static_cast<double>(random() >> 11) * 0x1p-53 - 1.0) *
             (k % 3 == 2 ? 1.0 : system.natural_length());
    nearby.make_admissible(d.data());
    double size = 0.0;
    for (Eigen::Index k = 0; k < d.size(); ++k)
      size = std::max(size, std::abs(d[k]) / (k % 3 == 2 ? 1.0 : system.natural_length()));
    if (!(size > 0.0)) continue;
    Eigen::VectorXd q = state.q + look_excursion / size * d;
    if (!nearby.solve_positions(state.t, q.data())) continue;
    evaluate(system, state.t, q);
    if (massless_motions(system, metric, undetermined).size() < here) return true;
  }
  return false;
}

std::string could_move(const Model& model, const MasslessMotion& motion) {
  const char* lack = lacks_inertia_only(model, motion) ? "inertia" : "mass";
  return fmt::format("{}, which {} no {}, could move without any mass moving",
                     names_of(model, motion), motion.parts.size() == 1 ? "has" : "have", lack);
}

}  // namespace

std::vector<MasslessMotion> massless_motions(const System& system,
                                             const std::vector<double>& metric, double threshold) {
  std::vector<MasslessMotion> motions;
  if (!system.has_massless()) return motions;
  const Eigen::MatrixXd vectors = null_vectors(joints_and_masses(system, metric), threshold);
  for (Eigen::Index i = 0; i < vectors.cols(); ++i)
    motions.push_back(describe(system, vectors.col(i)));
  return motions;
}

std::string undetermined_motion(System& system, const State& state,
                                const std::vector<double>& metric) {
  if (!system.has_massless()) return {};
  evaluate(system, state.t, state.q);
  const std::vector<MasslessMotion> here = massless_motions(system, metric, undetermined);
  if (here.empty()) return {};
  const bool only_here = determined_beside(system, state, metric, here.size());
  evaluate(system, state.t, state.q);
  if (only_here)
    return fmt::format("the start is an impasse: {}; start beside it",
                       could_move(system.model(), here.front()));
  return fmt::format("{}; joints must tie what has no mass or inertia to what has, or drive it",
                     freedom(system.model(), here));
}

std::string impasse_at(System& system, const State& state, const std::vector<double>& metric) {
  if (!system.has_massless() || !state.q.allFinite()) return {};
  evaluate(system, state.t, state.q);
  const std::vector<MasslessMotion> here = massless_motions(system, metric, at_impasse);
  return here.empty() ? std::string() : could_move(system.model(), here.front());
}

}  // namespace yoke

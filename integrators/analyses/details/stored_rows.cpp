// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/analyses/details/stored_rows.hpp>

#include <yoke/integrators/run/recorder.hpp>

namespace yoke {

namespace {

constexpr double same_time = 1e-12;  // of the rows' span

/// The polynomial through values, rates and second derivatives at both ends of [0, h].
double quintic(double s, double h, const double* a, const double* b) {
  const double s2 = s * s, s3 = s2 * s, s4 = s3 * s, s5 = s4 * s;
  return (1 - 10 * s3 + 15 * s4 - 6 * s5) * a[0] + (10 * s3 - 15 * s4 + 6 * s5) * b[0] +
         h * ((s - 6 * s3 + 8 * s4 - 3 * s5) * a[1] + (-4 * s3 + 7 * s4 - 3 * s5) * b[1]) +
         0.5 * h * h * ((s2 - 3 * s3 + 3 * s4 - s5) * a[2] + (s3 - 2 * s4 + s5) * b[2]);
}

/// Its derivative by time.
double quintic_rate(double s, double h, const double* a, const double* b) {
  const double s2 = s * s, s3 = s2 * s, s4 = s3 * s;
  const double turn = 30 * s2 - 60 * s3 + 30 * s4;
  return turn * (b[0] - a[0]) / h + (1 - 18 * s2 + 32 * s3 - 15 * s4) * a[1] +
         (-12 * s2 + 28 * s3 - 15 * s4) * b[1] +
         0.5 * h * ((2 * s - 9 * s2 + 12 * s3 - 5 * s4) * a[2] + (3 * s2 - 8 * s3 + 5 * s4) * b[2]);
}

}  // namespace

void prepare_for_rows(Dynamics& dynamics, const State& fallback) {
  State start = dynamics.system().model().start_state();
  if (dynamics.assemble(start)) return;
  State state = fallback;
  if (const Outcome outcome = dynamics.assemble(state); !outcome) throw ModelError(outcome.why);
}

StoredRows::StoredRows(Dynamics& dynamics, const Table& samples)
    : system_(dynamics.system()), samples_(samples) {
  Result names;
  const Recorder recorder(dynamics, names, 0);
  const std::vector<std::string>& expected = names.samples.names();
  const std::vector<std::string>& given = samples.names();
  for (std::size_t i = 0; i < expected.size(); ++i)
    if (i >= given.size() || given[i] != expected[i])
      throw ModelError(fmt::format(
          "stored rows: column {} is '{}', not '{}': these are not samples of this model", i + 1,
          i < given.size() ? given[i] : "missing", expected[i]));
  if (samples.rows() == 0) throw ModelError("stored rows: there are none");
  std::size_t column =
      1 + static_cast<std::size_t>(3 * system_.dofs()) + 3 * system_.joints().size();
  for (const ForceSlot& f : system_.forces()) {
    if (f.element->contacts() > 0)
      throw ModelError(fmt::format(
          "stored rows: what contact '{}' remembers is not in them; run up to the time wanted and "
          "take Result::final",
          f.element->name()));
    for (int i = 0; i < f.states; ++i) z_columns_.push_back(column + static_cast<std::size_t>(i));
    column += static_cast<std::size_t>(f.states) + f.element->channels().size();
  }
  energy_column_ = column;
}

void StoredRows::read(std::size_t row, State& state) const {
  state.t = time(row);
  std::size_t column = 1;
  for (Eigen::Index i = 0; i < state.q.size(); i += 3)
    for (Eigen::VectorXd* values : {&state.q, &state.v, &state.a})
      for (Eigen::Index j = 0; j < 3; ++j) (*values)[i + j] = samples_.value(row, column++);
  for (Eigen::Index i = 0; i < state.z.size(); ++i)
    state.z[i] = samples_.value(row, z_columns_[static_cast<std::size_t>(i)]);
  for (Eigen::Index i = 0; i < state.energy.size(); ++i)
    state.energy[i] = samples_.value(row, energy_column_ + static_cast<std::size_t>(i));
}

void StoredRows::interpolate(double t, State& state) const {
  const std::size_t last = count() - 1;
  const double slack = same_time * (time(last) - time(0));
  if (!(t >= time(0) - slack && t <= time(last) + slack))
    throw ModelError(
        fmt::format("stored rows: t = {:g} s is outside the accepted range {:g} to {:g} s", t,
                    time(0), time(last)));
  std::size_t low = 0, high = last;
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (time(middle) <= t ? low : high) = middle;
  }
  for (const std::size_t row : {low, high})
    if (std::abs(t - time(row)) <= slack) return read(row, state);
  State a = state, b = state;
  read(low, a);
  read(high, b);
  const double h = b.t - a.t, s = (t - a.t) / h;
  state.t = t;
  for (Eigen::Index i = 0; i < state.q.size(); ++i) {
    const double from[] = {a.q[i], a.v[i], a.a[i]}, to[] = {b.q[i], b.v[i], b.a[i]};
    state.q[i] = quintic(s, h, from, to);
    state.v[i] = quintic_rate(s, h, from, to);
  }
  state.a = (1.0 - s) * a.a + s * b.a;
  state.z = (1.0 - s) * a.z + s * b.z;
  state.energy = (1.0 - s) * a.energy + s * b.energy;
}

}  // namespace yoke

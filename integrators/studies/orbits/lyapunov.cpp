// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/studies/orbits/lyapunov.hpp>

#include <Eigen/QR>
#include <cmath>
#include <limits>

#include <yoke/core/error.hpp>
#include <yoke/integrators/studies/linearised/carried_run.hpp>

namespace yoke {

namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr double share_of_run = 1e-3;
constexpr std::size_t stretches = 10;  // of which the uncertainty is made

/// Orthonormal columns as the run goes on, and what they have grown.
class Growth {
 public:
  Growth(const LyapunovOptions& options, double start)
      : begin_(start + options.transient),
        interval_(options.interval > 0.0 ? options.interval
                                         : share_of_run * (options.until - start)),
        end_(options.until),
        next_(start) {
    plan(start);
  }

  /// At the start: directions of which none is special.
  void begin(CarriedVariation& variation) {
    for (Eigen::Index j = 0; j < variation.y.cols(); ++j)
      for (Eigen::Index i = 0; i < variation.y.rows(); ++i)
        variation.y(i, j) += 0.5 * std::cos(1.0 + 0.7 * static_cast<double>((i + 2) * (j + 3)));
    orthonormalise(variation);
    variation.pause = next_;
    if (variation.time() >= begin_) count(variation, Vector::Zero(variation.y.cols()));
  }

  void at(CarriedVariation& variation) {
    if (variation.time() < next_) return;
    const Vector grown = orthonormalise(variation);
    plan(variation.time());
    variation.pause = next_;
    if (variation.time() >= begin_)
      count(variation,
            times_.empty() ? Vector(Vector::Zero(grown.size())) : Vector(sums_.back() + grown));
  }

  void write(Lyapunov& result) const;

 private:
  /// The next end of an interval [s]: those behind the transient count from its end.
  void plan(double now) {
    next_ = now + interval_;
    if (now < begin_) next_ = std::min(next_, begin_);
    if (std::abs(next_ - end_) < 1e-6 * interval_) next_ = end_;
  }
  Vector orthonormalise(CarriedVariation& variation) const;
  void count(const CarriedVariation& variation, Vector sum) {
    if (times_.empty()) trace_begin_ = variation.growth_of_volume();
    trace_end_ = variation.growth_of_volume();
    times_.push_back(variation.time());
    sums_.push_back(std::move(sum));
  }

  double begin_, interval_, end_, next_;
  std::vector<double> times_;
  std::vector<Vector> sums_;  // of logarithms, since the first time
  double trace_begin_ = 0.0, trace_end_ = 0.0;
};

/// Memories are divided by the same triangle. Velocities count in lengths over the time scale.
Vector Growth::orthonormalise(CarriedVariation& variation) const {
  const Eigen::Index k = variation.y.cols(), f = variation.freedom();
  const double time = variation.scales().time;
  Matrix& y = variation.y;
  y.middleRows(f, f) *= time;
  const Eigen::HouseholderQR<Matrix> qr(y);
  const Matrix R = qr.matrixQR().topRows(k).triangularView<Eigen::Upper>();
  y = qr.householderQ() * Matrix::Identity(y.rows(), k);
  y.middleRows(f, f) /= time;
  if (!variation.m.isZero(0.0))
    variation.m =
        R.transpose().triangularView<Eigen::Lower>().solve(variation.m.transpose()).transpose();
  return R.diagonal().cwiseAbs().array().log();
}

void Growth::write(Lyapunov& result) const {
  result.history.add_column("t", "s");
  const Eigen::Index k = sums_.empty() ? 0 : sums_.front().size();
  for (Eigen::Index i = 0; i < k; ++i)
    result.history.add_column(fmt::format("exponent_{}", i + 1), "1/s");
  if (times_.size() < 2) return;
  for (std::size_t i = 1; i < times_.size(); ++i) {
    double* row = result.history.append();
    row[0] = times_[i];
    const Vector mean = sums_[i] / (times_[i] - times_[0]);
    std::copy(mean.begin(), mean.end(), row + 1);
  }
  const double duration = times_.back() - times_.front();
  result.exponents = sums_.back() / duration;
  result.mean_trace = (trace_end_ - trace_begin_) / duration;
  result.uncertainty = Vector::Constant(k, std::numeric_limits<double>::quiet_NaN());
  if (times_.size() <= stretches) return;
  Vector squares = Vector::Zero(k);
  for (std::size_t i = 0; i < stretches; ++i) {
    const std::size_t a = i * (times_.size() - 1) / stretches;
    const std::size_t b = (i + 1) * (times_.size() - 1) / stretches;
    squares += ((sums_[b] - sums_[a]) / (times_[b] - times_[a]) - result.exponents).cwiseAbs2();
  }
  result.uncertainty = (squares / (double{stretches} * (stretches - 1))).cwiseSqrt();
}

void check(const LyapunovOptions& o, double start) {
  const std::string owner = "lyapunov";
  constexpr double most = std::numeric_limits<double>::max();
  require_range(owner, "until", o.until, std::nextafter(start, most), most, "s");
  require_range(owner, "transient", o.transient, 0.0, 0.99 * (o.until - start), "s");
  require_range(owner, "interval", o.interval, 0.0, o.until - start - o.transient, "s");
  if (o.exponents < 0)
    throw ModelError(fmt::format("{}: exponents = {} must be at least 0", owner, o.exponents));
}

}  // namespace

Lyapunov lyapunov(const Model& model, const State& start, const LyapunovOptions& options) {
  check(options, start.t);
  SimulationOptions run = options.run;
  run.until = options.until;
  CarriedVariation variation(model, run.relative_tolerance, options.exponents, false);
  Growth growth(options, start.t);
  variation.at_start = [&](CarriedVariation& v, const State&) { growth.begin(v); };
  variation.at_step = [&](CarriedVariation& v) { growth.at(v); };
  Lyapunov result;
  result.run = run_with(variation, model, start, run);
  if (variation.y.size() == 0) throw ModelError(result.run.summary.reason);
  growth.write(result);
  result.complete = result.run.summary.stop == Stop::completed && result.history.rows() > 0;
  result.reason = result.run.summary.reason;
  if (result.run.summary.ok() && result.history.rows() == 0)
    result.reason = "the run has no interval behind the transient";
  result.degrees_of_freedom = variation.freedom();
  result.jumps = variation.jumps();
  result.notes = variation.notes();
  return result;
}

Lyapunov lyapunov(const Model& model, const LyapunovOptions& options) {
  return lyapunov(model, model.start_state(), options);
}

}  // namespace yoke

// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What exactness costs: force and stiffness of the exact logarithmic law (Johnson, steel pin in the
// end of the scotch-yoke's slot) beside those of the power law fitted to it, and beside the same
// law solved by Newton's method to the same accuracy, all at the same penetrations. The three are
// run in turn; the counters are medians over the rounds, in nanoseconds per evaluation:
//   power_ns, exact_ns, newton_ns
//   exact_to_power     aim: 1.0, at most 1.2
//   newton_to_exact
// "direct" calls the laws themselves, "as_value" through ElasticLaw, as the engine does. The range
// of penetrations: 1e-9 m to 0.05 mm evenly in the logarithm ("contact"), 1e-300 m to the limit
// ("whole"), and the quarter before the limit ("fold").
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <random>
#include <vector>

#include <yoke/contact/laws/catalog/power_fit.hpp>
#include <yoke/contact/laws/elastic/johnson.hpp>

namespace {

using namespace yoke;
using Clock = std::chrono::steady_clock;

/// The law solved for each penetration: w - ln w = 1 - ln x by Newton's method from the first terms
/// of the asymptotic series or, near the fold, of the series about it, until the step is below the
/// rounding.
class ByNewton {
 public:
  explicit ByNewton(const LogarithmicLaw& law)
      : inverse_a_(1.0 / law.a()), a_(law.a()), inverse_limit_(1.0 / law.limit()) {}
  ElasticResponse operator()(double d) const {
    const double s = 1.0 - std::log(d * inverse_limit_);
    const double p = std::sqrt(2.0 * (s - 1.0));
    double w = s < 3.0 ? 1.0 + p + p * p / 3.0 : s + std::log(s) * (1.0 + 1.0 / s);
    for (int i = 0; i < 20; ++i) {
      const double step = (w - std::log(w) - s) * w / (w - 1.0);
      w -= step;
      if (std::abs(step) <= 1e-8 * w) break;  // the next would be below 1e-15
    }
    const double force = d * inverse_a_ / w;
    return {force, inverse_a_ / (w - 1.0), a_ * force * force * (0.5 * w - 0.25)};
  }

 private:
  double inverse_a_, a_, inverse_limit_;
};

std::vector<double> penetrations(double low, double high, bool logarithmic) {
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<double> list(1024);
  for (double& d : list)
    d = logarithmic ? low * std::exp(std::log(high / low) * uniform(generator))
                    : low + (high - low) * uniform(generator);
  return list;
}

template <class Law>
double nanoseconds(const Law& law, const std::vector<double>& at) {
  const auto start = Clock::now();
  for (int round = 0; round < 20; ++round)
    for (const double d : at) {
      const ElasticResponse r = law(d);
      double force = r.force, stiffness = r.stiffness;
      benchmark::DoNotOptimize(force);
      benchmark::DoNotOptimize(stiffness);
    }
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count() /
         (20.0 * static_cast<double>(at.size()));
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

template <class Power, class Exact, class Newton>
void compare(benchmark::State& state, const Power& power, const Exact& exact, const Newton& newton,
             const std::vector<double>& at) {
  std::array<std::vector<double>, 3> times;
  for (auto _ : state) {
    times[0].push_back(nanoseconds(power, at));
    times[1].push_back(nanoseconds(exact, at));
    times[2].push_back(nanoseconds(newton, at));
  }
  const double p = median(times[0]), e = median(times[1]), n = median(times[2]);
  state.counters["power_ns"] = p;
  state.counters["exact_ns"] = e;
  state.counters["newton_ns"] = n;
  state.counters["exact_to_power"] = e / p;
  state.counters["newton_to_exact"] = n / e;
}

enum Range { contact, whole, fold };

void elastic_law(benchmark::State& state, Range range, bool as_value) {
  const Johnson johnson(113736.26e6, 0.1e-3, 10e-3);
  const LogarithmicLaw& exact = johnson.law;
  const ByNewton newton(exact);
  const PowerLaw power = fit_power_law(johnson, 10e3).law();
  const std::vector<double> at = range == contact ? penetrations(1e-9, 0.05e-3, true)
                                 : range == whole
                                     ? penetrations(1e-300, exact.limit(), true)
                                     : penetrations(0.75 * exact.limit(), exact.limit(), false);
  if (!as_value) return compare(state, power, exact, newton, at);
  const auto through = [](ElasticLaw law) {
    return [law = std::move(law)](double d) { return law.response(d); };
  };
  compare(state, through(power), through(johnson), through(newton), at);
}

BENCHMARK_CAPTURE(elastic_law, contact_direct, contact, false);
BENCHMARK_CAPTURE(elastic_law, contact_as_value, contact, true);
BENCHMARK_CAPTURE(elastic_law, whole_direct, whole, false);
BENCHMARK_CAPTURE(elastic_law, fold_direct, fold, false);

}  // namespace

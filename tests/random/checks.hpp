// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What is demanded of any mechanism. The first run (`run`: arkode-projection) is judged by itself,
// then against others of the same mechanism: another formulation (which one follows from the seed),
// and the mechanism turned, shifted, mirrored, reordered, in other units, among bystanders.
//
//   refused     the start is refused although the mechanism was built closed
//   failed      the run ends early
//   crossing    a singular position is reported where the constraints are independent
//   energy      |ledger| > 3 N rtol E; kinetic and potential energies are computed here. N steps, E
//               the energy that an error of one weight unit in every position and rate makes
//               (at least 1e-10 E)
//   violation   results are off the constraints by more than rounding; drift: by more than 300 rtol
//               (at least 1e-9) before projection
//   differs     from the first run, by more than 3 (N + N') rtol A(t)
//   steps       a changed description takes more than four times the steps (unless it says itself that
//               rounding hides 1000 times the tolerance: then its steps follow noise)
//   none        no equilibrium although the potential energy is bounded below; unrest: bodies
//               accelerate there; state refused: no run can start from it
//
// N steps, each of which errs by rtol, add up to N rtol A at most, A the growth of differences.
// A(t) is measured: two runs from starts moved at random by 1e-7 and 1e-5 (made consistent again)
// show how a difference at s has grown at t > s; the smaller of the two answers is taken, so that
// the error of a run cannot excuse itself. 3 is because another error than the one tried may grow
// faster. Where the bound exceeds 1 % the mechanism is called sensitive and not compared.
//
// A change of description rounds the lengths of the links. Where a truly singular position was
// crossed, the motion depends on the root of that: 10 sqrt(rounding) A more is allowed, and
// sqrt(rounding) of energy and drift. A sample that happens to lie a distance s beside it has rates
// that rounding of the lengths turns by rounding / s^2, of which 10 times is allowed.
//
// A quarter of the mechanisms also runs at 1e-13 (`tight`), with arkode-projection or ida-ggl: the
// tightest tolerance accepted must be reached, and shows the error of the first run.
//
// A run that ends for a good reason is no fault but counted: a driver at a dead point (the smallest
// singular value of the constraints, relative to that at the start, is below 1e-2, or 5e-2 where the
// run names a dead point), a contact law at the end of its range, friction of a joint that wedges, a
// run of more steps than we want to wait for.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <yoke/tests/random/changes.hpp>

namespace yoke::tests::random {

/// How the mechanism is run for a check: "run", "tight", the name of a formulation, of a change.
struct Method {
  std::string formulation;
  double tolerance = 1e-9;
};
Method method_of(const Description& d, const std::string& check);

struct Fault {
  std::string kind;    // "run failed", "turn differs", "ida-ggl energy", ...
  std::string detail;  // one sentence
};

struct Verdict {
  std::uint64_t seed = 0;
  std::string outcome = "ok";  // or sensitive, dead point, law limit, wedged, long, refused, failed
  std::vector<Fault> faults;
  long steps = 0;                          // of the first run
  double seconds = 0.0;                    // of processor and waiting, all checks
  std::map<std::string, double> measures;  // by check: what was found over what is allowed

  bool has(const std::string& kind) const {
    for (const Fault& fault : faults)
      if (fault.kind == kind) return true;
    return false;
  }
};

/// Only whether the motion of `other` is that of `d`; faults are those of the check `name`.
Verdict compare_changed(const Description& d, const std::string& name, const Changed& other);

/// All checks, or only what is needed to find faults of one kind. Runs at the tightest tolerance only
/// if the kind begins with "tight". Never throws.
Verdict check(const Description& d, const std::string& kind = "");

}  // namespace yoke::tests::random

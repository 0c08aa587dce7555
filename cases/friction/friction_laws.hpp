// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What the cases of friction share: the parameters of their contacts, the laws they offer by name
// beside those of the catalogue, and the motion of one coordinate that they are checked against.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <yoke/cases/case.hpp>
#include <yoke/core/friction_law.hpp>

namespace yoke::cases {

/// Parameters stiffness (of the elastic contact), mu, mu_static, threshold and presliding.
std::vector<CaseParameter> friction_parameters(const char* mu, const char* mu_static);

/// What the friction has to hold: the stiffness of bristles is made from it.
struct Pressed {
  double mass = 0.0;          // [kg]
  double normal_force = 0.0;  // [N]
};

/// A contact K d^1.5 (1 + 10 s/m d'), with the friction law after which it is called: coulomb (the
/// base), brown-mcphee, regularised-coulomb, stribeck, bengisu-akay, dahl and lugre. `walls` as in ContactChoice.
ContactChoice friction_laws(std::function<std::vector<Wall>(const Parameters&)> walls,
                            const std::function<Pressed(const Parameters&)>& pressed);

/// A mass on a line: m x'' = load - k x - T(N, x' - belt).
struct LineMotion {
  double mass = 0.0;             // [kg]
  double normal_force = 0.0;     // [N], constant
  double load = 0.0;             // [N]
  double stiffness = 0.0;        // [N/m] k
  double belt = 0.0;             // [m/s]
  double x = 0.0, v = 0.0;       // [m, m/s] at the start
  double reference_force = 1.0;  // [N] of the contact
};
struct LinePoint {
  double x, v;  // [m, m/s]
};
/// Where it is at each of the times [s], increasing: what a run of the engine is compared with. By another
/// library's method of Dormand and Prince; under a law that holds (Coulomb's) in closed form.
std::vector<LinePoint> move_on_line(const FrictionLaw& friction, const LineMotion& start,
                                    const std::vector<double>& times);

/// The largest distances of two columns of a run from that motion, at some fifty of its rows:
/// position and velocity. Positions are counted from the first row's.
std::vector<Check> line_checks(const Result& run, const FrictionLaw& friction,
                               const LineMotion& start, const std::string& x_column,
                               const std::string& v_column);

}  // namespace yoke::cases

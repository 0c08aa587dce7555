// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The state of a mechanism at one time. A value: copying it makes a snapshot.
#pragma once

#include <Eigen/Core>
#include <vector>

#include <yoke/core/contact_memory.hpp>

namespace yoke {

struct State {
  double t = 0.0;          // [s]
  Eigen::VectorXd q;       // [3 nb] x, y, angle of each body's centre of mass [m, m, rad]
  Eigen::VectorXd v;       // [3 nb] their rates
  Eigen::VectorXd z;       // [nz] states owned by elements
  Eigen::VectorXd a;       // [3 nb] accelerations, from the acceleration-level solve
  Eigen::VectorXd lambda;  // [nc] multipliers, M a + G^T lambda = Q
  Eigen::VectorXd energy;  // [nquad] dissipated energy and work of each element that has them [J]
  std::vector<double> parameters;       // changeable parameters of all elements
  std::vector<ContactMemory> contacts;  // memory of all contacts
  /// Slots of users' events handled at time handled_at. A run that starts at exactly that time does
  /// not handle them again, whatever sign rounding gives their functions.
  std::vector<int> handled;
  double handled_at = 0.0;  // [s]
};

}  // namespace yoke

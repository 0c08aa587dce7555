// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Which formulation goes on where the force of a contact, friction above all, is so stiff that stability
// bounds explicit steps. Nobody knows before: it depends on loads, on what touches and on the
// tolerance. So the run finds out. It begins with explicit Runge-Kutta; where stability has bounded its steps
// for some time, BDF has a trial; the one that came farther per work goes on. Motion with and without
// contacts is judged apart, and a formulation that has lost a trial waits longer for the next.
//
//   work   evaluations of the equations of motion, and Jacobians, each of which counts as several
//   ->     at the end of a step: the state there, projected, is a start of the other one
//   <-     likewise, when it falls behind, or when a step of it fails
//
// BDF errs more at the same tolerance: it gets a tighter one.
#pragma once

#include <memory>

#include <yoke/integrators/formulations/formulation.hpp>

namespace yoke {

/// Of "arkode-projection" and "ida-ggl".
std::unique_ptr<Formulation> make_stiffness_switch(Dynamics& dynamics,
                                                   const Tolerances& tolerances);

}  // namespace yoke

// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// `yoke orbit` and `yoke lyapunov`: a periodic orbit of a case or its Lyapunov exponents, with files and
// pictures.
#pragma once

#include <filesystem>
#include <string>

#include <yoke/cases/jobs/request.hpp>
#include <yoke/core/model.hpp>
#include <yoke/integrators/studies/orbits/lyapunov.hpp>
#include <yoke/integrators/studies/orbits/periodic_orbit.hpp>

namespace yoke::cases {

/// [s] How long `turns` turns of the body that a driver turns take, at the speed it has at the start of
/// the model. Throws ModelError if no driver turns a body.
double period_of_turns(const Model& model, int turns);

/// Searches, writes orbit.csv (a row a sample), multipliers.csv, events.csv, summary.json and pictures into
/// the request's output, and prints what it came to. `coordinate` is that of the phase portrait,
/// "ball.y"; empty: the one that moves fastest. The formulation, the tolerance and the rows are those of the
/// request. Throws ModelError.
RunStatus run_orbit(const std::string& title, const Model& model, const RunRequest& request,
                    PeriodicOrbitOptions options, const std::string& coordinate);

/// Measures, writes exponents.csv (a row an interval), summary.json and a picture, and prints.
RunStatus run_lyapunov(const std::string& title, const Model& model, const RunRequest& request,
                       LyapunovOptions options);

}  // namespace yoke::cases

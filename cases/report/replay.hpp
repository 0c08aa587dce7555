// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A run as a report shows it: what the mechanism looks like, how it moved, what its contacts did. As
// JSON in the folder of the run (replay.json), so that a report can be made again, or made of several
// runs, without running anything. Columns of numbers are base64 of little-endian float32, poses and
// times float64; columns that never change are one number.
#pragma once

#include <string>
#include <vector>

#include <yoke/cases/case.hpp>
#include <yoke/core/model.hpp>
#include <yoke/core/result.hpp>

namespace yoke::cases {

inline constexpr const char* replay_file = "replay.json";

struct Replay {
  const Case& c;
  const Parameters& parameters;
  std::string law{};      // "" if there is no choice
  std::string command{};  // that makes this run again
  const Model& model;
  const Table& samples;
  const std::vector<EventRecord>& events;
  const Summary& summary;
  std::vector<Check> checks{};
  std::vector<Portrait> portraits{};
  std::size_t share = 1;  // of so many runs that one report holds
};

std::string to_json(const Replay& replay);

/// The state at one instant as a row of samples: poses alone.
Table one_pose(const Model& model, const State& state);

}  // namespace yoke::cases

// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Replays that runs have left in their folders.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace yoke::cases {

struct StoredReplay {
  std::string case_name{}, law{}, folder{};  // of the folder its name alone
  std::string json{};                        // as to_json(Replay) wrote it
};

/// Those of a folder that `yoke run` wrote: its own, or those of its laws in the order in which they
/// were run. Throws ModelError naming the folder if there is none or one is damaged.
std::vector<StoredReplay> stored_replays(const std::filesystem::path& folder);

/// The same replay under a name of its own in the report.
std::string with_label(const StoredReplay& replay, const std::string& label);

}  // namespace yoke::cases

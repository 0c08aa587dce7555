// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A zip archive (PKWARE APPNOTE 6.3.3) whose entries are stored as they are, without compression: all
// that an FMU needs. The same contents give the same bytes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace yoke::cases {

struct ZipEntry {
  std::string name;  // "resources/yoke.json"
  std::string content;
};

/// Throws ModelError for more than the format holds: 65535 entries, 4 GiB.
std::string zip_archive(const std::vector<ZipEntry>& entries);

}  // namespace yoke::cases

// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The rows of a study on the disk, one line each in the order in which they came. A line is written by
// one call of the system and ends in a sum over itself, so that after a kill or a power failure whole rows
// are told from torn ones. The first line says which study it is.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <yoke/integrators/studies/study.hpp>

namespace yoke {

/// One process at a time has it: the system forgets the lock when the process ends, however it does.
class Journal {
 public:
  /// Opens or makes it, cuts off what follows the last whole row. `fingerprint` is of the study. Throws
  /// ModelError if it is of another study, OutputError.
  Journal(const std::filesystem::path& folder, const std::string& fingerprint, std::size_t points,
          std::size_t quantities);
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;
  ~Journal();

  /// What it held, each point once; to be called once.
  std::vector<StudyRow> take_rows() { return std::move(rows_); }
  /// Adds rows, which are then safe from a kill; on the disk at most two seconds later if rows go on.
  void append(const std::vector<StudyRow>& rows);
  /// Puts all of it on the disk.
  void sync();

 private:
  void create(const std::string& header);
  void read(const std::string& text, std::size_t points, std::size_t quantities);
  [[noreturn]] void fail(const char* what) const;

  std::filesystem::path path_;
  int file_ = -1;
  std::vector<StudyRow> rows_;
  std::string lines_;
  double last_sync_ = 0.0;  // [s]
};

}  // namespace yoke

// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A run on disk, so that it can go on after a kill as if nothing had been. The folder holds
//   checkpoint.bin   magic, format version, length, CRC-32, then CBOR: everything a run needs to go
//                    on but its rows. Replaced by renaming, so that at any instant it is whole.
//   samples.bin      rows of the samples table, raw doubles, appended before checkpoint.bin is
//   contacts.bin     renamed; likewise rows within contacts, and events. What lies beyond the
//   events.bin       counts of checkpoint.bin was written after it and is cut off.
#pragma once

#include <boost/crc.hpp>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <yoke/integrators/formulations/formulation.hpp>
#include <yoke/integrators/run/recorder.hpp>
#include <yoke/integrators/simulate.hpp>

namespace yoke {

/// How much of a file of rows belongs to a checkpoint.
struct RowsOnDisk {
  std::size_t count = 0;
  std::uint32_t checksum = 0;  // of a CRC-32 that goes on
};

/// Everything a run needs to go on, but its rows.
struct Checkpoint {
  std::uint64_t model = 0;  // fingerprint
  // What was asked; a run goes on only as it began.
  double until = 0.0;
  double relative_tolerance = 0.0;
  std::string formulation;
  int samples = 0, contact_rows = 0;
  std::vector<std::string> chosen_columns{};
  double every = 0.0;
  long every_events = 0;
  double baumgarte_rate = 0.0;
  double spectral_radius = 0.0;
  int order = 0;
  std::string linear_solver{};
  // Where it is.
  Scales scales;
  State state;
  std::vector<int> dropped_rows;
  long next_sample = 0;
  long next_time = 0;  // number of the next checkpoint by time
  long events_since = 0;
  Recorder::Ledger ledger;
  Summary summary;  // counters of everything before this point
  double window_start = 0.0;
  long window_events = 0;
  double largest_independence = 0.0;
  // How much of the other files belongs to it.
  std::size_t columns = 0;
  RowsOnDisk rows{}, rows_in_contacts{};
  std::size_t events = 0;
  std::uint32_t events_checksum = 0;
};

/// Writes checkpoints of one run.
class CheckpointWriter {
 public:
  /// Begins anew in `folder` (made if missing), removing what is there, or goes on behind
  /// `existing`. Throws OutputError.
  CheckpointWriter(std::filesystem::path folder, const Checkpoint* existing);
  /// Appends the rows and events that are new, then replaces checkpoint.bin. Durable when it
  /// returns. Throws OutputError naming the file; the checkpoint before is still good then.
  void write(Checkpoint& checkpoint, const Result& result);

 private:
  std::filesystem::path folder_;
  RowsOnDisk rows_, rows_in_contacts_;  // written so far
  std::size_t events_ = 0;
  boost::crc_32_type events_crc_;
};

/// The last checkpoint in `folder`, nothing if there is none. Throws ModelError, with the path and
/// the reason, if it is damaged or of another format.
std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& folder);
/// Rows and events that belong to it; `result` has its columns already. Cuts off what is beyond.
/// Throws ModelError if the files are shorter than they should be or not of this model.
void read_rows(const std::filesystem::path& folder, const Checkpoint& checkpoint, Result& result);

/// A state as bytes (CBOR), every bit of it, and back. Throws ModelError for other bytes.
std::vector<std::uint8_t> state_to_bytes(const State& state);
State state_from_bytes(std::span<const std::uint8_t> bytes);

}  // namespace yoke

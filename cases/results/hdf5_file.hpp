// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Tables in an HDF5 file: a group for each table, in it a dataset for each column, chunked, shuffled and
// deflated, with its unit as an attribute. Text is of fixed length, padded with zeros.
//
// The file can be added to while a run goes on, and be read after the program was killed: what is on the
// disk is what the last flush() left there, since nothing that a file already refers to ever moves. A
// chunk that is not full is written as it is, without the filters, so that the next rows fit into its
// place. Its form is that of HDF5 1.8, which marks no file as open.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <yoke/cases/results/output_table.hpp>

namespace yoke::cases {

/// Was it built with HDF5? Without it, what is below throws ModelError.
extern const bool has_hdf5;

class Hdf5File {
 public:
  /// A new file. Throws OutputError naming `shown`, as everything below.
  Hdf5File(const std::filesystem::path& path, const std::filesystem::path& shown);
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;
  ~Hdf5File();

  /// Writes the rows of a table that are not there yet. The first call makes its group, with chunks for
  /// `expected_rows` in all and text of up to `text_width` bytes; longer text is cut. After the last
  /// rows a chunk that is not full is compressed too.
  void append(const OutputTable& table, std::size_t expected_rows, std::size_t text_width,
              bool last = false);
  /// A text of its own beside the groups.
  void add_text(const std::string& name, const std::string& text);
  /// What was written can be read from now on whatever happens.
  void flush();
  void close();

 private:
  struct Group {
    std::size_t chunk = 0;  // rows
    std::size_t rows = 0;   // written
    bool partial = false;   // the last chunk is there, but not full
    std::vector<std::int64_t> datasets{};
    std::vector<std::size_t> sizes{};  // [bytes] of an element
  };
  void create(const OutputTable& table, std::size_t expected_rows, std::size_t text_width,
              Group& group);
  void gather(const Group& group, const OutputTable& table, std::size_t begin);
  void write_chunk(const Group& group, std::size_t column, std::size_t begin, bool as_it_is);
  void check(bool ok, const char* what) const;

  std::filesystem::path shown_;
  std::int64_t file_ = -1;
  std::map<std::string, Group> groups_;
  std::vector<std::vector<unsigned char>> elements_;  // of a chunk, by column
  std::vector<unsigned char> planes_, stream_;
};

}  // namespace yoke::cases

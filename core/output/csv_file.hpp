// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A text file, cell by cell or line by line.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

namespace yoke {

/// A file of comma-separated values (RFC 4180, lines end in \n) that is there whole or not at all: it is
/// written beside its place and takes it in finish(). What is no file, as a pipe or a device, is
/// written to directly. Everything throws OutputError naming the path.
class CsvFile {
 public:
  /// Opens it beside `path`.
  explicit CsvFile(const std::filesystem::path& path);
  CsvFile(const CsvFile&) = delete;
  CsvFile& operator=(const CsvFile&) = delete;
  /// Without finish() what was there before stays.
  ~CsvFile();

  /// The fewest digits that bring back every bit; "nan", "inf".
  void cell(double number);
  /// In quotes where it needs them.
  void cell(std::string_view text);
  /// Ends the line.
  void end_line() {
    buffer_.push_back('\n');
    first_cell_ = true;
    if (buffer_.size() > block) flush();
  }
  /// A line as it is.
  void line(std::string_view text) {
    buffer_.append(text);
    end_line();
  }
  /// The file takes its place.
  void finish();

 private:
  static constexpr std::size_t block = 1 << 15;  // bytes written at once

  void separate() {
    if (!first_cell_) buffer_.push_back(',');
    first_cell_ = false;
  }
  void flush();
  [[noreturn]] void fail(int error);
  void discard();

  std::filesystem::path path_, target_, written_;
  std::FILE* file_ = nullptr;
  std::string buffer_;
  bool first_cell_ = true;
  bool finished_ = false;
};

}  // namespace yoke

// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/output/csv_file.hpp>

#include <fmt/compile.h>
#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include <yoke/core/error.hpp>

namespace yoke {

CsvFile::CsvFile(const std::filesystem::path& path) : path_(path), target_(path) {
  std::error_code unknown;
  if (std::filesystem::is_symlink(path, unknown))
    target_ = std::filesystem::weakly_canonical(path, unknown);
  const bool other = std::filesystem::exists(target_, unknown) &&
                     !std::filesystem::is_regular_file(target_, unknown);
  written_ = target_;
  if (!other) written_ += ".part";
  file_ = std::fopen(written_.c_str(), "w");
  if (file_ == nullptr) fail(errno);
  buffer_.reserve(2 * block);
}

CsvFile::~CsvFile() {
  if (file_ != nullptr) std::fclose(file_);
  discard();
}

void CsvFile::cell(double number) {
  char text[32];
  char* begin = text;
  const char* end = fmt::format_to(begin, FMT_COMPILE("{}"), number);
  separate();
  buffer_.append(text, static_cast<std::size_t>(end - text));
}

void CsvFile::cell(std::string_view text) {
  separate();
  if (text.find_first_of(",\"\r\n") == text.npos) {
    buffer_.append(text);
    return;
  }
  buffer_.push_back('"');
  for (const char c : text) buffer_.append(c == '"' ? 2 : 1, c);
  buffer_.push_back('"');
}

void CsvFile::finish() {
  flush();
  // Some file systems tell only here that there is no room.
  if (std::fclose(std::exchange(file_, nullptr)) != 0) fail(errno);
  std::error_code error;
  if (written_ != target_) std::filesystem::rename(written_, target_, error);
  if (error) fail(error.value());
  finished_ = true;
}

void CsvFile::flush() {
  const std::size_t done = std::fwrite(buffer_.data(), 1, buffer_.size(), file_);
  if (done != buffer_.size() || std::fflush(file_) != 0) fail(errno);
  buffer_.clear();
}

void CsvFile::fail(int error) {
  if (file_ != nullptr) std::fclose(std::exchange(file_, nullptr));
  discard();
  throw OutputError(fmt::format("cannot write '{}': {}", path_.string(), std::strerror(error)));
}

void CsvFile::discard() {
  std::error_code unknown;
  if (!finished_ && written_ != target_) std::filesystem::remove(written_, unknown);
  finished_ = true;
}

}  // namespace yoke

// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/studies/details/journal.hpp>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>

#include <yoke/core/error.hpp>
#include <yoke/core/version.hpp>

namespace yoke {

namespace {

constexpr double seconds_between_syncs = 2.0;

double clock_seconds() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

/// FNV-1a of 32 bits, in eight hexadecimal digits.
std::string sum_of(std::string_view text) {
  std::uint32_t sum = 2166136261u;
  for (const char c : text) sum = (sum ^ static_cast<unsigned char>(c)) * 16777619u;
  return fmt::format("{:08x}", sum);
}

std::string line_of(const StudyRow& row) {
  std::string line =
      fmt::format("{}\t{}\t{:.6g}", row.point,
                  row.state == PointState::failed ? "failed" : "completed", row.seconds);
  for (const double x : row.values) fmt::format_to(std::back_inserter(line), "\t{}", x);
  line += '\t';
  line += row.reason;
  return line + '\t' + sum_of(line) + '\n';
}

template <class Number>
bool read_number(std::string_view text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size();
}

/// A whole row, or false.
bool read_line(std::string_view line, std::size_t points, std::size_t quantities, StudyRow& row) {
  const std::size_t last = line.rfind('\t');
  if (last == line.npos || line.substr(last + 1) != sum_of(line.substr(0, last))) return false;
  std::vector<std::string_view> cells;
  std::string_view rest = line.substr(0, last);
  for (std::size_t tab = rest.find('\t'); tab != rest.npos; tab = rest.find('\t')) {
    cells.push_back(rest.substr(0, tab));
    rest.remove_prefix(tab + 1);
  }
  if (cells.size() != 3 + quantities) return false;
  if (!read_number(cells[0], row.point) || row.point >= points) return false;
  row.state = cells[1] == "failed" ? PointState::failed : PointState::completed;
  row.values.resize(quantities);
  bool good = read_number(cells[2], row.seconds);
  for (std::size_t i = 0; i < quantities; ++i)
    good = read_number(cells[3 + i], row.values[i]) && good;
  row.reason = std::string(rest);
  return good;
}

}  // namespace

Journal::Journal(const std::filesystem::path& folder, const std::string& fingerprint,
                 std::size_t points, std::size_t quantities)
    : path_(folder / journal_name) {
  make_output_folder(folder);
  file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file_ < 0) fail("write");
  try {
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0) {
      if (errno != EWOULDBLOCK) fail("lock");
      throw OutputError(fmt::format(
          "'{}' is being written by another process; let it end, or choose another folder",
          path_.string()));
    }
    std::ifstream in(path_, std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(in), {});
    const std::string header = fmt::format("yoke-study-1\t{}\t{}\t{} points\t{} quantities\n",
                                           version, fingerprint, points, quantities);
    if (text.find('\n') == text.npos) {
      create(header);
    } else if (!text.starts_with(header)) {
      throw ModelError(fmt::format(
          "'{}' holds another study than this one, or one of another version of Yoke (here {}): "
          "choose another folder, or remove that one to begin anew",
          folder.string(), version));
    } else {
      read(text.substr(header.size()), points, quantities);
    }
  } catch (...) {
    ::close(file_);
    throw;
  }
}

Journal::~Journal() { ::close(file_); }

void Journal::create(const std::string& header) {
  if (::ftruncate(file_, 0) != 0) fail("write");
  lines_ = header;
  if (::write(file_, lines_.data(), lines_.size()) != static_cast<ssize_t>(lines_.size()))
    fail("write");
}

void Journal::read(const std::string& text, std::size_t points, std::size_t quantities) {
  std::vector<bool> seen(points);
  std::size_t whole = 0;  // bytes
  for (std::size_t end = text.find('\n'); end != text.npos; end = text.find('\n', whole)) {
    StudyRow row;
    if (!read_line(std::string_view(text).substr(whole, end - whole), points, quantities, row))
      break;
    whole = end + 1;
    if (seen[row.point]) continue;
    seen[row.point] = true;
    rows_.push_back(std::move(row));
  }
  const off_t torn = static_cast<off_t>(text.size() - whole);
  if (torn > 0 && ::ftruncate(file_, ::lseek(file_, 0, SEEK_END) - torn) != 0) fail("write");
}

void Journal::append(const std::vector<StudyRow>& rows) {
  lines_.clear();
  for (const StudyRow& row : rows) lines_ += line_of(row);
  errno = 0;
  if (::write(file_, lines_.data(), lines_.size()) != static_cast<ssize_t>(lines_.size()))
    fail("write");
  const double now = clock_seconds();
  if (now - last_sync_ < seconds_between_syncs) return;
  last_sync_ = now;
  sync();
}

void Journal::sync() {
  if (::fdatasync(file_) != 0 && errno != EINVAL && errno != EROFS) fail("write");
}

void Journal::fail(const char* what) const {
  throw OutputError(fmt::format("cannot {} '{}': {}", what, path_.string(),
                                errno != 0 ? std::strerror(errno) : "no room is left"));
}

}  // namespace yoke

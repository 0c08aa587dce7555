// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/fmu/zip_file.hpp>

#include <boost/crc.hpp>
#include <cstdint>
#include <limits>

#include <yoke/core/error.hpp>

namespace yoke::cases {

namespace {

constexpr std::uint16_t needed = 20;           // version 2.0 to extract
constexpr std::uint16_t first_of_1980 = 0x21;  // 1 January 1980, the first date there is

/// Little-endian, whatever the machine.
template <class T>
void put_number(std::string& out, T value) {
  for (std::size_t i = 0; i < sizeof(T); ++i)
    out.push_back(static_cast<char>((value >> (8 * i)) & 0xffu));
}

/// What both headers of an entry say.
void put_entry(std::string& out, const ZipEntry& entry) {
  boost::crc_32_type crc;
  crc.process_bytes(entry.content.data(), entry.content.size());
  const auto size = static_cast<std::uint32_t>(entry.content.size());
  put_number(out, needed);
  put_number<std::uint32_t>(out, 0);  // flags, method: stored
  put_number<std::uint16_t>(out, 0);  // time
  put_number(out, first_of_1980);
  put_number<std::uint32_t>(out, crc.checksum());
  put_number(out, size);
  put_number(out, size);
  put_number(out, static_cast<std::uint16_t>(entry.name.size()));
  put_number<std::uint16_t>(out, 0);  // extra field
}

}  // namespace

std::string zip_archive(const std::vector<ZipEntry>& entries) {
  constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max();
  std::string out, directory;
  for (const ZipEntry& entry : entries) {
    const auto place = static_cast<std::uint32_t>(out.size());
    out += "PK\3\4";
    put_entry(out, entry);
    out += entry.name;
    out += entry.content;
    directory += "PK\1\2";
    put_number(directory, needed);  // made by
    put_entry(directory, entry);
    put_number<std::uint16_t>(directory, 0);  // comment
    put_number<std::uint32_t>(directory, 0);  // disk, internal attributes
    put_number<std::uint32_t>(directory, 0);  // external attributes
    put_number(directory, place);
    directory += entry.name;
    if (out.size() > most) throw ModelError("zip: the archive would be larger than 4 GiB");
  }
  if (entries.size() > std::numeric_limits<std::uint16_t>::max())
    throw ModelError(fmt::format("zip: {} entries are more than 65535", entries.size()));
  const auto count = static_cast<std::uint16_t>(entries.size());
  const auto place = static_cast<std::uint32_t>(out.size());
  out += directory + "PK\5\6";
  put_number<std::uint32_t>(out, 0);  // disks
  put_number(out, count);
  put_number(out, count);
  put_number(out, static_cast<std::uint32_t>(directory.size()));
  put_number(out, place);
  put_number<std::uint16_t>(out, 0);  // comment
  return out;
}

}  // namespace yoke::cases

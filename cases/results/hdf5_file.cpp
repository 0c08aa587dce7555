// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/results/hdf5_file.hpp>

#include <fmt/format.h>

#include <yoke/core/error.hpp>

#ifdef YOKE_HDF5

#include <hdf5.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <mutex>
#include <span>

#include <yoke/cases/results/byte_planes.hpp>

namespace yoke::cases {

const bool has_hdf5 = true;

namespace {

constexpr std::size_t most_rows_of_chunk = 4096, fewest_rows_of_chunk = 64;
constexpr std::uint32_t all_filters_skipped = 0b11;

/// HDF5 is not always built for threads: one call of ours at a time.
std::recursive_mutex one_at_a_time;
using Lock = std::lock_guard<std::recursive_mutex>;

/// Closes what HDF5 has opened.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Text of so many bytes, padded with zeros.
hid_t text_type(std::size_t size) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, std::max<std::size_t>(size, 1));
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  return type;
}

/// As text of any length in UTF-8, which h5py gives back as such.
bool put_attribute(hid_t object, const std::string& name, const std::string& value) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  const char* text = value.c_str();
  return attribute >= 0 && H5Awrite(attribute, type, &text) >= 0;
}

/// What is written stays in memory until flush(): nothing is on the disk half.
void keep_in_memory(hid_t access) {
  H5AC_cache_config_t config = {};
  config.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  H5Pget_mdc_config(access, &config);
  config.evictions_enabled = false;
  config.incr_mode = H5C_incr__off;
  config.flash_incr_mode = H5C_flash_incr__off;
  config.decr_mode = H5C_decr__off;
  H5Pset_mdc_config(access, &config);
}

}  // namespace

Hdf5File::Hdf5File(const std::filesystem::path& path, const std::filesystem::path& shown)
    : shown_(shown) {
  const Lock lock(one_at_a_time);
  H5dont_atexit();  // it would try again to write what a full disk did not take, and crash
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are ours to tell
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_V18);
  keep_in_memory(access);
  file_ = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  check(file_ >= 0, "make it");
}

Hdf5File::~Hdf5File() {
  const Lock lock(one_at_a_time);
  for (const auto& [name, group] : groups_)
    for (const std::int64_t dataset : group.datasets) H5Dclose(dataset);
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5File::check(bool ok, const char* what) const {
  if (ok) return;
  throw OutputError(fmt::format("cannot write '{}': HDF5 could not {}{}", shown_.string(), what,
                                errno != 0 ? fmt::format(": {}", std::strerror(errno)) : ""));
}

void Hdf5File::create(const OutputTable& table, std::size_t expected_rows, std::size_t text_width,
                      Group& group) {
  group.chunk = std::clamp(expected_rows, fewest_rows_of_chunk, most_rows_of_chunk);
  const Handle in_order(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  H5Pset_link_creation_order(in_order, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  const Handle made(H5Gcreate2(file_, table.name.c_str(), H5P_DEFAULT, in_order, H5P_DEFAULT),
                    H5Gclose);
  check(made >= 0, "make a group");
  const hsize_t none = 0, unlimited = H5S_UNLIMITED, chunk = group.chunk;
  const Handle space(H5Screate_simple(1, &none, &unlimited), H5Sclose);
  const Handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_chunk(layout, 1, &chunk);
  H5Pset_shuffle(layout);
  H5Pset_deflate(layout, 1);
  H5Pset_obj_track_times(layout, false);  // the same results are the same bytes
  for (const OutputColumn& c : table.columns) {
    const std::size_t size = c.text ? text_width : sizeof(double);
    const Handle type(c.text ? text_type(size) : H5Tcopy(H5T_IEEE_F64LE), H5Tclose);
    const hid_t dataset =
        H5Dcreate2(made, c.name.c_str(), type, space, H5P_DEFAULT, layout, H5P_DEFAULT);
    check(dataset >= 0, "make a dataset");
    group.datasets.push_back(dataset);
    group.sizes.push_back(size);
    check(put_attribute(dataset, "unit", c.unit), "write a unit");
  }
}

void Hdf5File::append(const OutputTable& table, std::size_t expected_rows, std::size_t text_width,
                      bool last) {
  const Lock lock(one_at_a_time);
  errno = 0;
  const auto [place, is_new] = groups_.try_emplace(table.name);
  Group& group = place->second;
  if (is_new) create(table, expected_rows, text_width, group);
  if (table.rows <= group.rows) return;
  const hsize_t rows = table.rows;
  for (const std::int64_t dataset : group.datasets)
    check(H5Dset_extent(dataset, &rows) >= 0, "lengthen a dataset");
  for (std::size_t row = group.rows - group.rows % group.chunk; row < table.rows;
       row += group.chunk) {
    gather(group, table, row);
    const bool full = row + group.chunk <= table.rows || last;
    const bool there = row < group.rows && group.partial;
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      write_chunk(group, c, row, !full || there);
  }
  group.rows = table.rows;
  group.partial = table.rows % group.chunk != 0;
}

/// The elements of a chunk of every column, by blocks of rows: rows lie together in memory, and those of
/// a block stay in the cache until the last column has been there.
void Hdf5File::gather(const Group& group, const OutputTable& table, std::size_t begin) {
  constexpr std::size_t block = 64;
  const std::size_t end = std::min(begin + group.chunk, table.rows);
  elements_.resize(table.columns.size());
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    elements_[c].resize(group.chunk * group.sizes[c]);
    if (end - begin < group.chunk || table.columns[c].text) std::ranges::fill(elements_[c], 0);
  }
  for (std::size_t row = begin; row < end; row += block) {
    const std::size_t count = std::min(block, end - row);
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      const OutputColumn& column = table.columns[c];
      const std::size_t size = group.sizes[c];
      unsigned char* to = elements_[c].data() + (row - begin) * size;
      if (column.text) {
        for (std::size_t i = 0; i < count; ++i) {
          const std::string_view text = column.text(row + i);
          std::memcpy(to + i * size, text.data(), std::min(text.size(), size));
        }
      } else {
        copy_numbers(column.first + row * column.step, column.step, column.shift, count, to);
      }
    }
  }
}

void Hdf5File::write_chunk(const Group& group, std::size_t column, std::size_t begin,
                           bool as_it_is) {
  std::uint32_t skipped = all_filters_skipped;
  std::span<const unsigned char> bytes = elements_[column];
  if (!as_it_is) {
    shuffle_bytes(bytes, group.sizes[column], planes_);
    if (compress_planes(planes_, group.chunk, stream_)) {
      skipped = 0;
      bytes = stream_;
    }
  }
  const hsize_t offset = begin;
  check(H5Dwrite_chunk(group.datasets[column], H5P_DEFAULT, skipped, &offset, bytes.size(),
                       bytes.data()) >= 0,
        "write a chunk");
}

void Hdf5File::add_text(const std::string& name, const std::string& text) {
  const Lock lock(one_at_a_time);
  errno = 0;
  const Handle type(text_type(text.size()), H5Tclose);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(layout, false);
  const Handle dataset(
      H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, layout, H5P_DEFAULT), H5Dclose);
  check(dataset >= 0 && H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()) >= 0,
        "write a text");
}

void Hdf5File::flush() {
  const Lock lock(one_at_a_time);
  errno = 0;
  check(H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0, "flush it");
}

void Hdf5File::close() {
  const Lock lock(one_at_a_time);
  errno = 0;
  bool ok = true;
  for (auto& [name, group] : groups_) {
    for (const std::int64_t dataset : group.datasets) ok = H5Dclose(dataset) >= 0 && ok;
    group.datasets.clear();
  }
  ok = H5Fclose(file_) >= 0 && ok;
  file_ = -1;
  check(ok, "close it");
}

}  // namespace yoke::cases

#else

namespace yoke::cases {

const bool has_hdf5 = false;

namespace {
[[noreturn]] void refuse_hdf5() { throw ModelError("built without HDF5"); }
}  // namespace

Hdf5File::Hdf5File(const std::filesystem::path&, const std::filesystem::path&) { refuse_hdf5(); }
Hdf5File::~Hdf5File() = default;
void Hdf5File::append(const OutputTable&, std::size_t, std::size_t, bool) { refuse_hdf5(); }
void Hdf5File::add_text(const std::string&, const std::string&) { refuse_hdf5(); }
void Hdf5File::flush() { refuse_hdf5(); }
void Hdf5File::close() { refuse_hdf5(); }

}  // namespace yoke::cases

#endif

// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/run/checkpoint.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>

namespace yoke {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

constexpr std::array<char, 8> magic = {'Y', 'O', 'K', 'E', 'C', 'H', 'K', 'P'};
constexpr std::uint32_t format_version = 7;
constexpr std::size_t header_size = magic.size() + 4 + 8 + 4;

// ---- what is stored: one list of fields serves writing and reading ----

template <class C, class Visit>
void visit_memory(C& c, Visit&& visit) {
  visit("region", c.region);
  visit("onset_time", c.onset_time);
  visit("approach_velocity", c.approach_velocity);
  visit("effective_mass", c.effective_mass);
  visit("largest_penetration", c.largest_penetration);
  visit("permanent_set", c.permanent_set);
  visit("release_penetration", c.release_penetration);
  visit("past_kink", c.past_kink);
  visit("grip", c.grip);
}

template <class S, class Visit>
void visit_state(S& s, Visit&& visit) {
  visit("t", s.t);
  visit("q", s.q);
  visit("v", s.v);
  visit("z", s.z);
  visit("a", s.a);
  visit("lambda", s.lambda);
  visit("energy", s.energy);
  visit("parameters", s.parameters);
  visit("contacts", s.contacts);
  visit("handled", s.handled);
  visit("handled_at", s.handled_at);
}

template <class S, class Visit>
void visit_summary(S& s, Visit&& visit) {
  visit("reason", s.reason);
  visit("formulation", s.formulation);
  visit("formulation_reason", s.formulation_reason);
  visit("linear_solver", s.linear_solver);
  visit("relative_tolerance", s.relative_tolerance);
  visit("tolerance_kept", s.tolerance_kept);
  visit("length_scale", s.length_scale);
  visit("time_scale", s.time_scale);
  visit("t_start", s.t_start);
  visit("t_end", s.t_end);
  visit("t_asked", s.t_asked);
  visit("steps", s.steps);
  visit("rejected", s.rejected);
  visit("evaluations", s.evaluations);
  visit("recording_evaluations", s.recording_evaluations);
  visit("jacobians", s.jacobians);
  visit("refactorisations", s.refactorisations);
  visit("fresh_factorisations", s.fresh_factorisations);
  visit("last_step", s.last_step);
  visit("position_violation", s.position_violation);
  visit("angle_violation", s.angle_violation);
  visit("velocity_violation", s.velocity_violation);
  visit("angular_velocity_violation", s.angular_velocity_violation);
  visit("position_drift", s.position_drift);
  visit("angle_drift", s.angle_drift);
  visit("velocity_drift", s.velocity_drift);
  visit("angular_velocity_drift", s.angular_velocity_drift);
  visit("energy_balance", s.energy_balance);
  visit("energy_exchanged", s.energy_exchanged);
  visit("wall_time", s.wall_time);
  visit("degrees_of_freedom", s.degrees_of_freedom);
  visit("redundant_equations", s.redundant_equations);
  visit("not_unique_reactions", s.not_unique_reactions);
  visit("singular_positions", s.singular_positions);
  visit("notes", s.notes);
}

template <class S, class Visit>
void visit_singular_position(S& s, Visit&& visit) {
  visit("t", s.t);
  visit("equation", s.equation);
  visit("independence", s.independence);
  visit("energy_before", s.energy_before);
  visit("energy_after", s.energy_after);
}

template <class C, class Visit>
void visit_checkpoint(C& c, Visit&& visit) {
  visit("model", c.model);
  visit("until", c.until);
  visit("relative_tolerance", c.relative_tolerance);
  visit("formulation", c.formulation);
  visit("samples", c.samples);
  visit("contact_rows", c.contact_rows);
  visit("chosen_columns", c.chosen_columns);
  visit("every", c.every);
  visit("every_events", c.every_events);
  visit("baumgarte_rate", c.baumgarte_rate);
  visit("spectral_radius", c.spectral_radius);
  visit("order", c.order);
  visit("linear_solver", c.linear_solver);
  visit("length_scale", c.scales.length);
  visit("time_scale", c.scales.time);
  visit("state", c.state);
  visit("dropped_rows", c.dropped_rows);
  visit("next_sample", c.next_sample);
  visit("next_time", c.next_time);
  visit("events_since", c.events_since);
  visit("initial_energy", c.ledger.initial);
  visit("kinetic", c.ledger.start.kinetic);
  visit("potential", c.ledger.start.potential);
  visit("stored", c.ledger.start.stored);
  visit("summary", c.summary);
  visit("window_start", c.window_start);
  visit("window_events", c.window_events);
  visit("largest_independence", c.largest_independence);
  visit("columns", c.columns);
  visit("rows", c.rows.count);
  visit("samples_checksum", c.rows.checksum);
  visit("rows_in_contacts", c.rows_in_contacts.count);
  visit("contacts_checksum", c.rows_in_contacts.checksum);
  visit("events", c.events);
  visit("events_checksum", c.events_checksum);
}

struct Write {
  Json& json;

  template <class T>
  void operator()(const char* name, const T& value) {
    json[name] = to_json(value);
  }

  template <class T>
  static Json to_json(const T& value) {
    return value;
  }
  static Json to_json(const Eigen::VectorXd& value) {
    return std::vector<double>(value.begin(), value.end());
  }
  static Json to_json(const std::vector<ContactMemory>& contacts) {
    Json list = Json::array();
    for (const ContactMemory& c : contacts) {
      Json& entry = list.emplace_back(Json::object());
      entry["phase"] = static_cast<int>(c.phase);
      visit_memory(c, Write{entry});
    }
    return list;
  }
  static Json to_json(const std::vector<SingularPosition>& positions) {
    Json list = Json::array();
    for (const SingularPosition& p : positions)
      visit_singular_position(p, Write{list.emplace_back(Json::object())});
    return list;
  }
  static Json to_json(const State& state) {
    Json object = Json::object();
    visit_state(state, Write{object});
    return object;
  }
  static Json to_json(const Summary& summary) {
    Json object = Json::object();
    visit_summary(summary, Write{object});
    return object;
  }
};

struct Read {
  const Json& json;

  template <class T>
  void operator()(const char* name, T& value) {
    from_json(json.at(name), value);
  }

  template <class T>
  static void from_json(const Json& in, T& value) {
    in.get_to(value);
  }
  static void from_json(const Json& in, Eigen::VectorXd& value) {
    const auto numbers = in.get<std::vector<double>>();
    value = Eigen::Map<const Eigen::VectorXd>(numbers.data(),
                                              static_cast<Eigen::Index>(numbers.size()));
  }
  static void from_json(const Json& in, std::vector<ContactMemory>& contacts) {
    contacts.resize(in.size());
    for (std::size_t i = 0; i < in.size(); ++i) {
      contacts[i].phase = static_cast<ContactPhase>(in[i].at("phase").get<int>());
      visit_memory(contacts[i], Read{in[i]});
    }
  }
  static void from_json(const Json& in, std::vector<SingularPosition>& positions) {
    positions.resize(in.size());
    for (std::size_t i = 0; i < in.size(); ++i) visit_singular_position(positions[i], Read{in[i]});
  }
  static void from_json(const Json& in, State& state) { visit_state(state, Read{in}); }
  static void from_json(const Json& in, Summary& summary) { visit_summary(summary, Read{in}); }
};

// ---- files ----

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

[[noreturn]] void fail_to_write(const fs::path& path) {
  throw OutputError(
      fmt::format("checkpoint: cannot write '{}': {}", path.string(), std::strerror(errno)));
}

/// Appends to or replaces a file; the bytes are on the disk when it returns.
void write_durably(const fs::path& path, const char* mode, const Bytes& bytes) {
  const File file(std::fopen(path.c_str(), mode));
  if (!file) fail_to_write(path);
  const bool written =
      bytes.empty() || std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size();
  if (!written || std::fflush(file.get()) != 0 || fsync(fileno(file.get())) != 0)
    fail_to_write(path);
}

/// A renaming is durable once its folder is.
void sync_folder(const fs::path& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

template <class T>
void put(Bytes& bytes, const T& value) {
  const auto* p = reinterpret_cast<const std::uint8_t*>(&value);
  bytes.insert(bytes.end(), p, p + sizeof value);
}

template <class T>
T take(const std::uint8_t*& p) {
  T value;
  std::memcpy(&value, p, sizeof value);
  p += sizeof value;
  return value;
}

std::uint32_t checksum(std::span<const std::uint8_t> bytes) {
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.checksum();
}

Bytes read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw ModelError(fmt::format("checkpoint '{}' cannot be read", path.string()));
  return {std::istreambuf_iterator<char>(file), {}};
}

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
  throw ModelError(fmt::format("checkpoint '{}' is refused: {}", path.string(), reason));
}

Bytes encode(const EventRecord& e) {
  const Bytes cbor =
      Json::to_cbor(Json::array({e.t, e.element, e.kind, e.region, e.speed, e.penetration}));
  Bytes bytes;
  put(bytes, static_cast<std::uint32_t>(cbor.size()));
  bytes.insert(bytes.end(), cbor.begin(), cbor.end());
  return bytes;
}

EventRecord decode(std::span<const std::uint8_t> cbor) {
  const Json json = Json::from_cbor(cbor.begin(), cbor.end());
  return {.t = json.at(0),
          .element = json.at(1),
          .kind = json.at(2),
          .region = json.at(3),
          .speed = json.at(4),
          .penetration = json.at(5)};
}

const char* const state_file = "checkpoint.bin";
const char* const sample_file = "samples.bin";
const char* const contact_file = "contacts.bin";
const char* const event_file = "events.bin";

/// Appends the rows of a table that are new to its file.
void append_rows(const fs::path& path, const Table& table, RowsOnDisk& stored) {
  Bytes bytes;
  for (std::size_t i = stored.count * table.names().size(); i < table.data().size(); ++i)
    put(bytes, table.data()[i]);
  boost::crc_32_type crc;
  if (stored.count > 0) crc.reset(stored.checksum);
  crc.process_bytes(bytes.data(), bytes.size());
  stored = {.count = table.rows(), .checksum = crc.get_interim_remainder()};
  if (!bytes.empty()) write_durably(path, "ab", bytes);
}

}  // namespace

CheckpointWriter::CheckpointWriter(fs::path folder, const Checkpoint* existing)
    : folder_(std::move(folder)) {
  make_output_folder(folder_);
  if (existing != nullptr) {
    rows_ = existing->rows;
    rows_in_contacts_ = existing->rows_in_contacts;
    events_ = existing->events;
    events_crc_.reset(existing->events_checksum);
    return;
  }
  std::error_code error;
  fs::remove(folder_ / state_file, error);
  for (const char* name : {sample_file, contact_file, event_file})
    write_durably(folder_ / name, "wb", {});
}

void CheckpointWriter::write(Checkpoint& c, const Result& result) {
  append_rows(folder_ / sample_file, result.samples, rows_);
  append_rows(folder_ / contact_file, result.contact_samples, rows_in_contacts_);
  c.columns = result.samples.names().size();
  c.rows = rows_;
  c.rows_in_contacts = rows_in_contacts_;
  c.events = result.events.size();
  Bytes events;
  for (std::size_t i = events_; i < c.events; ++i) {
    const Bytes bytes = encode(result.events[i]);
    events.insert(events.end(), bytes.begin(), bytes.end());
  }
  events_crc_.process_bytes(events.data(), events.size());
  c.events_checksum = events_crc_.get_interim_remainder();
  if (!events.empty()) write_durably(folder_ / event_file, "ab", events);
  events_ = c.events;

  Json json = Json::object();
  visit_checkpoint(std::as_const(c), Write{json});
  const Bytes body = Json::to_cbor(json);
  Bytes bytes(magic.begin(), magic.end());
  put(bytes, format_version);
  put(bytes, static_cast<std::uint64_t>(body.size()));
  put(bytes, checksum(body));
  bytes.insert(bytes.end(), body.begin(), body.end());
  const fs::path fresh = folder_ / "checkpoint.new";
  std::error_code error;
  try {
    write_durably(fresh, "wb", bytes);
  } catch (const OutputError&) {
    fs::remove(fresh, error);
    throw;
  }
  fs::rename(fresh, folder_ / state_file, error);
  if (error) fail_to_write(folder_ / state_file);
  sync_folder(folder_);
}

std::optional<Checkpoint> read_checkpoint(const fs::path& folder) {
  const fs::path path = folder / state_file;
  if (!fs::exists(path)) return std::nullopt;
  const Bytes bytes = read_file(path);
  if (bytes.size() < header_size || std::memcmp(bytes.data(), magic.data(), magic.size()) != 0)
    refuse(path, "it is not a checkpoint of Yoke, or was cut off within its header");
  const std::uint8_t* p = bytes.data() + magic.size();
  if (const auto version = take<std::uint32_t>(p); version != format_version)
    refuse(path, fmt::format("its format is version {}, this program reads version {}", version,
                             format_version));
  const auto length = take<std::uint64_t>(p);
  const auto expected = take<std::uint32_t>(p);
  const std::span<const std::uint8_t> body(bytes.data() + header_size, bytes.size() - header_size);
  if (body.size() != length)
    refuse(path, fmt::format("it is truncated: {} of {} bytes", body.size(), length));
  if (checksum(body) != expected) refuse(path, "its checksum is wrong, it is damaged");
  Checkpoint c;
  try {
    const Json json = Json::from_cbor(body.begin(), body.end());
    visit_checkpoint(c, Read{json});
  } catch (const Json::exception& error) {
    refuse(path, error.what());
  }
  return c;
}

namespace {

void check_interim(const fs::path& path, std::span<const std::uint8_t> bytes,
                   std::uint32_t expected) {
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), bytes.size());
  if (crc.get_interim_remainder() != expected) refuse(path, "its checksum is wrong, it is damaged");
}

void take_rows(const fs::path& path, const RowsOnDisk& stored, Table& table) {
  const std::size_t row = table.names().size() * sizeof(double), size = stored.count * row;
  const Bytes bytes = read_file(path);
  if (bytes.size() < size)
    refuse(path, fmt::format("it is truncated: {} of {} bytes", bytes.size(), size));
  check_interim(path, {bytes.data(), size}, stored.checksum);
  for (std::size_t i = 0; i < stored.count; ++i)
    std::memcpy(table.append(), bytes.data() + i * row, row);
  fs::resize_file(path, size);
}

}  // namespace

void read_rows(const fs::path& folder, const Checkpoint& c, Result& result) {
  const fs::path samples = folder / sample_file, events = folder / event_file;
  if (c.columns != result.samples.names().size())
    refuse(samples, fmt::format("its rows have {} columns, those of the model {}", c.columns,
                                result.samples.names().size()));
  take_rows(samples, c.rows, result.samples);
  take_rows(folder / contact_file, c.rows_in_contacts, result.contact_samples);

  const Bytes log = read_file(events);
  const std::uint8_t* p = log.data();
  const std::uint8_t* const end = p + log.size();
  for (std::size_t i = 0; i < c.events; ++i) {
    const auto left = static_cast<std::size_t>(end - p);
    const std::size_t length = left >= 4 ? take<std::uint32_t>(p) : left;
    if (left < 4 || left - 4 < length)
      refuse(events, fmt::format("it is truncated: event {} of {} is not whole", i + 1, c.events));
    try {
      result.events.push_back(decode({p, length}));
    } catch (const Json::exception& error) {
      refuse(events, error.what());
    }
    p += length;
  }
  check_interim(events, {log.data(), p}, c.events_checksum);
  fs::resize_file(events, static_cast<std::uintmax_t>(p - log.data()));
}

Bytes state_to_bytes(const State& state) { return Json::to_cbor(Write::to_json(state)); }

State state_from_bytes(std::span<const std::uint8_t> bytes) {
  State state;
  try {
    Read::from_json(Json::from_cbor(bytes.begin(), bytes.end()), state);
  } catch (const Json::exception& error) {
    throw ModelError(fmt::format("these bytes are not a state: {}", error.what()));
  }
  return state;
}

}  // namespace yoke

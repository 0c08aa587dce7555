// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/report/stored.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include <yoke/cases/report/replay.hpp>
#include <yoke/core/error.hpp>

namespace yoke::cases {

namespace {

namespace fs = std::filesystem;

std::string text_of_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

StoredReplay load(const fs::path& folder) {
  const fs::path path = folder / replay_file;
  StoredReplay replay{.json = text_of_file(path)};
  while (replay.json.ends_with('\n')) replay.json.pop_back();  // a file of text ends with one
  try {
    const nlohmann::json json = nlohmann::json::parse(replay.json);
    json.at("case").get_to(replay.case_name);
    json.at("law").get_to(replay.law);
  } catch (const nlohmann::json::exception& error) {
    throw ModelError(fmt::format("'{}' is damaged: {}", path.string(), error.what()));
  }
  replay.folder = fs::weakly_canonical(folder).filename().string();
  return replay;
}

/// Folders of laws, by name.
std::vector<fs::path> folders_of_laws(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.is_directory() && fs::exists(entry.path() / replay_file))
      found.push_back(entry.path());
  std::ranges::sort(found);
  return found;
}

/// In the order of comparison.csv, whose first column holds the laws in quotes.
void sort_by_run(std::vector<StoredReplay>& replays, const fs::path& folder) {
  const std::string table = text_of_file(folder / "comparison.csv");
  const auto place = [&](const StoredReplay& r) { return table.find("\n\"" + r.law + "\","); };
  std::ranges::stable_sort(replays, {}, place);
}

}  // namespace

std::vector<StoredReplay> stored_replays(const fs::path& folder) {
  std::vector<StoredReplay> replays;
  if (fs::exists(folder / replay_file)) {
    replays.push_back(load(folder));
  } else if (fs::is_directory(folder)) {
    for (const fs::path& law : folders_of_laws(folder)) replays.push_back(load(law));
    sort_by_run(replays, folder);
  }
  if (replays.empty())
    throw ModelError(fmt::format(
        "there is no '{}' in '{}' or a folder in it: 'yoke run ... -o {}' did not write here, or was "
        "asked for no report",
        replay_file, folder.string(), folder.string()));
  return replays;
}

std::string with_label(const StoredReplay& replay, const std::string& label) {
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(replay.json);
  json["label"] = label;
  return json.dump();
}

}  // namespace yoke::cases

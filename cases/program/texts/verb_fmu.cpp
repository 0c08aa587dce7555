// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke fmu CASE: the case as an FMU, for co-simulation in other programs.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#include <yoke/cases/fmu/fmu_variables.hpp>
#include <yoke/cases/fmu/zip_file.hpp>
#include <yoke/cases/program/verb.hpp>
#include <yoke/core/error.hpp>
#include <yoke/core/result.hpp>
#include <yoke/core/version.hpp>

namespace yoke::cases {

namespace {

namespace fs = std::filesystem;

#if defined(__x86_64__)
constexpr const char* fmu_platform = "linux64";
#elif defined(__aarch64__)
constexpr const char* fmu_platform = "aarch64-linux";
#else
constexpr const char* fmu_platform = "linux32";
#endif
constexpr const char* fmu_library = "libyoke_fmu.so";

/// Beside the program in a build folder, in lib/yoke/ of an installation.
std::string read_fmu_library() {
  std::error_code unknown;
  const fs::path here = fs::read_symlink("/proc/self/exe", unknown).parent_path();
  for (const fs::path& path : {here / fmu_library, here / ".." / YOKE_LIBDIR / fmu_library}) {
    std::ifstream file(path, std::ios::binary);
    if (file) return {std::istreambuf_iterator<char>(file), {}};
  }
  throw ModelError(
      fmt::format("fmu: '{}' is missing beside '{}'; build it with './dev build' or install it",
                  fmu_library, here.string()));
}

/// Of all that the variables depend on: FNV-1a of it, twice with another start, as a GUID.
std::string guid_of(const FmuDescription& description) {
  const std::string text = model_description(description) + description.to_json() + version;
  const auto hash = [&](std::uint64_t value) {
    for (const char c : text) value = (value ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    return value;
  };
  const std::uint64_t a = hash(0xcbf29ce484222325u), b = hash(0x84222325cbf29ce4u);
  return fmt::format("{{{:08x}-{:04x}-{:04x}-{:04x}-{:012x}}}", a >> 32, (a >> 16) & 0xffffu,
                     a & 0xffffu, b >> 48, b & 0xffffffffffffu);
}

void write_whole(const fs::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw OutputError(fmt::format("fmu: cannot write '{}'", path.string()));
}

struct FmuOptions {
  FmuDescription description;
  std::string output;
};

int export_fmu(FmuOptions options) {
  FmuDescription& d = options.description;
  if (options.output.empty()) options.output = d.case_name + ".fmu";
  const std::string library = read_fmu_library();
  d.guid = guid_of(d);
  write_whole(options.output,
              zip_archive({{"modelDescription.xml", model_description(d)},
                           {"resources/yoke.json", d.to_json()},
                           {fmt::format("binaries/{}/yoke_fmu.so", fmu_platform), library}}));
  std::size_t inputs = 0, outputs = 0, parameters = 0;
  for (const FmuVariable& v : fmu_variables(d))
    ++(v.role == FmuRole::input ? inputs : v.role == FmuRole::output ? outputs : parameters);
  fmt::print("{}: FMI 2.0 for co-simulation; {} inputs, {} parameters, {} outputs\n",
             options.output, inputs, parameters, outputs);
  return exit_ok;
}

}  // namespace

void add_fmu_verb(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand("fmu", "Export a case as an FMU for co-simulation (FMI 2.0)");
  auto options = std::make_shared<FmuOptions>();
  FmuDescription& d = options->description;
  verb->add_option("CASE", d.case_name, "Name of the case; see 'yoke list'")->required();
  verb->add_option("--set", d.settings, "Set a parameter: --set crank_length=50mm; repeatable")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  verb->add_option("--law", d.law, "Contact law of the model")->type_name("NAME");
  verb->add_option("--rtol", d.relative_tolerance,
                   "Relative tolerance, unless the importer says one")
      ->capture_default_str();
  verb->add_option("-o,--output", options->output, "File to write; default: CASE.fmu")
      ->type_name("FILE");
  verb->callback([options, &action] { action = [options] { return export_fmu(*options); }; });
}

}  // namespace yoke::cases

// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Cases as FMUs, as an importer sees them: the archive, the description, the library. The importer is
// written here and knows of Yoke only what the standard says.
#include <dlfcn.h>
#include <doctest/doctest.h>

#include <cmath>
#include <cstdarg>
#include <cstdlib>
#include <map>

#include <yoke/cases/case.hpp>
#include <yoke/cases/fmu/fmi2.hpp>
#include <yoke/cases/fmu/zip_file.hpp>
#include <yoke/integrators/simulation.hpp>
#include <yoke/tests/cases/program/program_run.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;
namespace fs = std::filesystem;

std::vector<std::string> logged;

void keep_log(fmi2ComponentEnvironment, fmi2String, fmi2Status, fmi2String, fmi2String format,
              ...) {
  char text[1000];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  logged.emplace_back(text);
}

/// The value of an attribute in a tag; "" if it has none.
std::string attribute(const std::string& tag, const std::string& name) {
  const std::size_t at = tag.find(" " + name + "=\"");
  if (at == tag.npos) return {};
  const std::size_t from = at + name.size() + 3;
  return tag.substr(from, tag.find('"', from) - from);
}

struct Variable {
  unsigned reference = 0;
  std::string causality, start;
};

/// The entries of an archive into a folder. They are stored as they are, one after the other.
void unpack(const fs::path& archive, const fs::path& folder) {
  const std::string zip = content(archive);
  const auto number = [&](std::size_t at, std::size_t size) {
    std::size_t value = 0;
    for (std::size_t i = size; i-- > 0;)
      value = 256 * value + static_cast<unsigned char>(zip[at + i]);
    return value;
  };
  for (std::size_t at = 0; zip.compare(at, 4, "PK\3\4") == 0;) {
    REQUIRE(number(at + 8, 2) == 0);  // stored
    const std::size_t size = number(at + 18, 4), name = number(at + 26, 2);
    const fs::path path = folder / zip.substr(at + 30, name);
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << zip.substr(at + 30 + name, size);
    at += 30 + name + size;
  }
}

/// An FMU unpacked and loaded.
class Importer {
 public:
  Importer(const fs::path& folder, const std::string& fmu) : folder_(folder) {
    unpack(fmu, folder);
    xml = content(folder / "modelDescription.xml");
    for (std::size_t at = xml.find("<ScalarVariable"); at != xml.npos;
         at = xml.find("<ScalarVariable", at + 1)) {
      const std::string tag = xml.substr(at, xml.find("</ScalarVariable>", at) - at);
      variables[attribute(tag, "name")] = {
          static_cast<unsigned>(std::stoul(attribute(tag, "valueReference"))),
          attribute(tag, "causality"), attribute(tag, "start")};
    }
    for (const auto& entry : fs::recursive_directory_iterator(folder / "binaries"))
      if (entry.path().extension() == ".so") library_ = dlopen(entry.path().c_str(), RTLD_NOW);
    INFO((library_ == nullptr ? dlerror() : ""));
    REQUIRE(library_ != nullptr);
    guid = attribute(xml.substr(xml.find("<fmiModelDescription")), "guid");
  }
  Importer(const Importer&) = delete;
  ~Importer() {
    for (fmi2Component c : instances_) call<void>("fmi2FreeInstance", c);
    dlclose(library_);
  }

  template <class R, class... A>
  R call(const char* name, A... arguments) const {
    using Function = R (*)(A...);
    void* const symbol = dlsym(library_, name);
    if (symbol == nullptr) throw std::runtime_error(name);
    return reinterpret_cast<Function>(symbol)(arguments...);
  }
  template <class... A>
  fmi2Status status(const char* name, A... arguments) const {
    return call<fmi2Status>(name, arguments...);
  }

  fmi2Component instantiate(const std::string& with_guid) {
    const std::string resources = "file://" + (folder_ / "resources").string();
    return call<fmi2Component>("fmi2Instantiate", fmi2String("one"), fmi2CoSimulation,
                               fmi2String(with_guid.c_str()), fmi2String(resources.c_str()),
                               static_cast<const fmi2CallbackFunctions*>(&callbacks_), 0, 0);
  }
  /// Ready to be set.
  fmi2Component start(double stop, double tolerance) {
    fmi2Component c = instantiate(guid);
    REQUIRE(c != nullptr);
    instances_.push_back(c);
    CHECK(status("fmi2SetupExperiment", c, 1, tolerance, 0.0, 1, stop) == fmi2OK);
    CHECK(status("fmi2EnterInitializationMode", c) == fmi2OK);
    return c;
  }
  void go(fmi2Component c) const { CHECK(status("fmi2ExitInitializationMode", c) == fmi2OK); }
  fmi2Status set(fmi2Component c, const std::string& name, double value) const {
    const unsigned reference = variables.at(name).reference;
    return status("fmi2SetReal", c, &reference, std::size_t{1}, static_cast<const double*>(&value));
  }
  double get(fmi2Component c, const std::string& name) const {
    const unsigned reference = variables.at(name).reference;
    double value = std::nan("");
    CHECK(status("fmi2GetReal", c, &reference, std::size_t{1}, &value) == fmi2OK);
    return value;
  }
  fmi2Status step(fmi2Component c, double t, double h) const {
    return status("fmi2DoStep", c, t, h, 1);
  }

  std::string xml, guid;
  std::map<std::string, Variable> variables;

 private:
  fs::path folder_;
  void* library_ = nullptr;
  std::vector<fmi2Component> instances_;
  fmi2CallbackFunctions callbacks_{keep_log, nullptr, nullptr, nullptr, nullptr};
};

struct Exported {
  explicit Exported(const std::string& arguments) {
    const ProgramOutcome run = run_yoke(scratch, "fmu " + arguments + " -o " + file());
    INFO(run.out);
    REQUIRE(run.code == 0);
    said = run.out;
  }
  std::string file() const { return (scratch.path() / "x.fmu").string(); }
  TemporaryFolder scratch;
  std::string said;
};

/// Steps of many lengths that end exactly at `end`.
std::vector<double> odd_times(double end) {
  std::vector<double> times = {0.0};
  for (int i = 1; times.back() < end; ++i)
    times.push_back(std::min(end, times.back() + 0.003 * (1.0 + 0.9 * std::sin(1.0 * i))));
  return times;
}

}  // namespace

TEST_CASE("an FMU of a case gives the bits of the engine, with steps of any length and inputs") {
  Exported exported("slider_crank --rtol 1e-9");
  CHECK(contains(exported.said, "2 inputs"));
  Importer fmu(exported.scratch.path() / "unpacked", exported.file());
  CHECK(fmu.call<const char*>("fmi2GetVersion") == std::string("2.0"));
  CHECK(fmu.call<const char*>("fmi2GetTypesPlatform") == std::string("default"));
  CHECK(fmu.variables.at("motor.speed").causality == "input");
  CHECK(fmu.variables.at("slider.x_m").causality == "output");
  CHECK(fmu.variables.at("case.crank").causality == "parameter");

  const double end = 0.1;
  fmi2Component c = fmu.start(end, 1e-9);
  fmu.go(c);
  const cases::Case& of = cases::find_case("slider_crank");
  const Model model = cases::make_model(of, cases::Parameters(of.parameters));
  Simulation run(model, {.until = end, .relative_tolerance = 1e-9, .samples = 0});
  const std::vector<double> times = odd_times(end);
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (i % 7 == 0) {
      const double pull = 100.0 * std::sin(1.0 * static_cast<double>(i));
      CHECK(fmu.set(c, "motor.acceleration", pull) == fmi2OK);
      run.set("motor.acceleration", pull);
    }
    const double h = times[i] - times[i - 1];
    REQUIRE(fmu.step(c, run.time(), h) == fmi2OK);
    run.advance_to(i + 1 == times.size() ? end : run.time() + h);
    for (const char* name : {"slider.x_m", "slider.vx_m_per_s", "rod.angle_rad", "motor.work_J"})
      CHECK(fmu.get(c, name) == run.get(name));
  }
  CHECK(fmu.get(c, "motor.speed") == run.get("motor.speed"));
  CHECK(run.ended());
  CHECK(fmu.step(c, end, 0.01) == fmi2Error);  // behind its end
  CHECK(contains(logged.back(), "0.1"));
}

TEST_CASE("states of an FMU are taken, given back and kept as bytes") {
  Exported exported("slider_crank");
  Importer fmu(exported.scratch.path() / "unpacked", exported.file());
  fmi2Component c = fmu.start(0.1, 1e-8), other = fmu.start(0.1, 1e-8);
  fmu.go(c);
  fmu.go(other);
  REQUIRE(fmu.step(c, 0.0, 0.02) == fmi2OK);
  REQUIRE(fmu.set(c, "motor.acceleration", 50.0) == fmi2OK);
  REQUIRE(fmu.step(c, 0.02, 0.02) == fmi2OK);
  fmi2FMUstate state = nullptr;
  REQUIRE(fmu.status("fmi2GetFMUstate", c, &state) == fmi2OK);
  std::size_t size = 0;
  REQUIRE(fmu.status("fmi2SerializedFMUstateSize", c, state, &size) == fmi2OK);
  std::vector<char> bytes(size);
  CHECK(fmu.status("fmi2SerializeFMUstate", c, state, bytes.data(), size - 1) == fmi2Error);
  REQUIRE(fmu.status("fmi2SerializeFMUstate", c, state, bytes.data(), size) == fmi2OK);

  const auto finish = [&](fmi2Component which) {
    REQUIRE(fmu.step(which, 0.04, 0.03) == fmi2OK);
    return std::pair(fmu.get(which, "slider.x_m"), fmu.get(which, "motor.speed"));
  };
  REQUIRE(fmu.status("fmi2SetFMUstate", c, state) == fmi2OK);
  const auto first = finish(c);
  REQUIRE(fmu.set(c, "motor.acceleration", -9.0) == fmi2OK);
  REQUIRE(fmu.status("fmi2SetFMUstate", c, state) == fmi2OK);
  CHECK(finish(c) == first);
  // Another instance goes on from the bytes.
  fmi2FMUstate read = nullptr;
  REQUIRE(fmu.status("fmi2DeSerializeFMUstate", other, static_cast<const char*>(bytes.data()), size,
                     &read) == fmi2OK);
  REQUIRE(fmu.status("fmi2SetFMUstate", other, read) == fmi2OK);
  CHECK(finish(other) == first);
  CHECK(fmu.status("fmi2FreeFMUstate", c, &state) == fmi2OK);
  CHECK(state == nullptr);
  CHECK(fmu.status("fmi2FreeFMUstate", other, &read) == fmi2OK);
  bytes.resize(size / 2);
  CHECK(fmu.status("fmi2DeSerializeFMUstate", other, static_cast<const char*>(bytes.data()),
                   bytes.size(), &read) == fmi2Error);
  // From the start again.
  REQUIRE(fmu.status("fmi2Reset", c) == fmi2OK);
  CHECK(fmu.get(c, "motor.acceleration") == 0.0);
}

TEST_CASE("directional derivatives of an FMU: the torque by the acceleration of the motor") {
  Exported exported("slider_crank");
  Importer fmu(exported.scratch.path() / "unpacked", exported.file());
  fmi2Component c = fmu.start(0.1, 1e-8);
  fmu.go(c);
  REQUIRE(fmu.step(c, 0.0, 0.013) == fmi2OK);
  const double before = fmu.get(c, "slider.x_m");
  const unsigned unknowns[] = {fmu.variables.at("motor.moment_N_m").reference,
                               fmu.variables.at("slider.ax_m_per_s2").reference};
  const unsigned known = fmu.variables.at("motor.acceleration").reference;
  const double seed = 2.0;
  double slope[2] = {};
  REQUIRE(fmu.status("fmi2GetDirectionalDerivative", c, static_cast<const unsigned*>(unknowns),
                     std::size_t{2}, &known, std::size_t{1}, &seed, slope) == fmi2OK);
  CHECK(fmu.get(c, "slider.x_m") == before);
  // Both are linear in it.
  const double torque = fmu.get(c, "motor.moment_N_m"), a = fmu.get(c, "slider.ax_m_per_s2");
  REQUIRE(fmu.set(c, "motor.acceleration", 10.0) == fmi2OK);
  CHECK(slope[0] ==
        doctest::Approx(2.0 * (fmu.get(c, "motor.moment_N_m") - torque) / 10.0).epsilon(1e-8));
  CHECK(slope[1] ==
        doctest::Approx(2.0 * (fmu.get(c, "slider.ax_m_per_s2") - a) / 10.0).epsilon(1e-8));
  const unsigned wrong = fmu.variables.at("case.crank").reference;
  CHECK(fmu.status("fmi2GetDirectionalDerivative", c, static_cast<const unsigned*>(unknowns),
                   std::size_t{2}, &wrong, std::size_t{1}, &seed, slope) == fmi2Error);
  CHECK(logged.back() == "directional derivative: 'case.crank' is no input");
}

TEST_CASE("parameters of an FMU make the model of the case with these") {
  Exported exported("slider_crank --set rod=400mm");
  Importer fmu(exported.scratch.path() / "unpacked", exported.file());
  CHECK(fmu.variables.at("case.rod").start == "0.4");
  fmi2Component c = fmu.start(0.05, 1e-8);
  REQUIRE(fmu.set(c, "case.crank", 0.12) == fmi2OK);
  fmu.go(c);
  REQUIRE(fmu.step(c, 0.0, 0.05) == fmi2OK);
  const cases::Case& of = cases::find_case("slider_crank");
  const Model model =
      cases::make_model(of, cases::Parameters(of.parameters, {"rod=400mm", "crank=0.12m"}));
  Simulation run(model, {.until = 0.05, .samples = 0});
  run.advance_to(0.05);
  CHECK(fmu.get(c, "slider.x_m") == run.get("slider.x_m"));

  CHECK(fmu.set(c, "case.crank", 0.1) == fmi2Error);
  CHECK(logged.back() == "'case.crank' is fixed once the run has begun");
  CHECK(fmu.set(c, "slider.x_m", 0.1) == fmi2Error);
  CHECK(logged.back() == "'slider.x_m' is an output and cannot be set");
  fmi2Component other = fmu.start(0.05, 1e-8);
  CHECK(fmu.set(other, "case.crank", -1.0) == fmi2Error);
  CHECK(contains(logged.back(), "case.crank"));
  CHECK(fmu.instantiate("{another}") == nullptr);
  CHECK(contains(logged.back(), "GUID = '{another}' is not that of the resources"));
}

TEST_CASE("the description of an FMU is what the standard says") {
  // Ours, written after the text of the standard; and fmi2ModelDescription.xsd of the standard itself,
  // where a machine has it and YOKE_FMI2_SCHEMA names it.
  const std::string own = std::string(YOKE_SOURCE_DIR) + "/tests/cases/fmu/model_description.rng";
  const char* const schema = std::getenv("YOKE_FMI2_SCHEMA");
  const bool can_validate = std::system("command -v xmllint >/dev/null") == 0;
  if (!can_validate) MESSAGE("not validated: no xmllint");
  const auto valid = [](const std::string& how, const std::filesystem::path& xml) {
    return std::system(("xmllint --noout " + how + " " + xml.string() + " 2>/dev/null").c_str()) ==
           0;
  };
  for (const char* name : {"slider_crank", "scotch_yoke", "car_axis"}) {
    Exported exported(name);
    Importer fmu(exported.scratch.path() / "unpacked", exported.file());
    INFO(name);
    // Places in the list of variables, counted from 1, of all outputs and nothing else, twice.
    std::size_t outputs = 0, unknowns = 0;
    for (const auto& [variable, v] : fmu.variables) outputs += v.causality == "output" ? 1 : 0;
    for (std::size_t at = fmu.xml.find("<Unknown "); at != fmu.xml.npos;
         at = fmu.xml.find("<Unknown ", at + 1))
      ++unknowns;
    CHECK(unknowns == 2 * outputs);
    // Every unit is defined, and once.
    for (std::size_t at = fmu.xml.find("<Real "); at != fmu.xml.npos;
         at = fmu.xml.find("<Real ", at + 1)) {
      const std::string unit = attribute(fmu.xml.substr(at, fmu.xml.find("/>", at) - at), "unit");
      if (unit.empty()) continue;
      const std::string definition = "<Unit name=\"" + unit + "\"/>";
      CHECK(fmu.xml.find(definition) != fmu.xml.npos);
      CHECK(fmu.xml.find(definition) == fmu.xml.rfind(definition));
    }
    if (!can_validate) continue;
    const std::filesystem::path xml = exported.scratch.path() / "unpacked/modelDescription.xml";
    CHECK(valid("--relaxng " + own, xml));
    if (schema != nullptr) CHECK(valid("--schema " + std::string(schema), xml));
    // The schema is one that can say no.
    std::string wrong = fmu.xml;
    wrong.replace(wrong.find(" start="), 7, " begin=");
    const std::filesystem::path broken = exported.scratch.path() / "broken.xml";
    std::ofstream(broken, std::ios::binary) << wrong;
    CHECK_FALSE(valid("--relaxng " + own, broken));
  }
}

TEST_CASE("archives: what is stored comes out, the same bytes each time") {
  const TemporaryFolder scratch;
  const std::vector<cases::ZipEntry> entries = {{"a.txt", "one\n"},
                                                {"deep/er/b", std::string(70000, '\0')}};
  const std::string zip = cases::zip_archive(entries);
  CHECK(zip == cases::zip_archive(entries));
  std::ofstream(scratch.path() / "z.zip", std::ios::binary) << zip;
  const std::string path = (scratch.path() / "z.zip").string();
  unpack(path, scratch.path());
  for (const cases::ZipEntry& e : entries) CHECK(content(scratch.path() / e.name) == e.content);
  if (std::system("command -v unzip >/dev/null") == 0)
    CHECK(std::system(("unzip -tq " + path + " >/dev/null").c_str()) == 0);
  else
    MESSAGE("skipped: no unzip");
}

TEST_CASE("yoke fmu says what is wrong") {
  const TemporaryFolder scratch;
  CHECK(contains(run_yoke(scratch, "fmu slider_crnk").out, "slider_crank"));
  CHECK(contains(run_yoke(scratch, "fmu slider_crank --set crank=4m").out, "crank"));
  CHECK(contains(run_yoke(scratch, "fmu slider_crank -o /nowhere/x.fmu").out,
                 "fmu: cannot write '/nowhere/x.fmu'"));
}

// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The library of an FMU: functions of FMI 2.0 for co-simulation. One library serves all FMUs: it finds
// the description of its mechanism among their resources. No exception leaves it; what goes wrong is
// logged with the message of the engine.
#include <fmt/format.h>

#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include <yoke/cases/fmu/fmi2.hpp>
#include <yoke/cases/fmu/fmu_instance.hpp>
#include <yoke/core/error.hpp>

namespace yoke::cases {
namespace {

struct Slave {
  std::string name;
  fmi2CallbackFunctions callbacks;
  FmuInstance instance;
};

void log_error(const fmi2CallbackFunctions& callbacks, const std::string& name,
               const std::string& message) {
  if (callbacks.logger != nullptr)
    callbacks.logger(callbacks.componentEnvironment, name.c_str(), fmi2Error, "logStatusError",
                     "%s", message.c_str());
}

/// f() for the slave; its status, or fmi2Error and a line in the log.
template <class F>
fmi2Status guarded(fmi2Component component, const F& f) {
  if (component == nullptr) return fmi2Error;
  Slave& slave = *static_cast<Slave*>(component);
  try {
    return f(slave.instance);
  } catch (const std::exception& error) {
    log_error(slave.callbacks, slave.name, error.what());
    return fmi2Error;
  }
}

std::string decoded(const std::string& uri) {
  std::string out;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size()) {
      out += static_cast<char>(std::stoi(uri.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      out += uri[i];
    }
  }
  return out;
}

/// "file:///of/an/fmu/resources", "file:/of/..." or "/of/...".
std::filesystem::path path_of(const char* location) {
  std::string text = location != nullptr ? location : "";
  if (text.starts_with("file:")) {
    text = decoded(text.substr(5));
    if (text.starts_with("//")) text = text.substr(text.find('/', 2));
  }
  return text;
}

FmuDescription read_description(const char* location, const char* guid) {
  const std::filesystem::path path = path_of(location) / "yoke.json";
  std::ifstream file(path);
  if (!file) throw ModelError(fmt::format("cannot read '{}'", path.string()));
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  FmuDescription description = FmuDescription::from_json(text);
  if (guid == nullptr || description.guid != guid)
    throw ModelError(fmt::format("GUID = '{}' is not that of the resources, '{}'",
                                 guid != nullptr ? guid : "", description.guid));
  return description;
}

std::span<const unsigned> references(const fmi2ValueReference* vr, std::size_t count) {
  return {vr, count};
}

fmi2Status unsupported(fmi2Component component, std::size_t count, const char* type) {
  return guarded(component, [&](FmuInstance&) -> fmi2Status {
    if (count == 0) return fmi2OK;
    throw ModelError(fmt::format("there are no variables of type {}", type));
  });
}

}  // namespace
}  // namespace yoke::cases

using namespace yoke::cases;

extern "C" {

const char* fmi2GetTypesPlatform() { return "default"; }
const char* fmi2GetVersion() { return "2.0"; }
fmi2Status fmi2SetDebugLogging(fmi2Component, fmi2Boolean, std::size_t, const fmi2String*) {
  return fmi2OK;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions* callbacks, fmi2Boolean, fmi2Boolean) {
  const fmi2CallbackFunctions own = callbacks != nullptr ? *callbacks : fmi2CallbackFunctions{};
  const std::string called = name != nullptr ? name : "";
  try {
    if (type != fmi2CoSimulation) throw yoke::ModelError("this FMU is for co-simulation");
    return new Slave{called, own, FmuInstance(read_description(resources, guid))};
  } catch (const std::exception& error) {
    log_error(own, called, error.what());
    return nullptr;
  }
}
void fmi2FreeInstance(fmi2Component c) { delete static_cast<Slave*>(c); }

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean tolerance_defined, fmi2Real tolerance,
                               fmi2Real start, fmi2Boolean stop_defined, fmi2Real stop) {
  return guarded(c, [&](FmuInstance& fmu) {
    fmu.set_up(start, stop_defined != 0 ? std::optional(stop) : std::nullopt,
               tolerance_defined != 0 ? std::optional(tolerance) : std::nullopt);
    return fmi2OK;
  });
}
fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
  return guarded(c, [](FmuInstance&) { return fmi2OK; });
}
fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
  return guarded(c, [](FmuInstance& fmu) {
    fmu.time();  // what is wrong with the start is said here
    return fmi2OK;
  });
}
fmi2Status fmi2Terminate(fmi2Component c) {
  return guarded(c, [](FmuInstance&) { return fmi2OK; });
}
fmi2Status fmi2Reset(fmi2Component c) {
  return guarded(c, [](FmuInstance& fmu) {
    fmu.reset();
    return fmi2OK;
  });
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], std::size_t count,
                       fmi2Real value[]) {
  return guarded(c, [&](FmuInstance& fmu) {
    for (std::size_t i = 0; i < count; ++i) value[i] = fmu.get(vr[i]);
    return fmi2OK;
  });
}
fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], std::size_t count,
                       const fmi2Real value[]) {
  return guarded(c, [&](FmuInstance& fmu) {
    for (std::size_t i = 0; i < count; ++i) fmu.set(vr[i], value[i]);
    return fmi2OK;
  });
}
fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference*, std::size_t count,
                          fmi2Integer*) {
  return unsupported(c, count, "Integer");
}
fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference*, std::size_t count,
                          fmi2Boolean*) {
  return unsupported(c, count, "Boolean");
}
fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference*, std::size_t count,
                         fmi2String*) {
  return unsupported(c, count, "String");
}
fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference*, std::size_t count,
                          const fmi2Integer*) {
  return unsupported(c, count, "Integer");
}
fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference*, std::size_t count,
                          const fmi2Boolean*) {
  return unsupported(c, count, "Boolean");
}
fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference*, std::size_t count,
                         const fmi2String*) {
  return unsupported(c, count, "String");
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate* state) {
  return guarded(c, [&](FmuInstance& fmu) {
    auto kept = std::make_unique<FmuInstance::Kept>(fmu.keep());
    delete static_cast<FmuInstance::Kept*>(*state);  // one that the caller gives is used again
    *state = kept.release();
    return fmi2OK;
  });
}
fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
  return guarded(c, [&](FmuInstance& fmu) {
    if (state == nullptr) throw yoke::ModelError("fmi2SetFMUstate: there is no state");
    fmu.restore(*static_cast<FmuInstance::Kept*>(state));
    return fmi2OK;
  });
}
fmi2Status fmi2FreeFMUstate(fmi2Component, fmi2FMUstate* state) {
  if (state == nullptr) return fmi2OK;
  delete static_cast<FmuInstance::Kept*>(*state);
  *state = nullptr;
  return fmi2OK;
}
fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, std::size_t* size) {
  return guarded(c, [&](FmuInstance&) {
    *size = FmuInstance::to_bytes(*static_cast<FmuInstance::Kept*>(state)).size();
    return fmi2OK;
  });
}
fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[],
                                 std::size_t size) {
  return guarded(c, [&](FmuInstance&) {
    const auto all = FmuInstance::to_bytes(*static_cast<FmuInstance::Kept*>(state));
    if (size < all.size())
      throw yoke::ModelError(
          fmt::format("fmi2SerializeFMUstate: size = {} must be at least {}", size, all.size()));
    std::memcpy(bytes, all.data(), all.size());
    return fmi2OK;
  });
}
fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], std::size_t size,
                                   fmi2FMUstate* state) {
  return guarded(c, [&](FmuInstance&) {
    const auto* first = reinterpret_cast<const std::uint8_t*>(bytes);
    *state = new FmuInstance::Kept(FmuInstance::from_bytes({first, size}));
    return fmi2OK;
  });
}
fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknowns[],
                                        std::size_t unknown_count,
                                        const fmi2ValueReference knowns[], std::size_t known_count,
                                        const fmi2Real seed[], fmi2Real sensitivity[]) {
  return guarded(c, [&](FmuInstance& fmu) {
    const std::vector<double> all = fmu.derivative(
        references(unknowns, unknown_count), references(knowns, known_count), {seed, known_count});
    std::copy(all.begin(), all.end(), sensitivity);
    return fmi2OK;
  });
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference*,
                                       std::size_t count, const fmi2Integer*, const fmi2Real*) {
  return unsupported(c, count, "derivative of an input");
}
fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference*,
                                        std::size_t count, const fmi2Integer*, fmi2Real*) {
  return unsupported(c, count, "derivative of an output");
}
fmi2Status fmi2DoStep(fmi2Component c, fmi2Real t, fmi2Real step, fmi2Boolean) {
  return guarded(c, [&](FmuInstance& fmu) { return fmu.do_step(t, step) ? fmi2OK : fmi2Discard; });
}
fmi2Status fmi2CancelStep(fmi2Component) { return fmi2Error; }

fmi2Status fmi2GetStatus(fmi2Component, fmi2StatusKind, fmi2Status*) { return fmi2Discard; }
fmi2Status fmi2GetRealStatus(fmi2Component c, fmi2StatusKind kind, fmi2Real* value) {
  return guarded(c, [&](FmuInstance& fmu) {
    if (kind != fmi2LastSuccessfulTime) return fmi2Discard;
    *value = fmu.time();
    return fmi2OK;
  });
}
fmi2Status fmi2GetIntegerStatus(fmi2Component, fmi2StatusKind, fmi2Integer*) { return fmi2Discard; }
fmi2Status fmi2GetBooleanStatus(fmi2Component c, fmi2StatusKind kind, fmi2Boolean* value) {
  return guarded(c, [&](FmuInstance& fmu) {
    if (kind != fmi2Terminated) return fmi2Discard;
    *value = fmu.ended_early() ? 1 : 0;
    return fmi2OK;
  });
}
fmi2Status fmi2GetStringStatus(fmi2Component, fmi2StatusKind, fmi2String*) { return fmi2Discard; }

}  // extern "C"

// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/simulation.hpp>

#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include <yoke/integrators/engine/run.hpp>
#include <yoke/integrators/run/start/start_checks.hpp>

namespace yoke {

/// The run and what it needs beside it.
struct Simulation::Engine {
  template <class From>
  Engine(const Model& of, const From& from, SimulationOptions wanted)
      : model(of), options(std::move(wanted)), run(of, from, options) {
    run.begin();
  }
  explicit Engine(Engine& original)
      : model(original.model),
        options(original.options),
        run(original.run, without_checkpoints(options)) {}

  static const SimulationOptions& without_checkpoints(SimulationOptions& options) {
    options.checkpoints = {};
    return options;
  }
  void keep() {
    if (keeps) last = run.snapshot();
  }
  static std::unique_ptr<Engine> start(const Model& model, const State& start,
                                       const SimulationOptions& options);
  static std::unique_ptr<Engine> resume(const Model& model, const Checkpoint& checkpoint,
                                        const SimulationOptions& options);

  const Model& model;
  SimulationOptions options;
  Run run;
  bool keeps = false;
  std::optional<Snapshot> last;
};

std::unique_ptr<Simulation::Engine> Simulation::Engine::start(const Model& model,
                                                              const State& start,
                                                              const SimulationOptions& options) {
  check_model(model);
  check_state(model, start);
  if (options.checkpoints.resume)
    if (const auto checkpoint = read_checkpoint(options.checkpoints.folder))
      return resume(model, *checkpoint, options);
  return std::make_unique<Engine>(model, start, options);
}

std::unique_ptr<Simulation::Engine> Simulation::Engine::resume(const Model& model,
                                                               const Checkpoint& checkpoint,
                                                               const SimulationOptions& options) {
  check_checkpoint(model, options, checkpoint);
  return std::make_unique<Engine>(model, checkpoint, options);
}

std::vector<std::uint8_t> to_bytes(const Snapshot& s) {
  return nlohmann::json::to_cbor(
      {{"state", nlohmann::json::binary(state_to_bytes(s.state))},
       {"initial_energy", s.initial_energy},
       {"formulation", s.formulation},
       {"tolerance_kept", s.tolerance_kept},
       {"left_out", s.left_out},
       {"v_taken", std::vector<double>(s.v_taken.begin(), s.v_taken.end())}});
}

Snapshot snapshot_from_bytes(std::span<const std::uint8_t> bytes) {
  try {
    const auto json = nlohmann::json::from_cbor(bytes.begin(), bytes.end());
    const auto v = json.at("v_taken").get<std::vector<double>>();
    return {.state = state_from_bytes(json.at("state").get_binary()),
            .initial_energy = json.at("initial_energy"),
            .formulation = json.at("formulation"),
            .tolerance_kept = json.at("tolerance_kept"),
            .left_out = json.at("left_out").get<std::vector<int>>(),
            .v_taken = Eigen::VectorXd::Map(v.data(), static_cast<Eigen::Index>(v.size()))};
  } catch (const nlohmann::json::exception& error) {
    throw ModelError(fmt::format("these bytes are not a snapshot: {}", error.what()));
  }
}

Simulation::Simulation(std::unique_ptr<Engine> engine) : engine_(std::move(engine)) {}
Simulation::Simulation(const Model& model, const State& start, const SimulationOptions& options)
    : engine_(Engine::start(model, start, options)) {}
Simulation::Simulation(const Model& model, const SimulationOptions& options)
    : Simulation(model, model.start_state(), options) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

double Simulation::time() const { return engine_->run.time(); }
double Simulation::end_time() const { return engine_->options.until; }
bool Simulation::ended() const { return engine_->run.ended(); }
const Summary& Simulation::summary() const { return engine_->run.summary(); }
const std::vector<EventRecord>& Simulation::events() const { return engine_->run.events(); }

bool Simulation::advance_to(double t) {
  require_range("advance_to", "t", t, time(), end_time(), "s");
  engine_->keep();
  return engine_->run.advance_to(t);
}

bool Simulation::step() {
  engine_->keep();
  return engine_->run.step();
}

const State& Simulation::state() { return engine_->run.shown(); }

std::size_t Simulation::find_output(std::string_view column) const {
  return engine_->run.columns().index(column);
}

double Simulation::output(std::size_t column) {
  const Table& row = engine_->run.outputs();
  if (column >= row.names().size())
    throw ModelError(fmt::format("output: column = {} must be less than {}, the number of columns",
                                 column, row.names().size()));
  return row.value(0, column);
}

double Simulation::get(std::string_view name) {
  const Table& columns = engine_->run.columns();
  if (columns.has(name)) return output(columns.index(name));
  if (const auto index = engine_->model.parameter_index(name))
    return engine_->run.parameter(*index);
  throw ModelError(
      fmt::format("neither a column nor a parameter: '{}'; {}", name, columns.nearest(name)));
}

void Simulation::set(std::string_view parameter, double value) {
  engine_->run.set_parameter(engine_->model.find_parameter(parameter), value);
}

void Simulation::set(std::size_t parameter, double value) {
  const std::size_t count = engine_->run.shown().parameters.size();
  if (parameter >= count)
    throw ModelError(fmt::format(
        "set: parameter = {} must be less than {}, the number of parameters", parameter, count));
  engine_->run.set_parameter(parameter, value);
}

Snapshot Simulation::snapshot() { return engine_->run.snapshot(); }
void Simulation::restore(const Snapshot& snapshot) { engine_->run.restore(snapshot); }

void Simulation::keep_last(bool keep) {
  engine_->keeps = keep;
  engine_->last.reset();
}

void Simulation::rewind() {
  if (!engine_->last)
    throw ModelError("rewind: nothing was kept: call keep_last(), then advance_to() or step()");
  engine_->run.restore(*engine_->last);
}

Simulation Simulation::fork() { return Simulation(std::make_unique<Engine>(*engine_)); }

Result Simulation::result() { return engine_->run.result_so_far(); }
Result Simulation::finish() { return engine_->run.finish_run(); }

}  // namespace yoke

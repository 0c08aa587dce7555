// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke view CASE: the mechanism of a case in its start pose, drawn without a run.
#include <fmt/format.h>

#include <memory>
#include <string>

#include <yoke/cases/program/request.hpp>
#include <yoke/cases/program/verb.hpp>
#include <yoke/cases/report/page.hpp>
#include <yoke/cases/report/replay.hpp>
#include <yoke/integrators/simulate.hpp>

namespace yoke::cases {

namespace {

int view(const RequestOptions& options) {
  const Case& c = find_case(options.case_name);
  const RunRequest request = make_request(c, options);
  const std::string law = options.laws.empty() ? "" : options.laws.front();
  const Model model = make_model(c, request.parameters, law);
  const Table pose = one_pose(model, assembled_state(model));
  const std::vector<EventRecord> none;
  const Summary nothing;
  std::string command = request.command;
  command.replace(command.find("run"), 3, "view");
  const std::string replay = to_json(Replay{.c = c,
                                            .parameters = request.parameters,
                                            .law = law,
                                            .command = command,
                                            .model = model,
                                            .samples = pose,
                                            .events = none,
                                            .summary = nothing});
  const std::filesystem::path folder = request.output;
  make_output_folder(folder);
  write_page(folder / "view.html", c.name, PageKind::view, {replay});
  fmt::print("view: {}\n", (folder / "view.html").string());
  return exit_ok;
}

}  // namespace

void add_view_verb(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand("view", "Draw the mechanism of a case without running it");
  auto options = std::make_shared<RequestOptions>();
  add_case_options(*verb, *options);
  verb->add_option("-o,--output", options->output, "Folder for view.html")->type_name("DIR");
  verb->add_option("--law", options->laws, "Contact law of the model")
      ->type_name("LAW")
      ->allow_extra_args(false);
  verb->callback([verb, options, &action] {
    action = [verb, options] {
      if (options->help) return print_help(*verb, *options);
      return view(*options);
    };
  });
}

}  // namespace yoke::cases

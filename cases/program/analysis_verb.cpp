// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/program/analysis_verb.hpp>

#include <yoke/core/error.hpp>

namespace yoke::cases {

void add_analysis_verb(
    CLI::App& app, Action& action, const char* name, const char* description,
    const std::function<void(CLI::App&, AnalysisOptions&)>& more,
    const std::function<int(const Model&, const RunRequest&, const AnalysisOptions&)>& analyse) {
  CLI::App* verb = app.add_subcommand(name, description);
  auto options = std::make_shared<AnalysisOptions>();
  options->request.samples = 1001;
  RequestOptions& r = options->request;
  verb->set_help_flag();  // our own, because CASE changes what it prints
  verb->add_flag("-h,--help", r.help, "Print this help; with CASE also its parameters and laws");
  verb->add_option("CASE", r.case_name, "Name of the case; see 'yoke list'");
  verb->add_option("--set", r.settings, "Set a parameter: --set crank_length=50mm; repeatable")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  verb->add_option("--law", r.laws, "Contact law of the model")
      ->type_name("NAME")
      ->allow_extra_args(false);
  verb->add_option("-o,--output", r.output, "Folder for the results")->type_name("DIR");
  verb->add_option("--format", options->format, "text or json")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  if (more) more(*verb, *options);
  const std::string suffix = name;
  verb->callback([verb, options, analyse, suffix, &action] {
    action = [verb, options, analyse, suffix]() -> int {
      if (options->request.help) return print_help(*verb, options->request);
      const Case& c = find_case(options->request.case_name);
      RunRequest request = make_request(c, options->request);
      if (options->request.output.empty()) request.output = "results/" + c.name + "-" + suffix;
      const std::string law = options->request.laws.empty() ? "" : request.laws.front();
      return analyse(make_model(c, request.parameters, law), request, *options);
    };
  });
}

void add_motion_options(CLI::App& verb, AnalysisOptions& options) {
  verb.add_option("--duration", options.duration, "How long the motion is followed")
      ->type_name("TIME")
      ->capture_default_str();
  verb.add_option("--samples", options.request.samples, "Rows of motion.csv, uniform in time")
      ->type_name("N")
      ->capture_default_str();
}

double duration_of(const AnalysisOptions& options) {
  return parse_quantity("--duration", Quantity::time, options.duration);
}

int report_motion(const Result& result, const RunRequest& request, const AnalysisOptions& options) {
  result.write(request.output);
  const Summary& s = result.summary;
  if (options.format == "json") {
    fmt::print("{}\n", to_json(s));
    return s.ok() ? exit_ok : exit_failed;
  }
  fmt::print("{}: {:g} of {:g} s, {} rows\n", s.reason, s.t_end, s.t_asked, result.samples.rows());
  for (const std::string& equation : s.redundant_equations)
    fmt::print("redundant, left out: {}\n", equation);
  for (const SingularPosition& p : s.singular_positions)
    fmt::print("nearly singular at t = {:.9g} s ('{}', independence {:.1e})\n", p.t, p.equation,
               p.independence);
  fmt::print("results in {}\n", request.output.string());
  return s.ok() ? exit_ok : exit_failed;
}

}  // namespace yoke::cases

// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <fmt/format.h>

#include <sstream>

#include <yoke/cases/program/help/help.hpp>
#include <yoke/core/version.hpp>

namespace yoke::cases {

namespace {

/// As man(7) shows it.
std::string roff(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '\\' || c == '-') safe += '\\';
    if (c == '\\')
      safe += 'e';
    else
      safe += c;
  }
  if (safe.starts_with('.') || safe.starts_with('\'')) safe.insert(0, "\\&");
  return safe;
}

std::string as_printed(const std::string& lines) {
  std::string text = ".nf\n";
  std::istringstream stream(lines);
  for (std::string line; std::getline(stream, line);) text += roff(line) + "\n";
  return text + ".fi\n";
}

std::string options_of(const CLI::App& app) {
  std::string text;
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_name(option->get_positional(), true);
    const std::string type = option->get_expected_max() > 0 && !option->get_positional()
                                 ? " \\fI" + roff(option->get_type_name()) + "\\fR"
                                 : "";
    text +=
        fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", roff(name), type, roff(option->get_description()));
  }
  return text;
}

}  // namespace

std::string man_page(const CLI::App& app) {
  std::string text = fmt::format(
      ".TH YOKE 1 \"\" \"yoke {}\" \"User Commands\"\n.SH NAME\nyoke \\- {}\n.SH SYNOPSIS\n"
      ".B yoke\n\\fIVERB\\fR [\\fIOPTIONS\\fR]\n.SH DESCRIPTION\n"
      "Runs mechanisms with contacts and writes their results.\n.SH VERBS\n",
      version, "planar multibody engine");
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
    text += fmt::format(".SS yoke {}\n{}\n{}", roff(verb->get_name()),
                        roff(verb->get_description()), options_of(*verb));
    for (const CLI::App* inner : verb->get_subcommands([](const CLI::App*) { return true; }))
      text += fmt::format(".TP\n\\fB{}\\fR\n{}\n", roff(inner->get_name()),
                          roff(inner->get_description()));
    text += ".PP\n" + as_printed(verb->get_footer());
  }
  return text + ".SH EXIT STATUS AND ENVIRONMENT\n" + as_printed(app.get_footer());
}

}  // namespace yoke::cases

// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <fmt/ranges.h>

#include <algorithm>

#include <yoke/cases/case.hpp>
#include <yoke/cases/choices/quantity.hpp>
#include <yoke/cases/program/help/help.hpp>
#include <yoke/core/error.hpp>
#include <yoke/integrators/simulate.hpp>

namespace yoke::cases {

namespace {

/// What may follow a verb.
std::vector<std::string> words_after(const CLI::App& verb) {
  std::vector<std::string> words;
  for (const CLI::App* inner : verb.get_subcommands([](const CLI::App*) { return true; }))
    words.push_back(inner->get_name());
  for (const CLI::Option* option : verb.get_options()) {
    for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
    if (option->get_name() == "CASE")
      for (const Case& c : case_registry()) words.push_back(c.name);
  }
  return words;
}

/// The functions of both shells choose by the verb, the second word, and by the option before the cursor.
std::string branches(const CLI::App& app) {
  std::string text;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    text += fmt::format("    {}) words=\"{}\" ;;\n", verb->get_name(),
                        fmt::join(words_after(*verb), " "));
  return text;
}

std::string verb_names(const CLI::App& app) {
  std::string text = "--help --version";
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    text += " " + verb->get_name();
  return text;
}

std::string formulation_names() {
  std::string text = "automatic";
  for (const FormulationNote& note : formulations()) text += " " + std::string(note.name);
  return text;
}

constexpr const char* bash_frame = R"(# bash completion for yoke; written by 'yoke completion bash'
_yoke() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} words=""
  case $before in
    --formulation) words="{formulations}" ;;
    --format) words="csv hdf5 mat" ;;
    -o | --output) compopt -o default; COMPREPLY=(); return ;;
  esac
  if [ -z "$words" ]; then
    if [ "$COMP_CWORD" -eq 1 ]; then
      words="{verbs}"
    else
      case ${{COMP_WORDS[1]}} in
{branches}      esac
    fi
  fi
  COMPREPLY=($(compgen -W "$words" -- "$current"))
  [ "${{#COMPREPLY[@]}}" -gt 0 ] || compopt -o default
}}
complete -F _yoke yoke
)";

constexpr const char* zsh_frame = R"(#compdef yoke
# zsh completion for yoke; written by 'yoke completion zsh'
_yoke() {{
  local before=${{words[CURRENT - 1]}} verb=${{words[2]}}
  local -a choices
  case $before in
    --formulation) choices=(${{=:-"{formulations}"}}) ;;
    --format) choices=(csv hdf5 mat) ;;
    -o | --output) _files; return ;;
    *)
      local words=""
      if (( CURRENT == 2 )); then
        words="{verbs}"
      else
        case $verb in
{branches}        esac
      fi
      choices=(${{=words}})
      ;;
  esac
  compadd -- $choices || _files
}}
if [ "$funcstack[1]" = "_yoke" ]; then
  _yoke "$@"
else
  compdef _yoke yoke
fi
)";

}  // namespace

std::string completion_script(const CLI::App& app, const std::string& shell) {
  if (shell != "bash" && shell != "zsh")
    throw ModelError(
        fmt::format("completion for '{}'{}", shell, suggestion(shell, {"bash", "zsh"})));
  return fmt::format(fmt::runtime(shell == "bash" ? bash_frame : zsh_frame),
                     fmt::arg("formulations", formulation_names()),
                     fmt::arg("verbs", verb_names(app)), fmt::arg("branches", branches(app)));
}

}  // namespace yoke::cases

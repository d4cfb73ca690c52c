#include "tool/app.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/version.hpp>

namespace plexway::detail::cli {
namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& tool) {
  return tool.get_subcommands([](const CLI::App* app) { return !app->get_name().empty(); });
}

// Those that --help shows.
std::vector<const CLI::Option*> options_in(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
}

bool is_argument(const CLI::Option& option) { return option.get_positional(); }

// "--out", "-o": all its names, long ones first.
std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  return names;
}

std::string joined(const std::vector<std::string>& words, std::string_view between) {
  std::string text;
  for (const std::string& word : words) text.append(text.empty() ? "" : between).append(word);
  return text;
}

// What it takes, as in FILE; empty for a flag.
std::string value_of(const CLI::Option& option) {
  return option.get_items_expected_max() == 0 ? "" : option.get_type_name();
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

// As roff takes it: nothing is a request, minus signs are those of the keyboard.
std::string roff(std::string_view text) {
  std::string out;
  bool line_starts = true;
  for (const char c : text) {
    if (line_starts && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
    line_starts = c == '\n';
  }
  return out;
}

std::string roff_options(const CLI::App& app) {
  std::string page;
  for (const bool arguments : {true, false})
    for (const CLI::Option* option : options_in(app)) {
      if (is_argument(*option) != arguments) continue;
      const std::string value = value_of(*option);
      page += ".TP\n";
      if (arguments) {
        page += "\\fI" + roff(option->get_name(true)) + "\\fR\n";
      } else {
        std::vector<std::string> names = names_of(*option);
        for (std::string& name : names) name = roff(name);
        page += "\\fB" + joined(names, "\\fR, \\fB") + "\\fR";
        page += value.empty() ? "\n" : " \\fI" + roff(value) + "\\fR\n";
      }
      page += roff(one_line(option->get_description())) + "\n";
    }
  return page;
}

// Words as they stand, line by line.
std::string roff_block(const std::string& text) {
  return text.empty() ? "" : ".PP\n.nf\n" + roff(text) + "\n.fi\n";
}

std::string man_page(const CLI::App& tool) {
  std::string page = ".TH PLEXWAY 1 \"\" \"plexway " + std::string(version_string) +
                     "\" \"User Commands\"\n.SH NAME\nplexway \\- " + roff(tool.get_description()) +
                     "\n.SH SYNOPSIS\n.B plexway\n\\fICOMMAND\\fR [\\fIARGUMENTS\\fR] "
                     "[\\fIOPTIONS\\fR]\n.SH COMMANDS\n";
  for (const CLI::App* command : commands_of(tool))
    page += ".TP\n\\fB" + roff(command->get_name()) + "\\fR\n" +
            roff(one_line(command->get_description())) + "\n";
  page += ".SH OPTIONS\n" + roff_options(tool);
  for (const CLI::App* command : commands_of(tool)) {
    std::string upper = command->get_name();
    for (char& c : upper)
      if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    page += ".SH " + upper + "\n" + roff(one_line(command->get_description())) + "\n" +
            roff_options(*command) + roff_block(command->get_footer());
  }
  page += ".SH NOTES\n" + roff_block(tool.get_footer()) + ".SH EXIT STATUS\n";
  for (const ExitCodeMeaning& one : exit_codes)
    page += ".TP\n\\fB" + std::to_string(one.code) + "\\fR\n" + roff(one.meaning) + "\n";
  page +=
      ".SH ENVIRONMENT\n.TP\n\\fBPLEXWAY_HELPERS\\fR\nthe folder with plexway\\-tetgen and "
      "plexway\\-openvdb, where they are not where they were installed\n";
  return page;
}

std::vector<std::string> flags_of(const CLI::App& app) {
  std::vector<std::string> flags;
  for (const CLI::Option* option : options_in(app))
    if (!is_argument(*option))
      for (const std::string& name : names_of(*option)) flags.push_back(name);
  return flags;
}

std::vector<std::string> command_names(const CLI::App& tool) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands_of(tool)) names.push_back(command->get_name());
  return names;
}

std::string bash_completion(const CLI::App& tool) {
  std::string script =
      "# Completions of plexway for bash, made from its options.\n"
      "_plexway() {\n"
      "  local word=\"${COMP_WORDS[COMP_CWORD]}\" words=\"\"\n"
      "  COMPREPLY=()\n"
      "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
      "    words=\"" +
      joined(command_names(tool), " ") + " " + joined(flags_of(tool), " ") +
      "\"\n"
      "  elif [ \"${word#-}\" != \"$word\" ]; then\n"
      "    case \"${COMP_WORDS[1]}\" in\n";
  for (const CLI::App* command : commands_of(tool))
    script +=
        "      " + command->get_name() + ") words=\"" + joined(flags_of(*command), " ") + "\" ;;\n";
  return script +
         "    esac\n"
         "  fi\n"
         "  [ -n \"$words\" ] && COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
         "}\n"
         "complete -o default -F _plexway plexway\n";
}

// Between single quotes of a shell, and without what zsh's lists of options give a meaning.
std::string quoted(std::string text, std::string_view escaped = "") {
  std::string out;
  for (const char c : one_line(std::move(text))) {
    if (c == '\'')
      out += "'\\''";
    else if (escaped.find(c) != escaped.npos)
      out.append("\\").push_back(c);
    else
      out += c;
  }
  return out;
}

std::string zsh_completion(const CLI::App& tool) {
  std::string script =
      "#compdef plexway\n"
      "# Completions of plexway for zsh, made from its options.\n"
      "if (( CURRENT == 2 )); then\n"
      "  local -a commands=(\n";
  for (const CLI::App* command : commands_of(tool))
    script +=
        "    '" + command->get_name() + ":" + quoted(command->get_description(), ":\\") + "'\n";
  script +=
      "  )\n"
      "  _describe command commands\n"
      "  return\n"
      "fi\n"
      "local command=$words[2]\n"
      "shift words\n"
      "(( CURRENT-- ))\n"
      "case $command in\n";
  for (const CLI::App* command : commands_of(tool)) {
    script += "  " + command->get_name() + ")\n    _arguments '*:file:_files'";
    for (const CLI::Option* option : options_in(*command)) {
      if (is_argument(*option)) continue;
      const std::string value = value_of(*option);
      for (const std::string& name : names_of(*option)) {
        script += " \\\n      '*" + name + "[" + quoted(option->get_description(), "[]\\:") + "]";
        if (!value.empty()) script += ":" + quoted(value, ":\\") + ":_files";
        script += "'";
      }
    }
    script += "\n    ;;\n";
  }
  return script + "esac\n";
}

std::string fish_completion(const CLI::App& tool) {
  std::string script = "# Completions of plexway for fish, made from its options.\n";
  for (const CLI::App* command : commands_of(tool))
    script += "complete -c plexway -n __fish_use_subcommand -a " + command->get_name() + " -d '" +
              quoted(command->get_description()) + "'\n";
  for (const CLI::App* command : commands_of(tool))
    for (const CLI::Option* option : options_in(*command)) {
      if (is_argument(*option)) continue;
      script += "complete -c plexway -n '__fish_seen_subcommand_from " + command->get_name() + "'";
      for (const std::string& name : option->get_lnames()) script += " -l " + name;
      for (const std::string& name : option->get_snames()) script += " -s " + name;
      if (!value_of(*option).empty()) script += " -r";
      script += " -d '" + quoted(option->get_description()) + "'\n";
    }
  return script;
}

}  // namespace

std::string help_page(const CLI::App& tool, std::string_view kind) {
  if (kind == "man") return man_page(tool);
  if (kind == "bash") return bash_completion(tool);
  if (kind == "zsh") return zsh_completion(tool);
  if (kind == "fish") return fish_completion(tool);
  throw UsageError("--help-page " + std::string(kind) + ": choose one of man, bash, zsh, fish");
}

namespace {

constexpr std::size_t columns = 80, most_options = 12, examples = 3;

// Options that most need, the first ones first; a command has some of them.
constexpr std::array most_needed = {
    "source", "from",       "to",    "count",      "radius",        "sources", "truth",
    "out",    "picture",    "cells", "dual",       "accuracy",      "mask",    "metric",
    "as",     "repair",     "what",  "checkpoint", "resume",        "json",    "quiet",
    "astar",  "max-volume", "voxel", "precision",  "triangulation", "html",    "executor"};

// So much of it as fits, in whole words.
std::string cut(std::string text, std::size_t room) {
  text = text.substr(0, text.find('\n'));
  if (text.size() <= room) return text;
  text.resize(text.rfind(' ', room - 3));
  while (text.ends_with(',') || text.ends_with(':')) text.pop_back();
  return text + "...";
}

std::string row(const std::string& name, const std::string& text) {
  constexpr std::size_t gap = 26;
  const std::string start =
      "  " + name + std::string(name.size() + 3 < gap ? gap - name.size() - 2 : 1, ' ');
  return start + cut(text, columns - start.size()) + "\n";
}

std::string name_of(const CLI::Option& option) {
  std::string name;
  for (const std::string& one : option.get_snames()) name += "-" + one + ", ";
  name += "--" + option.get_lnames().front();
  return option.get_items_expected_max() == 0 ? name : name + " " + option.get_type_name();
}

std::vector<std::string> examples_of(const CLI::App& app) {
  std::vector<std::string> found;
  std::istringstream footer(app.get_footer());
  for (std::string line; std::getline(footer, line) && found.size() < examples;)
    if (line.starts_with("  plexway ") && line.size() <= columns) found.push_back(line);
  return found;
}

}  // namespace

std::string short_help(const CLI::App& app) {
  const bool is_tool = app.get_parent() == nullptr;
  const std::string name = is_tool ? "plexway" : "plexway " + app.get_name();
  std::string usage = "Usage: " + name;
  for (const CLI::Option* option : app.get_options())
    if (option->get_positional())
      usage += option->get_required() ? " " + option->get_name(true)
                                      : " [" + option->get_name(true) + "...]";
  std::string text = cut(app.get_description(), columns) + "\n" + usage +
                     (is_tool ? " COMMAND ..." : " [OPTIONS]") + "\n\n";
  if (is_tool)
    for (const CLI::App* command : app.get_subcommands(nullptr))
      text += row(command->get_name(), command->get_description());
  std::size_t shown = 0;
  for (const char* wanted : most_needed) {
    const CLI::Option* option = app.get_option_no_throw("--" + std::string(wanted));
    if (option == nullptr || shown == most_options) continue;
    text += row(name_of(*option), option->get_description());
    ++shown;
  }
  text += "\nExamples:\n";
  for (const std::string& example : examples_of(app)) text += example + "\n";
  return text + "\n" +
         (is_tool ? "'plexway COMMAND -h' is a command's summary, '--help' all of it."
                  : "'" + name + " --help' has all options.") +
         "\n";
}

}  // namespace plexway::detail::cli

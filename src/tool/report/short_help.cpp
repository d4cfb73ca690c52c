#include "tool/report/short_help.hpp"

#include <CLI/CLI.hpp>
#include <array>
#include <sstream>
#include <string_view>
#include <vector>

namespace plexway::cli {
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

}  // namespace plexway::cli

#include "tool/app.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/version.hpp>

#include "io/file_bytes.hpp"
#include "io/names.hpp"
#include "shape/info/solve_words.hpp"
#include "tool/report/console.hpp"

namespace plexway::detail::cli {
namespace {

std::string version_text() {
  std::string executors;
  for (const std::string_view name : built_executors()) executors.append(" ").append(name);
  std::string providers;
#ifdef PLEXWAY_HAS_BOOST_GRAPH
  providers += " boost_graph";
#endif
  std::string licence = "MIT";
#ifdef PLEXWAY_HAS_TETGEN
  providers += " tetgen";
  licence += "; the program plexway-tetgen, which fills surfaces, links TetGen 1.5 (AGPL)";
#endif
#ifdef PLEXWAY_HAS_FLANN
  providers += " flann";
#endif
#ifdef PLEXWAY_HAS_PCL
  providers += " pcl";
#endif
#ifdef PLEXWAY_HAS_OPENVDB
  providers += " openvdb";
#endif
#ifdef PLEXWAY_HAS_HDF5
  providers += " hdf5";
#endif
  return std::string("plexway ") + version_string + "\nprecision  float double\nexecutors " +
         executors + "\nproviders " + (providers.empty() ? " none" : providers) + "\nlicence    " +
         licence + "\n";
}

std::string exit_codes_in_short() {
  std::string text;
  for (const ExitCodeMeaning& one : exit_codes)
    text.append(text.empty() ? "Exit codes: " : ", ")
        .append(std::to_string(one.code) + " ")
        .append(one.brief);
  return text + ".";
}

// The command that was being parsed when something went wrong.
const CLI::App& innermost(const CLI::App& tool) {
  const auto chosen = tool.get_subcommands();
  return chosen.empty() ? tool : *chosen.front();
}

// What was probably meant: an option for what begins as one, else a command.
std::string hint(const CLI::App& app, const std::string& typed) {
  // Commands that know the same by another name.
  for (const auto& [known, words] :
       {std::pair<std::string, std::vector<std::string>>{"--from", {"-s", "--source", "--sources"}},
        {"--source", {"-f", "--from", "--start"}}})
    if (app.get_option_no_throw(known) != nullptr &&
        std::find(words.begin(), words.end(), typed) != words.end())
      return "; did you mean '" + known + "'?";
  std::vector<std::string> words;
  if (typed.starts_with("-")) {
    for (const CLI::Option* option : app.get_options())
      for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
  } else {
    for (const CLI::App* command : app.get_subcommands({})) words.push_back(command->get_name());
  }
  const std::vector<std::string_view> known(words.begin(), words.end());
  return io::did_you_mean(typed.substr(0, typed.find('=')), known);
}

std::string usage_complaint(const CLI::App& tool, const CLI::ParseError& error) {
  const CLI::App& app = innermost(tool);
  const bool in_tool = &app == &tool;
  std::string message = error.what();
  // A word that nobody knows is the likelier slip than the option that is missed because of it.
  if (const auto unknown = tool.remaining(true); !unknown.empty()) {
    const std::string& first = unknown.front();
    const char* const what = first.substr(0, 1) == "-" ? "unknown option '"
                             : in_tool                 ? "unknown command '"
                                                       : "unexpected argument '";
    message = what + first + "'";
    message += hint(app, first);
  }
  const std::string name = in_tool ? "plexway" : "plexway " + app.get_name();
  return message + (message.ends_with('?') ? " try '" : "; try '") + name + " --help'";
}

void parse_and_run(int argc, const char* const* argv, const Among* among) {
  Action action;
  CLI::App tool("Geodesic distance by virtual source propagation", "plexway");
  bool version = false;
  tool.add_flag("--version", version, "version, precisions, executors, providers and licence");
  std::string page;
  tool.add_option("--help-page", page,
                  "the manual page (man), or completions for bash, zsh or fish")
      ->type_name("KIND");
  tool.require_subcommand(0, 1);
  tool.footer(
      "'plexway COMMAND --help' tells more about a command.\n\n"
      "Examples:\n"
      "  plexway distance knot.ply --source vertex:0 --out distance.ply\n"
      "  plexway path knot.ply --from vertex:0 --to vertex:99 --out path.obj\n"
      "  plexway info knot.ply\n"
      "  plexway tetrahedralize organ.off --out organ.vtu --max-volume 1e-3\n"
      "  plexway convert broken.stl clean.ply --repair\n"
      "  plexway bench bunny.obj --source vertex:3160 --truth bunny.v3160.txt\n\n" +
      exit_codes_in_short());
  add_distance_command(tool, action, among);
  add_info_command(tool, action);
  add_bench_command(tool, action);
  add_path_command(tool, action);
  add_tetrahedralize_command(tool, action);
  add_convert_command(tool, action);
  add_prepare_command(tool, action);
  add_poisson_command(tool, action);
  add_cvt_command(tool, action);
  add_farthest_command(tool, action);
  add_pairs_command(tool, action, among);
  add_tune_command(tool, action);

  try {
    tool.parse(argc, argv);
  } catch (const CLI::Success&) {  // help was requested
    if (among != nullptr && !among->ranks.leads()) return;
    const bool in_short = std::find(argv, argv + argc, std::string_view("-h")) != argv + argc;
    write_output(in_short ? short_help(innermost(tool)) : tool.help());
    flush_output();
    return;
  } catch (const CLI::ParseError& error) {
    throw UsageError(usage_complaint(tool, error));
  }
  if (version || !page.empty()) {
    if (among != nullptr && !among->ranks.leads()) return;
    write_output(version ? version_text() : help_page(tool, page));
    flush_output();
    return;
  }
  if (among != nullptr && !tool.got_subcommand("pairs") && !tool.got_subcommand("distance"))
    throw UsageError(
        "ranks share the rows of 'pairs --sources' and the pieces of 'distance'; all else is for "
        "plexway alone");
  if (!action) throw UsageError("no command given; try 'plexway --help'");
  action();
}

}  // namespace

int run(int argc, const char* const* argv, const Among* among) noexcept {
  ignore_signals_of_writing();
  leave_nothing_behind();
  io::FileBytes::keep_streams();
  const auto ended = [&](ExitCode code, const char* message = nullptr) -> int {
    if (among != nullptr) return among->ended(code, message);
    if (message != nullptr) say_error(message);
    return code;
  };
  try {
    parse_and_run(argc, argv, among);
    return ended(exit_ok);
  } catch (const OutputClosed&) {
    return ended(exit_ok);
  } catch (const UsageError& error) {
    return ended(exit_usage, error.what());
  } catch (const InputError& error) {
    return ended(exit_bad_input, error.what());
  } catch (const NotBuiltError& error) {
    return ended(exit_not_built, error.what());
  } catch (const NothingReached& error) {
    return ended(exit_nothing_reached, error.what());
  } catch (const EndlessError& error) {
    return ended(exit_endless, error.what());
  } catch (const std::bad_alloc&) {
    return ended(exit_failure,
                 "out of memory: the input does not fit into what this process may use");
  } catch (const std::length_error&) {
    return ended(exit_failure, "out of memory: an array would be larger than any can be");
  } catch (const std::exception& error) {
    return ended(exit_failure, error.what());
  } catch (...) {
    return ended(exit_failure, "an unknown failure");
  }
}

}  // namespace plexway::detail::cli

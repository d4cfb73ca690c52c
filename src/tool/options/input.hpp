#pragma once

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/shape/read_options.hpp>
#include <plexway/shape/shape.hpp>

#include "tool/report/console.hpp"

namespace plexway::detail::cli {

/// Adds the options to a command, in a group of their own.
void add_cloud_options(CLI::App& command, CloudPreparation& options);

/// Adds options to a command, in a group of their own unless it has no name.
class OptionGroup {
 public:
  explicit OptionGroup(CLI::App& command, std::string name = "")
      : command_(command), name_(std::move(name)) {}

  /// One that takes what `type` stands for.
  template <class Value>
  CLI::Option* operator()(const std::string& names, Value& value, const char* type,
                          const std::string& help) const {
    return grouped(command_.add_option(names, value, help))->type_name(type);
  }
  CLI::Option* flag(const std::string& names, bool& value, const std::string& help) const {
    return grouped(command_.add_flag(names, value, help));
  }

 private:
  CLI::Option* grouped(CLI::Option* option) const {
    return name_.empty() ? option : option->group(name_);
  }

  CLI::App& command_;
  std::string name_;
};

/// Adds an option that names an output; "-" becomes "USUAL:-", standard output in that format.
void add_output(CLI::App& command, const std::string& name, std::string& out,
                const std::string& help, const char* usual);

/// What a name stands for that was typed. Throws UsageError for one that is none of them.
template <class Value>
Value choose(std::string_view option, const std::string& typed,
             std::initializer_list<std::pair<std::string_view, Value>> choices) {
  std::string names;
  for (const auto& [name, value] : choices) {
    if (typed == name) return value;
    names.append(names.empty() ? "" : ", ").append(name);
  }
  throw UsageError(std::string(option) + " '" + typed + "': choose one of " + names);
}

/// How to fill a surface with tetrahedra, as typed.
struct FillArguments : FillOptions {
  std::vector<std::string> hole_texts;
  VolumeOptions volume;

  /// Whether any of them but `volume` differs from its default.
  [[nodiscard]] bool given() const { return FillOptions::given() || !hole_texts.empty(); }
};

/// Adds the options to a command, in a group of their own.
void add_fill_options(CLI::App& command, FillArguments& options);

/// The options with the holes' points. Throws UsageError for a value out of range.
[[nodiscard]] FillOptions filling(const FillArguments& arguments);

/// Adds the options to a command, in a group of their own.
void add_volume_options(CLI::App& command, VolumeOptions& options);

/// What a user hands to the tool.
using Domain = AnyShape;

/// What the commands have in common that read a domain, as typed: how to read it, and what to tell.
struct InputCommand {
  std::string input, as;
  std::vector<std::string> more;  ///< further files than INPUT, where the command takes them
  std::optional<double> weld, merge;
  FillArguments fill;
  CloudPreparation cloud;
  bool json = false, quiet = false, strict = false, verbose = false;
};

/// What INPUT may be, for the help of the commands.
[[nodiscard]] std::string input_help();
inline constexpr const char* as_help =
    "what to take it as: surface, solid (fills a surface with tetrahedra),\n"
    "wireframe (the edges alone), cloud (the vertices of a surface alone) or mixed (all\n"
    "lines, triangles and tetrahedra of a .msh, .vtu or .vtk); default: what the file holds";
inline constexpr const char* usual_quiet = "no summary, notes or progress; errors stay";

///@{
/// Adds INPUT; INPUT, MORE and --weld; --json and --quiet; or these and all that says how to read a
/// domain: --as, and groups about filling and clouds; --verbose, of commands that solve; --merge
/// alone.
void add_input(CLI::App& app, InputCommand& command, const std::string& help = input_help());
void add_inputs(CLI::App& app, InputCommand& command);
void add_report_options(CLI::App& app, InputCommand& command, const char* quiet = usual_quiet);
void add_input_options(CLI::App& app, InputCommand& command, const char* quiet = usual_quiet);
void add_verbose_option(CLI::App& app, InputCommand& command);
void add_merge_option(CLI::App& app, InputCommand& command);
///@}

/// What the library tells while it works, on the line; `progress` must stay.
[[nodiscard]] ReadProgress read_progress(ProgressLine& progress);

/// How INPUT is to be read. Throws UsageError for a kind that does not exist.
[[nodiscard]] ReadOptions read_options(const InputCommand& command, ProgressLine& progress);

/// Reads INPUT as AnyShape::read does. Throws UsageError, too, for a kind that does not exist.
Domain load_domain(const InputCommand& command, ProgressLine& progress);

}  // namespace plexway::detail::cli

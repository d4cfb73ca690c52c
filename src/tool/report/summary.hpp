#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/shape/warnings.hpp>
#include <plexway/solve/distance_field.hpp>

#include "io/names.hpp"
#include "shape/info/report.hpp"
#include "shape/info/solve_words.hpp"
#include "shape/stopwatch.hpp"
#include "tool/options/input.hpp"

namespace plexway::detail::cli {
using io::check_output_name;
using io::check_output_place;
using io::check_outputs_differ;
using io::on_standard_output;

/// What the user should know of a command's result though nothing failed: "notes" of its summary,
/// and a line each.
class Notes {
 public:
  void add(std::string text) { texts_.push_back(std::move(text)); }
  void add(std::vector<std::string> texts) {
    for (std::string& text : texts) add(std::move(text));
  }
  void add(const std::vector<Warning>& warnings) {
    for (const Warning& warning : warnings) add(warning.text);
  }
  void add(const Notes& more) { add(more.texts_); }
  /// The array `notes`, empty where there are none.
  void tell(Json& json) const { json["notes"] = texts_; }
  /// On standard error; nothing where `quiet`.
  void say(bool quiet) const;

 private:
  std::vector<std::string> texts_;
};

/// What a command says of its result: one JSON object, and a table for people.
class Summary {
 public:
  Json json;
  Table table;

  /// Starts with the input and the kind of domain.
  Summary(const std::string& input, std::string_view kind);
  /// A value, and its row.
  template <class Value>
  void add(const std::string& key, const Value& value, const std::string& text) {
    json[key] = value;
    table.add(key, text);
  }
  /// A part of the time that the command took: of the object `seconds`, and of the last row.
  void took(const std::string& part, double seconds);
  /// Those of reading the domain.
  void took_loading(const Domain& domain);
  /// More for the row "time", for people.
  void time_note(const std::string& text) { time_ += text; }
  /// Adds the time, the files that were written and the notes, and prints: on standard output, but
  /// on standard error where one of the results went there; JSON, the table, or nothing where
  /// `quiet`. The notes are still to be said. Throws as write_output.
  void print(const InputCommand& command, const std::vector<std::string>& files,
             const Notes& notes = {});

 private:
  std::string time_;
};

/// "162 vertices, 320 triangles": how large a domain is.
[[nodiscard]] std::string size_text(const Domain& domain, std::size_t simplices);

/// What came of a solve, as 'plexway distance' tells it, whoever had the domain.
struct DistanceReport {
  std::size_t vertices = 0, reached = 0;
  Index farthest = none;
  double max_distance = 0;
  std::optional<double> mean_distance;
  PropagateStatistics statistics;
  std::size_t ranks = 0;  ///< 0: a process alone
  RankCounts counts = {};
  bool of_surface = false;  ///< where vertices may be raised and lowered

  /// How far it got, the work (in the table if it is verbose), and of ranks what they sent.
  void add_to(Summary& summary, bool verbose) const;
};

}  // namespace plexway::detail::cli

#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "shape/words.hpp"

namespace plexway::detail {

/// Keeps its keys in the order they were put in.
using Json = nlohmann::ordered_json;

/// Lines of a label and what it stands for, labels aligned.
class Table {
 public:
  void add(std::string label, std::string text);
  /// All lines of another one.
  void add(const Table& other);
  [[nodiscard]] std::string text() const;

 private:
  std::vector<std::pair<std::string, std::string>> lines_;
};

/// A line "written" for each file, but those without a name and standard output.
void add_written(Table& table, const std::vector<std::string>& files);

/// The object as the tool prints it: indented, with a line end. Bytes that are not UTF-8, as a file
/// name may hold, are replaced.
std::string json_text(const Json& object);

/// Null for what JSON cannot hold.
Json json_number(double value);

}  // namespace plexway::detail

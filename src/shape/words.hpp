#pragma once

#include <array>
#include <cstddef>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plexway::detail {

/// "triangle" for "triangles"; knows "vertices" and "tetrahedra" too.
std::string singular(std::string_view plural);
/// "1 triangle", "2 triangles"; the plural is given.
std::string counted(std::size_t count, std::string_view plural);
/// Four significant digits, for people: "0.01234", "1.235e-07", "inf".
std::string short_number(double value);
/// "1.23 s", "4.5 ms".
std::string short_time(double seconds);

/// Seventeen digits, from which the same number is read.
inline std::string exact_number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.17g", value);
  return text.data();
}

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

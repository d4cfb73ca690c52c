#include "shape/arguments/point_list.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include <plexway/error.hpp>

#include "io/file_bytes.hpp"
#include "io/number_rows.hpp"

namespace plexway {
namespace {

std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words(1);
  for (const char c : line) {
    if (c == ',')
      words.emplace_back();
    else if (c != '\r' && c != ' ')
      words.back() += c;
  }
  return words;
}

[[noreturn]] void fail(const std::string& file, std::size_t line, const std::string& cause) {
  throw InputError(file + ":" + std::to_string(line) + ": " + cause);
}

// A table as `farthest` writes it: x,y,z,vertex,simplex,b0,b1,b2,b3 and what else there is.
std::vector<PointSource> read_table(const std::string& file, std::string_view text,
                                    const AnyShape& domain) {
  std::vector<PointSource> points;
  std::array<std::size_t, 6> column{};
  std::size_t line = 0, width = 0;
  while (!text.empty()) {
    const std::string_view row = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(row.size() + 1, text.size()));
    ++line;
    const auto words = words_of(row);
    if (line == 1) {
      width = words.size();
      constexpr std::array<std::string_view, 6> names = {"vertex", "simplex", "b0",
                                                         "b1",     "b2",      "b3"};
      for (std::size_t i = 0; i < names.size(); ++i) {
        const auto found = std::find(words.begin(), words.end(), names[i]);
        if (found == words.end())
          fail(file, 1,
               "no column " + std::string(names[i]) +
                   ": give a vertex a line, or a table of points as 'plexway farthest' writes it");
        column[i] = static_cast<std::size_t>(found - words.begin());
      }
      continue;
    }
    if (words.size() == 1 && words[0].empty()) continue;
    if (words.size() != width) fail(file, line, "the header has another number of columns");
    std::array<double, 6> number{};
    for (std::size_t i = 0; i < number.size(); ++i) {
      const std::string& word = words[column[i]];
      const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), number[i]);
      if (error != std::errc{} || rest != word.data() + word.size() || !std::isfinite(number[i]))
        fail(file, line, "not a number: '" + word.substr(0, 32) + "'");
    }
    const bool at_vertex = number[0] != -1;
    const double which = at_vertex ? number[0] : number[1];
    const std::size_t there = at_vertex ? domain.vertices() : domain.simplices();
    if (!(which >= 0) || which != std::floor(which) || !(which < static_cast<double>(there)))
      fail(file, line,
           std::string(at_vertex ? "vertex " : "simplex ") + words[column[at_vertex ? 0 : 1]] +
               " is out of range: there are " + std::to_string(there));
    PointSource point;
    (at_vertex ? point.vertex : point.simplex) = static_cast<Index>(which);
    if (!at_vertex) point.barycentric = {number[2], number[3], number[4], number[5]};
    points.push_back(point);
  }
  if (points.empty()) throw InputError(file + ": no point in it");
  return points;
}

}  // namespace

std::vector<PointSource> read_point_list(const std::string& file, const AnyShape& domain) {
  const io::FileBytes bytes(file);
  const std::string_view text = bytes.view();
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != text.npos &&
      ((text[first] >= 'a' && text[first] <= 'z') || (text[first] >= 'A' && text[first] <= 'Z')))
    return read_table(file, text, domain);
  std::vector<PointSource> points;
  for (const io::NumberRow& row : io::read_number_rows(file, 1, 1, "a vertex (0-based) a line"))
    points.push_back(PointSource::at(io::vertex_in(file, row, 0, domain.vertices())));
  return points;
}

std::vector<Index> read_vertex_list(const std::string& file, const AnyShape& domain,
                                    const std::string& role) {
  std::vector<Index> vertices;
  for (const PointSource& point : read_point_list(file, domain)) {
    if (point.vertex == none)
      throw InputError(file + ": a point inside a simplex: " + role + " must be vertices");
    vertices.push_back(point.vertex);
  }
  return vertices;
}

}  // namespace plexway

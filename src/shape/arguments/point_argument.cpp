#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include <plexway/error.hpp>
#include <plexway/shape/support.hpp>

#include "io/file_bytes.hpp"
#include "io/number_rows.hpp"
#include "shape/arguments/arguments.hpp"
#include "shape/warnings/survey.hpp"
#include "shape/words.hpp"

namespace plexway::detail {
namespace {

constexpr std::string_view vertex_prefix = "vertex:";
constexpr std::string_view point_prefix = "point:";

[[noreturn]] void malformed(const std::string& text, const std::string& role) {
  throw UsageError("--" + role + " '" + text + "': " + meant_place(text) +
                   "write vertex:ID (0-based) or point:X,Y,Z");
}

// Any integer: one that does not fit is out of range in every file, and not a slip of the syntax.
std::optional<Index> parse_id(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  if (text.empty() || text.find_first_not_of("0123456789") != text.npos) return std::nullopt;
  Index id = none;
  const char* const end = text.data() + text.size();
  return std::from_chars(text.data(), end, id).ec == std::errc{} ? id : none;
}

}  // namespace

std::string meant_place(std::string_view text) {
  const bool number = !text.empty() && text.find_first_not_of("0123456789") == text.npos;
  if (!number && !parse_point(text)) return "";
  return std::string("did you mean '").append(number ? vertex_prefix : point_prefix) +
         std::string(text) + "'? ";
}

std::optional<double> number_of(std::string_view text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || rest != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::vector<double>> numbers_of(std::string_view text, std::size_t count) {
  std::vector<double> numbers;
  for (;;) {
    const std::size_t comma = text.find(',');
    const auto value = number_of(text.substr(0, comma));
    if (!value) return std::nullopt;
    numbers.push_back(*value);
    if (comma == text.npos) break;
    text.remove_prefix(comma + 1);
  }
  if (count > 0 && numbers.size() != count) return std::nullopt;
  return numbers;
}

std::optional<std::array<double, 3>> parse_point(std::string_view text) {
  const auto numbers = numbers_of(text, 3);
  if (!numbers) return std::nullopt;
  return std::array{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

SourceArgument parse_source(const std::string& text, const std::string& role) {
  const std::string_view view = text;
  if (view.starts_with(vertex_prefix)) {
    const std::string_view number = view.substr(vertex_prefix.size());
    const auto id = parse_id(number);
    if (!id) malformed(text, role);
    return {text, number.front() == '-' ? none : *id, role};
  }
  if (view.starts_with(point_prefix)) {
    const auto point = parse_point(view.substr(point_prefix.size()));
    if (!point) malformed(text, role);
    return {text, *point, role};
  }
  malformed(text, role);
}

std::vector<SourceArgument> parse_sources(const std::vector<std::string>& texts,
                                          const std::string& role) {
  std::vector<SourceArgument> arguments;
  for (const std::string& text : texts) arguments.push_back(parse_source(text, role));
  return arguments;
}

PointSource locate_source(const AnyShape& domain, const SourceArgument& argument) {
  if (const auto* point = std::get_if<1>(&argument.where)) {
    require_input(domain.file().string() + ": " + argument.role + " " + argument.text,
                  support(Purpose::places, domain));
    return domain.closest(*point);
  }
  const Index vertex = std::get<0>(argument.where);
  if (vertex >= domain.vertices()) {
    throw InputError(domain.file().string() + ": " + argument.role + " " + argument.text +
                     " is out of range: the vertices are 0 to " +
                     std::to_string(domain.vertices() - 1));
  }
  return PointSource::at(vertex);
}

std::vector<PointSource> locate_sources(const AnyShape& domain,
                                        const std::vector<SourceArgument>& arguments) {
  std::vector<PointSource> sources;
  for (const SourceArgument& argument : arguments)
    sources.push_back(locate_source(domain, argument));
  return sources;
}

std::optional<double> distance_from(const AnyShape& domain, const SourceArgument& argument,
                                    const PointSource& source) {
  const auto* point = std::get_if<1>(&argument.where);
  if (point == nullptr) return std::nullopt;
  const auto at = domain.position(source);
  return std::hypot(at[0] - (*point)[0], at[1] - (*point)[1], at[2] - (*point)[2]);
}

std::vector<std::string> far_notes(const AnyShape& domain,
                                   const std::vector<SourceArgument>& arguments,
                                   std::span<const PointSource> found) {
  std::vector<std::string> notes;
  std::optional<double> diagonal;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto away = distance_from(domain, arguments[i], found[i]);
    if (!away) continue;
    if (!diagonal) {
      const Box<3> box = bounding_box(domain.positions());
      diagonal =
          std::hypot(box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]);
    }
    if (*away > 0.01 * *diagonal)
      notes.push_back("--" + arguments[i].role + " " + arguments[i].text + " is " +
                      short_number(*away) + " from the " + std::string(kind_noun(domain.kind())) +
                      " (" + short_number(*away / *diagonal) +
                      " of its diagonal): the closest point was taken");
  }
  return notes;
}

std::string describe_source(const AnyShape& domain, const SourceArgument& argument,
                            const PointSource& source) {
  const auto off = distance_from(domain, argument, source);
  if (!off) return "vertex " + std::to_string(source.vertex);
  const std::string place = source.vertex != none ? "vertex " + std::to_string(source.vertex)
                                                  : singular(domain.simplex_name()) + " " +
                                                        std::to_string(source.simplex);
  return argument.text + " (" + place + ", " + short_number(*off) + " away)";
}

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
          io::fail_at(
              file, 1,
              "no column " + std::string(names[i]) +
                  ": give a vertex a line, or a table of points as 'plexway farthest' writes it");
        column[i] = static_cast<std::size_t>(found - words.begin());
      }
      continue;
    }
    if (words.size() == 1 && words[0].empty()) continue;
    if (words.size() != width) io::fail_at(file, line, "the header has another number of columns");
    std::array<double, 6> number{};
    for (std::size_t i = 0; i < number.size(); ++i) {
      const std::string& word = words[column[i]];
      const auto value = number_of(word);
      if (!value) io::fail_at(file, line, "not a number: '" + word.substr(0, 32) + "'");
      number[i] = *value;
    }
    const bool at_vertex = number[0] != -1;
    const double which = at_vertex ? number[0] : number[1];
    const std::size_t there = at_vertex ? domain.vertices() : domain.simplices();
    if (!(which >= 0) || which != std::floor(which) || !(which < static_cast<double>(there)))
      io::fail_at(file, line,
                  std::string(at_vertex ? "vertex " : "simplex ") +
                      words[column[at_vertex ? 0 : 1]] + " is out of range: there are " +
                      std::to_string(there));
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

}  // namespace plexway::detail

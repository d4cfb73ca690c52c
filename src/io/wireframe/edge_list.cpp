// Edges as plain text, one a line. docs/reference/formats.md has the rules.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "io/readers.hpp"
#include "io/surface/polygons.hpp"
#include "io/text_scanner.hpp"

namespace plexway::io {
namespace {

class EdgeListReader {
 public:
  EdgeListReader(std::string_view text, std::string_view name) : in_(text, name), name_(name) {
    // Vertices take memory later on. A file of a few lines must not ask for gigabytes.
    most_ = most_elements(text.size());
  }

  Edges read() && {
    while (in_.to_content()) {
      if (*in_.position() == '%') {
        // a comment
      } else if (*in_.position() == 'v') {
        read_header();
      } else {
        read_edge();
      }
      in_.next_line();
    }
    if (wires_.edges.empty() && !promised_)
      throw InputError(std::string(name_) + ": has no edges; a wireframe needs at least one");
    if (wires_.lengths.empty()) wires_.lengths.assign(wires_.edges.size(), 1.0);
    wires_.vertices = static_cast<std::size_t>(promised_.value_or(named_));
    return std::move(wires_);
  }

 private:
  void read_header() {
    const std::string_view word = in_.field();
    if (word != "vertices")
      in_.fail("this is neither an edge \"a b [length]\" nor \"vertices N\": it starts with " +
               quote(word));
    if (promised_ || !wires_.edges.empty())
      in_.fail("\"vertices N\" may stand only once, before all edges");
    const std::int64_t count = in_.integer("the number of vertices");
    if (count < 0) in_.fail("the number of vertices is negative: " + std::to_string(count));
    if (static_cast<std::uint64_t>(count) > most_) fail_too_many(count);
    promised_ = static_cast<std::uint64_t>(count);
    if (in_.to_field()) in_.fail("after the number of vertices there is " + quote(in_.field()));
  }

  void read_edge() {
    const std::uint32_t a = vertex("the edge's first vertex"), b = vertex("its second vertex");
    const std::size_t number = wires_.edges.size();
    const auto who = [&] { return "edge " + std::to_string(number); };
    const bool has_length = in_.to_field();
    if (number > 0 && has_length == wires_.lengths.empty())
      in_.fail(has_length ? who() + " has a length, but those before it have none"
                          : who() + " has no length, but those before it have one");
    wires_.edges.push_back({a, b});
    if (!has_length) return;
    const double length = in_.number("the length");
    if (length < 0) in_.fail(who() + ": its length is negative");
    wires_.lengths.push_back(length);
    if (in_.to_field())
      in_.fail(who() + " is followed by " + quote(in_.field()) +
               "; a line is \"a b\" or \"a b length\"");
  }

  std::uint32_t vertex(std::string_view what) {
    const std::int64_t index = in_.integer(what);
    const auto named = [&] {
      return "edge " + std::to_string(wires_.edges.size()) + " names vertex " +
             std::to_string(index);
    };
    if (index < 0) in_.fail(named() + "; vertices count from 0");
    const auto v = static_cast<std::uint64_t>(index);
    if (promised_ && v >= *promised_)
      in_.fail(named() + ", but the file has " + std::to_string(*promised_) + " vertices");
    if (v >= most_) fail_too_many(index);
    named_ = std::max(named_, v + 1);
    return static_cast<std::uint32_t>(v);
  }

  [[noreturn]] void fail_too_many(std::int64_t number) const {
    in_.fail(std::to_string(number) +
             " is too high for a file this small: number the vertices without gaps");
  }

  TextScanner in_;
  std::string_view name_;
  Edges wires_;
  std::optional<std::uint64_t> promised_;
  std::uint64_t named_ = 0;  ///< one more than the highest index
  std::uint64_t most_ = 0;
};

}  // namespace

Edges parse_edge_list(std::string_view text, std::string_view name) {
  return EdgeListReader(text, name).read();
}

}  // namespace plexway::io

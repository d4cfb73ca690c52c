
#include <string>

#include "io/file_bytes.hpp"
#include "io/readers.hpp"
#include "io/text_scanner.hpp"

namespace plexway::io {
namespace {

class SimplicesReader {
 public:
  SimplicesReader(std::string_view text, std::string_view name)
      : in_(text, name), most_(text.size()) {}

  Simplices read() && {
    heading("dimension");
    const std::int64_t dimension = in_.integer("the dimension");
    if (dimension < 1 || dimension > 4)
      in_.fail("simplices of dimension " + std::to_string(dimension) + ": 1 to 4 are read");
    read_.dimension = static_cast<int>(dimension);
    end_line("the dimension");
    read_vertices();
    read_rows();
    if (in_.to_content()) in_.fail("behind the last simplex there is " + quote(in_.field()));
    return std::move(read_);
  }

 private:
  void heading(std::string_view word) {
    if (!in_.to_content()) in_.fail("the file ends before \"" + std::string(word) + "\"");
    const std::string_view found = in_.field();
    if (found != word) in_.fail("expected \"" + std::string(word) + "\", found " + quote(found));
  }

  void end_line(std::string_view what) {
    if (in_.to_field()) in_.fail("after " + std::string(what) + " there is " + quote(in_.field()));
  }

  // A row takes a byte of the file at least: a mistake must not ask for gigabytes.
  std::size_t count(std::string_view what, std::size_t least) {
    const std::int64_t stated = in_.integer(what);
    if (stated < static_cast<std::int64_t>(least))
      in_.fail(std::string(what) + " is " + std::to_string(stated));
    return static_cast<std::size_t>(stated);
  }

  void row(std::string_view what) {
    if (!in_.to_content()) in_.fail("the file ends before " + std::string(what));
  }

  void read_vertices() {
    heading("vertices");
    read_.vertices = count("the number of vertices", 1);
    read_.axes = in_.to_field() ? count("the number of coordinates", 0) : 0;
    end_line("the number of coordinates");
    const auto dimension = static_cast<std::size_t>(read_.dimension);
    if (read_.axes > 0 && read_.axes < dimension)
      in_.fail("simplices of dimension " + std::to_string(dimension) + " need at least " +
               std::to_string(dimension) + " coordinates a vertex, or none and lengths");
    if (read_.vertices > (read_.axes > 0 ? most_ : most_ * 64 + (std::size_t{1} << 24)))
      in_.fail("the file is too short for " + std::to_string(read_.vertices) + " vertices");
    if (read_.axes > most_)
      in_.fail("the file is too short for " + std::to_string(read_.axes) + " coordinates");
    for (std::size_t v = 0; read_.axes > 0 && v < read_.vertices; ++v) {
      row("vertex " + std::to_string(v));
      for (std::size_t k = 0; k < read_.axes; ++k)
        read_.positions.push_back(in_.number("coordinate " + std::to_string(k)));
      end_line("the coordinates");
    }
  }

  void read_rows() {
    heading("simplices");
    const std::size_t simplices = count("the number of simplices", 1);
    end_line("the number of simplices");
    const auto corners = static_cast<std::size_t>(read_.dimension) + 1;
    for (std::size_t s = 0; s < simplices; ++s) {
      row("simplex " + std::to_string(s));
      for (std::size_t i = 0; i < corners; ++i) {
        const std::int64_t v = in_.integer("a vertex of the simplex");
        if (v < 0 || static_cast<std::uint64_t>(v) >= read_.vertices)
          in_.fail("simplex " + std::to_string(s) + " names vertex " + std::to_string(v) +
                   ", but the vertices are 0 to " + std::to_string(read_.vertices - 1));
        read_.corners.push_back(static_cast<std::uint32_t>(v));
      }
      for (std::size_t e = 0; read_.axes == 0 && e < corners * (corners - 1) / 2; ++e) {
        const double length = in_.number("the length of an edge");
        if (length < 0) in_.fail("simplex " + std::to_string(s) + ": a length is negative");
        read_.lengths.push_back(length);
      }
      end_line("the simplex");
    }
  }

  TextScanner in_;
  std::size_t most_;
  Simplices read_;
};

}  // namespace

Simplices parse_simplices(std::string_view text, std::string_view name) {
  return SimplicesReader(text, name).read();
}

Simplices read_simplices(const std::filesystem::path& file) {
  const OpenedFile opened(file);
  return parse_simplices(opened.bytes(), opened.name());
}

}  // namespace plexway::io

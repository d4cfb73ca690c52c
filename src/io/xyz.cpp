// Points as plain text, one a line. docs/FORMATS.md has the rules.

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include <plexway/io/points.hpp>

#include "surface_checks.hpp"
#include "text_scanner.hpp"

namespace plexway::io {
namespace {

constexpr std::array<std::string_view, 6> column_names = {"coordinate x",    "coordinate y",
                                                          "coordinate z",    "the normal's nx",
                                                          "the normal's ny", "the normal's nz"};

class XyzReader {
 public:
  XyzReader(std::string_view text, std::string_view name) : in_(text, name), name_(name) {}

  Points read() && {
    while (in_.to_content()) {
      if (!comment()) read_line();
      in_.next_line();
    }
    const std::size_t count = points_.positions.size();
    if (promised_ && count < *promised_)
      in_.fail("the file ends after " + std::to_string(count) + " of " +
               std::to_string(*promised_) + " points");
    if (count == 0)
      throw InputError(std::string(name_) + ": has no points; a cloud needs at least one");
    return std::move(points_);
  }

 private:
  bool comment() const {
    const char* at = in_.position();
    return *at == '%' || (*at == '/' && in_.bytes_left() > 1 && at[1] == '/');
  }

  void read_line() {
    if (promised_ && points_.positions.size() == *promised_)
      in_.fail("the file goes on after its " + std::to_string(*promised_) + " points with " +
               quote(in_.field()));
    std::array<double, 6> values{};
    std::size_t columns = 0;
    for (; in_.to_field(); ++columns) {
      if (columns == values.size()) fail_columns("more than 6");
      values[columns] = number(column_names[columns]);
    }
    if (columns == 1 && columns_ == 0 && !promised_) return promise(values[0]);
    if (columns != 3 && columns != 6) fail_columns(std::to_string(columns));
    if (columns_ != 0 && columns != columns_)
      in_.fail(point() + " has " + std::to_string(columns) + " numbers, but those before it have " +
               std::to_string(columns_));
    columns_ = columns;
    if (points_.positions.size() == most_vertices) in_.fail("more points than 32 bits count");
    points_.positions.push_back({values[0], values[1], values[2]});
    if (columns == 6) add_normal({values[3], values[4], values[5]});
  }

  double number(std::string_view what) {
    const char* from = in_.position();
    for (const char* at = from; at != from + in_.bytes_left() && *at > ' '; ++at)
      if (*at == ',' || *at == ';')
        in_.fail("numbers are separated by blanks here, not as in " + quote(in_.field()));
    return in_.number(what);
  }

  void promise(double count) {
    if (count < 0 || count != std::floor(count) || count >= static_cast<double>(most_vertices))
      in_.fail("a first line with one number must say how many points follow");
    const auto points = static_cast<std::uint64_t>(count);
    if (points > (in_.bytes_left() + 1) / 6)  // three digits, two blanks, a line's end
      in_.fail("the first line says " + std::to_string(points) + " points, but only " +
               std::to_string(in_.bytes_left()) + " bytes follow");
    promised_ = points;
    points_.positions.reserve(points);
  }

  void add_normal(const std::array<double, 3>& normal) {
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    if (length != 0 && !(length > 0.5 && length < 2))
      in_.fail(point(1) + " has a normal that is no unit vector; if columns 4 to 6 are something " +
               "else, such as colours, leave them out");
    points_.normals.push_back(normal);
  }

  std::string point(std::size_t back = 0) const {
    return "point " + std::to_string(points_.positions.size() - back);
  }

  [[noreturn]] void fail_columns(const std::string& columns) const {
    in_.fail(point() + " has " + columns + (columns == "1" ? " number" : " numbers") +
             "; a line is \"x y z\" or \"x y z nx ny nz\"");
  }

  TextScanner in_;
  std::string_view name_;
  Points points_;
  std::optional<std::uint64_t> promised_;
  std::size_t columns_ = 0;
};

}  // namespace

Points parse_xyz(std::string_view text, std::string_view name) {
  return XyzReader(text, name).read();
}

}  // namespace plexway::io

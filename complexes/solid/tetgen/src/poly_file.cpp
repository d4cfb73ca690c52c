// TetGen's .poly, .smesh and .node files: numbers in lines, # starts a comment, empty lines do not
// count. A polygon's corners may go on in the next line.

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include <plexway/error.hpp>
#include <plexway/tetgen/piecewise_linear_complex.hpp>

namespace plexway::tetgen {
namespace {

namespace fs = std::filesystem;
using Point = std::array<double, 3>;

constexpr std::array<std::string_view, 2> extensions = {".poly", ".smesh"};

std::string quote(std::string_view field) {
  std::string out = "'";
  for (const char c : field.substr(0, 32)) out += c >= ' ' && c <= '~' ? c : '?';
  return out + (field.size() > 32 ? "...'" : "'");
}

// The lines of a file that hold something, field by field.
class Lines {
 public:
  explicit Lines(const fs::path& file) : name_(file.string()) {
    std::error_code ignored;
    if (fs::is_directory(file, ignored)) throw InputError(name_ + ": is a directory, not a file");
    if (!fs::exists(file, ignored)) throw InputError(name_ + ": no such file");
    errno = 0;
    in_.open(file, std::ios::binary);
    if (!in_) {
      const int code = errno != 0 ? errno : EIO;
      throw InputError(name_ + ": cannot be read: " + std::generic_category().message(code));
    }
    size_ = fs::is_regular_file(file, ignored) ? fs::file_size(file, ignored) : 0;
  }

  [[noreturn]] void fail(const std::string& cause) const {
    throw InputError(name_ + ":" + std::to_string(number_) + ": " + cause);
  }

  // Moves to the next line that holds something; false at the end of the file.
  bool next() {
    while (std::getline(in_, line_)) {
      ++number_;
      line_.resize(std::min(line_.find('#'), line_.size()));
      at_ = 0;
      if (more()) return true;
    }
    line_.clear();
    at_ = 0;
    return false;
  }

  void expect(const std::string& what) {
    if (!next()) fail("the file ends before " + what);
  }

  bool more() {
    constexpr std::string_view blank = " \t\r\v\f,";
    while (at_ < line_.size() && blank.find(line_[at_]) != blank.npos) ++at_;
    return at_ < line_.size();
  }

  double number(const std::string& what) {
    const std::string_view text = field(what);
    double value = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (rest != text.data() + text.size() || error == std::errc::invalid_argument)
      fail(what + " is not a number: " + quote(text));
    if (error == std::errc::result_out_of_range || !std::isfinite(value))
      fail(what + " is not finite: " + quote(text));
    return value;
  }

  std::int64_t integer(const std::string& what) {
    const std::string_view text = field(what);
    std::int64_t value = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (rest != text.data() + text.size() || error != std::errc{})
      fail(what + " is not a whole number: " + quote(text));
    return value;
  }

  // A number of things that are yet to come. Each takes two bytes at least.
  std::size_t count(const std::string& what) {
    const std::int64_t value = integer(what);
    if (value < 0) fail(what + " is negative: " + std::to_string(value));
    const auto most = size_ > 0 ? size_ : std::uintmax_t{1} << 30;
    if (static_cast<std::uintmax_t>(value) > most)
      fail(what + " is " + std::to_string(value) + ", more than this file can hold");
    return static_cast<std::size_t>(value);
  }

  Point point(const std::string& what) {
    Point p;
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = number("coordinate " + std::string(1, "xyz"[k]) + " of " + what);
    return p;
  }

 private:
  std::string_view field(const std::string& what) {
    if (!more()) fail("the line ends before " + what);
    constexpr std::string_view ends = " \t\r\v\f,";
    const std::size_t from = at_;
    at_ = std::min(line_.find_first_of(ends, at_), line_.size());
    std::string_view text = std::string_view(line_).substr(from, at_ - from);
    if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
    return text;
  }

  std::string name_;
  std::ifstream in_;
  std::uintmax_t size_ = 0;
  std::string line_;
  std::size_t at_ = 0;
  std::size_t number_ = 0;
};

// Where the points come from decides what their numbers are.
struct Points {
  std::vector<Point> positions;
  std::int64_t first = 0;  // number of the first
};

Points read_points(Lines& lines) {
  lines.expect("the number of points");
  const std::size_t count = lines.count("the number of points");
  if (lines.more() && lines.integer("the dimension") != 3)
    lines.fail("the dimension is not 3; TetGen fills solids only");
  Points points;
  points.positions.reserve(std::min<std::size_t>(count, 1 << 20));
  for (std::size_t i = 0; i < count; ++i) {
    lines.expect("point " + std::to_string(i) + " of " + std::to_string(count));
    const std::int64_t number = lines.integer("the number of the point");
    if (i == 0) {
      if (number != 0 && number != 1)
        lines.fail("the first point has the number " + std::to_string(number) + "; it is 0 or 1");
      points.first = number;
    } else if (number != points.first + static_cast<std::int64_t>(i)) {
      lines.fail("point " + std::to_string(number) + " is out of order; expected " +
                 std::to_string(points.first + static_cast<std::int64_t>(i)));
    }
    points.positions.push_back(lines.point("the point"));
  }
  return points;
}

class Reader {
 public:
  Reader(Lines& lines, PiecewiseLinearComplex& complex, std::int64_t first)
      : lines_(lines), complex_(complex), first_(first) {}

  void facets(bool one_polygon_each) {
    lines_.expect("the number of facets");
    const std::size_t count = lines_.count("the number of facets");
    if (count == 0) lines_.fail("there are no facets");
    for (std::size_t f = 0; f < count; ++f) {
      lines_.expect("facet " + std::to_string(f) + " of " + std::to_string(count));
      PiecewiseLinearComplex::Facet facet;
      if (one_polygon_each) {
        facet.polygons.push_back(polygon());
      } else {
        const std::size_t polygons = lines_.count("the number of polygons");
        if (polygons == 0) lines_.fail("facet " + std::to_string(f) + " has no polygon");
        const std::size_t holes = lines_.more() ? lines_.count("the number of holes") : 0;
        for (std::size_t p = 0; p < polygons; ++p) {
          lines_.expect("polygon " + std::to_string(p) + " of facet " + std::to_string(f));
          facet.polygons.push_back(polygon());
        }
        for (std::size_t h = 0; h < holes; ++h) facet.holes.push_back(numbered_point("the hole"));
      }
      complex_.facets.push_back(std::move(facet));
    }
  }

  // Both lists may be missing.
  void holes_and_regions() {
    if (!lines_.next()) return;
    const std::size_t holes = lines_.count("the number of holes");
    for (std::size_t h = 0; h < holes; ++h) complex_.holes.push_back(numbered_point("the hole"));
    if (!lines_.next()) return;
    const std::size_t regions = lines_.count("the number of regions");
    for (std::size_t r = 0; r < regions; ++r) {
      PiecewiseLinearComplex::Region region{.point = numbered_point("the region")};
      if (lines_.more()) region.attribute = lines_.number("the attribute of the region");
      if (lines_.more()) region.max_volume = lines_.number("the volume bound of the region");
      complex_.regions.push_back(region);
    }
    if (lines_.next()) lines_.fail("expected the end of the file");
  }

 private:
  std::vector<Index> polygon() {
    const std::size_t corners = lines_.count("the number of corners");
    if (corners == 0) lines_.fail("a polygon without corners");
    std::vector<Index> polygon;
    for (std::size_t c = 0; c < corners; ++c) {
      if (!lines_.more()) lines_.expect("all corners of the polygon");
      const std::int64_t named = lines_.integer("a corner");
      const auto points = static_cast<std::int64_t>(complex_.positions.size());
      if (named < first_ || named - first_ >= points)
        lines_.fail("a polygon names point " + std::to_string(named) + ", but the points are " +
                    std::to_string(first_) + " to " + std::to_string(points - 1 + first_));
      polygon.push_back(static_cast<Index>(named - first_));
    }
    return polygon;
  }

  Point numbered_point(const std::string& what) {
    lines_.expect(what);
    lines_.integer("the number of " + what.substr(4));
    return lines_.point(what);
  }

  Lines& lines_;
  PiecewiseLinearComplex& complex_;
  std::int64_t first_;
};

}  // namespace

std::span<const std::string_view> poly_extensions() { return extensions; }

PiecewiseLinearComplex read_poly(const fs::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end())
    throw InputError(file.string() + ": unknown extension " + quote(extension) +
                     "; known are .poly .smesh");
  Lines lines(file);
  Points points = read_points(lines);
  if (points.positions.empty()) {
    Lines nodes(fs::path(file).replace_extension(".node"));
    points = read_points(nodes);
    if (points.positions.empty()) nodes.fail("there are no points");
  }
  PiecewiseLinearComplex complex;
  complex.positions = std::move(points.positions);
  Reader reader(lines, complex, points.first);
  reader.facets(extension == ".smesh");
  reader.holes_and_regions();
  return complex;
}

}  // namespace plexway::tetgen

// VTK's legacy files, up to version 5.1. Keywords are text, what they announce is text or, in
// binary files, big endian bytes.
// https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html

#include <string>
#include <utility>

#include "io/readers.hpp"
#include "io/solid/cells.hpp"

namespace plexway::io {
namespace {

using enum NumberType;

/// What follows the first three lines, `Source` being TextValues or ByteValues.
template <class Source>
class LegacyReader {
 public:
  /// `regions`: where those of the cells go, if they are wanted.
  LegacyReader(Source in, std::string_view name, Regions* regions)
      : in_(in), name_(name), regions_(regions) {}

  Mixed read(bool version5) {
    // What comes after these three is data at points and cells.
    while (!(has_points_ && has_cells_ && has_types_)) {
      const std::string_view word = in_.word();
      const std::string keyword = lower_case(word);
      if (keyword == "dataset") {
        const std::string_view kind = in_.word();
        if (lower_case(kind) == "polydata") return read_polydata(version5);
        if (lower_case(kind) != "unstructured_grid")
          in_.fail("the dataset is " + quote(kind) + "; read are UNSTRUCTURED_GRID and POLYDATA");
      } else if (keyword == "field") {
        skip_field();
      } else if (keyword == "metadata") {
        in_.skip_to_blank_line();
      } else if (keyword == "points" && !has_points_) {
        points();
      } else if (keyword == "cells" && !has_cells_) {
        if (!has_points_) in_.fail("CELLS come before POINTS");
        version5 ? cells5() : cells();
        has_cells_ = true;
      } else if (keyword == "cell_types" && !has_types_) {
        if (!has_cells_) in_.fail("CELL_TYPES come before CELLS");
        types();
      } else if (keyword.empty() || keyword == "point_data" || keyword == "cell_data") {
        in_.fail(std::string("the file has no ") + (!has_points_  ? "POINTS"
                                                    : !has_cells_ ? "CELLS"
                                                                  : "CELL_TYPES"));
      } else {
        in_.fail("expected POINTS, CELLS or CELL_TYPES, found " + quote(word));
      }
    }
    taker_.finish(name_);
    if (regions_ != nullptr) read_regions();
    return std::move(solid_);
  }

 private:
  // Data at points and cells, each array under a keyword that says how it is written.
  void read_regions() {
    std::vector<std::int64_t> best;
    std::size_t rank = region_names.size();
    std::uint64_t tuples = 0;
    bool at_cells = false;
    // An array of `components` numbers each, of `name`.
    const auto array = [&](std::string_view name, std::uint64_t components, NumberType type) {
      const std::size_t found = at_cells && components == 1 ? region_rank(name) : rank;
      if (components != 0 && tuples > in_.most(type) / components)
        in_.fail("the array " + quote(name) + " is cut off");
      if (found >= rank) return in_.skip(type, components * tuples, "a value of the array");
      rank = found;
      best.clear();
      for (std::uint64_t c = 0; c < tuples; ++c) best.push_back(read_region(in_, type));
    };
    for (;;) {
      const std::string_view word = in_.word();
      const std::string keyword = lower_case(word);
      if (keyword.empty()) break;
      if (keyword == "cell_data" || keyword == "point_data") {
        at_cells = keyword == "cell_data";
        tuples = count("tuples", i8, 1);
        if (at_cells && tuples != cells_.ends.size())
          in_.fail("data for " + std::to_string(tuples) + " cells, but there are " +
                   std::to_string(cells_.ends.size()));
      } else if (keyword == "metadata") {
        in_.skip_to_blank_line();
      } else if (keyword == "field") {
        in_.word();  // its name
        for (std::uint64_t left = count("arrays", i8, 1); left > 0;) {
          const std::string name(in_.word());
          if (name == "METADATA") {
            in_.skip_to_blank_line();
            continue;
          }
          const std::uint64_t components = count("components", i8, 1);
          if (count("tuples", i8, 1) != tuples) in_.fail("an array of another number of tuples");
          const NumberType type = number_type();
          in_.start_values();
          array(name, components, type);
          --left;
        }
      } else if (keyword == "scalars") {
        const std::string name(in_.word());
        const NumberType type = number_type();
        // How many components, if it says so, and a table of colours.
        std::uint64_t components = 1;
        std::string next = lower_case(in_.word());
        if (next != "lookup_table") {
          if (next.size() != 1 || next[0] < '1' || next[0] > '4')
            in_.fail("expected LOOKUP_TABLE, found " + quote(next));
          components = static_cast<std::uint64_t>(next[0] - '0');
          next = lower_case(in_.word());
          if (next != "lookup_table") in_.fail("expected LOOKUP_TABLE, found " + quote(next));
        }
        in_.word();
        in_.start_values();
        array(name, components, type);
      } else if (keyword == "vectors" || keyword == "normals" || keyword == "tensors") {
        const std::string name(in_.word());
        const NumberType type = number_type();
        in_.start_values();
        array(name, keyword == "tensors" ? 9 : 3, type);
      } else {
        in_.fail("data under " + quote(word) + " are not read: regions must come before");
      }
      if (rank == 0) break;
    }
    if (rank == region_names.size()) no_regions(name_);
    *regions_ = owners_.regions(best);
  }

  /// Points, and then cells of one kind after the other, as far as they go.
  Mixed read_polydata(bool version5) {
    if (regions_ != nullptr) no_regions(name_);
    for (;;) {
      const std::string_view word = in_.word();
      const std::string keyword = lower_case(word);
      const std::int64_t type = keyword == "vertices"          ? 2
                                : keyword == "lines"           ? 4
                                : keyword == "polygons"        ? 7
                                : keyword == "triangle_strips" ? 6
                                                               : 0;
      if (keyword.empty() || keyword == "point_data" || keyword == "cell_data") break;
      if (keyword == "field") {
        skip_field();
      } else if (keyword == "metadata") {
        in_.skip_to_blank_line();
      } else if (keyword == "points" && !has_points_) {
        points();
      } else if (type != 0) {
        if (!has_points_) in_.fail(std::string(word) + " come before POINTS");
        cells_ = {};
        version5 ? cells5() : cells();
        for (std::uint64_t c = 0; c < cells_.ends.size(); ++c)
          if (const auto wrong = add_vtk_cell(taker_, cells_, c, type)) in_.fail(*wrong);
      } else {
        in_.fail("expected POINTS, LINES or POLYGONS, found " + quote(word));
      }
    }
    if (!has_points_) in_.fail("the file has no POINTS");
    taker_.finish(name_);
    return std::move(solid_);
  }

  std::uint64_t count(std::string_view what, NumberType type, std::uint64_t values) {
    return checked_count(in_, in_.text_whole("the number of " + std::string(what)), what, type,
                         values);
  }

  NumberType number_type() {
    const std::string_view word = in_.word();
    const auto type = vtk_number_type(lower_case(word));
    if (!type) in_.fail("numbers of type " + quote(word) + " are not read");
    return *type;
  }

  /// Arrays that belong to the grid as a whole.
  void skip_field() {
    in_.word();  // its name
    const std::uint64_t arrays = count("arrays", i8, 1);
    for (std::uint64_t i = 0; i < arrays;) {
      const std::string_view word = in_.word();
      if (word.empty()) in_.fail("the file ends inside FIELD");
      if (word == "METADATA") {
        in_.skip_to_blank_line();
        continue;
      }
      const std::uint64_t components = count("components", i8, 1);
      const std::uint64_t tuples = count("tuples", i8, components == 0 ? 1 : components);
      const NumberType type = number_type();
      in_.start_values();
      in_.skip(type, components * tuples, "a value of the array");
      ++i;
    }
  }

  void points() {
    const std::uint64_t points = count("points", i8, 3);
    const NumberType type = number_type();
    in_.start_values();
    if (points > in_.most(type) / 3)
      in_.fail("there should be " + std::to_string(points) + " points, but only " +
               std::to_string(in_.bytes_left()) + " bytes follow");
    read_vtk_points(in_, type, points, solid_);
    has_points_ = true;
  }

  /// One list: for each cell how many points it has, and these.
  void cells() {
    const std::uint64_t cells = count("cells", i32, 1);
    const std::uint64_t size = count("numbers that make up the cells", i32, 1);
    in_.start_values();
    if (size < cells)
      in_.fail(std::to_string(cells) + " cells cannot be made of " + std::to_string(size) +
               " numbers");
    cells_.ends.reserve(cells);
    cells_.connectivity.reserve(size - cells);
    for (std::uint64_t c = 0; c < cells; ++c) {
      const std::int64_t corners = in_.whole(i32, "the number of points of a cell");
      const std::uint64_t left = size - cells - cells_.connectivity.size();
      if (corners < 0 || static_cast<std::uint64_t>(corners) > left)
        in_.fail("cell " + std::to_string(c) + " has " + std::to_string(corners) +
                 " points, but only " + std::to_string(left) + " are left for it");
      for (std::int64_t i = 0; i < corners; ++i) corner(i32);
      cells_.ends.push_back(cells_.connectivity.size());
    }
    if (cells_.connectivity.size() != size - cells)
      in_.fail("the cells are made of " + std::to_string(cells_.connectivity.size() + cells) +
               " numbers, not of " + std::to_string(size));
  }

  /// Two lists: where the points of each cell start, one more than there are cells; the points.
  void cells5() {
    const std::uint64_t offsets = count("offsets of cells", i8, 1);
    const std::uint64_t size = count("points of cells", i8, 1);
    const NumberType type = list("offsets");
    if (offsets > in_.most(type))
      in_.fail("there should be " + std::to_string(offsets) + " offsets, but only " +
               std::to_string(in_.bytes_left()) + " bytes follow");
    cells_.ends.reserve(offsets);
    std::int64_t before = 0;
    for (std::uint64_t i = 0; i < offsets; ++i) {
      const std::int64_t offset = in_.whole(type, "the offset of a cell");
      if (offset < before || (i == 0 && offset != 0) || static_cast<std::uint64_t>(offset) > size)
        in_.fail("offset " + std::to_string(i) + " is " + std::to_string(offset) + " after " +
                 std::to_string(before) + ", of " + std::to_string(size));
      before = offset;
      if (i != 0) cells_.ends.push_back(static_cast<std::uint64_t>(offset));
    }
    if (static_cast<std::uint64_t>(before) != size)
      in_.fail("the last offset is " + std::to_string(before) + ", but the cells have " +
               std::to_string(size) + " points");
    const NumberType point = list("connectivity");
    if (size > in_.most(point))
      in_.fail("there should be " + std::to_string(size) + " points of cells, but only " +
               std::to_string(in_.bytes_left()) + " bytes follow");
    cells_.connectivity.reserve(size);
    for (std::uint64_t i = 0; i < size; ++i) corner(point);
  }

  NumberType list(std::string_view keyword) {
    std::string_view word = in_.word();
    if (lower_case(word) == "metadata") {
      in_.skip_to_blank_line();
      word = in_.word();
    }
    if (lower_case(word) != keyword)
      in_.fail("expected " + quote(keyword) + ", found " + quote(word));
    const NumberType type = number_type();
    in_.start_values();
    return type;
  }

  void corner(NumberType type) {
    cells_.connectivity.push_back(read_vtk_corner(in_, type, solid_.positions.size()));
  }

  void types() {
    const std::uint64_t types = count("types of cells", i32, 1);
    in_.start_values();
    if (types != cells_.ends.size())
      in_.fail("there are " + std::to_string(types) + " types for " +
               std::to_string(cells_.ends.size()) + " cells");
    for (std::uint64_t c = 0; c < types; ++c) {
      const std::int64_t type = in_.whole(i32, "the type of a cell");
      if (const auto wrong = add_vtk_cell(taker_, cells_, c, type)) in_.fail(*wrong);
      if (regions_ != nullptr) owners_.take(solid_, c);
    }
    has_types_ = true;
  }

  Source in_;
  std::string_view name_;
  Regions* regions_;
  CellOwners owners_;
  Mixed solid_;
  VtkCells cells_;
  CellTaker taker_{solid_};
  bool has_points_ = false;
  bool has_cells_ = false;
  bool has_types_ = false;
};

Mixed parse(std::string_view bytes, std::string_view name, Regions* regions = nullptr) {
  // The first line looks like a comment, and the second holds anything.
  const auto fail = [&](std::size_t line, const std::string& cause) {
    throw InputError(std::string(name) + ":" + std::to_string(line) + ": " + cause);
  };
  constexpr std::string_view magic = "# vtk DataFile Version ";
  bytes = without_mark(bytes);
  if (!lower_case(bytes.substr(0, magic.size())).starts_with(lower_case(magic)))
    fail(1, "expected '# vtk DataFile Version', found " + quote(bytes.substr(0, bytes.find('\n'))));
  TextScanner first(bytes.substr(magic.size()), name);
  const double version = first.number("the version");
  if (version < 1 || version >= 6)
    first.fail("this version of .vtk is not read; those up to 5.1 are");
  TextScanner scanner(bytes, name);
  if (!scanner.next_line() || !scanner.next_line())
    scanner.fail("the file ends before ASCII or BINARY");
  const std::string_view word = scanner.field();
  const std::string mode = lower_case(word);
  if (mode != "ascii" && mode != "binary")
    scanner.fail("expected ASCII or BINARY, found " + quote(word));
  scanner.next_line();
  if (mode == "ascii") return LegacyReader(TextValues(scanner), name, regions).read(version >= 5);
  const std::size_t at = bytes.size() - scanner.bytes_left();
  return LegacyReader(ByteValues(bytes, name, std::endian::big, at), name, regions)
      .read(version >= 5);
}

}  // namespace

Mixed parse_vtk(std::string_view bytes, std::string_view name) { return parse(bytes, name); }

Regions parse_vtk_regions(std::string_view bytes, std::string_view name) {
  Regions regions;
  (void)parse(bytes, name, &regions);
  return regions;
}

}  // namespace plexway::io

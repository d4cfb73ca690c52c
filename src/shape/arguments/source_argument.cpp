#include "shape/arguments/arguments.hpp"

#include <cmath>
#include <string_view>

#include <plexway/error.hpp>
#include <plexway/shape/support.hpp>

#include "io/number_rows.hpp"
#include "shape/boundary.hpp"
#include "shape/shape_state.hpp"
#include "shape/words.hpp"

namespace plexway::detail {

const char* const source_set_help =
    "vertex:ID (0-based, file order), point:X,Y,Z (closest point of the domain),\n"
    "vertices:FILE (one a line, an offset behind it if wanted), boundary,\n"
    "segment:X,Y,Z,X,Y,Z (the shortest path between), polyline:FILE (a point a line),\n"
    "triangle:ID, circle:X,Y,Z,R; each with +OFFSET behind it if wanted. Repeat it\n"
    "for several sources, each vertex then gets the nearest";

namespace {

[[noreturn]] void malformed_source(const std::string& text) {
  throw UsageError("--source '" + text + "': " + meant_place(text) +
                   "write vertex:ID (0-based), point:X,Y,Z, vertices:FILE, boundary, "
                   "segment:X,Y,Z,X,Y,Z, polyline:FILE, triangle:ID or circle:X,Y,Z,R, and "
                   "+OFFSET behind it if wanted");
}

// Takes +OFFSET off the end. The + of an exponent, as in 1e+5, is none.
double take_offset(std::string& place) {
  const std::size_t plus = place.rfind('+');
  if (plus == place.npos || plus == 0) return 0;
  const char before = place[plus - 1];
  if (before == ',' || before == ':') return 0;
  if ((before == 'e' || before == 'E') && plus >= 2 && place[plus - 2] >= '0' &&
      place[plus - 2] <= '9')
    return 0;
  const auto offset = number_of(std::string_view(place).substr(plus + 1));
  if (!offset || *offset < 0) return 0;
  place.resize(plus);
  return *offset;
}

SetArgument parse_one(const std::string& text) {
  using Kind = SetArgument::Kind;
  SetArgument set;
  set.text = set.place = text;
  set.offset = take_offset(set.place);
  const std::string_view place = set.place;
  const std::size_t colon = place.find(':');
  const std::string_view name = place.substr(0, colon);
  const std::string_view rest = colon == place.npos ? "" : place.substr(colon + 1);
  const auto take_numbers = [&](Kind kind, std::size_t count) {
    const auto numbers = numbers_of(rest, count);
    if (!numbers) malformed_source(text);
    set.kind = kind;
    set.numbers = *numbers;
  };
  const auto take_file = [&](Kind kind) {
    if (rest.empty()) malformed_source(text);
    set.kind = kind;
    set.file = rest;
  };
  if (place == "boundary") {
    set.kind = Kind::boundary;
  } else if (name == "segment") {
    take_numbers(Kind::segment, 6);
  } else if (name == "circle" || name == "ball") {
    take_numbers(Kind::circle, 4);
    if (set.numbers[3] < 0) throw UsageError("--source '" + text + "': the radius must be >= 0");
  } else if (name == "vertices") {
    take_file(Kind::vertices);
  } else if (name == "polyline") {
    take_file(Kind::polyline);
  } else if (name == "triangle" || name == "simplex") {
    const auto number = number_of(rest);
    if (!number || *number < 0 || *number != std::floor(*number) || *number >= none)
      malformed_source(text);
    set.kind = Kind::simplex;
    set.simplex = static_cast<Index>(*number);
  } else if (name == "vertex" || name == "point") {
    try {
      (void)parse_source(set.place);
    } catch (const UsageError&) {
      malformed_source(text);
    }
  } else {
    malformed_source(text);
  }
  return set;
}

VertexSource read_vertices(const AnyShape& domain, const SetArgument& set) {
  VertexSource source;
  source.offset = set.offset;
  for (const io::NumberRow& row : io::read_number_rows(
           set.file, 1, 2, "a vertex (0-based) a line, and its offset if wanted")) {
    const double offset = row.numbers.size() == 2 ? row.numbers[1] : 0;
    source.vertices.push_back(io::vertex_in(set.file, row, 0, domain.vertices()));
    if (offset < 0) io::fail_at(set.file, row, "an offset below 0: " + short_number(offset));
    source.offsets.push_back(offset);
  }
  return source;
}

PointSource closest(const AnyShape& domain, const SetArgument& set,
                    const std::array<double, 3>& point) {
  require_input(domain.file().string() + ": source " + set.text, support(Purpose::places, domain));
  return domain.closest(point);
}

// Messages say which option it was about.
template <class Ask>
auto at_option(const std::string& text, const Ask& ask) {
  try {
    return ask();
  } catch (const UsageError& error) {
    throw UsageError("--source " + text + ": " + error.what());
  }
}

Source locate(const AnyShape& domain, const SetArgument& set, const Mask* mask) {
  using Kind = SetArgument::Kind;
  switch (set.kind) {
    case Kind::point: {
      PointSource point = locate_source(domain, parse_source(set.place));
      point.offset = set.offset;
      return point;
    }
    case Kind::vertices:
      return read_vertices(domain, set);
    case Kind::boundary:
      return with_file_name(domain, [&] {
        const AnyShape open = mask == nullptr ? domain : domain.open_part(*mask);
        return at_option("boundary", [&] { return open.boundary(set.offset); });
      });
    case Kind::circle:
      return BallSource{
          .centre = closest(domain, set, {set.numbers[0], set.numbers[1], set.numbers[2]}),
          .radius = set.numbers[3],
          .offset = set.offset};
    case Kind::simplex:
      support({.executor = ExecutorKind::serial,
               .domain = domain.kind(),
               .dimension = 2,
               .single_precision = false,
               .source = SourceKind::simplex})
          .require();
      if (set.simplex >= domain.simplices())
        throw InputError(domain.file().string() + ": source " + set.text +
                         " is out of range: the " + std::string(domain.simplex_name()) +
                         " are 0 to " + std::to_string(domain.simplices() - 1));
      return SimplexSource{.simplex = set.simplex, .offset = set.offset};
    case Kind::segment:
    case Kind::polyline: {
      std::vector<PointSource> points;
      if (set.kind == Kind::segment) {
        for (std::size_t i = 0; i < 6; i += 3)
          points.push_back(
              closest(domain, set, {set.numbers[i], set.numbers[i + 1], set.numbers[i + 2]}));
      } else {
        for (const auto& [row, line] : io::read_number_rows(set.file, 3, 3, "a point X Y Z a line"))
          points.push_back(closest(domain, set, {row[0], row[1], row[2]}));
      }
      CurveSource curve = at_option("'" + set.text + "'", [&] { return domain.joined(points); });
      curve.offset = set.offset;
      return curve;
    }
  }
  return PointSource{};
}

}  // namespace

std::vector<SetArgument> parse_source_sets(const std::vector<std::string>& texts) {
  std::vector<SetArgument> arguments;
  for (const std::string& text : texts) arguments.push_back(parse_one(text));
  return arguments;
}

std::vector<Source> locate_source_sets(const AnyShape& domain,
                                       std::span<const SetArgument> arguments, bool measured,
                                       const Mask* mask) {
  std::vector<Source> sources;
  for (const SetArgument& argument : arguments) {
    sources.push_back(locate(domain, argument, mask));
    if (auto* const set = std::get_if<VertexSource>(&sources.back());
        set != nullptr && measured && argument.kind == SetArgument::Kind::boundary)
      *set = rim_of(*set);
  }
  return sources;
}

std::vector<PointSource> as_points(std::span<const Source> sources) {
  std::vector<PointSource> points;
  for (const Source& source : sources)
    if (const auto* point = std::get_if<PointSource>(&source)) points.push_back(*point);
  return points.size() == sources.size() ? points : std::vector<PointSource>();
}

bool have_shapes(const AnyShape& domain, std::span<const Source> sources) {
  if (domain.kind() != DomainKind::surface) return false;
  for (const Source& source : sources)
    if (std::holds_alternative<CurveSource>(source) ||
        std::holds_alternative<SimplexSource>(source))
      return true;
  return false;
}

AskedPoints asked_points(std::span<const SetArgument> arguments, std::span<const Source> sources) {
  AskedPoints points;
  const auto add = [&](const SetArgument& set, std::size_t first, const PointSource& found) {
    const auto& n = set.numbers;
    points.asked.push_back({set.text, std::array{n[first], n[first + 1], n[first + 2]}});
    points.found.push_back(found);
  };
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (const auto* point = std::get_if<PointSource>(&sources[i])) {
      points.asked.push_back(parse_source(arguments[i].place));
      points.found.push_back(*point);
    } else if (const auto* ball = std::get_if<BallSource>(&sources[i])) {
      add(arguments[i], 0, ball->centre);
    } else if (const auto* curve = std::get_if<CurveSource>(&sources[i]);
               curve != nullptr && arguments[i].kind == SetArgument::Kind::segment) {
      add(arguments[i], 0, curve->points.front());
      add(arguments[i], 3, curve->points.back());
    }
  }
  return points;
}

std::string describe_source_set(const AnyShape& domain, const SetArgument& argument,
                                const Source& source) {
  std::string text;
  if (const auto* point = std::get_if<PointSource>(&source)) {
    text = describe_source(domain, parse_source(argument.place), *point);
  } else if (const auto* ball = std::get_if<BallSource>(&source)) {
    const auto& n = argument.numbers;
    text = describe_source(domain, {argument.place, std::array{n[0], n[1], n[2]}}, ball->centre);
  } else {
    text = argument.place;
    if (const auto* set = std::get_if<VertexSource>(&source)) {
      const bool boundary = argument.kind == SetArgument::Kind::boundary;
      text += " (" + counted((boundary ? rim_of(*set) : *set).vertices.size(), "vertices") + ")";
    }
    if (const auto* curve = std::get_if<CurveSource>(&source))
      text += " (" + counted(curve->points.size(), "points") + ")";
  }
  return argument.offset > 0 ? text + " + " + short_number(argument.offset) : text;
}

}  // namespace plexway::detail

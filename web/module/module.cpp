// What the page calls: a domain, its picture as arrays, a field on it. One of each at a time.
//
// Every call that can fail returns 0, or the exit code that the command-line tool would end with;
// plexway_text() has then the sentence for people, else what the call tells, as JSON. Arrays stay
// where they are until the next call of the same name.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/error.hpp>
#include <plexway/executors.hpp>
#include <plexway/shape/warnings.hpp>
#include <plexway/version.hpp>

#include "drawing.hpp"
#include "json_line.hpp"
#include "picking.hpp"

#define PLEXWAY_PAGE_CALLS extern "C" __attribute__((used))

namespace {

using namespace plexway;
using plexway::web::Drawing;
using plexway::web::JsonLine;

struct Session {
  std::optional<AnyDomain> domain;
  std::optional<AnyDomain> precise;  ///< the same in double precision
  std::optional<AnyDomain> edges;    ///< the same as a wireframe: what Dijkstra sees
  Drawing drawing;
  std::vector<PointSource> sources;
  AnyField field, along_edges;
  std::vector<float> distance, difference;
  std::vector<std::int32_t> label;
  std::optional<AnyPathField> paths;
  std::vector<float> path;
  web::Section section;
  web::Hit hit;
  std::string text;
};

Session& session() {
  static Session one;
  return one;
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

// Runs the body; the text becomes what it returns, or the sentence of what it throws.
template <class Body>
int answered(const Body& body) {
  std::string& text = session().text;
  try {
    text = body();
    return 0;
  } catch (const UsageError& error) {
    text = error.what();
    return 2;
  } catch (const InputError& error) {
    text = error.what();
    return 3;
  } catch (const NotBuiltError& error) {
    text = error.what();
    return 4;
  } catch (const EndlessError& error) {
    text = error.what();
    return 6;
  } catch (const std::bad_alloc&) {
    text =
        "the browser gives this page no more memory: take a smaller file, or the command-line tool";
    return 1;
  } catch (const std::exception& error) {
    text = error.what();
    return 1;
  }
}

std::vector<std::string> texts_of(const std::vector<Warning>& warnings) {
  std::vector<std::string> texts;
  for (const Warning& warning : warnings) texts.push_back(warning.text);
  return texts;
}

const AnyDomain& opened() {
  if (!session().domain) throw UsageError("open a file first");
  return *session().domain;
}

PropagateOptions options_of(std::string_view accuracy) {
  PropagateOptions options;
  if (accuracy == "fast")
    options.accuracy = Accuracy::fast();
  else if (accuracy == "accurate")
    options.accuracy = Accuracy::accurate();
  else if (accuracy == "exact")
    options.accuracy = Accuracy::exact();
  else if (accuracy != "usual")
    throw UsageError("accuracy '" + std::string(accuracy) +
                     "' is not known: take usual, fast, accurate or exact");
  return options;
}

// Exact distances take the domain in double precision, which is built when they are first asked
// for.
const AnyDomain& solved_on(std::string_view accuracy) {
  Session& now = session();
  if (accuracy != "exact") return opened();
  if (!now.precise) now.precise = AnyDomain(opened().shape(), {.precision = Precision::float64});
  return *now.precise;
}

}  // namespace

PLEXWAY_PAGE_CALLS const char* plexway_version() { return version_string; }
PLEXWAY_PAGE_CALLS const char* plexway_text() { return session().text.c_str(); }

/// Reads a file of the page's own file system. `as`: a kind's name, or empty for what the file
/// says.
PLEXWAY_PAGE_CALLS int plexway_open(const char* file, const char* as, int twice) {
  return answered([&] {
    Session& now = session();
    ReadOptions reading;
    if (*as != 0) {
      reading.as = kind_named(as);
      if (!reading.as) throw UsageError("'" + std::string(as) + "' is no kind of domain");
    }
    BuildOptions building;
    building.precision = twice != 0 ? Precision::float64 : Precision::float32;
    const auto start = std::chrono::steady_clock::now();
    AnyShape shape = AnyShape::read(file, reading);
    const double load = milliseconds_since(start);
    const auto built = std::chrono::steady_clock::now();
    AnyDomain domain(std::move(shape), building);
    const double build = milliseconds_since(built);
    now = Session{};
    now.domain = std::move(domain);
    const AnyShape& opened = now.domain->shape();
    now.drawing = Drawing(opened);
    JsonLine line;
    line.add("kind", kind_name(opened.kind()));
    line.add("vertices", opened.vertices());
    line.add("simplices", now.domain->simplices());
    line.add("simplexName", opened.simplex_name());
    line.add("components", now.domain->components());
    line.add("loadMs", load);
    line.add("buildMs", build);
    line.add("bytes", now.domain->bytes());
    line.add("note", opened.level_set_note());
    line.add("notes", texts_of(domain_warnings(*now.domain)));
    line.add("centre", now.drawing.centre());
    line.add("size", now.drawing.size());
    return line.text();
  });
}

/// An array of the drawing: 0 positions (3 floats a vertex, from the centre), 1 triangles, 2 edges.
PLEXWAY_PAGE_CALLS const void* plexway_array(int which) {
  return session().drawing.array(which).first;
}
/// How many numbers it has.
PLEXWAY_PAGE_CALLS std::size_t plexway_array_size(int which) {
  return session().drawing.array(which).second;
}

/// The place nearest to the eye that a ray meets, in the drawing's coordinates; `slack`: how far
/// from points and edges, as a share of the way to them. Keeps it for the calls that take `picked`.
PLEXWAY_PAGE_CALLS int plexway_pick(double ox, double oy, double oz, double dx, double dy,
                                    double dz, double slack) {
  return answered([&] {
    Session& now = session();
    now.hit = web::pick(opened().shape(), now.drawing, {ox, oy, oz}, {dx, dy, dz}, slack);
    JsonLine line;
    line.add("hit", now.hit.found);
    if (now.hit.found) {
      line.add("at", now.hit.at);
      line.add("vertex", now.hit.nearest_vertex);
      if (!now.distance.empty()) line.add("distance", web::interpolated(now.hit, now.distance));
    }
    return line.text();
  });
}

/// Makes what was picked a source: place `index` of the list, or its end.
PLEXWAY_PAGE_CALLS int plexway_set_source(int index, int vertex) {
  return answered([&] {
    Session& now = session();
    PointSource point;
    if (vertex >= 0) {
      if (static_cast<std::size_t>(vertex) >= opened().vertices())
        throw UsageError("vertex " + std::to_string(vertex) + " is not there: the last is " +
                         std::to_string(opened().vertices() - 1));
      point = PointSource::at(static_cast<Index>(vertex));
    } else if (now.hit.found) {
      point = now.hit.source;
    } else {
      throw UsageError("pick a point first");
    }
    const auto at = static_cast<std::size_t>(std::max(index, 0));
    if (at < now.sources.size())
      now.sources[at] = point;
    else
      now.sources.push_back(point);
    JsonLine line;
    line.add("sources", now.sources.size());
    line.add("at", now.drawing.placed(opened().shape().position(point)));
    line.add("argument", web::argument_of(opened().shape(), point));
    return line.text();
  });
}

PLEXWAY_PAGE_CALLS void plexway_clear_sources() { session().sources.clear(); }

/// Distances from all sources, in plexway_distance().
PLEXWAY_PAGE_CALLS int plexway_solve(const char* accuracy) {
  return answered([&] {
    Session& now = session();
    if (now.sources.empty()) throw UsageError("choose a source first");
    const AnyDomain& domain = solved_on(accuracy);
    const auto start = std::chrono::steady_clock::now();
    domain.solve(Serial{}, now.sources, options_of(accuracy), now.field);
    const double solve = milliseconds_since(start);
    now.paths.reset();
    now.distance.resize(now.field.size());
    double farthest = 0;
    std::size_t unreached = 0;
    for (std::size_t v = 0; v < now.distance.size(); ++v) {
      const double d = now.field[v];
      now.distance[v] = static_cast<float>(d);
      if (std::isfinite(d))
        farthest = std::max(farthest, d);
      else
        ++unreached;
    }
    now.label = now.field.file_label();
    JsonLine line;
    line.add("solveMs", solve);
    line.add("farthest", farthest);
    line.add("unreached", unreached);
    line.add("notes", texts_of(field_warnings(domain, now.field, now.sources)));
    return line.text();
  });
}

/// One float a vertex, +inf where unreachable.
PLEXWAY_PAGE_CALLS const float* plexway_distance() { return session().distance.data(); }
/// One a vertex with several sources, else null.
PLEXWAY_PAGE_CALLS const std::int32_t* plexway_label() {
  return session().label.empty() ? nullptr : session().label.data();
}

/// By how much Dijkstra's distances along the edges are longer, as a share: one float a vertex.
PLEXWAY_PAGE_CALLS int plexway_compare() {
  return answered([&] {
    Session& now = session();
    if (now.distance.empty()) throw UsageError("solve first");
    if (!now.edges) now.edges = AnyDomain(web::edges_of(opened().shape()));
    const std::vector<PointSource> starts = web::corners_of(opened().shape(), now.sources);
    const auto start = std::chrono::steady_clock::now();
    now.edges->solve(Serial{}, starts, {}, now.along_edges);
    const double solve = milliseconds_since(start);
    now.difference.resize(now.distance.size());
    double sum = 0, worst = 0;
    std::size_t count = 0;
    for (std::size_t v = 0; v < now.difference.size(); ++v) {
      const double ours = now.field[v], theirs = now.along_edges[v];
      const bool told = std::isfinite(ours) && std::isfinite(theirs) && ours > 0;
      now.difference[v] = told ? static_cast<float>(theirs / ours - 1) : 0.0F;
      if (!told) continue;
      sum += theirs / ours - 1;
      worst = std::max(worst, theirs / ours - 1);
      ++count;
    }
    JsonLine line;
    line.add("solveMs", solve);
    line.add("mean", count == 0 ? 0.0 : sum / static_cast<double>(count));
    line.add("worst", worst);
    return line.text();
  });
}
PLEXWAY_PAGE_CALLS const float* plexway_difference() { return session().difference.data(); }

/// The way from what was picked to its source, in plexway_way().
PLEXWAY_PAGE_CALLS int plexway_path(const char* accuracy) {
  return answered([&] {
    Session& now = session();
    if (!now.hit.found) throw UsageError("pick a point first");
    const auto start = std::chrono::steady_clock::now();
    if (!now.paths)
      now.paths = solved_on(accuracy).path_field(Serial{}, now.sources, options_of(accuracy));
    const Path way = now.paths->trace(now.hit.source);
    now.path.clear();
    for (const std::array<double, 3>& point : way.positions)
      for (const double c : now.drawing.placed(point)) now.path.push_back(static_cast<float>(c));
    JsonLine line;
    line.add("pathMs", milliseconds_since(start));
    line.add("length", way.length);
    line.add("points", way.positions.size());
    line.add("argument", web::argument_of(opened().shape(), now.hit.source));
    return line.text();
  });
}
PLEXWAY_PAGE_CALLS const float* plexway_way() { return session().path.data(); }

/// Where the plane {x: n.x = offset} cuts a solid, in the drawing's coordinates:
/// plexway_section_vertices() floats x, y, z, distance of triangles.
PLEXWAY_PAGE_CALLS int plexway_cut(double nx, double ny, double nz, double offset) {
  return answered([&] {
    Session& now = session();
    now.section =
        web::section_of(opened().shape(), now.drawing, {nx, ny, nz}, offset, now.distance);
    JsonLine line;
    line.add("triangles", now.section.numbers.size() / 12);
    return line.text();
  });
}
PLEXWAY_PAGE_CALLS const float* plexway_section() { return session().section.numbers.data(); }

/// Writes the field into the page's own file system; the extension picks the format.
PLEXWAY_PAGE_CALLS int plexway_write(const char* file) {
  return answered([&] {
    Session& now = session();
    if (now.distance.empty()) throw UsageError("solve first");
    opened().shape().write_field(file, now.field.doubles(), now.label, now.field.error());
    return std::string("{}");
  });
}

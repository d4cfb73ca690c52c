#pragma once

#include <cstddef>
#include <string>

#include <plexway/shape/cloud_shape.hpp>
#include <plexway/shape/warnings.hpp>

namespace plexway::detail {

/// How the points kept came from those in the file, for people: "5120 of 20000 points: 3 not
/// finite, 17 outliers"; empty where all were kept.
std::string kept_points(const CloudShape& cloud);

/// Why some points are not reached, and what would help, for people. `components` are those of the
/// complex. Cost: several times that of finding the neighbours.
std::string why_disconnected(const CloudShape& cloud, std::size_t components, Reader reader);

/// For people: paths were to be refracted in a solid, and are not.
[[nodiscard]] std::string smoothed_sentence();
/// For people, where lengths break the triangle inequality; else empty.
[[nodiscard]] std::string violations_sentence(const AnyDomain& domain);

/// What warnings advise, and how each reader asks for it: `X(name, people, tool, python)`.
#define PLEXWAY_SPELLINGS(X)                                                                     \
  X(fast, "the accuracy fast", "--accuracy fast", "accuracy='fast'")                             \
  X(accurate, "the accuracy accurate", "--accuracy accurate", "accuracy='accurate'")             \
  X(exact, "the accuracy exact", "--accuracy exact", "accuracy='exact'")                         \
  X(twice, "double precision", "--precision double", "precision='double'")                       \
  X(triangulation, "triangulation", "--triangulation", "triangulation=")                         \
  X(bounds, "the radius or the number of expansions", "--radius or --max-expansions", "radius=") \
  X(merge, "merging them", "--merge 0", "merge=0")                                               \
  X(k, "k = ", "--k ", "k=")                                                                     \
  X(neighbour_radius, "their radius", "--neighbour-radius", "neighbour_radius=")                 \
  X(normal_angle, "the largest angle of normals", "--max-normal-angle", "max_normal_angle=")     \
  X(in_the_file, "", " in the file", "")                                                         \
  X(those, "those given", "those in the file", "those given")                                    \
  X(columns, "(in a file the columns nx ny nz)", "(columns nx ny nz)",                           \
    "(normals=, in a file the columns nx ny nz)")                                                \
  X(original, "`original` of the points has", "the column original has", "`original` has")       \
  X(meant, "", "", "; refract=False says that this is meant")

#define PLEXWAY_NAME(name, people, tool, python) name,
/// The rows of PLEXWAY_SPELLINGS by name.
enum class Advice { PLEXWAY_SPELLINGS(PLEXWAY_NAME) };
#undef PLEXWAY_NAME

/// As that reader asks for it.
constexpr const char* spelled(Advice advice, Reader reader) {
  struct Row {
    const char *people, *tool, *python;
  };
#define PLEXWAY_ROW(name, people, tool, python) {people, tool, python},
  constexpr Row rows[] = {PLEXWAY_SPELLINGS(PLEXWAY_ROW)};
#undef PLEXWAY_ROW
  const Row& row = rows[static_cast<int>(advice)];
  return reader == Reader::tool ? row.tool : reader == Reader::python ? row.python : row.people;
}

}  // namespace plexway::detail

#pragma once

#include <plexway/shape/remarks.hpp>

namespace plexway {

/// What remarks advise, and how each reader asks for it: `X(name, people, tool, python)`.
#define PLEXWAY_SPELLINGS(X)                                                                     \
  X(fast, "the accuracy fast", "--accuracy fast", "accuracy='fast'")                             \
  X(accurate, "the accuracy accurate", "--accuracy accurate", "accuracy='accurate'")             \
  X(exact, "the accuracy exact", "--accuracy exact", "accuracy='exact'")                         \
  X(twice, "double precision", "--precision double", "precision='double'")                       \
  X(triangulation, "triangulation", "--triangulation", "triangulation=")                         \
  X(bounds, "the radius or the number of expansions", "--radius or --max-expansions", "radius=") \
  X(k, "k = ", "--k ", "k=")                                                                     \
  X(neighbour_radius, "their radius", "--neighbour-radius", "neighbour_radius=")                 \
  X(normal_angle, "the largest angle of normals", "--max-normal-angle", "max_normal_angle=")     \
  X(smooth, "smoothing", "--smooth", "smooth=True")                                              \
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

}  // namespace plexway

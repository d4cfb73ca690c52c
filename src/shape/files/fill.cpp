#include "shape/files/files.hpp"

#include <typeinfo>
#include <utility>

#include <plexway/error.hpp>

#include "io/names.hpp"

#ifdef PLEXWAY_HAS_TETGEN
#include <plexway/tetgen/tetrahedralize.hpp>
#endif

namespace plexway::detail {

void require_tetgen(const std::string& what) {
#ifdef PLEXWAY_HAS_TETGEN
  (void)what;
#else
  throw NotBuiltError(what +
                      ": filling a surface needs TetGen, which is not built in; install "
                      "libtet1.5-dev and build again");
#endif
}

bool is_poly(const std::string& file) {
  const std::string extension = io::lower_extension(file);
  return extension == ".poly" || extension == ".smesh";
}

bool is_vdb(const std::string& file) { return io::lower_extension(file) == ".vdb"; }

#ifdef PLEXWAY_HAS_TETGEN
namespace {

tetgen::TetrahedralizeOptions tetgen_options(const ReadOptions& options) {
  const auto go_on = [&options, told = false](double seconds) mutable {
    const bool on = !options.progress.seconds || options.progress.seconds(seconds);
    if (seconds > 60 && !told && options.progress.note) {
      told = true;
      const auto name = [&](std::string_view field) { return spelled(options.spelling, field); };
      options.progress.note("TetGen has taken a minute, and on needles it may never end; " +
                            name("keep_surface") + " or " + name("quality") +
                            " 0 often help, and " + name("max_seconds") + " sets a limit");
    }
    return on;
  };
  const FillOptions& fill = options.fill;
  return {.max_volume = fill.max_volume,
          .max_radius_edge = fill.quality,
          .quality = fill.quality > 0,
          .keep_surface = fill.keep_surface,
          .max_seconds = fill.max_seconds,
          .go_on = go_on};
}

template <class Fill>
io::Tets filled(const std::string& file, Fill fill) {
  try {
    tetgen::Solid solid = fill();
    return {std::move(solid.positions), std::move(solid.tets)};
  } catch (const InputError& error) {
    throw InputError(file + ": cannot be filled: " + error.what());
  } catch (const Error& error) {
    if (typeid(error) != typeid(Error)) throw;  // of another kind
    throw Error(file + ": cannot be filled: " + error.what());
  }
}

}  // namespace

io::Tets fill_surface(const std::string& file, const io::Triangles& surface,
                      const ReadOptions& options) {
  return filled(file, [&] {
    return tetgen::tetrahedralize(surface.positions, surface.triangles, options.fill.holes,
                                  tetgen_options(options));
  });
}

io::Tets fill_poly(const std::string& file, const ReadOptions& options) {
  auto complex = tetgen::read_poly(file);
  for (const auto& hole : options.fill.holes) complex.holes.push_back(hole);
  return filled(file, [&] { return tetgen::tetrahedralize(complex, tetgen_options(options)); });
}
#else
io::Tets fill_surface(const std::string& file, const io::Triangles&, const ReadOptions&) {
  require_tetgen(file);
  return {};
}
io::Tets fill_poly(const std::string& file, const ReadOptions&) {
  require_tetgen(file);
  return {};
}
#endif

}  // namespace plexway::detail

// FreeSurfer's surfaces of triangles: three bytes FF FF FE, a line of text, an empty line, and big
// endian the number of vertices and of triangles (int32), coordinates (float32) and corners
// (int32). What stands behind is not needed.

#include <plexway/io/triangles.hpp>

#include <bit>
#include <string>

#include <plexway/error.hpp>

#include "io/field/value_source.hpp"
#include "io/numbers.hpp"
#include "io/readers.hpp"
#include "io/surface/polygons.hpp"

namespace plexway::io {
namespace {

// Of text, where a patch stands behind each row, or of bytes.
template <class Source>
Triangles read_freesurfer(Source in, std::string_view name) {
  constexpr std::uint64_t numbers = Source::is_text ? 4 : 3;  // a row
  const auto count = [&](const std::string& what) {
    return checked_count(in, in.whole(NumberType::i32, "the number of " + what), what,
                         NumberType::f32, numbers);
  };
  Triangles surface;
  surface.positions.resize(count("vertices"));
  surface.triangles.resize(count("triangles"));
  for (auto& position : surface.positions) {
    for (double& x : position) x = in.real(NumberType::f32, "a coordinate");
    in.skip(NumberType::f32, numbers - 3, "the patch of a vertex");
  }
  for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
    for (std::uint32_t& corner : surface.triangles[f]) {
      const std::int64_t v = in.whole(NumberType::i32, "a corner");
      if (v < 0 || v >= std::ssize(surface.positions))
        in.fail(bad_corner("face", static_cast<std::int64_t>(f), v, surface.positions.size()));
      corner = static_cast<std::uint32_t>(v);
    }
    in.skip(NumberType::f32, numbers - 3, "the patch of a triangle");
  }
  require_faces(surface, name);
  return surface;
}

}  // namespace

Triangles parse_freesurfer(std::string_view bytes, std::string_view name) {
  using namespace std::string_view_literals;
  const std::size_t text = bytes.find("\n\n");
  if (bytes.substr(0, 3) != "\xFF\xFF\xFE"sv || text == bytes.npos)
    throw InputError(std::string(name) + ": is no surface of triangles of FreeSurfer");
  return read_freesurfer(ByteValues(bytes, name, std::endian::big, text + 2), name);
}

Triangles parse_freesurfer_ascii(std::string_view text, std::string_view name) {
  return read_freesurfer(TextValues(TextScanner(text, name)), name);
}

}  // namespace plexway::io

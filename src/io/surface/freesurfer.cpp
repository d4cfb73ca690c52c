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

class FreesurferReader : public BinaryNumbers<FreesurferReader> {
 public:
  FreesurferReader(std::string_view bytes, std::size_t at, std::string_view name)
      : BinaryNumbers(bytes, std::endian::big, at), name_(name) {}

  [[noreturn]] void fail(const std::string& cause) const {
    throw InputError(std::string(name_) + ": " + cause);
  }

  Triangles read() {
    const std::int64_t vertices = whole(NumberType::i32, "the number of vertices");
    const std::int64_t faces = whole(NumberType::i32, "the number of triangles");
    if (vertices < 0 || faces < 0) fail("a number of vertices or triangles is below 0");
    const auto bytes =
        static_cast<std::uint64_t>(vertices) * 12 + static_cast<std::uint64_t>(faces) * 12;
    if (bytes > bytes_left())
      fail("should have " + std::to_string(vertices) + " vertices and " + std::to_string(faces) +
           " triangles, but ends before");
    Triangles surface;
    surface.positions.resize(static_cast<std::size_t>(vertices));
    for (auto& position : surface.positions)
      for (double& x : position) x = real(NumberType::f32, "a coordinate");
    surface.triangles.resize(static_cast<std::size_t>(faces));
    for (std::size_t f = 0; f < surface.triangles.size(); ++f)
      for (std::uint32_t& corner : surface.triangles[f]) {
        const std::int64_t v = whole(NumberType::i32, "a corner");
        if (v < 0 || v >= vertices)
          fail(bad_corner("face", static_cast<std::int64_t>(f), v, surface.positions.size()));
        corner = static_cast<std::uint32_t>(v);
      }
    require_faces(surface, name_);
    return surface;
  }

 private:
  std::string_view name_;
};

}  // namespace

Triangles parse_freesurfer(std::string_view bytes, std::string_view name) {
  using namespace std::string_view_literals;
  const std::size_t text = bytes.find("\n\n");
  if (bytes.substr(0, 3) != "\xFF\xFF\xFE"sv || text == bytes.npos)
    throw InputError(std::string(name) + ": is no surface of triangles of FreeSurfer");
  return FreesurferReader(bytes, text + 2, name).read();
}

Triangles parse_freesurfer_ascii(std::string_view text, std::string_view name) {
  TextValues in(TextScanner(text, name));
  const auto count = [&](std::string_view what) {
    return checked_count(in, in.text_whole("the number of " + std::string(what)), what,
                         NumberType::f64, 4);
  };
  Triangles surface;
  surface.positions.resize(count("vertices"));
  surface.triangles.resize(count("triangles"));
  for (auto& position : surface.positions) {
    for (double& x : position) x = in.real(NumberType::f64, "a coordinate");
    in.skip(NumberType::f64, 1, "the patch of a vertex");
  }
  for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
    for (std::uint32_t& corner : surface.triangles[f]) {
      const std::int64_t v = in.text_whole("a corner");
      if (v < 0 || v >= std::ssize(surface.positions))
        in.fail(bad_corner("face", static_cast<std::int64_t>(f), v, surface.positions.size()));
      corner = static_cast<std::uint32_t>(v);
    }
    in.skip(NumberType::f64, 1, "the patch of a triangle");
  }
  require_faces(surface, name);
  return surface;
}

}  // namespace plexway::io

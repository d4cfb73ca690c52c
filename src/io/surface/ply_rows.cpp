// Binary Stanford PLY by ranges of rows.

#include <plexway/io/ply_rows.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>
#include <vector>

#include <plexway/error.hpp>

#include "io/surface/ply_body.hpp"

namespace plexway::io {
namespace {

/// Rows of one element, from bytes that start with the first of them.
class RowBytes : public BinaryNumbers<RowBytes> {
 public:
  RowBytes(std::string_view bytes, std::string_view name, std::endian order,
           const PlyElement& element)
      : BinaryNumbers(bytes, order, 0), name_(name), element_(element) {}

  [[noreturn]] void fail(const std::string& cause) const {
    throw InputError(std::string(name_) + ": " + quote(element_.name) + " element " +
                     std::to_string(row_) + ": " + cause);
  }
  void begin(std::uint64_t row) { row_ = row; }

 private:
  std::string_view name_;
  const PlyElement& element_;
  std::uint64_t row_ = 0;
};

/// The elements that a surface has.
struct RowLayout {
  PlyVertex vertex;
  PlyCorners face;
};

/// Bytes of a row where `corners`, if the element has it, is a list of three.
std::uint64_t row_size(const PlyElement& element, const PlyProperty* corners,
                       std::string_view name) {
  std::uint64_t size = 0;
  for (const PlyProperty& property : element.properties) {
    if (property.is_list && &property != corners)
      fail_ply_header(name, element.line,
                      "element " + quote(element.name) + " has a list " + quote(property.name) +
                          ", so its rows have no fixed size and are not read in parts");
    size += property.is_list ? size_of(property.count_type) + 3 * size_of(property.type)
                             : size_of(property.type);
  }
  return size;
}

}  // namespace

struct PlyRows::State {
  explicit State(const std::filesystem::path& file)
      : name(file.string()), opened{::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)} {
    if (opened.descriptor < 0) {
      if (errno == ENOENT) fail("no such file");
      refused(errno);
    }
    struct stat status {};
    if (::fstat(opened.descriptor, &status) != 0) refused(errno);
    if (S_ISDIR(status.st_mode)) fail("is a directory, not a file");
    if (!S_ISREG(status.st_mode)) fail("must be a regular file: it is read in parts");
    size = static_cast<std::uint64_t>(status.st_size);
    if (size == 0) fail("is empty");
    read_header();
  }
  [[noreturn]] void fail(const std::string& cause) const { throw InputError(name + ": " + cause); }
  [[noreturn]] void refused(int code) const {
    fail("cannot be read: " + std::generic_category().message(code));
  }

  void read(std::uint64_t offset, std::span<char> bytes) const {
    while (!bytes.empty()) {
      const ssize_t got =
          ::pread(opened.descriptor, bytes.data(), bytes.size(), static_cast<off_t>(offset));
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) refused(errno);
      if (got == 0) fail("ends before its last row");
      bytes = bytes.subspan(static_cast<std::size_t>(got));
      offset += static_cast<std::uint64_t>(got);
    }
  }

  /// Of more and more bytes, until it ends in them.
  void parse_header() {
    constexpr std::uint64_t most = std::uint64_t{1} << 24;
    for (std::uint64_t room = std::uint64_t{1} << 16;; room *= 4) {
      head.resize(static_cast<std::size_t>(std::min(room, size)));
      read(0, head);
      try {
        header = parse_ply_header(head, name);
        return;
      } catch (const InputError&) {
        if (room >= std::min(most, size)) throw;
      }
    }
  }

  void read_header() {
    parse_header();
    if (header.format == PlyFormat::ascii)
      fail("is text, which is not read in parts: convert it to a binary .ply");
    surface = std::make_unique<RowLayout>(RowLayout{{header, name}, {header, "face", name}});
    if (surface->face.element == nullptr || surface->face.element->count == 0)
      fail("has no faces; a surface needs at least one triangle");
    std::uint64_t at = header.size;
    for (const PlyElement& element : header.elements) {
      const bool has_vertices = &element == surface->vertex.element;
      if (element.properties.empty() || (element.count == 0 && !has_vertices)) continue;
      const std::uint64_t row = row_size(element, surface->face.list, name);
      if (element.count > (size - at) / row)
        fail("the header says " + std::to_string(element.count) + " " + quote(element.name) +
             " elements, but only " + std::to_string(size - at) + " bytes follow");
      if (has_vertices) vertices = {at, row};
      if (&element == surface->face.element) faces = {at, row};
      at += element.count * row;
    }
    check_end(at);
  }

  /// As PlyBytes::finish.
  void check_end(std::uint64_t at) const {
    std::string some;
    for (; at < size; at += some.size()) {
      some.resize(static_cast<std::size_t>(std::min(size - at, std::uint64_t{1} << 16)));
      read(at, some);
      if (const std::size_t other = some.find_first_not_of(ply_padding); other != some.npos)
        fail("byte " + std::to_string(at + other) +
             ": the file goes on after its last element: it has more than its header says, or "
             "faces with more than three corners, and in parts only triangles are read");
    }
  }

  struct Rows {
    std::uint64_t begin = 0, size = 0;  ///< of the first; of each
  };

  /// Calls take(source, row) for each of a range, some bytes at a time.
  template <class Take>
  void each_row(const Rows& rows, const PlyElement& element, std::size_t first, std::size_t count,
                const Take& take) const {
    constexpr std::size_t some = std::size_t{1} << 20;
    const std::size_t at_a_time = std::max<std::size_t>(some / rows.size, 1);
    std::vector<char> bytes;
    for (std::size_t done = 0; done < count; done += at_a_time) {
      const std::size_t now = std::min(at_a_time, count - done);
      bytes.resize(now * rows.size);
      read(rows.begin + (first + done) * rows.size, bytes);
      RowBytes source(
          std::string_view(bytes.data(), bytes.size()), name,
          header.format == PlyFormat::big_endian ? std::endian::big : std::endian::little, element);
      for (std::size_t i = 0; i < now; ++i) {
        source.begin(first + done + i);
        take(source, done + i);
      }
    }
  }

  struct Opened {
    int descriptor;
    ~Opened() {
      if (descriptor >= 0) ::close(descriptor);
    }
  };

  std::string name;
  Opened opened;
  std::uint64_t size = 0;
  std::string head;  ///< which the header's names point into
  PlyHeader header;
  std::unique_ptr<RowLayout> surface;
  Rows vertices, faces;
};

PlyRows::PlyRows(const std::filesystem::path& file) : state_(std::make_unique<State>(file)) {}
PlyRows::~PlyRows() = default;

std::size_t PlyRows::vertex_count() const { return state_->surface->vertex.element->count; }
std::size_t PlyRows::face_count() const { return state_->surface->face.element->count; }

void PlyRows::read_vertices(std::size_t first, std::span<std::array<double, 3>> positions) const {
  const PlyVertex& vertex = state_->surface->vertex;
  state_->each_row(state_->vertices, *vertex.element, first, positions.size(),
                   [&](RowBytes& source, std::size_t i) {
                     for (const PlyProperty& property : vertex.element->properties)
                       if (!vertex.take(source, property, positions[i]))
                         source.skip(property.type, 1, last_property);
                   });
}

void PlyRows::read_faces(std::size_t first, std::span<std::array<Index, 3>> corners) const {
  const RowLayout& surface = *state_->surface;
  state_->each_row(
      state_->faces, *surface.face.element, first, corners.size(),
      [&](RowBytes& source, std::size_t i) {
        for (const PlyProperty& property : surface.face.element->properties) {
          if (&property != surface.face.list) {
            source.skip(property.type, 1, last_property);
            continue;
          }
          const auto count = source.whole(property.count_type, "the number of corners");
          if (count != 3)
            source.fail(
                "it, or one before it, has not three corners: in parts only triangles are "
                "read");
          for (Index& v : corners[i]) {
            const std::int64_t index = source.whole(property.type, "a vertex of the face");
            if (index < 0 || static_cast<std::uint64_t>(index) >= vertex_count())
              source.fail(
                  bad_corner("face", static_cast<std::int64_t>(first + i), index, vertex_count()));
            v = static_cast<Index>(index);
          }
        }
      });
}

}  // namespace plexway::io

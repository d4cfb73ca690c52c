#include "opened_file.hpp"

#include <algorithm>

#include <plexway/error.hpp>

#include "extension.hpp"

#if PLEXWAY_IO_ZLIB
#include <zlib.h>
#endif

namespace plexway::io {
namespace {

#if PLEXWAY_IO_ZLIB
std::string unpacked(std::string_view bytes, const std::string& name) {
  // Meshes pack to a fifth or a tenth; what packs to a hundredth is none.
  const std::size_t room = (std::size_t{1} << 26) + 100 * bytes.size();
  std::string out(std::min<std::size_t>(room, 4 * bytes.size() + 64), '\0');
  z_stream stream{};
  if (inflateInit2(&stream, 15 + 16) != Z_OK) throw Error("zlib does not start");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(std::min<std::size_t>(bytes.size(), 1U << 31));
  int state = Z_OK;
  while (state == Z_OK) {
    if (stream.total_out == out.size()) out.resize(std::min(room, 2 * out.size()));
    stream.next_out = reinterpret_cast<Bytef*>(out.data() + stream.total_out);
    stream.avail_out =
        static_cast<uInt>(std::min<std::size_t>(out.size() - stream.total_out, 1U << 30));
    state = inflate(&stream, Z_NO_FLUSH);
  }
  out.resize(stream.total_out);
  inflateEnd(&stream);
  if (state != Z_STREAM_END) throw InputError(name + ": does not unpack: it is cut off or no mesh");
  return out;
}
#else
std::string unpacked(std::string_view, const std::string& name) {
  throw NotBuiltError(name +
                      ": this plexway unpacks no .gz: install zlib1g-dev and build it again, "
                      "or unpack the file");
}
#endif

}  // namespace

OpenedFile::OpenedFile(const std::filesystem::path& file) : name_(file.string()), input_(file) {
  if (input_.extension == ".gz") input_.extension = lower_extension(input_.file.stem());
}

std::string_view OpenedFile::bytes() const {
  if (!bytes_) {
    bytes_.emplace(name_);
    if (bytes_->view().starts_with("\x1F\x8B")) unpacked_ = unpacked(bytes_->view(), name_);
  }
  return unpacked_.empty() ? bytes_->view() : unpacked_;
}

}  // namespace plexway::io

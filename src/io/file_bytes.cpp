#include "io/file_bytes.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <map>
#include <mutex>
#include <string>
#include <system_error>
#include <utility>

#include <plexway/error.hpp>

#include "io/names.hpp"

#if PLEXWAY_IO_ZLIB
#include <zlib.h>
#endif

namespace plexway::io {
namespace {

struct Close {
  void operator()(std::FILE* f) const {
    if (f != stdin) std::fclose(f);
  }
};

struct Kept {
  std::shared_ptr<char[]> bytes;
  std::size_t size = 0;
};

std::atomic<bool> keeps_streams = false;

// Those read so far, by name.
std::map<std::string, Kept>& kept_streams() {
  static std::map<std::string, Kept> kept;
  return kept;
}
std::mutex kept_lock;

}  // namespace

void FileBytes::keep_streams() { keeps_streams = true; }

FileBytes::FileBytes(const std::filesystem::path& name, std::size_t most) {
  const auto fail = [&](const std::string& cause) {
    throw InputError(name.string() + ": " + cause);
  };
  const auto refused = [&](int code) {
    fail("cannot be read: " + std::generic_category().message(code));
  };
  const InputName input(name);
  std::error_code ignored;
  std::uintmax_t guess = 0;
  bool stream = true;
  if (!input.standard_input) {
    const auto status = std::filesystem::status(input.file, ignored);
    if (status.type() == std::filesystem::file_type::not_found) fail("no such file");
    if (std::filesystem::is_directory(status)) fail("is a directory, not a file");
    stream = !std::filesystem::is_regular_file(status);
    // A pipe does not know its size, and a file may grow: the size is only a first guess.
    if (!stream) guess = std::filesystem::file_size(input.file, ignored);
    if (ignored) guess = 0;
  }
  const bool keeps = stream && keeps_streams;
  std::unique_lock<std::mutex> lock(kept_lock, std::defer_lock);
  if (keeps) {
    lock.lock();
    if (const auto found = kept_streams().find(input.file.string());
        found != kept_streams().end()) {
      bytes_ = found->second.bytes;
      size_ = found->second.size;
      return;
    }
  }

  const std::unique_ptr<std::FILE, Close> in(
      input.standard_input ? stdin : std::fopen(input.file.c_str(), "rb"));
  if (!in) refused(errno);
  const std::size_t limit = stream ? SIZE_MAX : most;
  auto room =
      std::min(limit, static_cast<std::size_t>(std::max<std::uintmax_t>(guess + 1, 1U << 16)));
  auto bytes = std::make_unique_for_overwrite<char[]>(room);
  for (;;) {
    size_ += std::fread(bytes.get() + size_, 1, room - size_, in.get());
    if (size_ < room || size_ == limit) break;
    auto larger = std::make_unique_for_overwrite<char[]>(2 * room);
    std::copy_n(bytes.get(), size_, larger.get());
    bytes = std::move(larger);
    room *= 2;
  }
  if (std::ferror(in.get()) != 0) refused(errno);
  if (size_ == 0) fail("is empty");
  bytes_ = std::move(bytes);
  if (keeps) kept_streams()[input.file.string()] = {bytes_, size_};
}

#if PLEXWAY_IO_ZLIB
std::string inflated(std::string_view packed, Deflated how, std::size_t room,
                     std::string_view name) {
  std::string out(std::min<std::size_t>(room, 4 * packed.size() + 64), '\0');
  z_stream stream{};
  if (inflateInit2(&stream, static_cast<int>(how)) != Z_OK) throw Error("zlib does not start");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  int state = Z_OK;
  while (state == Z_OK) {
    stream.avail_in =
        static_cast<uInt>(std::min<std::size_t>(packed.size() - stream.total_in, 1U << 31));
    if (stream.total_out == out.size()) out.resize(std::min(room, 2 * out.size()));
    stream.next_out = reinterpret_cast<Bytef*>(out.data() + stream.total_out);
    stream.avail_out =
        static_cast<uInt>(std::min<std::size_t>(out.size() - stream.total_out, 1U << 30));
    state = inflate(&stream, Z_NO_FLUSH);
  }
  out.resize(stream.total_out);
  inflateEnd(&stream);
  if (state != Z_STREAM_END)
    throw InputError(std::string(name) +
                     ": does not unpack: it is cut off, broken or out of proportion");
  return out;
}
#else
std::string inflated(std::string_view, Deflated, std::size_t, std::string_view name) {
  throw NotBuiltError(
      std::string(name) +
      ": is packed, and this plexway was built without zlib: install zlib1g-dev and "
      "build it again, or save the file without compression");
}
#endif

OpenedFile::OpenedFile(const std::filesystem::path& file) : name_(file.string()), input_(file) {
  if (input_.extension == ".gz") input_.extension = lower_extension(input_.file.stem());
}

OpenedFile::OpenedFile(const std::filesystem::path& file, std::string_view bytes)
    : OpenedFile(file) {
  bytes_ = bytes;
}

std::string_view OpenedFile::bytes() const {
  if (!bytes_) bytes_ = file_.emplace(name_).view();
  if (unpacked_.empty() && bytes_->starts_with("\x1F\x8B")) {
    // Meshes pack to a fifth or a tenth; what packs to a hundredth is none.
    const std::size_t room = (std::size_t{1} << 26) + 100 * bytes_->size();
    std::string unpacked = inflated(*bytes_, Deflated::gzip, room, name_);
    // What unpacks twice would be bounded by the larger bytes between.
    if (unpacked.starts_with("PK\x03\x04") || unpacked.starts_with("DRACO"))
      throw InputError(name_ + ": is gzip around what is already packed: unpack it with gunzip");
    unpacked_ = std::move(unpacked);
  }
  return unpacked_.empty() ? *bytes_ : unpacked_;
}

}  // namespace plexway::io

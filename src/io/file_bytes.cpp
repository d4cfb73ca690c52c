#include "file_bytes.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <string>
#include <system_error>

#include <plexway/error.hpp>

namespace plexway::io {
namespace {

using File = std::unique_ptr<std::FILE, decltype([](std::FILE* f) { std::fclose(f); })>;

}  // namespace

FileBytes::FileBytes(const std::filesystem::path& file) {
  const auto fail = [&](const std::string& cause) {
    throw InputError(file.string() + ": " + cause);
  };
  const auto refused = [&](int code) {
    fail("cannot be read: " + std::generic_category().message(code));
  };
  std::error_code ignored;
  const auto status = std::filesystem::status(file, ignored);
  if (status.type() == std::filesystem::file_type::not_found) fail("no such file");
  if (std::filesystem::is_directory(status)) fail("is a directory, not a file");

  const File in(std::fopen(file.c_str(), "rb"));
  if (!in) refused(errno);
  // A pipe does not know its size, and a file may grow: the size is only a first guess.
  std::uintmax_t guess = 0;
  if (std::filesystem::is_regular_file(status)) {
    guess = std::filesystem::file_size(file, ignored);
    if (ignored) guess = 0;
  }
  auto room = static_cast<std::size_t>(std::max<std::uintmax_t>(guess + 1, 1U << 16));
  bytes_ = std::make_unique_for_overwrite<char[]>(room);
  for (;;) {
    size_ += std::fread(bytes_.get() + size_, 1, room - size_, in.get());
    if (size_ < room) break;
    auto larger = std::make_unique_for_overwrite<char[]>(2 * room);
    std::copy_n(bytes_.get(), size_, larger.get());
    bytes_ = std::move(larger);
    room *= 2;
  }
  if (std::ferror(in.get()) != 0) refused(errno);
  if (size_ == 0) fail("is empty");
}

}  // namespace plexway::io

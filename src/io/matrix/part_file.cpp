#include <plexway/io/matrix_file.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>

#include <plexway/error.hpp>

namespace plexway::io {

namespace fs = std::filesystem;

fs::path PartFile::path_of(const fs::path& out) {
  fs::path path = out;
  return path += ".part";
}

PartFile::PartFile(const fs::path& out, bool resume, std::uint64_t end)
    : out_(out), path_(path_of(out)) {
  file_ = ::open(path_.c_str(), O_RDWR | O_CLOEXEC | (resume ? 0 : O_CREAT | O_TRUNC), 0666);
  if (file_ < 0 && resume && errno == ENOENT)
    throw Error("cannot go on with " + out_.string() + ": " + path_.string() +
                " is gone; remove the .journal beside it to begin anew");
  if (file_ < 0) refused(errno);
  struct stat status {};
  if (::fstat(file_, &status) != 0) refused(errno);
  if (resume && static_cast<std::uint64_t>(status.st_size) > end &&
      ::ftruncate(file_, static_cast<off_t>(end)) != 0)
    refused(errno);
}

PartFile::~PartFile() {
  if (file_ >= 0) ::close(file_);
}

void PartFile::write(std::uint64_t offset, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t wrote = ::pwrite(file_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote < 0) refused(errno);
    bytes.remove_prefix(static_cast<std::size_t>(wrote));
    offset += static_cast<std::uint64_t>(wrote);
  }
}

void PartFile::read(std::uint64_t offset, std::span<char> bytes) const {
  while (!bytes.empty()) {
    const ssize_t got = ::pread(file_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) refused(errno);
    if (got == 0)
      throw Error("cannot go on with " + out_.string() + ": " + path_.string() +
                  " is shorter than its journal says; remove both to begin anew");
    bytes = bytes.subspan(static_cast<std::size_t>(got));
    offset += static_cast<std::uint64_t>(got);
  }
}

void PartFile::sync() {
  if (::fdatasync(file_) != 0 && errno != EINVAL) refused(errno);
}

void PartFile::commit() {
  if (::fsync(file_) != 0 && errno != EINVAL) refused(errno);
  std::error_code error;
  fs::rename(path_, out_, error);
  if (error) refused(error.value());
}

void PartFile::remove() {
  if (::unlink(path_.c_str()) != 0) refused(errno);
}

void PartFile::refused(int code) const {
  throw Error("cannot write " + out_.string() + ": " + std::generic_category().message(code));
}

void check_room(const fs::path& out, double bytes) {
  std::error_code error;
  const fs::path folder = out.has_parent_path() ? out.parent_path() : fs::path(".");
  const fs::space_info space = fs::space(folder, error);
  if (error) return;  // then writing will tell
  struct stat status {};
  const double there = ::stat(PartFile::path_of(out).c_str(), &status) == 0
                           ? 512 * static_cast<double>(status.st_blocks)
                           : 0;
  const double free = static_cast<double>(space.available);
  if (bytes - there > free)
    throw Error("cannot write " + out.string() + ": it takes " + short_bytes(bytes - there) +
                ", and the disk has " + short_bytes(free) + " free");
}

std::string short_bytes(double bytes) {
  const char* const units[] = {"bytes", "kB", "MB", "GB", "TB", "PB"};
  std::size_t unit = 0;
  while (bytes >= 999.5 && unit + 1 < std::size(units)) bytes /= 1000, ++unit;
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %s", bytes, units[unit]);
  return text;
}

}  // namespace plexway::io

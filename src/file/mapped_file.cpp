#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include <plexway/error.hpp>

#include "file/mapped_file.hpp"

namespace plexway::detail::file {

namespace {

// No fault for each few pages, as all of them are read soon; and what is fetched ahead is there.
#ifdef MAP_POPULATE
constexpr int all_at_once = MAP_POPULATE;
#else
constexpr int all_at_once = 0;
#endif

}  // namespace

MappedFile::MappedFile(const std::filesystem::path& file) {
  const auto fail = [&](const std::string& cause) {
    throw InputError(file.string() + ": " + cause);
  };
  const auto refused = [&](int code) {
    fail("cannot be read: " + std::generic_category().message(code));
  };
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) {
    if (errno == ENOENT) fail("no such file");
    refused(errno);
  }
  struct stat status {};
  const bool known = ::fstat(descriptor, &status) == 0;
  void* start = MAP_FAILED;
  int code = errno;
  const bool regular = known && S_ISREG(status.st_mode);
  if (regular && status.st_size > 0) {
    size_ = static_cast<std::size_t>(status.st_size);
    start = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE | all_at_once, descriptor, 0);
    code = errno;
  }
  ::close(descriptor);
  if (known && S_ISDIR(status.st_mode)) fail("is a directory, not a file");
  if (known && !regular) fail("must be a regular file: it is mapped, not read");
  if (known && size_ == 0) fail("is empty");
  if (start == MAP_FAILED) refused(code);
  start_ = static_cast<const std::byte*>(start);
}

MappedFile::~MappedFile() { ::munmap(const_cast<std::byte*>(start_), size_); }

namespace {

// One to one in both of its arguments, so that nothing that differs becomes the same.
std::uint64_t mixed(std::uint64_t before, std::uint64_t word) {
  const std::uint64_t product = (before ^ word) * 0x9e3779b97f4a7c15;
  return product ^ (product >> 32);
}

}  // namespace

void Checksum::add(const std::byte* bytes, std::size_t size) {
  // The processor itself fetches ahead only to the end of a page.
  constexpr std::size_t ahead = 4096;
  std::array<std::uint64_t, lanes> lane = lane_;
  for (std::size_t at = 0; at < size; at += block) {
    if (at + ahead < size) __builtin_prefetch(bytes + at + ahead);
    for (std::size_t i = 0; i < lanes; ++i) {
      std::uint64_t word;
      std::memcpy(&word, bytes + at + sizeof(word) * i, sizeof(word));
      lane[i] = mixed(lane[i], word);
    }
  }
  lane_ = lane;
}

std::uint64_t Checksum::value() const {
  std::uint64_t all = 0;
  for (const std::uint64_t one : lane_) all = mixed(all, one);
  return all;
}

}  // namespace plexway::detail::file

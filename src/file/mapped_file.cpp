#include "file/mapped_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include <plexway/error.hpp>

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

}  // namespace plexway::detail::file

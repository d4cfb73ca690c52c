// GIfTI: a surface, and the same bytes as labels.

#include <sys/mman.h>
#include <unistd.h>

#include <string>

#include "fuzz_reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::check_reader(plexway::io::parse_gifti, data, size);
  const int bytes = ::memfd_create("input", 0);
  fuzz::require(bytes >= 0, "a file in memory");
  const ssize_t written = ::write(bytes, data, size);
  fuzz::require(written == static_cast<ssize_t>(size), "all bytes in memory");
  const std::string name = "/proc/self/fd/" + std::to_string(bytes);
  try {
    (void)plexway::io::read_gifti_labels(name);
  } catch (const plexway::InputError& error) {
    const std::string_view message = error.what();
    fuzz::require(message.starts_with(name), "a message names the file");
    for (const char c : message)
      fuzz::require(c >= ' ' && c <= '~', "a message is one printable line");
  }
  ::close(bytes);
  return 0;
}

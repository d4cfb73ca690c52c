// The tool's own small files: rows of numbers (sources, metrics, spacings), true distances, tables.
// The first byte says which.

#include <sys/mman.h>
#include <unistd.h>

#include <string>

#include "any/errors/truth_file.hpp"
#include "any/tuning/policy_file.hpp"
#include "fuzz_reader.hpp"
#include "io/number_rows.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const int bytes = ::memfd_create("input", 0);
  fuzz::require(bytes >= 0, "a file in memory");
  const std::uint8_t kind = data[0];
  const ssize_t written = ::write(bytes, data + 1, size - 1);
  fuzz::require(written == static_cast<ssize_t>(size - 1), "all bytes in memory");
  const std::string name = "/proc/self/fd/" + std::to_string(bytes);
  try {
    switch (kind % 4) {
      case 0:
        for (const auto& row : plexway::io::read_number_rows(name, 1, 6, "numbers"))
          for (const double x : row.numbers) fuzz::require(!std::isnan(x), "no NaN in a row");
        break;
      case 1:
        for (const double x : plexway::read_truth(name, 3 + kind / 16))
          fuzz::require(!(x < 0), "no distance below 0");
        break;
      case 2:
        (void)plexway::read_probe_table(name);
        break;
      default:
        (void)plexway::read_saddle_thresholds(name);
    }
  } catch (const plexway::InputError& error) {
    const std::string_view message = error.what();
    fuzz::require(message.starts_with(name), "a message names the file");
    for (const char c : message)
      fuzz::require(c >= ' ' && c <= '~', "a message is one printable line");
  }
  ::close(bytes);
  return 0;
}

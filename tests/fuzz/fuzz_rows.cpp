// The tool's own small files: rows of numbers (sources, metrics, spacings), true distances, tables.
// The first byte says which.

#include "fuzz_reader.hpp"
#include "io/number_rows.hpp"
#include "shape/errors/measures.hpp"
#include "shape/tuning/tuning.hpp"

PLEXWAY_FUZZER(rows)(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::uint8_t kind = data[0];
  const fuzz::MemoryFile file(data + 1, size - 1);
  const std::string name = file.name();
  return fuzz::check_input(name, [&] {
    switch (kind % 4) {
      case 0:
        for (const auto& row : plexway::io::read_number_rows(name, 1, 6, "numbers"))
          for (const double x : row.numbers) fuzz::require(!std::isnan(x), "no NaN in a row");
        break;
      case 1:
        for (const double x : plexway::detail::read_truth(name, 3 + kind / 16))
          fuzz::require(!(x < 0), "no distance below 0");
        break;
      case 2:
        (void)plexway::detail::read_probe_table(name);
        break;
      default:
        (void)plexway::detail::read_saddle_thresholds(name);
    }
  });
}

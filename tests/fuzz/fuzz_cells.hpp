#pragma once

#include <plexway/io/mixed.hpp>

#include "fuzz_reader.hpp"

namespace fuzz {

/// What every reader of files of any kind promises for any bytes: points, and cells of them, or an
/// InputError of one line that starts with the file's name.
template <class Parser>
int check_cells(Parser parse, const std::uint8_t* data, std::size_t size) {
  try {
    const plexway::io::Mixed cells = parse({reinterpret_cast<const char*>(data), size}, "input");
    require(!cells.positions.empty(), "there are points");
    for (const auto& position : cells.positions)
      for (const double c : position) require(std::isfinite(c), "coordinates are finite");
    const auto in_range = [&](const auto& rows) {
      for (const auto& row : rows)
        for (const auto vertex : row)
          require(vertex < cells.positions.size(), "indices are in range");
    };
    in_range(cells.edges);
    in_range(cells.triangles);
    in_range(cells.tets);
  } catch (const plexway::InputError& error) {
    const std::string_view message = error.what();
    require(message.starts_with("input:"), "a message names the file");
    for (const char c : message) require(c >= ' ' && c <= '~', "a message is one printable line");
  } catch (const plexway::NotBuiltError&) {
    // A build without pugixml, zlib or nlohmann-json may say so.
  }
  return 0;
}

}  // namespace fuzz

#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plexway::io {

/// What a reader cut, dropped, passed over or repaired.
struct FileReport {
  std::size_t split_polygons = 0;  ///< of more than three corners, cut into triangles
  std::size_t split_cells = 0;     ///< hexahedra, prisms and pyramids, cut into tetrahedra
  /// Cells that have no place in a domain of what has most dimensions: "triangles", and how many.
  std::vector<std::pair<std::string, std::size_t>> passed_over = {};
  /// What was guessed or repaired: sentences without the file's name.
  std::vector<std::string> notes = {};

  /// Counts `count` more of what is passed over.
  void pass_over(std::string_view what, std::size_t count) {
    if (count == 0) return;
    for (auto& [name, so_far] : passed_over)
      if (name == what) return static_cast<void>(so_far += count);
    passed_over.emplace_back(what, count);
  }
  /// "12 triangles, 3 lines"; empty for none.
  [[nodiscard]] std::string passed_over_text() const {
    std::string list;
    for (const auto& [name, count] : passed_over)
      list += (list.empty() ? "" : ", ") + std::to_string(count) + " " + name;
    return list;
  }
};

}  // namespace plexway::io

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/io/mixed.hpp>
#include <plexway/io/tets.hpp>

#include "surface_checks.hpp"

namespace plexway::io {

inline constexpr std::string_view axis_names[3] = {"coordinate x", "coordinate y", "coordinate z"};

/// Counts the cells that are passed over, so that a file without tetrahedra can be told what it
/// has instead.
class OtherCells {
 public:
  void add(std::string_view kind, std::uint64_t count = 1) {
    if (count == 0) return;
    for (auto& [name, so_far] : kinds_) {
      if (name == kind) {
        so_far += count;
        return;
      }
    }
    kinds_.emplace_back(kind, count);
  }

  [[nodiscard]] bool empty() const { return kinds_.empty(); }

  /// "12 triangles, 3 lines"; "no cells at all".
  std::string text() const {
    std::string list;
    for (const auto& [name, count] : kinds_)
      list += (list.empty() ? "" : ", ") + std::to_string(count) + " " + name;
    return list.empty() ? "no cells at all" : list;
  }

 private:
  std::vector<std::pair<std::string, std::uint64_t>> kinds_;
};

/// Which cells a reader takes: tetrahedra, passing over all others; whatever a mixed domain can
/// have, and nothing else; or whatever there is, where tetrahedra let it pass over others.
enum class Take { tets, mixed, any };

inline void require_tets(const Tets& solid, const OtherCells& others, std::string_view name) {
  if (solid.tets.empty())
    throw InputError(std::string(name) + ": has no tetrahedra; it has " + others.text());
}

/// Throws where there is nothing of what is taken, or where something would be missing.
inline void require_cells(const Mixed& cells, const OtherCells& others, Take take,
                          std::string_view name) {
  if (take == Take::tets) {
    if (cells.tets.empty()) require_tets({}, others, name);
    return;
  }
  if (take == Take::any && !cells.tets.empty()) return;
  if (!others.empty())
    throw InputError(std::string(name) + ": has " + others.text() +
                     "; a domain is made of lines, polygons and tetrahedra");
  if (take == Take::any && !cells.positions.empty()) return;  // points may be a cloud
  if (cells.edges.empty() && cells.triangles.empty() && cells.tets.empty())
    throw InputError(std::string(name) + ": has no lines, triangles or tetrahedra");
}

inline Tets tets_of(Mixed cells) { return {std::move(cells.positions), std::move(cells.tets)}; }

/// What is wrong with a tetrahedron that names a vertex the file does not have. Both as the file
/// counts them.
inline std::string bad_corner(std::int64_t tet, std::int64_t vertex, std::size_t vertices) {
  return "tetrahedron " + std::to_string(tet) + " names vertex " + std::to_string(vertex) +
         ", but the file has " + std::to_string(vertices) + " vertices";
}

}  // namespace plexway::io

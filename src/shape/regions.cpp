#include <utility>
#include <variant>

#include <plexway/error.hpp>
#include <plexway/io/mixed.hpp>
#include <plexway/io/regions.hpp>
#include <plexway/shape/shape.hpp>
#include <plexway/support.hpp>

#include "shape/words.hpp"

namespace plexway {
std::vector<std::int64_t> AnyShape::regions() const {
  support(Purpose::regions, kind()).require();
  if (file().empty()) throw UsageError("regions come from a file, and this shape has none");
  const std::string name = file().string();
  const auto foreign = [&](std::size_t cells) {
    return UsageError(name + " has regions of " + counted(cells, "cells") + ", which are not the " +
                      counted(simplices(), simplex_name()) + " of the domain");
  };
  io::Regions found = io::read_regions(file());
  std::vector<std::int64_t> regions;
  if (kind() == DomainKind::solid) {
    regions = std::move(found.tets);
  } else if (kind() == DomainKind::mixed) {
    for (const auto* list : {&found.edges, &found.triangles, &found.tets})
      regions.insert(regions.end(), list->begin(), list->end());
  } else {
    const io::Mixed cells = io::read_cells(file());
    if (const auto* surface = std::get_if<io::Triangles>(&data())) {
      if (cells.triangles != surface->triangles) throw foreign(cells.triangles.size());
      regions = std::move(found.triangles);
    } else {
      if (cells.edges != std::get<io::Edges>(data()).edges) throw foreign(cells.edges.size());
      regions = std::move(found.edges);
    }
  }
  if (regions.size() != simplices()) throw foreign(regions.size());
  return regions;
}

}  // namespace plexway

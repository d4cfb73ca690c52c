#include "shape/collapsed.hpp"

#include <type_traits>
#include <variant>

#include <plexway/error.hpp>

#include "shape/words.hpp"

namespace plexway {
namespace {

template <class Corners>
bool has_twice(const Corners& corners) {
  for (std::size_t i = 1; i < corners.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (corners[i] == corners[j]) return true;
  return false;
}

}  // namespace

void find_collapsed(AnyShape::State& state) {
  Index number = 0;
  const auto look = [&](const auto& rows) {
    for (const auto& row : rows) {
      if (has_twice(row)) state.collapsed.push_back(number);
      ++number;
    }
  };
  std::visit(
      [&](const auto& data) {
        using Data = std::decay_t<decltype(data)>;
        if constexpr (std::is_same_v<Data, io::Triangles>) {
          look(data.triangles);
        } else if constexpr (std::is_same_v<Data, io::Tets>) {
          look(data.tets);
        } else if constexpr (std::is_same_v<Data, SimplexShape>) {
          const auto corners = static_cast<std::size_t>(data.dimension) + 1;
          for (std::size_t at = 0; at < data.corners.size(); at += corners, ++number)
            if (has_twice(std::span(data.corners).subspan(at, corners)))
              state.collapsed.push_back(number);
        } else if constexpr (std::is_same_v<Data, MixedShape>) {
          for (const MixedShape::Part& part : data.parts) {
            number += static_cast<Index>(part.edges.size());
            look(part.triangles);
            look(part.tets);
          }
        }
      },
      state.data);
}

std::string collapsed_sentence(const AnyShape& shape) {
  const auto collapsed = shape.collapsed();
  if (collapsed.empty()) return "";
  const std::string first = std::to_string(collapsed.front());
  return counted(collapsed.size(), shape.simplex_name()) +
         (collapsed.size() == 1
              ? " (" + first + ") has a corner twice and is left out"
              : " (" + first + " is the first) have a corner twice and are left out");
}

std::shared_ptr<const Mask> without_collapsed(const AnyShape& shape,
                                              std::shared_ptr<const Mask> mask) {
  if (shape.collapsed().empty()) return mask;
  if (shape.collapsed().size() == shape.simplices())
    throw InputError("all " + counted(shape.simplices(), shape.simplex_name()) +
                     " have a corner twice: there is nothing to go along");
  auto open = mask ? std::make_shared<Mask>(*mask)
                   : std::make_shared<Mask>(shape.vertices(), shape.simplices());
  for (const Index simplex : shape.collapsed()) open->close_simplex(simplex);
  return open;
}

}  // namespace plexway

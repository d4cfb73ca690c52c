#include "any/arguments/mask_argument.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include <plexway/error.hpp>

#include "io/number_rows.hpp"

namespace plexway {
namespace {

// "vertices" or "simplices", and the file.
std::pair<std::string, std::string> parts_of(const MaskArgument& argument) {
  const std::size_t colon = argument.text.find(':');
  const std::string kind = argument.text.substr(0, colon);
  if (colon == argument.text.npos || (kind != "vertices" && kind != "simplices"))
    throw UsageError("--mask '" + argument.text + "': write vertices:FILE or simplices:FILE");
  return {kind, argument.text.substr(colon + 1)};
}

}  // namespace

std::string mask_file(const MaskArgument& argument) {
  return argument.text.empty() ? std::string() : parts_of(argument).second;
}

std::optional<Mask> read_mask(const MaskArgument& argument, const AnyShape& domain) {
  if (argument.text.empty()) return std::nullopt;
  const auto [kind, file] = parts_of(argument);
  if (domain.kind() != DomainKind::surface && domain.kind() != DomainKind::solid &&
      domain.kind() != DomainKind::wireframe)
    throw UsageError("--mask: for surfaces, solids and wireframes; leave points out of a cloud");
  Mask mask(domain.vertices(), domain.simplices());
  const bool vertices = kind == "vertices";
  for (const io::NumberRow& row :
       io::read_number_rows(file, 1, 1, "the number (0-based) of one of the " + kind + " a line")) {
    if (vertices) {
      mask.close_vertex(io::vertex_in(file, row, 0, domain.vertices()));
      continue;
    }
    const double s = row.numbers[0];
    if (!(s >= 0 && s == std::floor(s) && s < static_cast<double>(domain.simplices())))
      io::fail_at(file, row,
                  "no such simplex: the " + std::string(domain.simplex_name()) + " are 0 to " +
                      std::to_string(domain.simplices() - 1));
    mask.close_simplex(static_cast<Index>(s));
  }
  for (std::size_t s = 0; s < domain.simplices(); ++s) {
    const auto corners = domain.corners(s);
    if (mask.closed_simplices()[s] == 0 &&
        std::none_of(corners.begin(), corners.end(),
                     [&](std::uint32_t v) { return mask.closed_vertices()[v] != 0; }))
      return mask;
  }
  throw InputError(file + ": closes all of " + domain.file().string());
}

OpenParts::OpenParts(const Mask& mask, const AnyShape& domain)
    : mask_(mask), number_(domain.simplices(), none), reached_(domain.vertices(), 0) {
  for (std::size_t s = 0; s < domain.simplices(); ++s) {
    const auto corners = domain.corners(s);
    if (mask.closed_simplices()[s] != 0 ||
        std::any_of(corners.begin(), corners.end(),
                    [&](std::uint32_t v) { return mask.closed_vertices()[v] != 0; }))
      continue;
    number_[s] = static_cast<Index>(whole_.size());
    whole_.push_back(static_cast<Index>(s));
    for (const std::uint32_t v : corners) reached_[v] = 1;
  }
}

void OpenParts::check(Index vertex) const {
  if (reached_[vertex] != 0) return;
  throw InputError(
      "--mask: vertex " + std::to_string(vertex) +
      (mask_.closed_vertices()[vertex] != 0 ? " is masked" : " is cut off by the mask") +
      ": no path passes there");
}

Index OpenParts::open(Index simplex) const {
  if (number_[simplex] == none)
    throw InputError("--mask: simplex " + std::to_string(simplex) +
                     " is masked, and a point or a source lies in it: no path passes there");
  return number_[simplex];
}

void OpenParts::move(PointSource& point) const {
  if (point.vertex != none)
    check(point.vertex);
  else
    point.simplex = open(point.simplex);
}

void OpenParts::move(Source& source) const {
  if (auto* const point = std::get_if<PointSource>(&source)) move(*point);
  if (auto* const ball = std::get_if<BallSource>(&source)) move(ball->centre);
  if (auto* const whole = std::get_if<SimplexSource>(&source))
    whole->simplex = open(whole->simplex);
  if (const auto* const set = std::get_if<VertexSource>(&source))
    for (const Index v : set->vertices) check(v);
  if (auto* const curve = std::get_if<CurveSource>(&source))
    for (PointSource& point : curve->points)
      if (!names_nothing(point)) move(point);
}

AnyShape open_domain(const Mask& mask, const AnyShape& domain,
                     std::shared_ptr<const MeasuredLengths>& lengths) {
  const auto keep = [&](const auto& simplices, auto member, const MeasuredLengths* own) {
    const auto rows = [&](const MeasuredLengths& all) {
      return mask.open_rows(simplices, all.*member);
    };
    if (lengths != nullptr) {
      MeasuredLengths open = *lengths;
      open.*member = rows(*lengths);
      lengths = std::make_shared<const MeasuredLengths>(std::move(open));
    }
    return own == nullptr ? decltype(rows(*own))() : rows(*own);
  };
  const std::vector<std::array<double, 3>> positions(domain.positions().begin(),
                                                     domain.positions().end());
  const MeasuredLengths* own = domain.lengths();
  if (const auto* surface = std::get_if<io::Triangles>(&domain.data())) {
    const std::span<const std::array<Index, 3>> all = surface->triangles;
    auto kept = keep(all, &MeasuredLengths::triangles, own);
    return own == nullptr ? AnyShape::surface(positions, mask.open(all))
                          : AnyShape::surface(domain.vertices(), mask.open(all), std::move(kept));
  }
  if (const auto* solid = std::get_if<io::Tets>(&domain.data())) {
    const std::span<const std::array<Index, 4>> all = solid->tets;
    auto kept = keep(all, &MeasuredLengths::tets, own);
    return own == nullptr ? AnyShape::solid(positions, mask.open(all))
                          : AnyShape::solid(domain.vertices(), mask.open(all), std::move(kept));
  }
  const io::Edges& wire = std::get<io::Edges>(domain.data());
  const std::span<const std::array<Index, 2>> all = wire.edges;
  keep(all, &MeasuredLengths::edges, nullptr);
  return wire.lengths.empty() ? AnyShape::wireframe(positions, mask.open(all))
                              : AnyShape::wireframe(wire.vertices, mask.open(all),
                                                    mask.open_rows(all, wire.lengths));
}

}  // namespace plexway

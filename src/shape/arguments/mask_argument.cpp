#include "shape/arguments/arguments.hpp"
#include "shape/inside.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <set>
#include <string_view>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/io/labels.hpp>
#include <plexway/shape/open_simplices.hpp>

#include "io/number_rows.hpp"

namespace plexway {
using namespace detail;

namespace detail {

namespace {

enum class MaskKind { vertices, simplices, labels, regions };

struct ParsedMask {
  MaskKind kind;
  std::string file;
  std::set<std::int64_t> labels;
};

// "3,7", or nothing.
std::set<std::int64_t> whole_numbers(std::string_view text) {
  std::set<std::int64_t> numbers;
  for (const char* at = text.data(); at <= text.data() + text.size();) {
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(at, text.data() + text.size(), number);
    if (error != std::errc{}) return {};
    numbers.insert(number);
    if (end == text.data() + text.size()) return numbers;
    if (*end != ',') return {};
    at = end + 1;
  }
  return {};
}

ParsedMask parse_mask(const std::string& text, Spelling spelling) {
  const std::size_t first = text.find(':'), last = text.rfind(':');
  if (first != text.npos && first > 0 && first + 1 < text.size()) {
    const std::string kind = text.substr(0, first), rest = text.substr(first + 1);
    if (kind == "vertices") return {MaskKind::vertices, rest, {}};
    if (kind == "simplices") return {MaskKind::simplices, rest, {}};
    std::set<std::int64_t> labels = whole_numbers(std::string_view(text).substr(last + 1));
    if (!labels.empty() && kind == "regions" && first == last)
      return {MaskKind::regions, "", std::move(labels)};
    if (!labels.empty()) return {MaskKind::labels, text.substr(0, last), std::move(labels)};
  }
  throw UsageError(spelled(spelling, "mask") + " '" + text +
                   "': write vertices:FILE, simplices:FILE, FILE:3,7 (labels) or regions:3,7");
}

// Calls close(i) for those that have one of the labels, each of which must be there.
template <class Close>
void close_labelled(const std::vector<std::int64_t>& label, const std::set<std::int64_t>& closed,
                    const std::string& file, const char* what, const Close& close) {
  std::set<std::int64_t> unseen = closed;
  for (std::size_t i = 0; i < label.size(); ++i) {
    if (!closed.contains(label[i])) continue;
    unseen.erase(label[i]);
    close(static_cast<Index>(i));
  }
  if (!unseen.empty())
    throw InputError(file + ": nothing has the " + what + " " + std::to_string(*unseen.begin()));
}

void close_numbered(const ParsedMask& asked, const AnyShape& domain, Mask& mask) {
  const bool vertices = asked.kind == MaskKind::vertices;
  const std::string what = vertices ? "vertices" : "simplices";
  for (const io::NumberRow& row : io::read_number_rows(
           asked.file, 1, 1, "the number (0-based) of one of the " + what + " a line")) {
    if (vertices) {
      mask.close_vertex(io::vertex_in(asked.file, row, 0, domain.vertices()));
      continue;
    }
    const double s = row.numbers[0];
    if (!(s >= 0 && s == std::floor(s) && s < static_cast<double>(domain.simplices())))
      io::fail_at(asked.file, row,
                  "no such simplex: the " + std::string(domain.simplex_name()) + " are 0 to " +
                      std::to_string(domain.simplices() - 1));
    mask.close_simplex(static_cast<Index>(s));
  }
}

template <class Place>
void require_all(const Mask* mask, const AnyShape& domain, std::span<const Place> places) {
  if (mask == nullptr) return;
  const OpenSimplices open(*mask, domain);
  try {
    for (const Place& place : places) open.require(place);
  } catch (const UsageError& error) {
    throw InputError(std::string("--mask: ") + error.what());
  }
}

}  // namespace

std::string mask_file(const MaskArgument& argument) {
  return argument.text.empty() ? std::string() : parse_mask(argument.text, Spelling::flags).file;
}

std::shared_ptr<const Mask> read_mask(const MaskArgument& argument, const AnyShape& domain) {
  return argument.text.empty() ? nullptr : read_mask(argument.text, domain, Spelling::flags);
}

}  // namespace detail

std::shared_ptr<const Mask> read_mask(const std::string& text, const AnyShape& domain,
                                      Spelling spelling) {
  const ParsedMask asked = parse_mask(text, spelling);
  require(spelled(spelling, "mask"), support(Purpose::masks, domain.kind()));
  auto mask = std::make_shared<Mask>(domain.vertices(), domain.simplices());
  const auto close_vertex = [&](Index v) { mask->close_vertex(v); };
  const auto close_simplex = [&](Index s) { mask->close_simplex(s); };
  if (asked.kind == MaskKind::labels)
    close_labelled(io::read_vertex_labels(asked.file, domain.vertices()), asked.labels, asked.file,
                   "label", close_vertex);
  else if (asked.kind == MaskKind::regions)
    close_labelled(domain.regions(), asked.labels, domain.file().string(), "region", close_simplex);
  else
    close_numbered(asked, domain, *mask);
  for (std::size_t s = 0; s < domain.simplices(); ++s)
    if (mask->is_open(domain.corners(s), s)) return mask;
  throw InputError(spelled(spelling, "mask") + " " + text + ": closes all of " +
                   domain.file().string());
}

namespace detail {

void require_open(const Mask* mask, const AnyShape& domain, std::span<const PointSource> points) {
  require_all(mask, domain, points);
}
void require_open(const Mask* mask, const AnyShape& domain, std::span<const Source> sources) {
  require_all(mask, domain, sources);
}

}  // namespace detail

}  // namespace plexway

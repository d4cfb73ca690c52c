#include "executors/same_work.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <plexway/error.hpp>

#include "complexes/common/kept_archive.hpp"
#include "executors/threads/rank_mail.hpp"

namespace plexway::detail {
namespace {

void put(KeptOut& out, const PointSource& point) {
  out(point.vertex, point.simplex, point.offset);
  if (point.vertex == none) out(point.barycentric);
}
void put(KeptOut& out, const VertexSource& set) { out(set.vertices, set.offsets, set.offset); }
void put(KeptOut& out, const BallSource& ball) {
  put(out, ball.centre);
  out(ball.radius, ball.offset);
}
void put(KeptOut& out, const CurveSource& curve) {
  out(curve.points.size(), curve.offset);
  for (const PointSource& point : curve.points) put(out, point);
}
void put(KeptOut& out, const SimplexSource& simplex) { out(simplex.simplex, simplex.offset); }

std::uint64_t digest_of(const SourceList& sources) {
  KeptOut out;
  for (const PointSource& point : sources.points()) put(out, point);
  for (const Source& source : sources.sources()) {
    out(source.index());
    std::visit([&](const auto& one) { put(out, one); }, source);
  }
  return out.checksum();
}

std::uint64_t digest_of(const PropagateOptions& options, std::size_t piece) {
  KeptOut out;
  const ProbeTable& probe = options.probe;
  out(options.accuracy.kind(), options.accuracy.error(), options.visibility, options.schedule,
      options.step, options.radius, options.max_expansions, options.vectorised, probe.slender,
      probe.uneven, probe.low, probe.share, piece);
  return out.checksum();
}

/// Of all that a complex is made of, where that can be kept and goes in pieces; else of its counts.
template <class D>
std::uint64_t digest_of(const D& domain, [[maybe_unused]] PieceMemory& memory) {
  if constexpr (D::kind == DomainKind::surface || D::kind == DomainKind::solid) {
    return memory.digest_of(domain, [&] {
      KeptOut nowhere;
      KeptParts::keep(nowhere, domain);
      return nowhere.checksum();
    });
  } else {
    return domain.vertex_count();
  }
}

/// Throws in every rank where one has another number; `what[i]` says of what the i-th is one.
void compare(PieceRanks& ranks, std::span<const std::uint64_t> own,
             std::span<const char* const> what) {
  // Each rank's in its own places, and zeros elsewhere.
  std::vector<std::uint64_t> all(own.size() * ranks.count());
  for (std::size_t i = 0; i < own.size(); ++i) all[own.size() * ranks.rank() + i] = own[i];
  add_up(&ranks, all);
  for (std::size_t i = 0; i < own.size(); ++i)
    for (std::size_t r = 1; r < ranks.count(); ++r) {
      if (all[own.size() * r + i] == all[i]) continue;
      const std::string cause = std::string("the ranks of one solve need the same ")
                                    .append(what[i])
                                    .append(": rank ")
                                    .append(std::to_string(r))
                                    .append(" differs from rank 0");
      if (std::string_view(what[i]) == "domain") throw InputError(cause);
      throw UsageError(cause);
    }
}

/// Of rows and where they are, some at a time.
template <class Row, class Read>
std::uint64_t checksum_of(std::size_t begin, std::size_t end, const Read& read) {
  constexpr std::size_t batch = std::size_t{1} << 16;
  std::vector<Row> some;
  std::uint64_t sum = 0;
  for (; begin < end; begin += some.size()) {
    some.resize(std::min(batch, end - begin));
    read(begin, std::span(some));
    KeptOut out;
    out(begin, some);
    sum += out.checksum();
  }
  return sum;
}

}  // namespace

void check_same_words(PieceRanks& ranks, std::span<const std::string> words, const char* what) {
  KeptOut out;
  for (const std::string& word : words) out(word);
  const std::array own = {out.checksum()};
  const std::array names = {what};
  compare(ranks, own, names);
}

template <class D>
void check_same_work(PieceRanks& ranks, const D& domain, const SourceList& sources,
                     const PropagateOptions& options, std::size_t piece, PieceMemory& memory) {
  const std::array own = {digest_of(domain, memory), digest_of(sources), digest_of(options, piece)};
  constexpr std::array what = {"domain", "sources", "options"};
  compare(ranks, own, what);
}

void check_same_work(PieceRanks& ranks, const SourceList& sources, const PropagateOptions& options,
                     std::size_t piece) {
  const std::array own = {digest_of(sources), digest_of(options, piece)};
  constexpr std::array what = {"sources", "options"};
  compare(ranks, own, what);
}

void check_same_rows(PieceRanks& ranks, const SurfaceRows& rows) {
  const std::array<std::string, 2> counts = {std::to_string(rows.vertex_count()),
                                             std::to_string(rows.face_count())};
  check_same_words(ranks, counts, "domain");
  const std::size_t n = ranks.count(), ours = ranks.rank();
  if (n == 1) return;
  // One of the slices of a process's range, which as many others look at.
  const auto slice = [&](std::size_t owner, std::size_t number) {
    const auto place = [&](std::size_t count, std::size_t k) {
      const std::size_t begin = count * owner / n, end = count * (owner + 1) / n;
      return begin + (end - begin) * k / (n - 1);
    };
    const std::size_t v = rows.vertex_count(), f = rows.face_count();
    return checksum_of<std::array<double, 3>>(
               place(v, number), place(v, number + 1),
               [&](std::size_t first, auto some) { rows.read_vertices(first, some); }) +
           3 * checksum_of<std::array<Index, 3>>(
                   place(f, number), place(f, number + 1),
                   [&](std::size_t first, auto some) { rows.read_faces(first, some); });
  };
  std::vector<std::uint64_t> differences(n, 0);  // what the owner finds, less what others find
  for (std::size_t k = 0; k + 1 < n; ++k) {
    differences[ours] += slice(ours, k);
    const std::size_t owner = (ours + n - 1 - k) % n;
    try {
      differences[owner] -= slice(owner, k);
    } catch (const InputError&) {
      ++differences[owner];  // it says it itself, if its rows are wrong, too
    }
  }
  add_up(&ranks, differences);
  for (std::size_t r = 0; r < n; ++r)
    if (differences[r] != 0)
      throw InputError("the ranks of one solve need the same domain: what rank " +
                       std::to_string(r) + " reads differs from what others read there");
}

#define PLEXWAY_SAME_WORK(...)                                                      \
  template void check_same_work(PieceRanks&, const __VA_ARGS__&, const SourceList&, \
                                const PropagateOptions&, std::size_t, PieceMemory&);
PLEXWAY_DOMAINS(PLEXWAY_SAME_WORK)
#undef PLEXWAY_SAME_WORK

}  // namespace plexway::detail

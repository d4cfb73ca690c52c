#include "executors/same_work.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include <plexway/error.hpp>

#include "complexes/common/kept_parts.hpp"
#include "executors/threads/rank_mail.hpp"
#include "file/checksum.hpp"

namespace plexway {
namespace {

/// A number for a list of numbers.
class Digest {
 public:
  void add(std::uint64_t word) { words_.push_back(word); }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(const PointSource& point) {
    add(std::uint64_t{point.vertex});
    add(std::uint64_t{point.simplex});
    if (point.vertex == none)
      for (const double b : point.barycentric) add(b);
    add(point.offset);
  }
  void add(const VertexSource& set) {
    add(std::uint64_t{set.vertices.size()});
    for (const Index v : set.vertices) add(std::uint64_t{v});
    add(std::uint64_t{set.offsets.size()});
    for (const double offset : set.offsets) add(offset);
    add(set.offset);
  }
  void add(const BallSource& ball) {
    add(ball.centre);
    add(ball.radius);
    add(ball.offset);
  }
  void add(const CurveSource& curve) {
    add(std::uint64_t{curve.points.size()});
    for (const PointSource& point : curve.points) add(point);
    add(curve.offset);
  }
  void add(const SimplexSource& simplex) {
    add(std::uint64_t{simplex.simplex});
    add(simplex.offset);
  }
  [[nodiscard]] std::uint64_t value() {
    add(std::uint64_t{words_.size()});
    constexpr std::size_t in_block = file::Checksum::block / sizeof(std::uint64_t);
    words_.resize((words_.size() + in_block - 1) / in_block * in_block);
    const auto bytes = std::as_bytes(std::span(words_));
    file::Checksum checksum;
    checksum.add(bytes.data(), bytes.size());
    return checksum.value();
  }

 private:
  std::vector<std::uint64_t> words_;
};

std::uint64_t digest_of(const SourceList& sources) {
  Digest digest;
  if (sources.only_points()) {
    for (const PointSource& point : sources.points()) digest.add(point);
  } else {
    for (const Source& source : sources.sources()) {
      digest.add(std::uint64_t{source.index()});
      std::visit([&](const auto& one) { digest.add(one); }, source);
    }
  }
  return digest.value();
}

std::uint64_t digest_of(const PropagateOptions& options, std::size_t piece) {
  Digest digest;
  digest.add(static_cast<std::uint64_t>(options.accuracy.kind()));
  digest.add(options.accuracy.error());
  digest.add(static_cast<std::uint64_t>(options.visibility));
  digest.add(static_cast<std::uint64_t>(options.schedule));
  digest.add(options.step);
  digest.add(options.radius);
  digest.add(std::uint64_t{options.max_expansions});
  digest.add(std::uint64_t{options.vectorised});
  for (const double number : {options.probe.slender, options.probe.uneven, options.probe.low})
    digest.add(number);
  for (const double share : options.probe.share) digest.add(share);
  digest.add(std::uint64_t{piece});
  return digest.value();
}

/// Of all that a complex is made of, where that can be kept and goes in pieces; else of its counts.
template <class D>
std::uint64_t digest_of(const D& domain) {
  if constexpr (D::kind == DomainKind::surface || D::kind == DomainKind::solid) {
    thread_local std::uint64_t identity = 0, digest = 0;
    if (identity != domain.identity()) {
      KeptOut nowhere;
      KeptParts::keep(nowhere, domain);
      digest = nowhere.checksum();
      identity = domain.identity();
    }
    return digest;
  } else {
    Digest digest;
    digest.add(std::uint64_t{domain.vertex_count()});
    return digest.value();
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
  std::vector<std::byte> bytes;
  std::uint64_t sum = 0;
  for (; begin < end; begin += some.size()) {
    some.resize(std::min(batch, end - begin));
    read(begin, std::span(some));
    const auto rows = std::as_bytes(std::span(some));
    const auto place = std::as_bytes(std::span(&begin, 1));
    bytes.assign(place.begin(), place.end());
    bytes.insert(bytes.end(), rows.begin(), rows.end());
    bytes.resize((bytes.size() + file::Checksum::block - 1) / file::Checksum::block *
                 file::Checksum::block);
    file::Checksum checksum;
    checksum.add(bytes.data(), bytes.size());
    sum += checksum.value();
  }
  return sum;
}

}  // namespace

void check_same_words(PieceRanks& ranks, std::span<const std::string> words, const char* what) {
  Digest digest;
  for (const std::string& word : words) {
    digest.add(std::uint64_t{word.size()});
    for (const char c : word) digest.add(std::uint64_t{static_cast<unsigned char>(c)});
  }
  const std::array own = {digest.value()};
  const std::array names = {what};
  compare(ranks, own, names);
}

template <class D>
void check_same_work(PieceRanks& ranks, const D& domain, const SourceList& sources,
                     const PropagateOptions& options, std::size_t piece) {
  const std::array own = {digest_of(domain), digest_of(sources), digest_of(options, piece)};
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
                                const PropagateOptions&, std::size_t);
PLEXWAY_DOMAINS(PLEXWAY_SAME_WORK)
#undef PLEXWAY_SAME_WORK

}  // namespace plexway

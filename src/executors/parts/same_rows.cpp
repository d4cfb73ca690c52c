#include "executors/parts/same_rows.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <plexway/error.hpp>

#include "executors/same_work.hpp"
#include "executors/threads/piece_post.hpp"
#include "file/checksum.hpp"

namespace plexway {
namespace {

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

}  // namespace plexway

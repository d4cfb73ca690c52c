#include <plexway/executors/joined_rows.hpp>

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include <plexway/error.hpp>

#include "executors/threads/rank_mail.hpp"

namespace plexway {
using namespace detail;
namespace {

using Point = std::array<double, 3>;
using Key = std::array<std::uint64_t, 3>;

/// A point of a part, on its way to who numbers all that have its key.
struct VertexQuery {
  Key key;  ///< its id, or the bits of where it lies
  Point position;
  std::uint32_t part, point;
};
/// And back.
struct Answer {
  std::uint32_t part, point;
  std::uint64_t number;
};
struct Vertex {
  std::uint64_t number;
  Point position;
};
struct Row3 {
  std::uint64_t number;
  std::array<Index, 3> corner;
};
/// A numbered point, on its way to who looks at all in its place.
struct Placed {
  Key place;
  std::uint64_t id;
  std::uint32_t part;
  std::uint32_t unused = 0;  ///< so that no byte sent is left open
};
/// A triangle by its corners in order, on its way to who looks for others of these.
struct Cornered {
  std::array<std::uint64_t, 3> corners;
  std::uint64_t part;
};

Key key_of(const Point& position) {
  Key key;
  for (std::size_t d = 0; d < 3; ++d) key[d] = std::bit_cast<std::uint64_t>(position[d] + 0.0);
  return key;  // -0 is 0
}

std::size_t hash_of(const Key& key) {
  std::uint64_t sum = 0;
  for (const std::uint64_t word : key)
    sum = (std::rotl(sum, 21) ^ word) * std::uint64_t{0x9e3779b97f4a7c15};
  return static_cast<std::size_t>(sum >> 20);
}

/// Who has number i of `count` in its range: number r of n begins at count * r / n.
std::size_t home_of(std::uint64_t i, std::uint64_t count, std::size_t ranks) {
  return static_cast<std::size_t>(((i + 1) * ranks - 1) / count);
}

/// Gives points of all parts their numbers.
class Numbering {
 public:
  /// Ours, of so many.
  Numbering(PieceRanks* ranks, std::span<const SurfaceFilePart> parts, std::size_t all_parts)
      : ranks_(ranks), parts_(parts), all_parts_(all_parts) {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      place_.push_back({static_cast<std::uint32_t>(parts_[i].number), i});
      numbers_.emplace_back(parts_[i].positions.size());
    }
    std::sort(place_.begin(), place_.end());
    by_ids_ = have_ids();
  }

  /// How many vertices there are.
  std::uint64_t run() {
    joined_.by_ids = by_ids_;
    if (by_ids_) count_apart();
    ask();
    count_shared();
    by_ids_ ? number_by_ids() : number_by_parts();
    return count_;
  }
  /// After `run`, the same for all.
  [[nodiscard]] const JoinedCounts& joined() const { return joined_; }
  /// Of point v of our part i.
  [[nodiscard]] std::uint64_t of(std::size_t i, std::size_t v) const { return numbers_[i][v]; }

 private:
  [[noreturn]] static void fail(const SurfaceFilePart& part, const std::string& cause) {
    throw InputError(part.name + ": " + cause);
  }

  bool have_ids() const {
    std::uint64_t counts[] = {0, 0};  // of parts with and without
    for (const SurfaceFilePart& part : parts_)
      if (!part.positions.empty()) ++counts[part.ids.empty()];
    add_up(ranks_, counts);
    if (counts[0] > 0 && counts[1] > 0)
      throw InputError("of the parts " + std::to_string(counts[0]) + " number their points and " +
                       std::to_string(counts[1]) +
                       " do not: save all with GlobalPointIds, or all without");
    return counts[0] > 0;
  }

  /// Numbers that are each file's own tear a surface where files meet, and nothing else shows it:
  /// so looks at places as well. A slit that ends at a border of files is none of it: there each
  /// file has both of its sides.
  void count_apart() {
    RankMail mail(ranks_);
    for (const SurfaceFilePart& part : parts_)
      for (std::size_t v = 0; v < part.positions.size(); ++v) {
        const Key place = key_of(part.positions[v]);
        mail.to(hash_of(place) % mail.count())
            .add(Placed{place, part.ids[v], static_cast<std::uint32_t>(part.number)});
      }
    mail.meet();
    auto placed = mail.all<Placed>();
    std::sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) {
      return std::tie(a.place, a.id, a.part) < std::tie(b.place, b.id, b.part);
    });
    std::uint64_t apart = 0;
    std::vector<std::uint32_t> here, met;  // parts in a place, and those with another's number
    for (std::size_t i = 0; i < placed.size();) {
      here.clear(), met.clear();
      const std::size_t first = i;
      while (i < placed.size() && placed[i].place == placed[first].place) {
        const std::size_t same = i;
        while (i < placed.size() && placed[i].place == placed[first].place &&
               placed[i].id == placed[same].id)
          here.push_back(placed[i++].part);
        if (placed[i - 1].part != placed[same].part)
          met.insert(met.end(), here.end() - static_cast<std::ptrdiff_t>(i - same), here.end());
      }
      for (std::vector<std::uint32_t>* const some : {&here, &met}) {
        std::sort(some->begin(), some->end());
        some->erase(std::unique(some->begin(), some->end()), some->end());
      }
      apart += here.size() > 1 && met.size() < here.size();
    }
    add_up(ranks_, std::span(&apart, 1));
    joined_.apart = apart;
  }

  /// What points of several parts became one, and which parts have none of these.
  void count_shared() {
    // Of parts: points shared, triangles (what has none need not hang together); vertices shared.
    std::vector<std::uint64_t> sums(2 * all_parts_ + 1, 0);
    for (const SurfaceFilePart& part : parts_) sums[2 * part.number + 1] = part.triangles.size();
    each_key([&](std::size_t first, std::size_t last) {
      // A part has a key once.
      sums.back() += last - first > 1;
      for (std::size_t i = first; i < last; ++i) sums[2 * asked_[i].part] += last - first > 1;
    });
    add_up(ranks_, sums);
    joined_.shared = sums.back();
    for (std::size_t p = 0; p < all_parts_; ++p) {
      joined_.parts += sums[2 * p + 1] > 0;
      joined_.alone += sums[2 * p + 1] > 0 && sums[2 * p] == 0;
    }
  }

  /// Each point goes to who has its key; there sorted by key, part and point.
  void ask() {
    std::uint64_t largest = 0;
    for (const SurfaceFilePart& part : parts_)
      for (const std::uint64_t id : part.ids) largest = std::max(largest, id);
    // As a double, and so rounded: homes are ranges of ids all the same.
    const double ids = 1 + most_of(ranks_, static_cast<double>(largest));
    RankMail mail(ranks_);
    std::vector<Key> own;
    for (const SurfaceFilePart& part : parts_) {
      own.clear();
      for (std::size_t v = 0; v < part.positions.size(); ++v)
        own.push_back(by_ids_ ? Key{part.ids[v], 0, 0} : key_of(part.positions[v]));
      for (std::size_t v = 0; v < own.size(); ++v) {
        const std::size_t to =
            by_ids_ ? std::min(static_cast<std::size_t>(static_cast<double>(own[v][0]) / ids *
                                                        static_cast<double>(mail.count())),
                               mail.count() - 1)
                    : hash_of(own[v]) % mail.count();
        mail.to(to).add(VertexQuery{own[v], part.positions[v],
                                    static_cast<std::uint32_t>(part.number),
                                    static_cast<std::uint32_t>(v)});
      }
      check_apart(part, own);
    }
    mail.meet();
    asked_ = mail.all<VertexQuery>();
    std::sort(asked_.begin(), asked_.end(), [](const VertexQuery& a, const VertexQuery& b) {
      return std::tie(a.key, a.part, a.point) < std::tie(b.key, b.part, b.point);
    });
    for (std::size_t i = 1; i < asked_.size(); ++i)
      if (asked_[i].key == asked_[i - 1].key && asked_[i].position != asked_[i - 1].position)
        throw InputError("point " + std::to_string(asked_[i].key[0]) +
                         " of the whole lies in part " + std::to_string(asked_[i - 1].part) +
                         " elsewhere than in part " + std::to_string(asked_[i].part));
  }

  void check_apart(const SurfaceFilePart& part, std::vector<Key>& keys) const {
    std::vector<std::uint32_t> order(keys.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::tie(keys[a], a) < std::tie(keys[b], b);
    });
    for (std::size_t i = 1; i < order.size(); ++i) {
      if (keys[order[i]] != keys[order[i - 1]]) continue;
      const std::string both =
          "points " + std::to_string(order[i - 1]) + " and " + std::to_string(order[i]);
      if (by_ids_)
        fail(part, both + " have the same number " + std::to_string(keys[order[i]][0]) +
                       (part.ids_name.empty() ? "" : " in '" + part.ids_name + "'"));
      fail(part, both +
                     " lie in the same place, so which of them goes on in another part is open: "
                     "save it with GlobalPointIds");
    }
  }

  /// The first point of each key.
  template <class Visit>
  void each_key(const Visit& visit) const {
    for (std::size_t i = 0; i < asked_.size();) {
      const std::size_t first = i;
      while (i < asked_.size() && asked_[i].key == asked_[first].key) ++i;
      visit(first, i);
    }
  }

  void number_by_ids() {
    std::vector<std::uint64_t> keys(ranks_ == nullptr ? 1 : ranks_->count(), 0);
    const std::size_t ours = ranks_ == nullptr ? 0 : ranks_->rank();
    each_key([&](std::size_t, std::size_t) { ++keys[ours]; });
    add_up(ranks_, keys);
    count_ = std::accumulate(keys.begin(), keys.end(), std::uint64_t{0});
    std::uint64_t next = std::accumulate(
        keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(ours), std::uint64_t{0});
    RankMail mail(ranks_);
    each_key([&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) answer(mail, asked_[i], next);
      ++next;
    });
    hear(mail);
  }

  /// A vertex is numbered where it comes first, and by that part.
  void number_by_parts() {
    RankMail firsts(ranks_);
    each_key([&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)  // of whom: of the first
        answer(firsts, asked_[i], std::uint64_t{asked_[first].part} << 32 | asked_[first].point);
    });
    hear(firsts);
    std::vector<std::uint64_t> counts(all_parts_, 0);
    const auto is_first = [&](std::size_t i, std::size_t v) {
      return numbers_[i][v] == (std::uint64_t{parts_[i].number} << 32 | v);
    };
    for (std::size_t i = 0; i < parts_.size(); ++i)
      for (std::size_t v = 0; v < numbers_[i].size(); ++v)
        counts[parts_[i].number] += is_first(i, v);
    add_up(ranks_, counts);
    count_ = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
    std::exclusive_scan(counts.begin(), counts.end(), counts.begin(), std::uint64_t{0});
    // To who has the key, which tells the others.
    RankMail told(ranks_);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      std::uint64_t next = counts[parts_[i].number];
      for (std::size_t v = 0; v < numbers_[i].size(); ++v)
        if (is_first(i, v))
          told.to(hash_of(key_of(parts_[i].positions[v])) % told.count())
              .add(Answer{static_cast<std::uint32_t>(parts_[i].number),
                          static_cast<std::uint32_t>(v), next++});
    }
    told.meet();
    auto known = told.all<Answer>();
    const auto less = [](const auto& a, const auto& b) {
      return std::tie(a.part, a.point) < std::tie(b.part, b.point);
    };
    std::sort(known.begin(), known.end(), less);
    RankMail mail(ranks_);
    each_key([&](std::size_t first, std::size_t last) {
      const auto number = std::lower_bound(known.begin(), known.end(), asked_[first], less)->number;
      for (std::size_t i = first; i < last; ++i) answer(mail, asked_[i], number);
    });
    hear(mail);
  }

  void answer(RankMail& mail, const VertexQuery& to, std::uint64_t number) const {
    mail.to(to.part % mail.count()).add(Answer{to.part, to.point, number});
  }
  void hear(RankMail& mail) {
    mail.meet();
    for (const Answer& told : mail.all<Answer>()) {
      const auto found =
          std::lower_bound(place_.begin(), place_.end(), std::pair(told.part, std::size_t{0}));
      numbers_[found->second][told.point] = told.number;
    }
  }

  PieceRanks* ranks_;
  std::span<const SurfaceFilePart> parts_;
  std::size_t all_parts_;
  std::vector<std::pair<std::uint32_t, std::size_t>> place_;  ///< of a part by number, among ours
  std::vector<std::vector<std::uint64_t>> numbers_;
  std::vector<VertexQuery> asked_;
  bool by_ids_ = false;
  std::uint64_t count_ = 0;
  JoinedCounts joined_;
};

/// A triangle that two parts have would be there twice, and paths go on over either.
void check_no_overlap(PieceRanks* ranks, std::span<const SurfaceFilePart> parts,
                      const Numbering& numbers) {
  RankMail mail(ranks);
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (const std::array<Index, 3>& triangle : parts[i].triangles) {
      Cornered one{{}, parts[i].number};
      for (std::size_t c = 0; c < 3; ++c) one.corners[c] = numbers.of(i, triangle[c]);
      std::sort(one.corners.begin(), one.corners.end());
      mail.to(hash_of(one.corners) % mail.count()).add(one);
    }
  mail.meet();
  auto all = mail.all<Cornered>();
  std::sort(all.begin(), all.end(), [](const Cornered& a, const Cornered& b) {
    return std::tie(a.corners, a.part) < std::tie(b.corners, b.part);
  });
  // The least pair, so that all say the same with any number of processes.
  const double none_found = std::numeric_limits<double>::infinity();
  double first = none_found, second = none_found;
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i].corners != all[i - 1].corners || all[i].part == all[i - 1].part) continue;
    const auto a = static_cast<double>(all[i - 1].part), b = static_cast<double>(all[i].part);
    if (std::tie(a, b) < std::tie(first, second)) first = a, second = b;
  }
  const double least = least_of(ranks, first);
  second = least_of(ranks, first == least ? second : none_found);
  if (second == none_found) return;
  const auto text = [](double part) { return std::to_string(static_cast<std::uint64_t>(part)); };
  throw InputError("a triangle is in parts " + text(least) + " and " + text(second) +
                   ": mark ghost cells by vtkGhostType");
}

void check_row_count(const char* what, std::uint64_t count) {
  if (count >= none) throw InputError("more than 4294967294 " + std::string(what));
}

}  // namespace

JoinedRows::JoinedRows(PieceRanks* ranks, std::vector<SurfaceFilePart> parts) {
  std::size_t largest = 0;  // of all parts: their number
  for (const SurfaceFilePart& part : parts) largest = std::max(largest, part.number + 1);
  largest = static_cast<std::size_t>(most_of(ranks, static_cast<double>(largest)));
  std::vector<std::uint64_t> begin(largest + 1, 0);  // of each part's triangles
  for (const SurfaceFilePart& part : parts) begin[part.number] = part.triangles.size();
  add_up(ranks, begin);
  std::exclusive_scan(begin.begin(), begin.end(), begin.begin(), std::uint64_t{0});
  const std::uint64_t faces_in_all = begin.back();
  Numbering numbers(ranks, parts, largest);
  const std::uint64_t vertices_in_all = numbers.run();
  joined_ = numbers.joined();
  check_row_count("vertices", vertices_in_all);
  check_row_count("faces", faces_in_all);
  vertices_ = static_cast<std::size_t>(vertices_in_all);
  faces_ = static_cast<std::size_t>(faces_in_all);

  check_no_overlap(ranks, parts, numbers);

  RankMail vertices(ranks), faces(ranks);
  const std::size_t n = vertices.count(), ours = deal_of(ranks).ours;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const SurfaceFilePart& part = parts[i];
    for (std::size_t v = 0; v < part.positions.size(); ++v)
      vertices.to(home_of(numbers.of(i, v), vertices_, n))
          .add(Vertex{numbers.of(i, v), part.positions[v]});
    for (std::size_t f = 0; f < part.triangles.size(); ++f) {
      Row3 triangle{begin[part.number] + f, {}};
      for (std::size_t c = 0; c < 3; ++c)
        triangle.corner[c] = static_cast<Index>(numbers.of(i, part.triangles[f][c]));
      faces.to(home_of(triangle.number, faces_, n)).add(triangle);
    }
  }
  parts = {};
  const auto range = [&](std::size_t count, std::size_t& first) {
    first = count * ours / n;
    return count * (ours + 1) / n - first;
  };
  positions_.resize(range(vertices_, first_vertex_));
  corners_.resize(range(faces_, first_face_));
  vertices.meet();
  vertices.each([&](Unpacked& in) {
    const auto vertex = in.take<Vertex>();
    positions_[static_cast<std::size_t>(vertex.number) - first_vertex_] = vertex.position;
  });
  faces.meet();
  faces.each([&](Unpacked& in) {
    const auto triangle = in.take<Row3>();
    corners_[static_cast<std::size_t>(triangle.number) - first_face_] = triangle.corner;
  });
}

void JoinedRows::read_vertices(std::size_t first,
                               std::span<std::array<double, 3>> positions) const {
  std::copy_n(positions_.begin() + static_cast<std::ptrdiff_t>(first - first_vertex_),
              positions.size(), positions.begin());
}

void JoinedRows::read_faces(std::size_t first, std::span<std::array<Index, 3>> corners) const {
  std::copy_n(corners_.begin() + static_cast<std::ptrdiff_t>(first - first_face_), corners.size(),
              corners.begin());
}

}  // namespace plexway

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include <plexway/error.hpp>

#include "complexes/common/kept_archive.hpp"

namespace plexway::detail {

namespace {

constexpr std::size_t archive_block = file::Checksum::block;
constexpr std::array<char, 8> magic = {'p', 'l', 'e', 'x', 'w', 'a', 'y', '\x1a'};
// On a machine with the other byte order the bytes are those of another number.
constexpr std::uint32_t byte_order = 0x01020304;

struct alignas(archive_block) Header {
  std::array<char, 8> name = magic;
  std::uint32_t order = byte_order, version = kept_version;
  std::array<char, archive_block - 16> rest = {};
};
struct PartHead {
  std::uint64_t element = 0, count = 0;
};
// What fits into the block of its head.
constexpr std::size_t short_part = archive_block - sizeof(PartHead);
struct alignas(archive_block) Trailer {
  std::array<char, 8> name = magic;
  std::uint64_t size = 0, checksum = 0;
  std::array<char, archive_block - 24> rest = {};
};
static_assert(sizeof(Header) == archive_block && sizeof(Trailer) == archive_block);

template <class Block>
Block block_at(std::span<const std::byte> bytes, std::size_t at) {
  Block one;
  std::memcpy(&one, bytes.data() + at, sizeof(one));
  return one;
}
template <class Block>
const std::byte* bytes_of(const Block& one) {
  return reinterpret_cast<const std::byte*>(&one);
}

}  // namespace

bool is_kept(std::span<const std::byte> bytes) {
  return bytes.size() >= magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
}

void seal(std::span<std::byte> file) {
  if (file.size() < 2 * archive_block || file.size() % archive_block != 0) return;
  const std::size_t end = file.size() - archive_block;
  file::Checksum checksum;
  checksum.add(file.data(), end);
  const Trailer trailer{magic, file.size(), checksum.value(), {}};
  std::memcpy(file.data() + end, &trailer, archive_block);
}

KeptOut::KeptOut() {
  const Header header;
  write(bytes_of(header), archive_block);
}

KeptOut::KeptOut(const std::filesystem::path& file) : KeptOut() { file_.emplace(file); }

void KeptOut::begin_part(std::size_t element, std::size_t count) {
  const PartHead head{element, count};
  write(bytes_of(head), sizeof(head));
  if (element * count > short_part) end_part();
}

void KeptOut::write(const std::byte* bytes, std::size_t size) {
  constexpr std::size_t most = std::size_t{1} << 20;
  while (size > 0) {
    const std::size_t some = std::min(size, most);
    pending_.insert(pending_.end(), bytes, bytes + some);
    bytes += some;
    size -= some;
    if (pending_.size() >= most) flush();
  }
}

void KeptOut::end_part() {
  pending_.resize((pending_.size() + archive_block - 1) / archive_block * archive_block);
}

void KeptOut::flush() {
  const std::size_t size = pending_.size() / archive_block * archive_block;
  checksum_.add(pending_.data(), size);
  if (file_)
    if (const int code = file_->write(reinterpret_cast<const char*>(pending_.data()), size))
      file_->refuse(code);
  written_ += size;
  pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(size));
}

void KeptOut::commit() {
  flush();
  const Trailer trailer{magic, written_ + archive_block, checksum_.value(), {}};
  if (const int code = file_->write(reinterpret_cast<const char*>(&trailer), archive_block))
    file_->refuse(code);
  file_->commit();
}

std::uint64_t KeptOut::checksum() {
  flush();
  return checksum_.value();
}

KeptIn::KeptIn(const std::filesystem::path& file) : name_(file.string()) {
  const auto mapped = std::make_shared<const file::MappedFile>(file);
  bytes_ = mapped->bytes();
  keeper_ = mapped;
  check();
}

KeptIn::KeptIn(std::span<const std::byte> bytes, std::shared_ptr<const void> keeper,
               std::string name)
    : name_(std::move(name)), keeper_(std::move(keeper)), bytes_(bytes) {
  check();
}

void KeptIn::refuse(const std::string& cause) const { throw InputError(name_ + ": " + cause); }

void KeptIn::check() {
  if (!is_kept(bytes_)) refuse("is no prepared domain of plexway");
  if (bytes_.size() < 2 * archive_block) refuse("is cut short");
  const auto header = block_at<Header>(bytes_, 0);
  if (header.order != byte_order)
    refuse("was prepared on a machine with another byte order: prepare it here");
  if (header.version != kept_version)
    refuse("was prepared by another version of plexway (its format is " +
           std::to_string(header.version) + ", here it is " + std::to_string(kept_version) +
           "): prepare it again");
  if (bytes_.size() % archive_block != 0) refuse("is cut short or damaged");
  at_ = archive_block;
  end_ = bytes_.size() - archive_block;
  const auto trailer = block_at<Trailer>(bytes_, end_);
  if (trailer.name != magic || trailer.size != bytes_.size()) refuse("is cut short or damaged");
  file::Checksum checksum;
  checksum.add(bytes_.data(), end_);
  require(checksum.value() == trailer.checksum);
  const Trailer whole{magic, trailer.size, trailer.checksum, {}};
  require(std::memcmp(bytes_.data() + end_, &whole, archive_block) == 0);
}

KeptIn::Elements KeptIn::take_elements(std::size_t size) {
  require(end_ - at_ >= archive_block);
  const auto head = block_at<PartHead>(bytes_, at_);
  require(head.element == size && head.count <= (end_ - at_) / size);
  const std::size_t bytes = static_cast<std::size_t>(head.count) * size;
  const std::size_t start = at_ + (bytes > short_part ? archive_block : sizeof(head));
  require(bytes <= end_ - start);
  at_ = (start + bytes + archive_block - 1) / archive_block * archive_block;
  return {bytes_.data() + start, static_cast<std::size_t>(head.count)};
}

namespace {

template <class Array>
bool all_below(const Array& numbers, std::size_t end) {
  Index largest = 0;
  for (const Index i : numbers) largest = std::max(largest, i);
  return numbers.empty() || largest < end;
}

// Rows end to end: from 0, ascending, to `end`.
bool are_rows(const Rows<Index>& begin, std::size_t rows, std::size_t end) {
  return begin.size() == rows + 1 && begin[0] == 0 && std::is_sorted(begin.begin(), begin.end()) &&
         begin[rows] == end;
}

// A length, in the unit inside.
template <class Real>
bool is_length(Real x) {
  return x >= 0 && x <= std::numeric_limits<Real>::max();
}

bool is_unit(double x) { return x > 0 && x <= std::numeric_limits<double>::max(); }

// Is each of them followed by another one, and no two by the same?
bool are_cycles(std::vector<std::array<Index, 2>>& followed) {
  std::vector<Index> to;
  for (const auto& step : followed) to.push_back(step[1]);
  std::sort(to.begin(), to.end());
  if (std::adjacent_find(to.begin(), to.end()) != to.end()) return false;
  return std::all_of(followed.begin(), followed.end(), [&](const auto& step) {
    return std::binary_search(to.begin(), to.end(), step[0]);
  });
}

// No infinity, no NaN, and no negative length.
template <class Real>
bool bad_numbers(const TriangleRecord<Real>& t) {
  bool bad = false;
  if constexpr (sizeof(Real) == 4) {
    // By their bits, two at a time: an exponent of ones and one more is the sign's bit.
    constexpr std::uint64_t exponents = 0x7f8000007f800000, one = 0x0080000000800000;
    std::uint32_t first;
    std::array<std::uint64_t, 4> bits;
    std::memcpy(&first, t.length, sizeof(first));
    std::memcpy(bits.data(), t.length + 1, sizeof(bits));
    // Of lengths the sign as well.
    std::uint64_t found = bits[0] | first | ((first & exponents) + one);
    for (const std::uint64_t b : bits) found |= (b & exponents) + one;
    bad = (found & 0x8000000080000000) != 0;
  } else {
    for (std::size_t i = 0; i < 3; ++i)
      bad |= !is_length(t.length[i]) || !std::isfinite(t.cosine[i]) ||
             !std::isfinite(t.signed_sine[i]);
  }
  return bad;
}

template <class Real>
bool glued(std::span<const TriangleRecord<Real>> triangles, std::size_t vertices) {
  const Index m = static_cast<Index>(triangles.size() - 1);
  const Index sentinel = m << Across::face_shift;
  std::vector<std::array<Index, 2>> fans;
  bool bad = false;
  // Neighbours come from memory, a few at once, and what names them before.
  constexpr Index ahead = 24, farther = 64;
  for (Index f = 0; f < m; ++f) {
    if (f + ahead < m)
      for (const Index o : triangles[f + ahead].across)
        __builtin_prefetch(triangles[std::min(o >> Across::face_shift, m)].across);
    __builtin_prefetch(triangles[std::min(f + farther, m)].across);
    const TriangleRecord<Real>& t = triangles[f];
    bad |= (t.face & ~reversed) >= m;
    bad |= bad_numbers(t);
    bad |= std::max({t.corner[0], t.corner[1], t.corner[2]}) >= vertices;
    for (Index i = 0; i < 3; ++i) {
      const Index o = t.across[i], own = f << Across::face_shift | i;
      // No boundary, no fan and no fourth edge.
      if (o < sentinel && (o & (Across::fan | Across::edge_mask)) < 3) [[likely]] {
        bad |= triangles[o >> Across::face_shift].across[o & Across::edge_mask] !=
               (own | (o & Across::flip));
      } else if (o != sentinel) {
        if (o > sentinel || (o & Across::edge_mask) > 2) return false;
        fans.push_back({own, o & ~Across::special});
      }
    }
  }
  for (const Index o : triangles[m].across) bad |= o != sentinel;
  for (const Index v : triangles[m].corner) bad |= v >= vertices;
  return !bad && are_cycles(fans);
}

}  // namespace

template <class Real>
void KeptParts::check(KeptIn& in, const TriangleMesh<Real>& mesh) {
  const std::size_t n = mesh.vertex_to_inside_.size();
  in.require(mesh.triangles_.size() >= 2 && mesh.triangles_.size() <= Across::limit && n > 0);
  const std::size_t m = mesh.face_count();
  const SurfaceSummary& s = mesh.summary_;
  in.require(s.vertices == n && s.faces == m && is_unit(s.mean_edge));
  in.require(mesh.face_to_inside_.size() == m && mesh.corner_of_vertex_.size() == n);
  in.require(all_below(mesh.vertex_to_inside_, n) && all_below(mesh.face_to_inside_, m));
  bool bad = false;
  for (const Index c : mesh.corner_of_vertex_) bad |= c != none && c >= 3 * m;
  in.require(!bad);
  in.require(
      are_rows(mesh.irregular_begin_, mesh.irregular_.size(), mesh.irregular_corners_.size()) ||
      (mesh.irregular_begin_.empty() && mesh.irregular_.empty()));
  in.require(all_below(mesh.irregular_, n) && all_below(mesh.irregular_corners_, 3 * m) &&
             all_below(mesh.pinched_, n));
  in.require(mesh.positions_.empty() || mesh.positions_.size() == n);
  if (mesh.chord_begin_.empty())
    in.require(mesh.chords_.empty());
  else
    in.require(are_rows(mesh.chord_begin_, n, mesh.chords_.size()));
  for (const auto& chord : mesh.chords_) bad |= chord.vertex >= n || !is_length(chord.length);
  in.require(!bad && glued<Real>(mesh.triangles(), n));
}

template <class Real>
void KeptParts::check(KeptIn& in, const TetMesh<Real>& mesh) {
  const std::size_t n = mesh.vertex_to_inside_.size(), m = mesh.tet_to_inside_.size();
  const SolidSummary& s = mesh.summary_;
  in.require(n > 0 && m > 0 && m < TetAcross::limit && mesh.tets_.size() == m + 1);
  in.require(s.vertices == n && s.tets == m && is_unit(s.mean_edge));
  in.require(mesh.points_.size() == (s.embedded ? n : 0) &&
             mesh.lengths_.size() == (s.embedded ? 0 : m + 1));
  in.require(all_below(mesh.vertex_to_inside_, n));
  bool bad = false;
  for (const Index t : mesh.tet_to_inside_) bad |= (t & ~TetMesh<Real>::turned) >= m;
  in.require(!bad && are_rows(mesh.corners_begin_, n, mesh.corners_.size()));
  in.require(all_below(mesh.corners_, 4 * m) && all_below(mesh.pinched_, n) &&
             all_below(mesh.pinched_edge_tets_, m));
  for (const auto& edge : mesh.pinched_edges_)
    bad |= edge.vertex[0] >= n || edge.vertex[1] >= n || edge.begin > edge.end ||
           edge.end > mesh.pinched_edge_tets_.size();
  for (const Vector3<double>& p : mesh.points_)
    bad |= !(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
  for (const auto& squares : mesh.lengths_)
    for (const Real l : squares) bad |= !is_length(l);
  for (const auto& crack : mesh.cracks_) bad |= crack[0] >= n || crack[1] >= n;
  const Index sentinel = static_cast<Index>(m) << TetAcross::tet_shift;
  for (Index t = 0; t < m; ++t) {
    const TetRecord& record = mesh.tets_[t];
    for (Index i = 0; i < 4; ++i) {
      bad |= record.corner[i] >= n;
      const Index o = record.across[i];
      if (o == sentinel) continue;
      in.require(o < sentinel);
      bad |= mesh.tets_[o >> TetAcross::tet_shift].across[o & TetAcross::face_mask] !=
             (t << TetAcross::tet_shift | i);
    }
  }
  for (Index i = 0; i < 4; ++i)
    bad |= mesh.tets_[m].across[i] != sentinel || mesh.tets_[m].corner[i] >= n;
  in.require(!bad);
}

template <class Real>
void KeptParts::check(KeptIn& in, const Wireframe<Real>& wireframe) {
  const std::size_t n = wireframe.vertex_to_inside_.size(), m = wireframe.arc_of_edge_.size();
  const WireframeSummary& s = wireframe.summary_;
  in.require(m > 0 && s.vertices == n && s.edges == m);
  in.require(is_unit(wireframe.unit_) && is_unit(wireframe.typical_edge_));
  in.require(are_rows(wireframe.begin_, n, wireframe.arcs_.size()));
  in.require(all_below(wireframe.vertex_to_inside_, n) &&
             all_below(wireframe.arc_of_edge_, wireframe.arcs_.size()));
  bool bad = false;
  for (const WireArc<Real>& arc : wireframe.arcs_) bad |= arc.to >= n || !is_length(arc.length);
  in.require(!bad);
}

template <class Real>
void KeptParts::check(KeptIn& in, const PointCloud<Real>& cloud) {
  check(in, cloud.surface_);
  const std::size_t n = cloud.summary_.points;
  in.require(cloud.surface_.vertex_count() == n + cloud.more_.size());
  bool bad = false;
  for (const auto& [point, first] : cloud.twins_) bad |= point >= n || first >= n;
  in.require(!bad && std::is_sorted(cloud.twins_.begin(), cloud.twins_.end()));
}

template void KeptParts::check(KeptIn&, const TriangleMesh<float>&);
template void KeptParts::check(KeptIn&, const TriangleMesh<double>&);
template void KeptParts::check(KeptIn&, const TetMesh<float>&);
template void KeptParts::check(KeptIn&, const TetMesh<double>&);
template void KeptParts::check(KeptIn&, const Wireframe<float>&);
template void KeptParts::check(KeptIn&, const Wireframe<double>&);
template void KeptParts::check(KeptIn&, const PointCloud<float>&);
template void KeptParts::check(KeptIn&, const PointCloud<double>&);

}  // namespace plexway::detail

#include "complexes/common/kept_archive.hpp"

#include <algorithm>

#include <plexway/error.hpp>

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

}  // namespace plexway::detail

// The binary arrays of VTK's XML files. Plain: the number of bytes, the bytes. Compressed: the
// number of blocks, the size of a block, that of the last one if it is smaller (or 0), the
// compressed size of each, the blocks.
// https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html

#include "vtu_data.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include <plexway/error.hpp>

#include "io/base64.hpp"
#include "io/bytes.hpp"

#if PLEXWAY_IO_ZLIB
#include <zlib.h>
#endif

namespace plexway::io {
namespace {

/// Hands out bytes in turn, decoding base64 where it must.
class Stream {
 public:
  Stream(std::string_view data, bool base64, const std::string& where)
      : data_(data), base64_(base64), where_(where) {}

  [[noreturn]] void fail(const std::string& cause) const {
    throw InputError(where_ + ": " + cause);
  }

  /// The most bytes that can follow.
  std::uint64_t most() const {
    const std::uint64_t left = data_.size() - at_;
    return base64_ ? left / 4 * 3 + 3 + waiting_ : left;
  }

  void take(char* to, std::size_t bytes) {
    if (!base64_) {
      if (bytes > data_.size() - at_) fail("the file ends inside its bytes");
      std::copy_n(data_.data() + at_, bytes, to);
      at_ += bytes;
      return;
    }
    for (std::size_t i = 0; i < bytes; ++i) {
      if (waiting_ == 0) decode_group();
      to[i] = group_[decoded_ - waiting_];
      --waiting_;
    }
  }

  std::uint64_t take_length(const VtuEncoding& encoding) {
    std::array<char, 8> bytes{};
    take(bytes.data(), size_of(encoding.header));
    return encoding.header == NumberType::u32 ? load<std::uint32_t>(bytes.data(), encoding.order)
                                              : load<std::uint64_t>(bytes.data(), encoding.order);
  }

 private:
  /// Four characters make up to three bytes. A padded group ends a piece (VTK pads behind the
  /// header of a compressed array), so another may follow it.
  void decode_group() {
    std::uint32_t bits = 0;
    std::size_t padding = 0;
    for (int i = 0; i < 4; ++i) {
      const char c = next();
      if (c == '=' && i >= 2) {
        ++padding;
        bits <<= 6;
        continue;
      }
      const int value = base64_value(c);
      if (value < 0 || padding != 0)
        fail("its base64 holds something else: " + std::to_string(static_cast<unsigned char>(c)));
      bits = bits << 6 | static_cast<std::uint32_t>(value);
    }
    for (std::size_t i = 0; i < 3; ++i) group_[i] = static_cast<char>(bits >> (16 - 8 * i) & 0xFF);
    decoded_ = 3 - padding;
    waiting_ = decoded_;
  }

  char next() {
    while (at_ != data_.size() && (data_[at_] == ' ' || (data_[at_] >= '\t' && data_[at_] <= '\r')))
      ++at_;
    if (at_ == data_.size()) fail("its base64 ends too soon");
    return data_[at_++];
  }

  std::string_view data_;
  bool base64_;
  const std::string& where_;
  std::size_t at_ = 0;
  std::array<char, 3> group_{};
  std::size_t decoded_ = 0;  ///< bytes in the group
  std::size_t waiting_ = 0;  ///< of these, not yet taken
};

void take_room(const Stream& in, std::uint64_t bytes, std::uint64_t& room) {
  if (bytes > room)
    in.fail("would unpack to more than the " + std::to_string(room) +
            " bytes left to it: out of proportion to the file; if it is what it says, save it "
            "without compression");
  room -= bytes;
}

std::string decode_plain(Stream& in, const VtuEncoding& encoding, std::uint64_t& room) {
  const std::uint64_t bytes = in.take_length(encoding);
  if (bytes > in.most())
    in.fail("should have " + std::to_string(bytes) + " bytes, but only " +
            std::to_string(in.most()) + " can follow");
  take_room(in, bytes, room);
  std::string out(bytes, '\0');
  in.take(out.data(), out.size());
  return out;
}

#if PLEXWAY_IO_ZLIB
std::string decode_compressed(Stream& in, const VtuEncoding& encoding, std::uint64_t& room) {
  const std::uint64_t blocks = in.take_length(encoding);
  const std::uint64_t block = in.take_length(encoding);
  const std::uint64_t last = in.take_length(encoding);
  if (blocks > in.most() / size_of(encoding.header))
    in.fail("should have " + std::to_string(blocks) + " blocks, but only " +
            std::to_string(in.most()) + " bytes can follow");
  std::vector<std::uint64_t> sizes(blocks);
  for (std::uint64_t& size : sizes) size = in.take_length(encoding);

  if (blocks > 0) {
    const std::uint64_t full = last != 0 ? blocks - 1 : blocks;
    const bool fits = block == 0 || full <= room / block;
    take_room(in, fits ? full * block + last : room + 1, room);
  }
  std::string out;
  std::string packed;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    const std::uint64_t size = b + 1 == blocks && last != 0 ? last : block;
    if (sizes[b] > in.most()) in.fail("block " + std::to_string(b) + " ends behind the file");
    // Deflate packs a byte into no less than 1/1032.
    if (size / 1032 > sizes[b] + 64)
      in.fail("block " + std::to_string(b) + " of " + std::to_string(sizes[b]) +
              " bytes cannot hold " + std::to_string(size));
    packed.resize(sizes[b]);
    in.take(packed.data(), packed.size());
    const std::size_t before = out.size();
    out.resize(before + size);
    uLongf written = static_cast<uLongf>(size);
    const int status = uncompress(reinterpret_cast<Bytef*>(out.data() + before), &written,
                                  reinterpret_cast<const Bytef*>(packed.data()),
                                  static_cast<uLong>(packed.size()));
    if (status != Z_OK || written != size)
      in.fail("block " + std::to_string(b) + " does not unpack to " + std::to_string(size) +
              " bytes");
  }
  return out;
}
#else
std::string decode_compressed(Stream&, const VtuEncoding&, std::uint64_t&) {
  throw NotBuiltError(
      "this plexway reads no compressed .vtu: install zlib1g-dev and build it again, or save the "
      "file without compression");
}
#endif

}  // namespace

std::string decode_vtu_array(std::string_view data, bool base64, const VtuEncoding& encoding,
                             const std::string& where, std::uint64_t& room) {
  Stream in(data, base64, where);
  return encoding.compressed ? decode_compressed(in, encoding, room)
                             : decode_plain(in, encoding, room);
}

}  // namespace plexway::io

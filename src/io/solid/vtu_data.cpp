// The binary arrays of VTK's XML files. Plain: the number of bytes, the bytes. Compressed: the
// number of blocks, the size of a block, that of the last one if it is smaller (or 0), the
// compressed size of each, the blocks.
// https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html

#include "io/solid/vtu_data.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include <plexway/error.hpp>

#include "io/base64.hpp"
#include "io/numbers.hpp"

#if PLEXWAY_IO_ZLIB
#include <zlib.h>
#endif
#if PLEXWAY_IO_LZ4
#include <lz4.h>
#endif
#if PLEXWAY_IO_LIBLZMA
#include <lzma.h>
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

// How a block is unpacked: false where it does not come to just `out`.
using Unpack = bool (*)(std::string_view packed, std::span<char> out);

struct Packing {
  std::string_view name;  // of the compressor
  std::string_view package;
  std::uint64_t most;  // bytes that one packed byte comes to, at best
  Unpack unpack;       // null where the library is not there
};

#if PLEXWAY_IO_ZLIB
constexpr Unpack inflate = [](std::string_view packed, std::span<char> out) {
  uLongf written = static_cast<uLongf>(out.size());
  return uncompress(reinterpret_cast<Bytef*>(out.data()), &written,
                    reinterpret_cast<const Bytef*>(packed.data()),
                    static_cast<uLong>(packed.size())) == Z_OK &&
         written == out.size();
};
#else
constexpr Unpack inflate = nullptr;
#endif

#if PLEXWAY_IO_LZ4
constexpr Unpack unpack_lz4 = [](std::string_view packed, std::span<char> out) {
  return std::in_range<int>(packed.size()) && std::in_range<int>(out.size()) &&
         LZ4_decompress_safe(packed.data(), out.data(), static_cast<int>(packed.size()),
                             static_cast<int>(out.size())) == static_cast<int>(out.size());
};
#else
constexpr Unpack unpack_lz4 = nullptr;
#endif

#if PLEXWAY_IO_LIBLZMA
constexpr Unpack unpack_lzma = [](std::string_view packed, std::span<char> out) {
  std::uint64_t memory = std::uint64_t{1} << 28;
  std::size_t read = 0, written = 0;
  return lzma_stream_buffer_decode(&memory, 0, nullptr,
                                   reinterpret_cast<const std::uint8_t*>(packed.data()), &read,
                                   packed.size(), reinterpret_cast<std::uint8_t*>(out.data()),
                                   &written, out.size()) == LZMA_OK &&
         written == out.size();
};
#else
constexpr Unpack unpack_lzma = nullptr;
#endif

// In the order of VtuPacking, behind `none`.
constexpr std::array<Packing, 3> packings = {{
    {"vtkZLibDataCompressor", "zlib1g-dev", 1032, inflate},
    {"vtkLZ4DataCompressor", "liblz4-dev", 255, unpack_lz4},
    {"vtkLZMADataCompressor", "liblzma-dev", 8192, unpack_lzma},
}};

std::string decode_compressed(Stream& in, const VtuEncoding& encoding, std::uint64_t& room) {
  const Packing& packing = packings[static_cast<std::size_t>(encoding.packing) - 1];
  if (packing.unpack == nullptr)
    throw NotBuiltError("this plexway reads no .vtu compressed by " + std::string(packing.name) +
                        ": install " + std::string(packing.package) +
                        " and build it again, or save the file without compression");
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
    if (size / packing.most > sizes[b] + 64)
      in.fail("block " + std::to_string(b) + " of " + std::to_string(sizes[b]) +
              " bytes cannot hold " + std::to_string(size));
    packed.resize(sizes[b]);
    in.take(packed.data(), packed.size());
    const std::size_t before = out.size();
    out.resize(before + size);
    if (!packing.unpack(packed, std::span(out).subspan(before)))
      in.fail("block " + std::to_string(b) + " does not unpack to " + std::to_string(size) +
              " bytes");
  }
  return out;
}
}  // namespace

VtuPacking vtu_packing(std::string_view compressor) {
  if (compressor.empty()) return VtuPacking::none;
  const auto known = std::find_if(packings.begin(), packings.end(),
                                  [&](const Packing& one) { return one.name == compressor; });
  return static_cast<VtuPacking>(known - packings.begin() + 1);
}

std::string decode_vtu_array(std::string_view data, bool base64, const VtuEncoding& encoding,
                             const std::string& where, std::uint64_t& room) {
  Stream in(data, base64, where);
  return encoding.packing != VtuPacking::none ? decode_compressed(in, encoding, room)
                                              : decode_plain(in, encoding, room);
}

}  // namespace plexway::io

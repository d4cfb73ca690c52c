#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

namespace plexway::io {

/// All bytes of a file, in memory. The name may be as `InputName` has it.
class FileBytes {
 public:
  /// Throws InputError "FILE: cause" when it is missing, a directory, empty or not readable.
  /// `most`: of a regular file no more than its first bytes.
  explicit FileBytes(const std::filesystem::path& file, std::size_t most = SIZE_MAX);

  /// From now on what comes through a pipe is kept, and another look at that name finds it again:
  /// for a program that looks at each input as often as it likes, and ends.
  static void keep_streams();

  std::string_view view() const { return {bytes_.get(), size_}; }

 private:
  std::shared_ptr<char[]> bytes_;
  std::size_t size_ = 0;
};

}  // namespace plexway::io

#pragma once

#include <filesystem>
#include <fstream>

#include "fuzz_reader.hpp"

namespace fuzz {

/// Bytes as a file on disk, for readers that go by the extension or map it into memory.
class NamedFile {
 public:
  NamedFile(std::string_view extension, const std::uint8_t* data, std::size_t size)
      : name_((std::filesystem::temp_directory_path() /
               ("plexway-fuzz-" + std::to_string(::getpid()) + std::string(extension)))
                  .string()) {
    std::ofstream out(name_, std::ios::binary);
    out.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    out.close();
    require(!out.fail(), "a file on disk");
  }
  NamedFile(const NamedFile&) = delete;
  NamedFile& operator=(const NamedFile&) = delete;
  ~NamedFile() {
    std::error_code ignored;
    std::filesystem::remove(name_, ignored);
  }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  std::string name_;
};

}  // namespace fuzz

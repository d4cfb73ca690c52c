// .vdb: OpenVDB reads them in a helper, which may say anything: a damaged file may have it write
// anywhere. An odd first byte: the rest is what the helper says, behind what it says when it
// begins. An even one: the rest is a file for the true helper, where there is one.

#include <filesystem>

#include <plexway/openvdb/level_set.hpp>

#include "fuzz_named_file.hpp"

namespace fuzz_vdb {

namespace {

using fuzz::NamedFile;

constexpr char magic[] = {0x20, 0x42, 0x44, 0x56, 0, 0, 0, 0};

/// A script in place of the helper: it says what a file holds.
class Parrot {
 public:
  Parrot() : folder_(std::filesystem::temp_directory_path() / ("plexway-parrot-" + own())) {
    std::filesystem::create_directories(folder_);
    const auto program = folder_ / "plexway-openvdb";
    std::ofstream(program) << "#!/bin/sh\nexec cat '" << words().string() << "' >&3\n";
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    if (const char* chosen = std::getenv("PLEXWAY_HELPERS")) true_one_ = chosen;
  }
  ~Parrot() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  void say(const std::uint8_t* data, std::size_t size) {
    std::ofstream(words(), std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    ::setenv("PLEXWAY_HELPERS", folder_.c_str(), 1);
  }
  void let_the_true_one_speak() const {
    if (true_one_.empty())
      ::unsetenv("PLEXWAY_HELPERS");
    else
      ::setenv("PLEXWAY_HELPERS", true_one_.c_str(), 1);
  }

 private:
  static std::string own() { return std::to_string(::getpid()); }
  [[nodiscard]] std::filesystem::path words() const { return folder_ / "words"; }

  std::filesystem::path folder_;
  std::string true_one_;
};

}  // namespace

PLEXWAY_FUZZER(vdb)(const std::uint8_t* data, std::size_t size) {
  static Parrot parrot;
  if (size == 0) return 0;
  const bool speech = data[0] % 2 == 1;
  if (speech)
    parrot.say(data + 1, size - 1);
  else
    parrot.let_the_true_one_speak();
  const NamedFile file(".vdb", speech ? reinterpret_cast<const std::uint8_t*>(magic) : data + 1,
                       speech ? sizeof magic : size - 1);
  try {
    const auto level_set = plexway::openvdb::read_level_set(file.name());
    fuzz::require(level_set.inside_voxels() > 0, "something lies inside");
    fuzz::require(std::isfinite(level_set.voxel()) && level_set.voxel() > 0, "voxels have a size");
  } catch (const plexway::Error& error) {  // of the file, or of the helper
    fuzz::require_line(error.what());
  } catch (const std::bad_alloc&) {
    fuzz::require(speech, "memory for a small file");
  }
  return 0;
}

}  // namespace fuzz_vdb

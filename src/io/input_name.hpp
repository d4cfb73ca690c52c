#pragma once

#include <filesystem>
#include <string>

namespace plexway::io {

/// What the name of an input means: "ply:NAME" is the file NAME, of the format that .ply has, for
/// names that do not tell it, such as those of pipes; "-" is standard input. A file that has such a
/// name is meant itself.
struct InputName {
  explicit InputName(const std::filesystem::path& given);

  std::filesystem::path file;
  std::string extension;  ///< with its dot, ascii letters in lower case
  bool standard_input = false;
};

}  // namespace plexway::io

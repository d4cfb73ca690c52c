#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace plexway::io {

/// The extension of `file` with its dot, ascii letters in lower case; of "ply:-", standard output
/// as a .ply, ".ply".
std::string lower_extension(const std::filesystem::path& file);

/// "FILE: unknown extension '.xyz'; known are .a .b"
std::string unknown_extension(const std::filesystem::path& file,
                              std::span<const std::string_view> known);

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

#pragma once

#include <filesystem>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace plexway::io {

/// Ascii letters in lower case.
constexpr char lower_case(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; }
std::string lower_case(std::string_view text);

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

/// "; did you mean 'known'?" for the known word that a slip of the hand turned into this one, the
/// first of the nearest, or "" where none is near: more than a third of the letters wrong, left
/// out, one too many or swapped with the next. Case does not count.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> known);

/// Whether an output goes there: "-", or "FORMAT:-".
bool on_standard_output(const std::string& out);

/// Before any work: throws UsageError where `out`, given by `option`, is one of the files that are
/// read, and Error where its folder does not exist or it is one. Empty is fine.
void check_output_place(const std::string& out, std::span<const std::string> inputs,
                        const char* option);

/// The same for one input, and UsageError for an extension that is not `known`.
void check_output_name(const std::string& out, const std::string& input,
                       std::span<const std::string_view> known, const char* option = "--out");

/// Throws UsageError where two of them, not empty, are the same.
void check_outputs_differ(std::initializer_list<std::string> names);

/// A piece of a file, fit for a one-line message: short, printable, in quotes.
inline std::string quote(std::string_view piece) {
  constexpr std::size_t longest = 32;
  std::string out = "'";
  for (char c : piece.substr(0, longest)) out += c >= ' ' && c <= '~' ? c : '?';
  if (piece.size() > longest) out += "...";
  return out + "'";
}

/// Text for XML, in an element or between quotes; control characters become blanks.
inline std::string escape_xml(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return out;
}

}  // namespace plexway::io

#include "extension.hpp"

#include <algorithm>
#include <system_error>

#include "did_you_mean.hpp"
#include "file/standard_output.hpp"
#include "quote.hpp"

namespace plexway::io {

std::string lower_extension(const std::filesystem::path& file) {
  const std::string name = file.string();
  if (const auto format = file::format_on_standard_output(name); !format.empty())
    return std::string(1, '.').append(format);
  std::string extension = file.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + ('a' - 'A'));
  return extension;
}

std::string unknown_extension(const std::filesystem::path& file,
                              std::span<const std::string_view> known) {
  const bool stream = !file::format_on_standard_output(file.string()).empty();
  const std::string extension = stream ? lower_extension(file) : file.extension().string();
  std::string message = file.string() + ": ";
  message += extension.empty() ? "no extension" : "unknown extension " + quote(extension);
  message += did_you_mean(extension, known);
  message += message.ends_with('?') ? " known are" : "; known are";
  for (const auto name : known) message.append(" ").append(name);
  return message;
}

InputName::InputName(const std::filesystem::path& given)
    : file(given), extension(lower_extension(given)) {
  std::error_code ignored;
  if (std::filesystem::exists(given, ignored)) return;
  const std::string name = given.string();
  // Of one letter it would be a drive.
  if (const auto colon = name.find(':'); colon != name.npos && colon >= 2 && colon <= 8) {
    const bool is_format =
        std::all_of(name.begin(), name.begin() + static_cast<std::ptrdiff_t>(colon),
                    [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); });
    if (is_format && colon + 1 < name.size()) {
      extension.assign(1, '.').append(name, 0, colon);
      file = name.substr(colon + 1);
    }
  }
  standard_input = file == "-" && !std::filesystem::exists(file, ignored);
}

}  // namespace plexway::io

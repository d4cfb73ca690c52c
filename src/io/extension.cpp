#include "extension.hpp"

#include "quote.hpp"

namespace plexway::io {

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + ('a' - 'A'));
  return extension;
}

std::string unknown_extension(const std::filesystem::path& file,
                              std::span<const std::string_view> known) {
  const std::string extension = file.extension().string();
  std::string message = file.string() + ": ";
  message += extension.empty() ? "no extension" : "unknown extension " + quote(extension);
  message += "; known are";
  for (const auto name : known) message.append(" ").append(name);
  return message;
}

}  // namespace plexway::io

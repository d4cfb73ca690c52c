#include "input_name.hpp"

#include <algorithm>
#include <system_error>

#include "extension.hpp"

namespace plexway::io {

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

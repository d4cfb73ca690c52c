#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace plexway::io {

/// The numbers in the colour table that an annotation of FreeSurfer (.annot) gives its vertices; -1
/// for a colour that the table has not. Throws InputError "FILE: cause".
[[nodiscard]] std::vector<std::int64_t> read_freesurfer_annotation(
    const std::filesystem::path& file);
/// The same of bytes; `name` is for messages.
[[nodiscard]] std::vector<std::int64_t> parse_freesurfer_annotation(std::string_view bytes,
                                                                    std::string_view name);

}  // namespace plexway::io

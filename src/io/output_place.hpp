#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace plexway::io {

/// Before any work: throws UsageError where `out`, given by `option`, is one of the files that are
/// read, and Error where its folder does not exist or it is one. Empty is fine.
void check_output_place(const std::string& out, std::span<const std::string> inputs,
                        const char* option);

/// The same for one input, and UsageError for an extension that is not `known`.
void check_output_name(const std::string& out, const std::string& input,
                       std::span<const std::string_view> known, const char* option = "--out");

/// Throws UsageError where two of them, not empty, are the same.
void check_outputs_differ(std::initializer_list<std::string> names);

}  // namespace plexway::io

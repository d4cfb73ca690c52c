#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <plexway/any/shape.hpp>
#include <plexway/complex/mask.hpp>
#include <plexway/source/point_source.hpp>

namespace plexway {

/// As typed: FILE or KIND:FILE, or nothing.
struct MaskArgument {
  std::string text;
};

/// The file, or nothing. Throws UsageError for an unknown kind.
[[nodiscard]] std::string mask_file(const MaskArgument& argument);

/// What is closed of a domain, or nothing. Throws InputError "FILE:LINE: cause", where nothing
/// stays open, and UsageError for a cloud.
[[nodiscard]] std::optional<Mask> read_mask(const MaskArgument& argument, const AnyShape& domain);

/// Sources where `simplices` are only the open ones. Throws InputError for one that is closed, or
/// that the mask cuts off from everything.
void move_sources(const Mask& mask, const AnyShape& domain, std::vector<PointSource>& sources);

/// The domain, and lengths of its simplices (may be null), without what is closed.
[[nodiscard]] AnyShape open_domain(const Mask& mask, const AnyShape& domain,
                                   std::shared_ptr<const MeasuredLengths>& lengths);

}  // namespace plexway

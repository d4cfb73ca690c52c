#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <plexway/complex/mask.hpp>
#include <plexway/source/point_source.hpp>

#include "cli/options/input.hpp"
#include "cli/options/metric_options.hpp"

namespace CLI {
class App;
}

namespace plexway::cli {

/// As typed: FILE or KIND:FILE, or nothing.
struct MaskArgument {
  std::string text;
};

void add_mask_option(CLI::App& command, MaskArgument& argument);
/// The file, or nothing. Throws UsageError for an unknown kind.
[[nodiscard]] std::string mask_file(const MaskArgument& argument);

/// What is closed of a domain, or nothing. Throws InputError "FILE:LINE: cause", where nothing
/// stays open, and UsageError for a cloud.
[[nodiscard]] std::optional<Mask> read_mask(const MaskArgument& argument, const Domain& domain);

/// Sources where `simplices` are only the open ones. Throws InputError for one that is closed, or
/// that the mask cuts off from everything.
void move_sources(const Mask& mask, const Domain& domain, std::vector<PointSource>& sources);

/// The domain, and lengths of its simplices (may be null), without what is closed.
[[nodiscard]] Domain open_domain(const Mask& mask, const Domain& domain,
                                 std::shared_ptr<const MeasuredLengths>& lengths);

}  // namespace plexway::cli

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <plexway/any/shape.hpp>
#include <plexway/complex/mask.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/source/source.hpp>

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

/// What a mask leaves of a domain, by numbers: open_domain counts only the open simplices.
class OpenParts {
 public:
  OpenParts(const Mask& mask, const AnyShape& domain);

  /// From the whole domain to the open one. Throw InputError for what is closed, or cut off from
  /// everything.
  void move(PointSource& point) const;
  void move(Source& source) const;
  /// Back: the number of an open simplex in the whole domain.
  [[nodiscard]] Index whole(Index simplex) const { return whole_[simplex]; }

 private:
  void check(Index vertex) const;
  [[nodiscard]] Index open(Index simplex) const;

  const Mask& mask_;
  std::vector<Index> number_, whole_;
  std::vector<char> reached_;
};

/// The domain, and lengths of its simplices (may be null), without what is closed.
[[nodiscard]] AnyShape open_domain(const Mask& mask, const AnyShape& domain,
                                   std::shared_ptr<const MeasuredLengths>& lengths);

}  // namespace plexway

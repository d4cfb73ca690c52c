// .pcd: our own look at the header, and where PCL is there what it makes of files that pass.

#include "pcd_check.hpp"

#include "fuzz_named_file.hpp"

#ifdef PLEXWAY_HAS_PCL
#include <plexway/pcl/files.hpp>
#endif

PLEXWAY_FUZZER(pcd)(const std::uint8_t* data, std::size_t size) {
  bool passed = false;
  fuzz::check_input("input", [&] {
    const auto promise =
        plexway::pcl::check_pcd({reinterpret_cast<const char*>(data), size}, "input");
    fuzz::require(promise.points > 0 && promise.point_bytes > 0, "there are points");
    fuzz::require(promise.points <= 88 * size, "no more points than the file is worth");
    passed = true;
  });
#ifdef PLEXWAY_HAS_PCL
  const fuzz::NamedFile file(".pcd", data, size);
  return fuzz::check_input(file.name(), [&] {
    const auto cloud = plexway::pcl::read_points(file.name());
    fuzz::require(passed, "nothing is read that did not pass");
    fuzz::require_finite(cloud.positions);
  });
#else
  static_cast<void>(passed);
  return 0;
#endif
}

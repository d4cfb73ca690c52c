#pragma once

#include "any/info/info_report.hpp"

namespace plexway::cli {

/// The executors of this build, and the devices they find on this machine.
InfoReport info_of_devices();

}  // namespace plexway::cli

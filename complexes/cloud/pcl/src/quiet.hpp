#pragma once

#include <pcl/console/print.h>

namespace plexway::pcl {

/// While one lives, PCL prints nothing. The level is one for the whole process; it is put back.
class Quiet {
 public:
  Quiet() : level_(::pcl::console::getVerbosityLevel()) {
    ::pcl::console::setVerbosityLevel(::pcl::console::L_ALWAYS);
  }
  ~Quiet() { ::pcl::console::setVerbosityLevel(level_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  ::pcl::console::VERBOSITY_LEVEL level_;
};

}  // namespace plexway::pcl

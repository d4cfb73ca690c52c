#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "folder.hpp"

namespace testing {

/// A script in place of one of our helper programs, found while this lives.
class FakeHelper {
 public:
  FakeHelper(const std::string& name, const std::string& script) {
    const auto file = folder_.write(name, "#!/bin/sh\n" + script + "\n");
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    ::setenv("PLEXWAY_HELPERS", folder_.path().c_str(), 1);
  }
  ~FakeHelper() { ::unsetenv("PLEXWAY_HELPERS"); }
  FakeHelper(const FakeHelper&) = delete;
  FakeHelper& operator=(const FakeHelper&) = delete;

 private:
  Folder folder_;
};

}  // namespace testing

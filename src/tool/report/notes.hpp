#pragma once

#include <string>
#include <vector>

#include <plexway/shape/remarks.hpp>

#include "shape/info/report.hpp"

namespace plexway::cli {

/// What the user should know of a command's result though nothing failed: "notes" of its report,
/// and a line each.
class Notes {
 public:
  void add(std::string text) { texts_.push_back(std::move(text)); }
  void add(const std::vector<Remark>& remarks) {
    for (const Remark& remark : remarks) texts_.push_back(remark.text);
  }
  void add(const Notes& more) {
    texts_.insert(texts_.end(), more.texts_.begin(), more.texts_.end());
  }
  /// The array `notes`, empty where there are none.
  void tell(Json& json) const { json["notes"] = texts_; }
  /// On standard error; nothing where `quiet`.
  void say(bool quiet) const;

 private:
  std::vector<std::string> texts_;
};

}  // namespace plexway::cli

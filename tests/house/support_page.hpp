#pragma once

#include <string>

namespace house {

/// docs/reference/support.md, all of it, made from the table in support.hpp.
std::string support_page();

}  // namespace house

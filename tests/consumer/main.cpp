#include <cstdio>
#include <type_traits>

#include <plexway/error.hpp>
#include <plexway/version.hpp>

static_assert(std::is_base_of_v<plexway::Error, plexway::InputError>);
static_assert(PLEXWAY_VERSION == plexway::version_major * 10000 + plexway::version_minor * 100 +
                                     plexway::version_patch);

int main() {
  try {
    throw plexway::InputError("consumer: thrown on purpose");
  } catch (const plexway::Error& error) {
    std::printf("plexway %s: %s\n", plexway::version_string, error.what());
  }
}

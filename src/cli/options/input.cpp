#include "cli/options/input.hpp"

#include <plexway/error.hpp>

namespace plexway::cli {

Domain load_domain(const std::string& file, const std::string& as, const FillArguments& fill,
                   const CloudPreparation& cloud, ProgressLine& progress) {
  ReadOptions options;
  options.spelling = Spelling::flags;
  if (!as.empty()) {
    options.as = kind_named(as);
    if (!options.as || *options.as == DomainKind::simplices || *options.as == DomainKind::mixed)
      throw UsageError("--as " + as +
                       ": no such kind; the kinds are surface, solid, cloud, wireframe");
  }
  options.fill = filling(fill);
  options.volume = fill.volume;
  options.cloud = cloud;
  options.progress = {.stage = [&](std::string_view what) { progress.phase(what); },
                      .share = progress.share_callback(),
                      .seconds =
                          [&](double seconds) {
                            progress.seconds_passed(seconds);
                            return true;
                          },
                      .note = [&](std::string_view text) { progress.note(text); }};
  return Domain::read(file, options);
}

}  // namespace plexway::cli

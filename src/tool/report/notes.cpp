#include "tool/report/notes.hpp"

#include "tool/report/console.hpp"

namespace plexway::cli {

void Notes::say(bool quiet) const {
  if (quiet) return;
  for (const std::string& text : texts_) say_note(text);
}

}  // namespace plexway::cli

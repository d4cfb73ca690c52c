// TetGen in a program of its own, helper/main.cpp. It is not made to be a guest: it writes to
// standard output even when told to be quiet, leaks all it has when it gives up, and asserts. A
// child keeps all of that away from the caller, and the AGPL too.

#include "isolated_run.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <string>
#include <vector>

#include <plexway/error.hpp>

#include "complexes/common/helper_process.hpp"
#include "complexes/common/plain_bytes.hpp"

namespace plexway::tetgen {
namespace {

constexpr std::size_t most_said = std::size_t{1} << 18;

std::string request_of(const PiecewiseLinearComplex& complex, const std::string& switches) {
  detail::isolated::BytesOut out;
  out.put_row(switches);
  out.put_row(complex.positions);
  out.put_row(complex.holes);
  out.put_row(complex.regions);
  out.put(static_cast<std::uint64_t>(complex.facets.size()));
  for (const auto& facet : complex.facets) {
    out.put_row(facet.holes);
    out.put(static_cast<std::uint64_t>(facet.polygons.size()));
    for (const auto& polygon : facet.polygons) out.put_row(polygon);
  }
  return out.bytes();
}

// Seconds since it was made, against what a caller is ready to wait.
class Clock {
 public:
  explicit Clock(const Patience& patience) : patience_(patience) {}

  // Milliseconds for poll; negative for no end.
  int wait() const {
    constexpr int a_while = 200;
    if (!(patience_.seconds > 0)) return patience_.go_on ? a_while : -1;
    const double left = std::clamp(1e3 * (patience_.seconds - seconds()) + 1, 0.0, 1e9);
    return patience_.go_on ? std::min(static_cast<int>(left), a_while) : static_cast<int>(left);
  }

  // `done` while the run may go on.
  Ending look() {
    const double now = seconds();
    if (patience_.seconds > 0 && now >= patience_.seconds) return Ending::out_of_time;
    if (!patience_.go_on || now < asked_ + 0.15) return Ending::done;
    asked_ = now;
    return patience_.go_on(now) ? Ending::done : Ending::cancelled;
  }

 private:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  const Patience& patience_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double asked_ = 0;
};

// Reads both pipes to their ends, whichever has something, so that neither can fill up and block;
// or until patience is over, and then says how.
Ending listen_to(detail::isolated::Helper& helper, const Patience& patience, std::string& said,
                 std::string& bytes) {
  detail::isolated::Descriptor &speech = helper.speech(), &answer = helper.answer();
  Clock clock(patience);
  std::vector<char> buffer(std::size_t{1} << 16);
  while (speech.number >= 0 || answer.number >= 0) {
    std::array<pollfd, 2> wait = {{{speech.number, POLLIN, 0}, {answer.number, POLLIN, 0}}};
    if (::poll(wait.data(), wait.size(), clock.wait()) < 0 && errno != EINTR) return Ending::killed;
    if (const Ending ending = clock.look(); ending != Ending::done) return ending;
    for (std::size_t i = 0; i < 2; ++i) {
      if (wait[i].fd < 0 || wait[i].revents == 0) continue;
      const ssize_t got = ::read(wait[i].fd, buffer.data(), buffer.size());
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) {
        (i == 0 ? speech : answer).close();
        continue;
      }
      const auto size = static_cast<std::size_t>(got);
      if (i == 1) {
        bytes.append(buffer.data(), size);
      } else if (said.size() + size <= most_said) {
        said.append(buffer.data(), size);
      } else if (patience.until_it_talks) {
        return Ending::out_of_time;
      }
    }
  }
  return Ending::done;
}

}  // namespace

Run run_isolated(const PiecewiseLinearComplex& complex, const std::string& switches,
                 const Patience& patience) {
  detail::isolated::Helper helper(helper_name, "TetGen",
                                  reinterpret_cast<const void*>(&run_isolated), true);
  helper.tell(request_of(complex, switches));
  Run run;
  std::string bytes;
  run.ending = listen_to(helper, patience, run.said, bytes);
  if (run.ending != Ending::done) return run;
  // Only a whole answer counts; a helper that was killed gives none.
  detail::isolated::BytesIn in(bytes);
  std::int32_t ending = 0;
  if (in.get(ending) && in.get_row(run.points) && in.get_row(run.tets) &&
      in.get_row(run.attributes)) {
    run.ending = static_cast<Ending>(ending);
    return run;
  }
  const detail::isolated::HelperEnd end = helper.end();
  run.ending = end.crashed() ? Ending::crashed : Ending::killed;
  run.how = end.text();
  return run;
}

}  // namespace plexway::tetgen

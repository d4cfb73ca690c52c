// TetGen in a child process. It is not made to be a guest: it writes to standard output even when
// told to be quiet, leaks all it has when it gives up, and asserts. A child keeps all of that away
// from the caller, from its other threads and from its standard output.

#include "isolated_run.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <new>

#include <plexway/error.hpp>

#include "../../child_process.hpp"
#include "tetgen_arrays.hpp"

namespace plexway::tetgen {
namespace {

using isolated::Pipe, isolated::send;

constexpr std::size_t most_said = std::size_t{1} << 18;
// Behind it begins what TetGen says; before it may stand what the caller had not flushed yet.
constexpr std::string_view start_of_speech = "\n\x01plexway\x01\n";

struct Header {
  std::int32_t ending = 0;
  std::uint64_t points = 0, tets = 0, attributes = 0;
};

template <class Number>
void send_array(int to, const Number* numbers, std::uint64_t count) {
  send(to, numbers, count * sizeof(Number));
}

void fill(const PiecewiseLinearComplex& complex, const std::string& switches, int speech,
          int answer) {
  isolated::speak_into(speech);
  std::fwrite(start_of_speech.data(), 1, start_of_speech.size(), stdout);
  std::fflush(stdout);
  std::setvbuf(stdout, nullptr, _IOLBF, 1 << 12);  // abort() does not flush

  // Nothing is freed: the process ends here, and after an error TetGen's memory is not to be
  // touched.
  Header header;
  auto* const in = new tetgenio;
  auto* const out = new tetgenio;
  try {
    to_tetgen(complex, *in);
    std::string line = switches;
    ::tetrahedralize(line.data(), in, out);
  } catch (const int code) {
    header.ending = code == 0 ? static_cast<int>(Ending::internal_error) : code;
  } catch (const std::bad_alloc&) {
    header.ending = static_cast<int>(Ending::out_of_memory);
  } catch (...) {
    header.ending = static_cast<int>(Ending::internal_error);
  }
  std::fflush(stdout);
  if (header.ending == 0) {
    header.points = static_cast<std::uint64_t>(out->numberofpoints);
    header.tets = static_cast<std::uint64_t>(out->numberoftetrahedra);
    if (out->numberoftetrahedronattributes == 1) header.attributes = header.tets;
  }
  send(answer, &header, sizeof header);
  send_array(answer, out->pointlist, 3 * header.points);
  send_array(answer, out->tetrahedronlist, 4 * header.tets);
  send_array(answer, out->tetrahedronattributelist, header.attributes);
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
Ending listen_to(Pipe& speech, Pipe& answer, const Patience& patience, std::string& said,
                 std::string& bytes) {
  Clock clock(patience);
  std::vector<char> buffer(std::size_t{1} << 16);
  while (speech.read.number >= 0 || answer.read.number >= 0) {
    std::array<pollfd, 2> wait = {
        {{speech.read.number, POLLIN, 0}, {answer.read.number, POLLIN, 0}}};
    if (::poll(wait.data(), wait.size(), clock.wait()) < 0 && errno != EINTR) return Ending::killed;
    if (const Ending ending = clock.look(); ending != Ending::done) return ending;
    for (std::size_t i = 0; i < 2; ++i) {
      if (wait[i].fd < 0 || wait[i].revents == 0) continue;
      const ssize_t got = ::read(wait[i].fd, buffer.data(), buffer.size());
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) {
        (i == 0 ? speech.read : answer.read).close();
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

template <class Row>
bool take(std::string_view& bytes, std::vector<Row>& rows, std::uint64_t count) {
  if (bytes.size() < count * sizeof(Row)) return false;
  rows.resize(count);
  if (count > 0) std::memcpy(rows.data(), bytes.data(), count * sizeof(Row));
  bytes.remove_prefix(count * sizeof(Row));
  return true;
}

}  // namespace

Run run_isolated(const PiecewiseLinearComplex& complex, const std::string& switches,
                 const Patience& patience) {
  Pipe speech("TetGen"), answer("TetGen");
  const isolated::Child running(
      "TetGen", [&] { fill(complex, switches, speech.write.number, answer.write.number); });
  speech.write.close();
  answer.write.close();

  Run run;
  std::string bytes;
  const Ending heard = listen_to(speech, answer, patience, run.said, bytes);
  const std::size_t start = run.said.find(start_of_speech);
  run.said.erase(0, start == run.said.npos ? run.said.size() : start + start_of_speech.size());
  if (heard != Ending::done) {
    run.ending = heard;
    return run;
  }
  // Only a whole answer counts; a child that was killed gives none.
  Header header;
  if (bytes.size() < sizeof header) return run;
  std::memcpy(&header, bytes.data(), sizeof header);
  std::string_view rest(bytes);
  rest.remove_prefix(sizeof header);
  if (take(rest, run.points, header.points) && take(rest, run.tets, header.tets) &&
      take(rest, run.attributes, header.attributes))
    run.ending = static_cast<Ending>(header.ending);
  return run;
}

}  // namespace plexway::tetgen

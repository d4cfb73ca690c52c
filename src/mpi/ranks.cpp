#include <plexway/mpi/ranks.hpp>

#include <mpi.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <exception>
#include <limits>
#include <mutex>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

#include <plexway/error.hpp>

#include "file/new_file.hpp"
#include "pairs/row_work.hpp"

namespace plexway::mpi {
namespace {

using Clock = std::chrono::steady_clock;

// To the leader: give me a block; a row, as its number and its bytes; a block is through; I am
// through, and this is what I did; I failed. From it: which block.
enum Tag { want = 1, row, through, report, failed, block };

constexpr std::uint64_t no_block = std::numeric_limits<std::uint64_t>::max();
constexpr auto nap = std::chrono::microseconds(100);

static_assert(std::is_trivially_copyable_v<PairsReport>);

void send(const void* bytes, std::size_t size, int to, Tag tag) {
  if (size > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw UsageError("a row of more than 2 GB does not go from rank to rank");
  MPI_Send(bytes, static_cast<int>(size), MPI_BYTE, to, tag, MPI_COMM_WORLD);
}

// MPI's own waiting takes a core, which others have use for.
void wait(MPI_Request& request) {
  for (int ready = 0;;) {
    MPI_Test(&request, &ready, MPI_STATUS_IGNORE);
    if (ready != 0) return;
    std::this_thread::sleep_for(nap);
  }
}

// Looks again at once for a while, then lets others go first, then sleeps.
class Patience {
 public:
  void wait() {
    if (++times_ < 200) return;
    if (times_ < 400)
      std::this_thread::yield();
    else
      std::this_thread::sleep_for(std::chrono::microseconds(20));
  }

 private:
  int times_ = 0;
};

// What was thrown, for the leader to throw again: its kind and its text.
enum class Kind : char { other, usage, input, not_built, endless, memory };

std::string packed_error() {
  const auto text = [](Kind kind, const char* what) {
    return std::string(1, static_cast<char>(kind)) + what;
  };
  try {
    throw;
  } catch (const UsageError& error) {
    return text(Kind::usage, error.what());
  } catch (const InputError& error) {
    return text(Kind::input, error.what());
  } catch (const NotBuiltError& error) {
    return text(Kind::not_built, error.what());
  } catch (const EndlessError& error) {
    return text(Kind::endless, error.what());
  } catch (const std::bad_alloc&) {
    return text(Kind::memory, "");
  } catch (const std::exception& error) {
    return text(Kind::other, error.what());
  } catch (...) {
    return text(Kind::other, "an unknown failure");
  }
}

[[noreturn]] void throw_packed(const std::string& packed, int rank) {
  const std::string text = "rank " + std::to_string(rank) + ": " + packed.substr(1);
  switch (static_cast<Kind>(packed[0])) {
    case Kind::usage:
      throw UsageError(text);
    case Kind::input:
      throw InputError(text);
    case Kind::not_built:
      throw NotBuiltError(text);
    case Kind::endless:
      throw EndlessError(text);
    case Kind::memory:
      throw std::bad_alloc();
    case Kind::other:
      break;
  }
  throw Error(text);
}

/// The leader's side of a matrix: its own threads solve beside, while this one hears the others.
class Leader {
 public:
  Leader(const PairsRequest& request, std::size_t vertices, const PairsSink<RowRanks::Bytes>& sink,
         int others)
      : request_(request), sink_(sink), others_(others) {
    const std::size_t rows = request.row_count(vertices);
    for (std::size_t b = 0; b < request.block_count(vertices); ++b) {
      if (request.wanted && !request.wanted(b)) continue;
      wanted_.push_back(b);
      total_ += std::min(request.block, rows - b * request.block);
    }
  }

  PairsReport run(const RowRanks::Solve& solve) {
    std::thread solver([&] { solve_own(solve); });
    try {
      while (others_ > 0 || !solved_) {
        if (own_failed_) break;
        if (!hear()) std::this_thread::sleep_for(nap);
        tell();
      }
    } catch (...) {
      stop_ = true;
      solver.join();
      throw;
    }
    solver.join();
    if (own_error_) std::rethrow_exception(own_error_);
    return report_;
  }

 private:
  std::optional<std::size_t> next() {
    const std::scoped_lock lock(dealing_);
    if (stop_ || given_ == wanted_.size()) return std::nullopt;
    return wanted_[given_++];
  }

  void keep(std::size_t number, RowRanks::Bytes bytes) {
    sink_.row(number, bytes);
    ++rows_;
  }
  void finish(std::size_t number) {
    if (!sink_.block) return;
    const std::scoped_lock lock(finishing_);
    sink_.block(number);
  }

  void solve_own(const RowRanks::Solve& solve) {
    try {
      PairsRequest mine = request_;
      mine.wanted = {};
      mine.progress = {};
      mine.next = [this] { return next(); };
      mine.solve.progress = [this](const Progress& progress) {
        return !stop_ && (!request_.solve.progress || request_.solve.progress(progress));
      };
      const PairsReport done =
          solve(mine, {[this](std::size_t number, RowRanks::Bytes bytes) { keep(number, bytes); },
                       [this](std::size_t number) { finish(number); }});
      add(done);
    } catch (...) {
      own_error_ = std::current_exception();
      own_failed_ = true;
    }
    solved_ = true;
  }

  void add(const PairsReport& done) {
    const std::scoped_lock lock(finishing_);
    report_.rows += done.rows;
    report_.complete = report_.complete && done.complete;
    detail::apps::add(report_.statistics, done.statistics);
  }

  // Takes a message, if there is one.
  bool hear() {
    int here = 0, size = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &here, &status);
    if (here == 0) return false;
    MPI_Get_count(&status, MPI_BYTE, &size);
    message_.resize(static_cast<std::size_t>(size));
    MPI_Recv(message_.data(), size, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
    std::uint64_t number = no_block;
    if (message_.size() >= sizeof number) std::memcpy(&number, message_.data(), sizeof number);
    switch (static_cast<Tag>(status.MPI_TAG)) {
      case want: {
        if (const auto given = next()) number = *given;
        send(&number, sizeof number, status.MPI_SOURCE, block);
        break;
      }
      case row:
        keep(number, RowRanks::Bytes(message_).subspan(sizeof number));
        break;
      case through:
        finish(number);
        break;
      case report: {
        PairsReport done;
        std::memcpy(&done, message_.data(), sizeof done);
        add(done);
        --others_;
        break;
      }
      case failed:
        throw_packed({reinterpret_cast<const char*>(message_.data()), message_.size()},
                     status.MPI_SOURCE);
      case block:
        break;
    }
    return true;
  }

  void tell() {
    if (!request_.progress) return;
    const auto now = Clock::now();
    if (now - reported_ < std::chrono::milliseconds(50)) return;
    reported_ = now;
    const double seconds = std::chrono::duration<double>(now - start_).count();
    const std::size_t rows = rows_;
    const double rate = static_cast<double>(rows) / std::max(seconds, 1e-9);
    const double left = static_cast<double>(total_ - rows) / rate;
    if (!request_.progress({rows, total_, seconds, rate,
                            rows > 0 ? left : std::numeric_limits<double>::infinity()}))
      throw Cancelled("cancelled by the progress callback");
  }

  const PairsRequest& request_;
  const PairsSink<RowRanks::Bytes>& sink_;
  int others_;
  std::vector<std::size_t> wanted_;  // blocks
  std::size_t given_ = 0, total_ = 0;
  std::mutex dealing_, finishing_;
  std::atomic<bool> stop_{false}, solved_{false}, own_failed_{false};
  std::exception_ptr own_error_;
  std::atomic<std::size_t> rows_{0};
  PairsReport report_;
  std::vector<std::byte> message_;
  Clock::time_point start_ = Clock::now(), reported_ = start_;
};

PairsReport follow(const PairsRequest& request, const RowRanks::Solve& solve) {
  std::mutex calling;  // of MPI
  PairsRequest mine = request;
  mine.wanted = {};
  mine.progress = {};
  mine.next = [&]() -> std::optional<std::size_t> {
    const std::scoped_lock lock(calling);
    std::uint64_t number = 0;
    send(nullptr, 0, 0, want);
    MPI_Recv(&number, sizeof number, MPI_BYTE, 0, block, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    if (number == no_block) return std::nullopt;
    return static_cast<std::size_t>(number);
  };
  const PairsSink<RowRanks::Bytes> sink = {
      [&](std::size_t number, RowRanks::Bytes bytes) {
        const std::uint64_t head = number;
        std::vector<std::byte> message(sizeof head + bytes.size());
        std::memcpy(message.data(), &head, sizeof head);
        if (!bytes.empty()) std::memcpy(message.data() + sizeof head, bytes.data(), bytes.size());
        const std::scoped_lock lock(calling);
        send(message.data(), message.size(), 0, row);
      },
      [&](std::size_t number) {
        const std::uint64_t head = number;
        const std::scoped_lock lock(calling);
        send(&head, sizeof head, 0, through);
      }};
  try {
    const PairsReport done = solve(mine, sink);
    send(&done, sizeof done, 0, report);
    return done;
  } catch (...) {
    const std::string packed = packed_error();
    send(packed.data(), packed.size(), 0, failed);
  }
  // The leader says why, and ends all.
  for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
}

}  // namespace

// What `compare` is told by who goes on.
constexpr int here = -1;

struct Ranks::State {
  int rank = 0, count = 1, on_node = 1;
  int rank_on_node = 0, maker = 0;  // the process that makes what its node needs once
  bool share_nodes = false;
  bool met = false, in_field = false;
  MPI_Comm pieces = MPI_COMM_NULL;  // what belongs to fields
  int tag = 0;                      // of a meeting: 0 and 1 in turns
  std::vector<MPI_Request> sending;
};

Ranks::Ranks(int& argc, char**& argv) : state_(std::make_unique<State>()) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_SERIALIZED, &provided);
  if (provided < MPI_THREAD_SERIALIZED) {
    MPI_Finalize();
    throw Error("this MPI allows no threads");
  }
  MPI_Comm_rank(MPI_COMM_WORLD, &state_->rank);
  MPI_Comm_size(MPI_COMM_WORLD, &state_->count);
  MPI_Comm node;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
  MPI_Comm_size(node, &state_->on_node);
  MPI_Comm_rank(node, &state_->rank_on_node);
  state_->maker = static_cast<int>(::getpid());
  MPI_Bcast(&state_->maker, 1, MPI_INT, 0, node);
  MPI_Comm_free(&node);
  int most = 1;
  MPI_Allreduce(&state_->on_node, &most, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  state_->share_nodes = most > 1;
  MPI_Comm_dup(MPI_COMM_WORLD, &state_->pieces);
}

Ranks::~Ranks() {
  MPI_Request all;
  MPI_Ibarrier(MPI_COMM_WORLD, &all);
  wait(all);
  MPI_Comm_free(&state_->pieces);
  MPI_Finalize();
}

std::size_t Ranks::count() const { return static_cast<std::size_t>(state_->count); }
std::size_t Ranks::rank() const { return static_cast<std::size_t>(state_->rank); }
bool Ranks::met() const { return state_->met; }

int Ranks::threads() const {
  const int cores = static_cast<int>(std::max(std::thread::hardware_concurrency(), 1U));
  cpu_set_t bound;
  CPU_ZERO(&bound);
  const int ours = ::sched_getaffinity(0, sizeof bound, &bound) == 0 ? CPU_COUNT(&bound) : cores;
  return std::max(ours < cores ? ours : cores / state_->on_node, 1);
}

bool Ranks::share_nodes() const { return state_->share_nodes; }

void Ranks::once_a_node(const std::function<void(const std::filesystem::path&)>& make,
                        const std::function<void(const std::filesystem::path&)>& take) {
  std::error_code absent;
  std::filesystem::path file = std::filesystem::temp_directory_path(absent);
  if (absent) file = "/dev/null";  // nothing can be written below it, and so each makes its own
  file /= "plexway-" + std::to_string(state_->maker) + ".plexway";
  struct Removed {
    explicit Removed(const std::filesystem::path& name) : path(name.string()) {}
    ~Removed() { ::unlink(path.c_str()); }
    const std::string path;
    const detail::file::Unfinished by_signals{path.c_str()};
  };
  std::optional<Removed> made;
  if (state_->rank_on_node == 0) {
    made.emplace(file);
    make(file);
  }
  all_come();
  take(file);
  all_come();
}

void Ranks::all_come() {
  const Verdict verdict = compare(here);
  if (verdict.code != here) throw Absent{verdict};
  state_->met = state_->in_field = false;  // there is more to come
}

void Ranks::meet(std::span<const PieceRanks::Bytes> to, std::span<std::vector<std::byte>> from,
                 std::span<std::uint64_t> sums, double& least) {
  // A message is as long as MPI's counts allow, and goes on in another one.
  constexpr std::size_t most = std::size_t{1} << 30;
  static_assert(sizeof(std::uint64_t) == sizeof(unsigned long long));
  state_->met = state_->in_field = true;  // now others wait for this one
  // Nobody is told that nothing comes. A rank joins the reductions once what it sent has arrived,
  // so when they end, all has. Who is a meeting ahead by then sends by the other tag.
  const int tag = state_->tag ^= 1;
  auto& sending = state_->sending;
  sending.clear();
  for (std::size_t step = 1; step < count(); ++step) {  // not all to the same one at once
    const std::size_t r = (rank() + step) % count();
    from[r].clear();
    for (std::size_t at = 0; at < to[r].size(); at += most)
      MPI_Issend(to[r].data() + at, static_cast<int>(std::min(to[r].size() - at, most)), MPI_BYTE,
                 static_cast<int>(r), tag, state_->pieces, &sending.emplace_back());
  }
  const std::vector<std::uint64_t> own(sums.begin(), sums.end());
  const double own_least = least;
  MPI_Request reductions[2];
  const auto hear = [&] {
    int here_now = 0, size = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, tag, state_->pieces, &here_now, &status);
    if (here_now == 0) return false;
    MPI_Get_count(&status, MPI_BYTE, &size);
    auto& bytes = from[static_cast<std::size_t>(status.MPI_SOURCE)];
    const std::size_t before = bytes.size();
    bytes.resize(before + static_cast<std::size_t>(size));
    MPI_Recv(bytes.data() + before, size, MPI_BYTE, status.MPI_SOURCE, tag, state_->pieces,
             MPI_STATUS_IGNORE);
    return true;
  };
  Patience patience;
  for (bool joined = false;;) {
    while (hear()) patience = {};
    int through = 0;
    if (joined) {
      MPI_Testall(2, reductions, &through, MPI_STATUSES_IGNORE);
      if (through != 0) return;
    } else {
      MPI_Testall(static_cast<int>(sending.size()), sending.data(), &through, MPI_STATUSES_IGNORE);
      if (through != 0) {
        MPI_Iallreduce(own.data(), sums.data(), static_cast<int>(own.size()), MPI_UINT64_T, MPI_SUM,
                       state_->pieces, &reductions[0]);
        MPI_Iallreduce(&own_least, &least, 1, MPI_DOUBLE, MPI_MIN, state_->pieces, &reductions[1]);
        joined = true;
        continue;
      }
    }
    patience.wait();
  }
}

PairsReport Ranks::share(const PairsRequest& request, std::size_t vertices,
                         const PairsSink<RowRanks::Bytes>& sink, const Solve& solve) {
  const Verdict verdict = compare(here);
  if (verdict.code != here) throw Absent{verdict};
  if (!leads()) return follow(request, solve);
  return Leader(request, vertices, sink, state_->count - 1).run(solve);
}

Ranks::Verdict Ranks::stay_away(int code) { return compare(code); }

namespace {

// The leader's failure, or else the first; or else who is through; or nobody.
Ranks::Verdict verdict_of(std::span<const int> codes, int code) {
  for (std::size_t r = 0; r < codes.size(); ++r)
    if (codes[r] > 0) return {r, codes[r]};
  for (std::size_t r = 0; r < codes.size(); ++r)
    if (codes[r] == 0) return {r, 0};
  return {0, code};
}

}  // namespace

Ranks::Verdict Ranks::compare(int code) {
  state_->met = true;
  std::vector<int> codes(count());
  MPI_Request all;
  MPI_Iallgather(&code, 1, MPI_INT, codes.data(), 1, MPI_INT, MPI_COMM_WORLD, &all);
  wait(all);
  return verdict_of(codes, code);
}

std::optional<Ranks::Verdict> Ranks::fail_together(int code) {
  if (!state_->in_field) return std::nullopt;
  // Not on the stack: where others do not come MPI keeps it until the end.
  static int own;
  static std::vector<int> codes;
  own = code;
  codes.resize(count());
  MPI_Request all;
  MPI_Iallgather(&own, 1, MPI_INT, codes.data(), 1, MPI_INT, MPI_COMM_WORLD, &all);
  const auto end = Clock::now() + std::chrono::milliseconds(500);
  for (int ready = 0; Clock::now() < end;) {
    MPI_Test(&all, &ready, MPI_STATUS_IGNORE);
    if (ready != 0) return verdict_of(codes, code);
    std::this_thread::sleep_for(nap);
  }
  return std::nullopt;
}

void Ranks::end_all(int code) {
  MPI_Abort(MPI_COMM_WORLD, code);
  std::terminate();  // not reached
}

}  // namespace plexway::mpi

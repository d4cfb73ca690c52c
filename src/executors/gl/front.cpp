#include "executors/gl/front.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <limits>

#include <plexway/error.hpp>

#include "executors/gl/context.hpp"

namespace plexway::detail::gl {

namespace {

/// Reads a small buffer again and again while the device works on: each time it is copied aside
/// behind what has been launched so far, and what arrives is the copy made the time before. Without
/// persistent mapping (OpenGL 4.4) it waits for the device instead.
class Readback {
 public:
  Readback(const Session& session, GLuint buffer, std::size_t bytes);
  ~Readback();
  Readback(const Readback&) = delete;
  Readback& operator=(const Readback&) = delete;

  /// Starts a copy. True, with `values`, if an earlier one has arrived.
  bool next(const Session& session, void* values);
  /// Waits for all copies and forgets them.
  void finish(const Session& session);

 private:
  const Functions& gl_;
  GLuint buffer_, copies_ = 0;
  std::size_t bytes_;
  const unsigned char* mapped_ = nullptr;
  std::array<GLsync, 2> fences_{};
  std::size_t started_ = 0;
};

Readback::Readback(const Session& session, GLuint buffer, std::size_t bytes)
    : gl_(session.gl), buffer_(buffer), bytes_(bytes) {
  if (gl_.BufferStorage == nullptr || gl_.MapBufferRange == nullptr) return;
  const auto all = static_cast<GLsizeiptr>(fences_.size() * bytes_);
  constexpr GLbitfield flags = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
  gl_.GenBuffers(1, &copies_);
  gl_.BindBuffer(GL_COPY_WRITE_BUFFER, copies_);
  gl_.BufferStorage(GL_COPY_WRITE_BUFFER, all, nullptr, flags);
  mapped_ =
      static_cast<const unsigned char*>(gl_.MapBufferRange(GL_COPY_WRITE_BUFFER, 0, all, flags));
}

Readback::~Readback() {
  for (const GLsync fence : fences_)
    if (fence != nullptr) gl_.DeleteSync(fence);
  if (copies_ != 0) gl_.DeleteBuffers(1, &copies_);
}

bool Readback::next(const Session&, void* values) {
  if (mapped_ == nullptr) {
    gl_.BindBuffer(GL_COPY_READ_BUFFER, buffer_);
    gl_.GetBufferSubData(GL_COPY_READ_BUFFER, 0, static_cast<GLsizeiptr>(bytes_), values);
    return true;
  }
  const std::size_t slot = started_++ % fences_.size(), last = 1 - slot;
  gl_.BindBuffer(GL_COPY_READ_BUFFER, buffer_);
  gl_.BindBuffer(GL_COPY_WRITE_BUFFER, copies_);
  gl_.CopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 0,
                        static_cast<GLintptr>(slot * bytes_), static_cast<GLsizeiptr>(bytes_));
  fences_[slot] = gl_.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  gl_.Flush();
  if (fences_[last] == nullptr) return false;
  GLenum waited = GL_TIMEOUT_EXPIRED;
  while (waited == GL_TIMEOUT_EXPIRED)
    waited = gl_.ClientWaitSync(fences_[last], 0, GLuint64{1000000000});
  gl_.DeleteSync(fences_[last]);
  fences_[last] = nullptr;
  if (waited == GL_WAIT_FAILED) throw Error("the GL device was lost while it worked");
  std::memcpy(values, mapped_ + last * bytes_, bytes_);
  return true;
}

void Readback::finish(const Session&) {
  gl_.Finish();
  for (GLsync& fence : fences_) {
    if (fence != nullptr) gl_.DeleteSync(fence);
    fence = nullptr;
  }
}

constexpr GLbitfield all_that_follows =
    GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT;

}  // namespace

void dispatch(const Session& session, std::size_t invocations) {
  const std::size_t group = session.context().group(), most = session.limits().groups;
  const std::size_t groups = (invocations + group - 1) / group;
  const std::size_t rows = (groups + most - 1) / most;
  if (rows > most)
    throw NotBuiltError("a launch of " + std::to_string(groups) +
                        " work groups is more than this GL device can do (" + std::to_string(most) +
                        " squared, GL_MAX_COMPUTE_WORK_GROUP_COUNT)");
  if (groups > 0)
    session.gl.DispatchCompute(static_cast<GLuint>(std::min(groups, most)),
                               static_cast<GLuint>(rows), 1);
  session.gl.MemoryBarrier(all_that_follows);
}

Front::Front()
    : control_("control"),
      cells_("distances"),
      labels_("labels"),
      waiting_("waiting labels"),
      waiting_labels_("waiting labels") {}

void Front::release(const Session& session) {
  for (Buffer* b : {&control_, &cells_, &labels_, &waiting_, &waiting_labels_}) b->release(session);
}

std::size_t Front::bytes() const {
  return control_.bytes() + cells_.bytes() + labels_.bytes() + waiting_.bytes() +
         waiting_labels_.bytes();
}

void Front::start(const Session& session, std::size_t cells, std::size_t label_bytes,
                  std::size_t room, double step, std::size_t max_expansions) {
  if (cells >= none)
    throw NotBuiltError("one launch on the GL device cannot number " + std::to_string(cells) +
                        " simplices, 2^32 - 2 at most");
  label_bytes_ = label_bytes;
  growths_ = 0;
  control_.reserve(session, sizeof(FrontControl));
  labels_.check(session, cells * label_bytes);  // before anything large is allocated
  cells_.reserve(session, cells * sizeof(Cell));
  labels_.reserve(session, cells * label_bytes);
  state_ = FrontControl();
  state_.limit = state_.step = static_cast<float>(step);
  state_.budget = {static_cast<GLuint>(max_expansions & 0xffffffffu),
                   static_cast<GLuint>(max_expansions >> 32)};
  // What an earlier solve needed, this one may need again.
  const std::size_t there = std::min(waiting_.bytes() / (3 * sizeof(Waiting)),
                                     waiting_labels_.bytes() / (3 * label_bytes));
  state_.capacity = static_cast<GLuint>(std::min(there, cells + 1));
  make_room(session, std::min(room, most_entries(session)));
  cells_.fill(session, FrontControl::unreached, cells * (sizeof(Cell) / sizeof(GLuint)));
}

void Front::make_room(const Session& session, std::size_t entries) {
  if (state_.capacity >= entries && state_.capacity > 0) return;
  // Every queue may become the current one: all have the same room.
  const std::size_t capacity = std::max(entries, std::size_t{1});
  waiting_.reserve(session, 3 * capacity * sizeof(Waiting));
  waiting_labels_.reserve(session, 3 * capacity * label_bytes_);
  state_.capacity = static_cast<GLuint>(capacity);
}

void Front::begin_with(const Session& session, std::size_t entries) {
  state_.total = state_.waiting_in[0] = static_cast<GLuint>(entries);
  write_state(session);
  accept(session, 0, entries);
}

void Front::accept(const Session& session, std::size_t first, std::size_t count) {
  bind(session);
  const Uniforms program(session, session.program("accept.comp"));
  program.set("first", first);
  program.set("count", count);
  dispatch(session, count);
}

std::size_t Front::add(const Session& session, const std::function<void()>& add) {
  for (;;) {
    state_.state = FrontControl::running;
    state_.begin = state_.total;
    state_.count = 0;
    state_.waiting_in = {};
    state_.was_far = state_.live = state_.accepted = 0;
    state_.nearest_far = FrontControl::unreached;
    state_.spare = 0;
    write_state(session);
    bind(session);
    add();
    read_state(session);
    const std::size_t found = state_.waiting_in[state_.far];
    if (found <= state_.capacity) {
      accept(session, std::size_t{state_.far} * state_.capacity, found);
      read_state(session);
      return state_.accepted;
    }
    grow(session);
  }
}

bool Front::spread(const Session& session, GLuint rule, std::size_t share,
                   const std::string& label_defines,
                   const std::function<void(const FrontControl&)>& report, GLuint narrow) {
  constexpr std::size_t offers = offsetof(FrontControl, dispatch);
  constexpr std::size_t settling = offsetof(FrontControl, settle_dispatch);
  const GLuint contest = session.program("contest.comp", label_defines);
  const GLuint twins = session.program("twins.comp", label_defines);
  const GLuint settle = session.program("settle.comp", label_defines);
  const auto bind_all = [&] {
    bind(session);
    session.gl.BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, control_.name());
  };
  bind_all();
  advance(session, share);
  Readback readback(session, control_.name(), sizeof(FrontControl));
  std::size_t rounds = 8;
  for (;;) {
    for (std::size_t n = 0; n < rounds; ++n) {
      launch(session, contest, settling);
      launch(session, twins, offsetof(FrontControl, twin_dispatch));
      launch(session, settle, settling);
      if (narrow != 0) launch(session, narrow, settling);
      launch(session, rule, offers);
      advance(session, share);
    }
    rounds = std::min<std::size_t>(2 * rounds, 64);
    // What it was some rounds ago, while those just launched are under way: once it rests, they
    // do nothing.
    if (!readback.next(session, &state_)) continue;
    if (report) report(state_);
    if (state_.state == FrontControl::running) continue;
    readback.finish(session);
    read_state(session);
    if (state_.state != FrontControl::overflowed) break;
    grow(session);
    // What the round settled makes its offers again.
    state_.state = FrontControl::running;
    write_state(session);
    bind_all();
    session.gl.UseProgram(rule);
    dispatch(session, session.context().group() / share * state_.count);
    advance(session, share);
    rounds = 8;
  }
  if (state_.state == FrontControl::done) return true;
  settle_all(session, label_defines);
  return false;
}

void Front::launch(const Session& session, GLuint program, std::size_t indirect) const {
  session.gl.UseProgram(program);
  session.gl.DispatchComputeIndirect(static_cast<GLintptr>(indirect));
  session.gl.MemoryBarrier(all_that_follows);
}

void Front::advance(const Session& session, std::size_t share) {
  const Uniforms program(session, session.program("advance.comp"));
  program.set("share", share);
  program.set("group", std::size_t{session.context().group()});
  program.set("most_groups", std::min<std::size_t>(session.limits().groups, 65535));
  session.gl.DispatchCompute(1, 1, 1);
  session.gl.MemoryBarrier(all_that_follows);
}

void Front::settle_all(const Session& session, const std::string& label_defines) {
  const FrontControl before = state_;
  bind(session);
  for (const char* const pass : {"contest.comp", "twins.comp", "settle.comp"})
    for (GLuint queue = 0; queue < 3; ++queue) {
      read_state(session);
      state_.current = queue;
      state_.limit = std::numeric_limits<float>::infinity();
      state_.twin_dispatch[0] = 1;
      state_.begin = queue == before.current ? before.begin : 0;
      state_.count =
          (queue == before.current ? before.total : before.waiting_in[queue]) - state_.begin;
      write_state(session);
      session.gl.UseProgram(session.program(pass, label_defines));
      dispatch(session, state_.count);
    }
  read_state(session);
  state_.expansions = before.expansions;
}

std::size_t Front::most_entries(const Session& session) const {
  return session.limits().block / (3 * std::max(label_bytes_, sizeof(Waiting)));
}

void Front::grow(const Session& session) {
  const std::size_t old = state_.capacity, most = most_entries(session);
  // At the limit twice as many are asked for, which is refused with the limit.
  const std::size_t capacity = old < most ? std::min(2 * old, most) : 2 * old;
  ++growths_;
  const auto move = [&](Buffer& buffer, std::size_t size) {
    Buffer larger(buffer.what());
    larger.reserve(session, 3 * capacity * size);
    for (std::size_t queue = 0; queue < 3; ++queue)
      larger.copy(session, buffer, queue * old * size, queue * capacity * size, old * size);
    buffer.swap(larger);
    larger.release(session);
  };
  move(waiting_, sizeof(Waiting));
  move(waiting_labels_, label_bytes_);
  state_.capacity = static_cast<GLuint>(capacity);
}

void Front::bind(const Session& session) const {
  control_.bind(session, 0);
  cells_.bind(session, 1);
  labels_.bind(session, 2);
  waiting_.bind(session, 3);
  waiting_labels_.bind(session, 4);
}

void Front::write_state(const Session& session) {
  control_.write(session, std::span<const FrontControl>(&state_, 1));
}

void Front::read_state(const Session& session) {
  control_.read(session, std::span<FrontControl>(&state_, 1));
}

}  // namespace plexway::detail::gl

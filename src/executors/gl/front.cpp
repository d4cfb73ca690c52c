#include "executors/gl/front.hpp"

#include <algorithm>
#include <bit>

#include "executors/gl/readback.hpp"
#include "executors/gl/uniforms.hpp"

namespace plexway::gl {
namespace {

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
      best_("distances"),
      labels_("labels"),
      waiting_("waiting labels"),
      waiting_labels_("waiting labels") {}

void Front::release(const Session& session) {
  for (Buffer* b : {&control_, &best_, &labels_, &waiting_, &waiting_labels_}) b->release(session);
}

std::size_t Front::bytes() const {
  return control_.bytes() + best_.bytes() + labels_.bytes() + waiting_.bytes() +
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
  best_.reserve(session, cells * sizeof(GLuint));
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
  best_.fill(session, FrontControl::unreached, cells);
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

bool Front::add(const Session& session, const std::function<void()>& add) {
  for (;;) {
    state_.state = FrontControl::running;
    state_.begin = state_.total;
    state_.count = 0;
    state_.waiting_in = {};
    state_.nearest_far = FrontControl::unreached;
    state_.spare = 0;
    write_state(session);
    bind(session);
    add();
    read_state(session);
    const std::size_t near = state_.waiting_in[state_.near], far = state_.waiting_in[state_.far];
    if (near <= state_.capacity && far <= state_.capacity) {
      const std::size_t before = FrontControl::wide(state_.updates);
      for (const GLuint queue : {state_.near, state_.far})
        accept(session, std::size_t{queue} * state_.capacity, state_.waiting_in[queue]);
      read_state(session);
      return FrontControl::wide(state_.updates) != before;
    }
    grow(session);
  }
}

bool Front::spread(const Session& session, GLuint rule, std::size_t share,
                   const std::string& keep_defines,
                   const std::function<void(const FrontControl&)>& report, GLuint settle) {
  const Functions& gl = session.gl;
  bind(session);
  gl.BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, control_.name());
  const GLuint advance_program = session.program("advance.comp");
  advance(session, share);
  Readback readback(session, control_.name(), sizeof(FrontControl));
  std::size_t rounds = 8;
  for (;;) {
    for (std::size_t n = 0; n < rounds; ++n) {
      for (const GLuint program : {settle, rule}) {
        if (program == 0) continue;
        gl.UseProgram(program);
        gl.DispatchComputeIndirect(0);
        gl.MemoryBarrier(all_that_follows);
      }
      gl.UseProgram(advance_program);
      gl.DispatchCompute(1, 1, 1);
      gl.MemoryBarrier(all_that_follows);
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
    state_.state = FrontControl::running;
    state_.count = 0;  // so the same part of the queue is expanded again
    write_state(session);
    bind(session);
    gl.BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, control_.name());
    advance(session, share);
    rounds = 8;
  }
  if (state_.state == FrontControl::done) return true;
  keep(session, keep_defines);
  return false;
}

void Front::advance(const Session& session, std::size_t share) {
  const Uniforms program(session, session.program("advance.comp"));
  program.set("share", share);
  program.set("most_groups", std::min<std::size_t>(session.limits().groups, 65535));
  session.gl.DispatchCompute(1, 1, 1);
  session.gl.MemoryBarrier(all_that_follows);
}

void Front::keep(const Session& session, const std::string& defines) {
  bind(session);
  for (GLuint queue = 0; queue < 3; ++queue) {
    const Uniforms program(session, session.program("keep.comp", defines));
    program.set("first", std::size_t{queue} * state_.capacity);
    program.set("count", std::size_t{state_.waiting_in[queue]});
    dispatch(session, state_.waiting_in[queue]);
  }
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
  best_.bind(session, 1);
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

}  // namespace plexway::gl

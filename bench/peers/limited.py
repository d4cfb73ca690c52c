#!/usr/bin/env python3
"""Runs a command within limits and writes down what it took.

    limited.py SECONDS BYTES REPORT STDERR COMMAND...

SECONDS are of the processor, since a busy machine stretches the clock; what hangs is ended after ten times as long.

The command gets a session of its own, so that all it started ends with it. REPORT is a JSON object: `wall` and
`processor` seconds (user and system, of the command and what it waited for), `peak` bytes of the largest of these
processes, `status` as the shell has it (128 + N for signal N), `late` where it was stopped: by `clock` or `processor`.
This program is small on purpose, since the kernel counts what started a process as the process's own until it has
loaded: no peak is below its size, which is reported as `floor`.
"""
import json
import math
import os
import resource
import signal
import sys
import time


def start(seconds, memory, errors, command):
    child = os.fork()
    if child:
        return child
    try:
        os.setsid()
        if memory > 0:
            resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        most = max(1, math.ceil(seconds))
        resource.setrlimit(resource.RLIMIT_CPU, (most, most + 1))
        nothing = os.open(os.devnull, os.O_RDWR)
        os.dup2(nothing, 0)
        os.dup2(nothing, 1)
        os.dup2(os.open(errors, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o644), 2)
        os.execvp(command[0], command)
    except OSError as error:
        os.write(2, f"{command[0]}: {error.strerror}\n".encode())
    os._exit(127)


def end_all_of(child):
    try:
        os.killpg(child, signal.SIGKILL)
    except ProcessLookupError:
        pass


def main():
    seconds, memory, report, errors = float(sys.argv[1]), int(sys.argv[2]), sys.argv[3], sys.argv[4]
    late = []
    begin = time.monotonic()
    child = start(seconds, memory, errors, sys.argv[5:])

    def stop(*_):
        late.append("clock")
        end_all_of(child)

    signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, 10 * seconds)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    try:
        _, status, used = os.wait4(child, 0)
        wall = time.monotonic() - begin
        signal.setitimer(signal.ITIMER_REAL, 0)
    finally:  # whoever stops this stops the command
        end_all_of(child)
    code = 128 + os.WTERMSIG(status) if os.WIFSIGNALED(status) else os.WEXITSTATUS(status)
    if not late and os.WIFSIGNALED(status) and os.WTERMSIG(status) == signal.SIGXCPU:
        late.append("processor")
    own = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    with open(report, "w", encoding="utf-8") as file:
        json.dump({"wall": wall, "processor": used.ru_utime + used.ru_stime, "peak": 1024 * used.ru_maxrss,
                   "status": code, "late": late[0] if late else None, "floor": 1024 * own}, file)


if __name__ == "__main__":
    main()

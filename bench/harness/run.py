"""Runs programs by turns, each within a limit, and takes medians."""

import math
import os
import resource
import signal
import statistics
import subprocess
import sys
import time


# The allocator of all programs that are compared keeps what they free, as it does with small blocks:
# fetching memory from the system anew in each round would be most of what differs between sizes.
KEEP = {"GLIBC_TUNABLES": "glibc.malloc.mmap_threshold=8589934592:"
                          "glibc.malloc.trim_threshold=8589934592"}


class Unfinished(Exception):
    """A program that gave no result: the reason as the tables show it."""


def run(words, limit, stdin=None, stdout=subprocess.PIPE, env=None, allowed=(0,)):
    """Runs a program; gives its output, the time on the clock and that of the processor.

    `limit` is in seconds of processor time; `allowed` are the statuses of success.
    """
    # On the clock a busy machine may take longer.
    alarm = 5 * limit + 30
    prepare = lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 2))
    start = time.monotonic()
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        ended = subprocess.run(
            words, stdin=stdin, stdout=stdout, stderr=subprocess.PIPE, text=True,
            env=env, preexec_fn=prepare, timeout=alarm, check=False,
        )
    except subprocess.TimeoutExpired:
        raise Unfinished(f"> {limit} s") from None
    wall = time.monotonic() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    if ended.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
        raise Unfinished(f"> {limit} s")
    if ended.returncode not in allowed:
        said = (ended.stderr.strip().splitlines() or ["nothing"])[-1]
        print(f"{words}: status {ended.returncode}: {said}", file=sys.stderr)
        raise Unfinished("crash" if ended.returncode < 0 or "panicked" in ended.stderr else "error")
    return ended.stdout, wall, cpu


class Result:
    """The medians of what a program told of one input; see `bench/src/measure.rs`."""

    def __init__(self, rows):
        self.edges, self.found, self.growth = rows[0][0], rows[0][1], rows[0][4]
        self.first = statistics.median(row[2] for row in rows)
        self.second = statistics.median(row[3] for row in rows)
        self.cold = statistics.median(row[5] for row in rows)

    @property
    def time(self):
        """Both stages, in nanoseconds."""
        return self.first + self.second


def by_turns(commands, rounds, limit, budget):
    """Runs each program once a round, on the file it is given.

    `commands` has the words and the file of each name. A program that has spent `budget` seconds
    skips the rounds left; one that fails is not run again. Gives a Result or Unfinished by name.
    All keep the memory they free.
    """
    env = os.environ | KEEP
    rows = {name: [] for name in commands}
    spent = dict.fromkeys(commands, 0.0)
    failed = {}
    for _ in range(rounds):
        for name, (words, path) in commands.items():
            if name in failed or spent[name] > budget:
                continue
            try:
                with open(path, "rb") as file:
                    told, _, cpu = run(words, limit, stdin=file, env=env)
            except Unfinished as reason:
                failed[name] = reason
                continue
            rows[name].append([int(word) for word in told.split()])
            spent[name] += cpu
    return {name: failed.get(name) or Result(rows[name]) for name in commands}


def short(number, digits=3):
    """A number of about that many digits, without an exponent."""
    size = math.floor(math.log10(number)) if number > 0 else 0
    return f"{number:,.{max(digits - 1 - size, 0)}f}"


def microseconds(result, edges=None):
    """The cell of a table: time an edge, or why there is none."""
    if not isinstance(result, Result):
        return str(result)
    return short(result.time / (edges or result.edges) / 1e3)


def ratio(above, below):
    """The cell of a table: how many times as long `above` took."""
    if isinstance(above, Result) and isinstance(below, Result):
        return short(above.time / below.time, 2)
    return ""

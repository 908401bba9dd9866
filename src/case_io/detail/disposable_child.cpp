// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. Memory for the outcome is shared, a pipe takes complaints, then this process forks.
// 2. The child: handlers, descriptors and limits, the filter of system calls, the work, the
// outcome.
// 3. The parent waits, kills after the deadline, and believes nothing but a finished outcome.
#include "case_io/detail/disposable_child.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <new>
#include <thread>

#include "case_io/detail/memory_room.hpp"
#include "case_io/detail/shared_array.hpp"
#include "case_io/detail/system_call_filter.hpp"
#include "core/error.hpp"
#include "core/is_sanitized.hpp"

namespace carpus::case_io {
namespace {

enum class Outcome : std::uint32_t { None, Done, Io, Invalid, OutOfMemory, Unexpected };

struct Report {
  std::atomic<std::uint64_t> steps;
  Outcome outcome;
  std::array<char, 2048> words;
};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

void set_limit(__rlimit_resource resource, std::uint64_t most) {
  rlimit limit{};
  if (::getrlimit(resource, &limit) != 0) return;
  limit.rlim_max = std::min<rlim_t>(limit.rlim_max, most);
  limit.rlim_cur = limit.rlim_max;
  if (::setrlimit(resource, &limit) != 0) ::_exit(EXIT_FAILURE);
}

void forget_signals() {
  for (int signal = 1; signal < NSIG; ++signal) ::signal(signal, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
}

/// Everything but memory and the pipe is gone after this.
void lock_in(const ChildTask& task, int complaints) {
  // Asked for here: until the fork other threads may have mapped more.
  const std::uint64_t mapped = mapped_bytes();
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  forget_signals();
  if (::dup2(complaints, STDERR_FILENO) < 0) ::_exit(EXIT_FAILURE);
  ::close(STDIN_FILENO);
  ::close(STDOUT_FILENO);
  if (::close_range(STDERR_FILENO + 1, ~0U, 0) != 0) ::_exit(EXIT_FAILURE);
  ::prctl(PR_SET_DUMPABLE, 0);
  if (!kIsSanitized) set_limit(RLIMIT_AS, mapped + task.heap_bytes);
  const auto seconds = std::chrono::ceil<std::chrono::seconds>(task.deadline).count();
  set_limit(RLIMIT_CPU, static_cast<std::uint64_t>(seconds) + 1);
  set_limit(RLIMIT_CORE, 0);
  set_limit(RLIMIT_FSIZE, 0);
  if (!allow_decoding_only()) {
    constexpr const char* kWords = "this system does not filter system calls";
    if (::write(STDERR_FILENO, kWords, std::strlen(kWords)) < 0) ::_exit(EXIT_FAILURE);
    ::_exit(EXIT_FAILURE);
  }
}

void say(Report& report, Outcome outcome, const char* words) noexcept {
  std::strncpy(report.words.data(), words, report.words.size() - 1);
  report.outcome = outcome;
}

[[noreturn]] void be_the_child(const ChildTask& task, Report& report, int complaints) noexcept {
  lock_in(task, complaints);
  try {
    task.work(report.steps);
    report.outcome = Outcome::Done;
  } catch (const InvalidInput& error) {
    say(report, Outcome::Invalid, error.what());
  } catch (const Error& error) {
    say(report, Outcome::Io, error.what());
  } catch (const std::bad_alloc&) {
    say(report, Outcome::OutOfMemory, "");
  } catch (const std::exception& error) {
    say(report, Outcome::Unexpected, error.what());
  } catch (...) {
    say(report, Outcome::Unexpected, "an unknown exception");
  }
  ::_exit(EXIT_SUCCESS);
}

class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int value() const noexcept { return value_; }
  void close() {
    if (value_ >= 0) ::close(value_);
    value_ = -1;
  }

 private:
  int value_;
};

/// How the child ended; status as waitpid gives it.
struct Ending {
  int status = 0;
  bool is_too_late = false;
};

std::uint64_t steps_of(const ChildTask& task, const Report& report) {
  return std::min(report.steps.load(), task.most_steps);
}

Ending wait_for(pid_t child, const ChildTask& task, const Report& report) {
  const auto deadline = std::chrono::steady_clock::now() + task.deadline;
  auto pause = std::chrono::microseconds(100);
  constexpr auto kLongestPause = std::chrono::microseconds(10000);
  std::uint64_t told = 0;
  Ending ending;
  const auto tell = [&] {
    if (!task.watch) return;
    for (const std::uint64_t now = steps_of(task, report); told < now;) task.watch(++told);
  };
  const auto kill_child = [&] {
    ::kill(child, SIGKILL);
    while (::waitpid(child, &ending.status, 0) < 0 && errno == EINTR) {
    }
  };
  for (;;) {
    const pid_t ended = ::waitpid(child, &ending.status, WNOHANG);
    if (ended == child || (ended < 0 && errno != EINTR)) break;
    try {
      tell();
    } catch (...) {  // whoever watches has had enough
      kill_child();
      throw;
    }
    if (std::chrono::steady_clock::now() > deadline) {
      ending.is_too_late = true;
      kill_child();
      break;
    }
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, kLongestPause);
  }
  tell();
  return ending;
}

std::string complaints_in(int pipe) {
  std::array<char, 400> bytes{};
  const ssize_t got = ::read(pipe, bytes.data(), bytes.size());
  std::string words(bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  for (char& c : words) c = c >= ' ' && c <= '~' ? c : ' ';
  words.erase(words.find_last_not_of(' ') + 1);
  return words;
}

constexpr const char* kCopyAgain = "; it is damaged: copy it again from its source";

[[noreturn]] void throw_ending(const std::string& file,
                               const Ending& ending,
                               const std::string& complaints) {
  if (ending.is_too_late || (WIFSIGNALED(ending.status) && WTERMSIG(ending.status) == SIGXCPU)) {
    throw IoError(file + ": takes too long to decode" + kCopyAgain);
  }
  std::string how = WIFSIGNALED(ending.status)
                        ? std::string("signal ") + std::to_string(WTERMSIG(ending.status))
                        : "exit " + std::to_string(WEXITSTATUS(ending.status));
  if (WIFSIGNALED(ending.status) && WTERMSIG(ending.status) == SIGSYS) {
    how += ", a system call that it may not make";
  }
  if (WIFSIGNALED(ending.status) && WTERMSIG(ending.status) == SIGBUS) {
    how += ", the file shrank or its disk failed";
  }
  if (!complaints.empty()) how += ": " + complaints;
  throw IoError(file + ": its decoder crashed (" + how + ")" + kCopyAgain);
}

void throw_report(const std::string& file, Report& report, const std::string& complaints) {
  report.words.back() = '\0';
  std::string words = report.words.data();
  for (char& c : words) c = c == '\n' || static_cast<unsigned char>(c) >= ' ' ? c : '?';
  switch (report.outcome) {
    case Outcome::Done:
      if (complaints.empty()) return;
      throw IoError(file + ": its decoder complains (" + complaints + ")" + kCopyAgain);
    case Outcome::Io:
      throw IoError(words);
    case Outcome::Invalid:
      throw InvalidInput(words);
    case Outcome::OutOfMemory:
      throw IoError(file + ": asks its decoder for more memory than such a file needs" +
                    kCopyAgain);
    case Outcome::None:
    case Outcome::Unexpected:
      break;
  }
  throw IoError(file + ": cannot be decoded (" + words + ")" + kCopyAgain);
}

}  // namespace

std::chrono::milliseconds time_for(std::uint64_t bytes) {
  constexpr std::uint64_t kLeastMs = 20000;
  constexpr std::uint64_t kSlowestBytesPerMs = 5000;
  return std::chrono::milliseconds(kLeastMs + bytes / kSlowestBytesPerMs);
}

void run_in_child(const ChildTask& task) {
  SharedArray<Report> shared(1);
  Report& report = *new (shared.values().data()) Report{};
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK) != 0) {
    throw IoError(task.subject(0) + ": cannot be read, too many files are open; try again");
  }
  const Descriptor read_end(ends[0]);
  Descriptor write_end(ends[1]);
  sigset_t all;
  sigset_t before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);  // no handler of ours may run in the child
  const pid_t child = ::fork();
  if (child == 0) be_the_child(task, report, ends[1]);
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (child < 0) {
    throw IoError(task.subject(0) + ": cannot be read, no process can be started (" +
                  std::strerror(errno) + "); close other programs and try again");
  }
  write_end.close();
  const Ending ending = wait_for(child, task, report);
  const std::string complaints = complaints_in(read_end.value());
  const std::string file = task.subject(steps_of(task, report));
  if (ending.is_too_late || !WIFEXITED(ending.status) ||
      WEXITSTATUS(ending.status) != EXIT_SUCCESS || report.outcome == Outcome::None) {
    throw_ending(file, ending, complaints);
  }
  throw_report(file, report, complaints);
}

}  // namespace carpus::case_io

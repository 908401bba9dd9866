// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/watched_program.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>

#include "core/error.hpp"

namespace carpus::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kNice = 10;
constexpr int kLookEveryMs = 100;
constexpr std::chrono::seconds kToEnd{1};
constexpr std::size_t kLongestLine = 500;

/// Between fork and exec: nothing but calls to the system.
[[noreturn]] void become(const char* program, char* const* argv, int said) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::setpgid(0, 0);
  if (::nice(kNice) == -1) errno = 0;  // it works as well without
  const int none = ::open("/dev/null", O_RDWR);
  ::dup2(none, STDIN_FILENO);
  ::dup2(none, STDOUT_FILENO);
  ::dup2(said, STDERR_FILENO);
  ::close_range(STDERR_FILENO + 1, ~0U, 0);
  std::signal(SIGPIPE, SIG_DFL);
  std::signal(SIGXFSZ, SIG_DFL);
  sigset_t all;
  sigemptyset(&all);
  ::sigprocmask(SIG_SETMASK, &all, nullptr);
  ::execv(program, argv);
  ::_exit(127);
}

class Child {
 public:
  Child(pid_t pid, int said) : pid_(pid), said_(said) {}
  ~Child() { ::close(said_); }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// @return whether there may be more
  bool read(const Progress& progress, std::string& complaint) {
    ::pollfd waiting{said_, POLLIN, 0};
    if (::poll(&waiting, 1, kLookEveryMs) <= 0) return true;
    std::array<char, 4096> piece{};
    const ssize_t size = ::read(said_, piece.data(), piece.size());
    if (size <= 0) return size < 0 && errno == EINTR;
    for (const char c : std::string_view(piece.data(), static_cast<std::size_t>(size))) {
      if (c != '\n') {
        if (line_.size() < kLongestLine) line_ += c;
        continue;
      }
      if (!line_.empty() && !follow_progress(line_, progress) &&
          line_.find("warning:") == std::string::npos) {
        complaint = line_;
      }
      line_.clear();
    }
    return true;
  }
  void end(int signal) const { ::kill(-pid_, signal); }
  [[nodiscard]] int status() const {
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
  }

 private:
  pid_t pid_;
  int said_;
  std::string line_;
};

}  // namespace

bool follow_progress(std::string_view line, const Progress& progress) {
  const std::size_t end = line.find(" %] ");
  if (!line.starts_with('[') || end == std::string_view::npos) return false;
  std::string_view digits = line.substr(1, end - 1);
  digits.remove_prefix(std::min(digits.find_first_not_of(' '), digits.size()));
  int percent = 0;
  const auto [last, error] = std::from_chars(digits.data(), digits.data() + digits.size(), percent);
  if (error != std::errc{} || last != digits.data() + digits.size()) return false;
  std::string_view stage = line.substr(end + 4);
  stage = stage.substr(0, stage.find_last_not_of(' ') + 1);
  progress(stage, std::min(1.0, percent / 100.0));
  return true;
}

ProgramEnd run_watched(const std::filesystem::path& program,
                       const std::vector<std::string>& arguments,
                       const Progress& progress,
                       const std::atomic<bool>& stop,
                       std::chrono::seconds longest) {
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) {
    throw IoError(std::string("no pipe can be made: ") + std::strerror(errno));
  }
  const pid_t pid = ::fork();
  if (pid == 0) become(argv[0], argv.data(), pipe[1]);
  ::close(pipe[1]);
  if (pid < 0) {
    ::close(pipe[0]);
    throw IoError(program.string() + ": cannot be started: " + std::strerror(errno));
  }
  Child child(pid, pipe[0]);
  ProgramEnd end;
  const auto due = Clock::now() + longest;
  Clock::time_point asked{};
  while (child.read(progress, end.complaint)) {
    const auto now = Clock::now();
    const bool is_late = now > due;
    if (!stop && !is_late) continue;
    end.was_stopped = true;
    if (asked == Clock::time_point{}) {
      asked = now;
      child.end(SIGTERM);
    } else if (now > asked + kToEnd) {
      child.end(SIGKILL);
    }
  }
  const int status = child.status();
  end.is_well = !end.was_stopped && WIFEXITED(status) && WEXITSTATUS(status) == 0;
  if (end.is_well || !end.complaint.empty()) return end;
  end.complaint = WIFSIGNALED(status) ? "The work on it ended by itself; is there enough memory?"
                                      : "The work on it failed and did not say why.";
  return end;
}

}  // namespace carpus::cli

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/child_program.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <fstream>
#include <sstream>

#include "core/error.hpp"

namespace carpus::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLinesTold = 4;

std::string last_lines(const fs::path& log) {
  std::ifstream file(log);
  std::deque<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (line.empty()) continue;
    lines.push_back(line.substr(0, 300));
    if (lines.size() > kLinesTold) lines.pop_front();
  }
  std::string text;
  for (const std::string& line : lines) text += "\n  " + line;
  return text;
}

class FileActions {
 public:
  explicit FileActions(const fs::path& log) {
    ::posix_spawn_file_actions_init(&actions_);
    ::posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, log.c_str(),
                                       O_WRONLY | O_CREAT | O_TRUNC, 0644);
    ::posix_spawn_file_actions_adddup2(&actions_, STDOUT_FILENO, STDERR_FILENO);
  }
  ~FileActions() { ::posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
  [[nodiscard]] const ::posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  ::posix_spawn_file_actions_t actions_{};
};

}  // namespace

fs::path own_program() { return fs::read_symlink("/proc/self/exe"); }

fs::path find_on_path(const std::vector<std::string>& names) {
  const char* path = std::getenv("PATH");
  if (path == nullptr) return {};
  for (const std::string& name : names) {
    std::istringstream folders(path);
    for (std::string folder; std::getline(folders, folder, ':');) {
      if (folder.empty()) continue;
      const fs::path file = fs::path(folder) / name;
      if (fs::is_regular_file(file) && ::access(file.c_str(), X_OK) == 0) return file;
    }
  }
  return {};
}

void run_program(const fs::path& program,
                 const std::vector<std::string>& arguments,
                 const fs::path& log) {
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const FileActions actions(log);
  ::pid_t child = 0;
  if (const int error =
          ::posix_spawn(&child, program.c_str(), actions.get(), nullptr, argv.data(), environ);
      error != 0) {
    throw IoError(program.string() + ": cannot be started: " + std::strerror(error));
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) throw IoError(program.string() + ": was lost");
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  std::string what = program.filename().string();
  for (std::size_t i = 0; i < std::min<std::size_t>(2, arguments.size()); ++i) {
    what += " " + arguments[i];
  }
  throw IoError(what + (WIFSIGNALED(status) ? " was stopped" : " failed") + ":" + last_lines(log));
}

}  // namespace carpus::cli

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/bench_peers_command.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cli/child_program.hpp"
#include "core/error.hpp"

namespace carpus::cli {
namespace {

/// Becomes carpus-bench; returns only by an exception.
void become_bench(const std::string& what, const std::vector<std::string>& arguments) {
  const auto program = own_program().parent_path() / "carpus-bench";
  std::vector<std::string> words{program.string(), what};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  execv(program.c_str(), argv.data());
  throw IoError(program.string() +
                ": cannot be started. It is built where the libraries that it compares with are "
                "installed; in the project's folder run: tools/install bench && cmake --preset "
                "release && cmake --build build/release --target carpus-bench");
}

}  // namespace

void add_bench_peers_command(CLI::App& bench) {
  for (const auto& [name, what] :
       {std::pair{"hull", "Convex hulls against Qhull, CGAL and Bullet"},
        std::pair{"collision", "Convex bodies in contact against FCL, libccd, Bullet, GLPK, CLP"},
        std::pair{"imaging", "Watershed and gradient against ITK, surfaces against VTK"},
        std::pair{"fluoroscopy", "Pictures of moving bones: how exact, how many a second"}}) {
    CLI::App* verb = bench.add_subcommand(name, what);
    verb->set_help_flag();  // carpus-bench answers --help
    verb->prefix_command();
    verb->callback([verb] { become_bench(verb->get_name(), verb->remaining()); });
  }
}

}  // namespace carpus::cli
